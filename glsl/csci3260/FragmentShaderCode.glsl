#version 330 core
// Using the shadow map: the extra test whether the fragment is in the shadow, and the shading that it modifies.

in vec3 Position_worldspace;
in vec3 Normal_worldspace;
in vec2 UV;
// DEVIATES: ShadowCoord, the slides declare `shadow_vertexPosition` here, which their vertex shader does not write.
in vec4 ShadowCoord;

uniform sampler2D objTexture;
// The calculated shadow map.
uniform sampler2D shadowMap;

// The stages of the slides, as far as they differ here.
const int NO_BIAS = 0, CONSTANT = 1, SLOPE = 2, PCF = 3;
uniform int stage;
uniform float biasValue;
uniform bool shadows;
// Towards the light, of length 1.
uniform vec3 lightInvDir;

// PCF: the fragment's own texel and one on each side, so that the blur grows with the texels.
const vec2 taps[5] = vec2[](vec2(0, 0), vec2(-1, 0), vec2(1, 0), vec2(0, -1), vec2(0, 1));

// What a full shadow leaves of the specular light; of the diffuse light it leaves 0.5.
uniform float specularVisibility;

uniform vec3 materialColor;
uniform vec3 MaterialSpecularColor;
uniform vec3 AmbientLightColor;
uniform vec3 DiffuseLightColor;
uniform vec3 SpecularLightColor;

out vec4 color;

void main()
{
    vec3 n = normalize(Normal_worldspace);
    vec3 l = lightInvDir;

    // A bias: we only shade if the current fragment's depth is really far away from the lightmap value.
    float bias = stage == NO_BIAS ? 0.0 : biasValue;
    if (stage == SLOPE) {
        // DEVIATES: cosTheta, clamped to a little above 0: tan(acos(0)) is huge or negative, as the driver rounds.
        float cosTheta = clamp(dot(n, l), 0.001, 1.0);
        bias = biasValue * tan(acos(cosTheta));
        bias = clamp(bias, 0.0, 2 * biasValue);
    }

    float visibility = 1.0;
    if (texture(shadowMap, ShadowCoord.xy).z < ShadowCoord.z - bias) {
        visibility = 0.5;
    }
    if (stage == PCF) {
        // The mean of five tests.
        visibility = 1.0;
        vec2 texel = 1.0 / vec2(textureSize(shadowMap, 0));
        for (int i = 0; i < 5; i++) {
            if (texture(shadowMap, ShadowCoord.xy + taps[i] * texel).z < ShadowCoord.z - bias)
                visibility -= 0.1;
        }
    }
    if (!shadows)
        visibility = 1.0;
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
