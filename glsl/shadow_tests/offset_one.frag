#version 330 core
// The offset test, with one tap: the texel around the point.

// As offset.frag declares it.
struct FittedMap {
    sampler2D depths;
    vec4 rectangle;
    vec4 nearness;
};
bool is_lit(FittedMap fitted_map, ivec2 texel, vec2 within, float depth, vec2 slope);

float share_of_texels(FittedMap fitted_map, vec2 within, float depth, vec2 slope)
{
    return is_lit(fitted_map, ivec2(within), within, depth, slope) ? 1.0 : 0.0;
}
