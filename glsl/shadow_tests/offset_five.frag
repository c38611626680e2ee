#version 330 core
// The offset test, with five taps: the texel around the point and one on each side; their mean.

// As offset.frag declares it.
struct FittedMap {
    sampler2D depths;
    vec4 rectangle;
    vec4 nearness;
};
bool is_lit(FittedMap fitted_map, ivec2 texel, vec2 within, float depth, vec2 slope);

float share_of_texels(FittedMap fitted_map, vec2 within, float depth, vec2 slope)
{
    ivec2 texel = ivec2(within);
    vec4 lit = vec4(
        is_lit(fitted_map, texel - ivec2(1, 0), within, depth, slope),
        is_lit(fitted_map, texel + ivec2(1, 0), within, depth, slope),
        is_lit(fitted_map, texel - ivec2(0, 1), within, depth, slope),
        is_lit(fitted_map, texel + ivec2(0, 1), within, depth, slope));
    return (dot(lit, vec4(1)) + float(is_lit(fitted_map, texel, within, depth, slope))) / 5;
}
