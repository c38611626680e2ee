#version 330 core
// lighting.frag with the exact shadow test in place of the handout's. A test holds the two files equal but for that.

in vec3 eyePosition;
in vec3 eyeNormal;
// The input color.
in vec3 C_in;
// In each light's coordinate system.
in vec3 directionalCoord;
in vec3 spotCoord;

// The global ambient light level.
uniform vec3 A;

// The directional light; in eye space, of length 1, and towards the light.
uniform bool directionalEnabled;
uniform vec3 directionalAmbient;
uniform vec3 directionalDiffuse;
uniform vec3 directionalDirection;

// The spotlight, in eye space; its direction has length 1, and is the way that it shines.
uniform bool spotEnabled;
uniform vec3 spotAmbient;
uniform vec3 spotDiffuse;
uniform vec3 spotPosition;
uniform vec3 spotDirection;
uniform float spotCosCutoff;
uniform float spotExponent;
// Constant, linear, quadratic.
uniform vec3 spotAttenuation;

out vec4 C_out;

// Which triangles each ray of a light can meet; it and its test are in shadow_tests/exact.frag.
struct LightBuffer {
    usamplerBuffer cells;
    isamplerBuffer nodes;
    vec4 rectangle;
    int side;
};
uniform LightBuffer directionalBuffer;
uniform LightBuffer spotBuffer;
bool is_in_shadow_of_rays(LightBuffer light_buffer, vec3 position_lcs, vec3 normal_lcs);
bool is_in_shadow_of_source(LightBuffer light_buffer, vec3 position_lcs, bool all_directions, vec3 normal_lcs);

// S_l: 0.5 when the pixel is in shadow and 1.0 otherwise.
float S(bool in_shadow)
{
    return in_shadow ? 0.5 : 1.0;
}

void main()
{
    vec3 N = normalize(eyeNormal);
    vec3 sum = vec3(0.0);
    // The triangle's normal, for each light.
    vec3 directionalNormal = cross(dFdx(directionalCoord), dFdy(directionalCoord));
    vec3 spotNormal = cross(dFdx(spotCoord), dFdy(spotCoord));

    if (directionalEnabled) {
        vec3 A_l = directionalAmbient;
        vec3 D_l = directionalDiffuse * max(dot(N, directionalDirection), 0.0);
        float S_l = S(is_in_shadow_of_rays(directionalBuffer, directionalCoord, directionalNormal));
        sum += S_l * (A_l + D_l);
    }

    if (spotEnabled) {
        vec3 L = spotPosition - eyePosition;
        float d = length(L);
        L /= d;
        float spotDot = dot(-L, spotDirection);
        // Outside the cone of light, A_l + D_l = 0.
        if (spotDot >= spotCosCutoff) {
            float attenuation = pow(spotDot, spotExponent) / dot(spotAttenuation, vec3(1.0, d, d * d));
            vec3 A_l = attenuation * spotAmbient;
            vec3 D_l = attenuation * spotDiffuse * max(dot(N, L), 0.0);
            float S_l = S(is_in_shadow_of_source(spotBuffer, spotCoord, false, spotNormal));
            sum += S_l * (A_l + D_l);
        }
    }

    C_out = vec4(C_in * max(A, clamp(sum, 0.0, 1.0)), 1.0);
}
