#version 330 core
// The offset test, with nine taps: the texel around the point and the eight around that; their mean.

// As offset.frag declares it.
struct FittedMap {
    sampler2D depths;
    vec4 rectangle;
    vec4 nearness;
};
bool is_lit(FittedMap fitted_map, ivec2 texel, vec2 within, float depth, vec2 slope);

float share_of_texels(FittedMap fitted_map, vec2 within, float depth, vec2 slope)
{
    float lit = 0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            lit += float(is_lit(fitted_map, ivec2(within) + ivec2(x, y), within, depth, slope));
    return lit / 9;
}
