#version 330 core
// The intermediate values of the shadow test, for `shadowlab explain`. A frame buffer holds bytes: each drawing shows one
// value, the 32 bits of the float as the four bytes of the color.

in vec3 position_ecs;
in vec2 texcoord;

uniform sampler2D uniform_sampler_diffuse;
// Which of the three functions gives the shadow_factor.
const int NONE = 0, PCF_5 = 1, PCF_9 = 2;
uniform int uniform_filter;

uniform sampler2D uniform_sampler_shadow_map;
uniform float constant_depth_bias;
uniform float uniform_sample_step;

// These are in is_point_in_shadow.frag.
vec4 to_light_space(vec3 position_ecs);
float is_point_in_shadow(vec4 position_lcs);
float is_point_in_shadow_pcf_5(vec4 position_lcs);
float is_point_in_shadow_pcf_9(vec4 position_lcs);

// Center, top, bottom, left, right, and the diagonals.
const vec2 offsets[9] = vec2[](
    vec2(0, 0), vec2(0, 1), vec2(0, -1), vec2(-1, 0), vec2(1, 0),
    vec2(-1, 1), vec2(1, 1), vec2(-1, -1), vec2(1, -1));

// Counted from 1: what the clear color leaves is no object.
uniform int object_number;
// Which of the values below.
uniform int value_number;

out vec4 out_color;

void main(void)
{
    if (texture(uniform_sampler_diffuse, texcoord).a < 1.0)
        discard;

    vec4 position_lcs = to_light_space(position_ecs);
    float shadow_factor;
    if (uniform_filter == PCF_9)
        shadow_factor = is_point_in_shadow_pcf_9(position_lcs);
    else if (uniform_filter == PCF_5)
        shadow_factor = is_point_in_shadow_pcf_5(position_lcs);
    else
        shadow_factor = is_point_in_shadow(position_lcs);

    float stored[9];
    float visible[9];
    vec2 s = uniform_sample_step / vec2(textureSize(uniform_sampler_shadow_map, 0));
    for (int i = 0; i < 9; i++) {
        vec2 offset = s * offsets[i];
        stored[i] = texture(uniform_sampler_shadow_map, position_lcs.xy + offset).r;
        visible[i] = is_point_in_shadow(position_lcs + vec4(offset, 0.0, 0.0));
    }

    float values[29] = float[29](
        object_number, gl_PrimitiveID,
        position_ecs.x, position_ecs.y, position_ecs.z,
        position_lcs.x, position_lcs.y, position_lcs.z, position_lcs.w,
        position_lcs.z - constant_depth_bias,
        stored[0], stored[1], stored[2], stored[3], stored[4], stored[5], stored[6], stored[7], stored[8],
        visible[0], visible[1], visible[2], visible[3], visible[4], visible[5], visible[6], visible[7], visible[8],
        shadow_factor);
    uint bits = floatBitsToUint(values[value_number]);
    uvec4 bytes = uvec4(bits, bits >> 8, bits >> 16, bits >> 24) & 255u;
    out_color = vec4(bytes) / 255.0;
}
