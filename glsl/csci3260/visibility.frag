#version 330 core
// The shadow test of FragmentShaderCode.glsl alone: 1 is lit, 0 is in full shadow, where `visibility` is 0.5. A test
// holds the two files equal.

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

out vec4 color;

void main()
{
    vec3 n = normalize(Normal_worldspace);
    vec3 l = lightInvDir;

    float bias = stage == NO_BIAS ? 0.0 : biasValue;
    if (stage == SLOPE) {
        float cosTheta = clamp(dot(n, l), 0.001, 1.0);
        bias = biasValue * tan(acos(cosTheta));
        bias = clamp(bias, 0.0, 2 * biasValue);
    }

    float visibility = 1.0;
    if (texture(shadowMap, ShadowCoord.xy).z < ShadowCoord.z - bias) {
        visibility = 0.5;
    }
    if (stage == PCF) {
        visibility = 1.0;
        vec2 texel = 1.0 / vec2(textureSize(shadowMap, 0));
        for (int i = 0; i < 5; i++) {
            if (texture(shadowMap, ShadowCoord.xy + taps[i] * texel).z < ShadowCoord.z - bias)
                visibility -= 0.1;
        }
    }
    if (!shadows)
        visibility = 1.0;

    color = vec4(vec3((visibility - 0.5) / 0.5), 1);
}
