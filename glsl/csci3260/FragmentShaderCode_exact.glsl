#version 330 core
// FragmentShaderCode.glsl with the exact shadow test in place of the slides'. A test holds the two files equal but for
// that.

in vec3 Position_worldspace;
in vec3 Normal_worldspace;
in vec2 UV;
// In the light's coordinate system: the light shines along -z.
in vec4 ShadowCoord;

uniform sampler2D objTexture;
// Towards the light, of length 1.
uniform vec3 lightInvDir;

// What a full shadow leaves of the specular light; of the diffuse light it leaves 0.5.
uniform float specularVisibility;

uniform vec3 materialColor;
uniform vec3 MaterialSpecularColor;
uniform vec3 AmbientLightColor;
uniform vec3 DiffuseLightColor;
uniform vec3 SpecularLightColor;

out vec4 color;

// Which triangles each ray of the light can meet; it and its test are in shadow_tests/exact.frag.
struct LightBuffer {
    usamplerBuffer cells;
    isamplerBuffer nodes;
    vec4 rectangle;
    int side;
};
uniform LightBuffer light_buffer;
bool is_in_shadow_of_rays(LightBuffer light_buffer, vec3 position_lcs, vec3 normal_lcs);

void main()
{
    vec3 n = normalize(Normal_worldspace);
    vec3 l = lightInvDir;

    // Is there a triangle between the fragment and the light? What is dark anyway is not asked about.
    vec3 normal_lcs = cross(dFdx(ShadowCoord.xyz), dFdy(ShadowCoord.xyz));
    float visibility = 1.0;
    if (dot(n, l) > 0) {
        if (is_in_shadow_of_rays(light_buffer, ShadowCoord.xyz, normal_lcs))
            visibility = 0.5;
    }
    // Can set different visibilities to diffuse and specular light.
    float visibilitySpecular = mix(specularVisibility, 1.0, (visibility - 0.5) / 0.5);

    vec3 MaterialDiffuseColor = materialColor * texture(objTexture, UV).rgb;
    vec3 MaterialAmbientColor = MaterialDiffuseColor;
    float DiffuseBrightness = clamp(dot(n, l), 0.0, 1.0);
    // The eye is the origin. A face that is turned away from the light mirrors nothing of it.
    vec3 E = normalize(-Position_worldspace);
    float SpecularBrightness = DiffuseBrightness > 0.0 ? clamp(dot(E, reflect(-l, n)), 0.0, 1.0) : 0.0;

    color = vec4(
        // Ambient: shadow mapping has no effect on ambient light
        MaterialAmbientColor * AmbientLightColor +
        // Diffuse and specular: each by its visibility
        visibility * MaterialDiffuseColor * DiffuseLightColor * DiffuseBrightness +
        visibilitySpecular * MaterialSpecularColor * SpecularLightColor * pow(SpecularBrightness, 50.0), 1);
}
