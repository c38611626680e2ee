#version 330 core
// The intermediate values of FragmentShaderCode.glsl's shadow test, for `shadowlab explain`. A frame buffer holds bytes:
// each drawing shows one value, the 32 bits of the float as the four bytes of the color.

in vec3 Position_worldspace;
in vec3 Normal_worldspace;
in vec4 ShadowCoord;

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

// Counted from 1: what the clear color leaves is no object.
uniform int objectNumber;
// Which of the values below.
uniform int valueNumber;

out vec4 color;

void main()
{
    vec3 n = normalize(Normal_worldspace);
    vec3 l = lightInvDir;

    float bias = stage == NO_BIAS ? 0.0 : biasValue;
    float cosTheta = clamp(dot(n, l), 0.001, 1.0);
    if (stage == SLOPE) {
        bias = biasValue * tan(acos(cosTheta));
        bias = clamp(bias, 0.0, 2 * biasValue);
    }

    float stored[5];
    vec2 texel = 1.0 / vec2(textureSize(shadowMap, 0));
    for (int i = 0; i < 5; i++)
        stored[i] = texture(shadowMap, ShadowCoord.xy + taps[i] * texel).z;

    float visibility = 1.0;
    if (texture(shadowMap, ShadowCoord.xy).z < ShadowCoord.z - bias) {
        visibility = 0.5;
    }
    if (stage == PCF) {
        visibility = 1.0;
        for (int i = 0; i < 5; i++) {
            if (stored[i] < ShadowCoord.z - bias)
                visibility -= 0.1;
        }
    }
    if (!shadows)
        visibility = 1.0;

    float values[17] = float[17](
        objectNumber, gl_PrimitiveID,
        Position_worldspace.x, Position_worldspace.y, Position_worldspace.z,
        ShadowCoord.x, ShadowCoord.y, ShadowCoord.z,
        cosTheta, bias, ShadowCoord.z - bias,
        stored[0], stored[1], stored[2], stored[3], stored[4], visibility);
    uint bits = floatBitsToUint(values[valueNumber]);
    uvec4 bytes = uvec4(bits, bits >> 8, bits >> 16, bits >> 24) & 255u;
    color = vec4(bytes) / 255.0;
}
