#version 330 core
// The offset test, with one tap: the texel around the point.

bool is_lit(ivec2 texel, vec2 within, float depth, vec2 slope);

float share_of_texels(vec2 within, float depth, vec2 slope)
{
    return is_lit(ivec2(within), within, depth, slope) ? 1.0 : 0.0;
}
