#version 330 core
// Second pass: per-pixel lighting, combined with the shadow-map information of each enabled light.

in vec3 eyePosition;
in vec3 eyeNormal;
// The input color.
in vec3 C_in;
in vec4 directionalCoord;
in vec4 spotCoord;

// The global ambient light level.
uniform vec3 A;
uniform bool shadows;

// The directional light; in eye space, of length 1, and towards the light.
uniform bool directionalEnabled;
uniform vec3 directionalAmbient;
uniform vec3 directionalDiffuse;
uniform vec3 directionalDirection;
uniform sampler2D directionalMap;
uniform float directionalBias;

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
uniform sampler2D spotMap;
uniform float spotBias;

out vec4 C_out;

// S_l: 0.5 when the pixel is in shadow and 1.0 otherwise.
float S(sampler2D shadowMap, vec4 coord, float bias)
{
    if (!shadows)
        return 1.0;
    vec3 place = coord.xyz / coord.w;
    // Where the map is empty it holds 1, and nothing beyond the far plane is in shadow there.
    float depth = min(place.z, 1.0);
    return texture(shadowMap, place.xy).r < depth - bias ? 0.5 : 1.0;
}

void main()
{
    vec3 N = normalize(eyeNormal);
    vec3 sum = vec3(0.0);

    if (directionalEnabled) {
        vec3 A_l = directionalAmbient;
        vec3 D_l = directionalDiffuse * max(dot(N, directionalDirection), 0.0);
        float S_l = S(directionalMap, directionalCoord, directionalBias);
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
            float S_l = S(spotMap, spotCoord, spotBias);
            sum += S_l * (A_l + D_l);
        }
    }

    C_out = vec4(C_in * max(A, clamp(sum, 0.0, 1.0)), 1.0);
}
