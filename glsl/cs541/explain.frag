#version 330 core
// The intermediate values of lighting.frag's shadow test, for `shadowlab explain`. A frame buffer holds bytes: each
// drawing shows one value, the 32 bits of the float as the four bytes of the color.

in vec3 light_vector;
in vec4 vshadow_position;

uniform sampler2D shadow_sampler;
uniform float epsilon;
uniform bool shadows;

const int NO_BEAM = 0, RECTANGULAR = 1, CIRCULAR = 2;
uniform int beam;

// Counted from 1: what the clear color leaves is no object.
uniform int object_number;
// Which of the values below.
uniform int value_number;

out vec4 frag_color;

void main(void)
{
    vec2 uv = vshadow_position.xy/vshadow_position.w;
    float shadow_depth = texture(shadow_sampler,uv).z;
    float point_depth = vshadow_position.z/vshadow_position.w;
    float own_depth = point_depth;
    point_depth = point_depth - epsilon;

    bool in_front = vshadow_position.w > 0;
    bool uv_inside = 0 <= uv.x && uv.x <= 1 && 0 <= uv.y && uv.y <= 1;
    bool inside_beam = in_front && uv_inside;
    if (beam == CIRCULAR)
        inside_beam = inside_beam && distance(uv, vec2(0.5)) <= 0.5;
    bool in_shadow = shadows && inside_beam && shadow_depth < point_depth;

    float values[16] = float[16](
        object_number, gl_PrimitiveID,
        light_vector.x, light_vector.y, light_vector.z,
        vshadow_position.x, vshadow_position.y, vshadow_position.z, vshadow_position.w,
        uv.x, uv.y, own_depth, point_depth, shadow_depth,
        (in_front ? 1 : 0) + (uv_inside ? 2 : 0) + (inside_beam ? 4 : 0), in_shadow ? 1 : 0);
    uint bits = floatBitsToUint(values[value_number]);
    uvec4 bytes = uvec4(bits, bits >> 8, bits >> 16, bits >> 24) & 255u;
    frag_color = vec4(bytes) / 255.0;
}
