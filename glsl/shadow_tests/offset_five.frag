#version 330 core
// The offset test, with five taps: the texel around the point and one on each side; their mean.

bool is_lit(ivec2 texel, vec2 within, float depth, vec2 slope);

float share_of_texels(vec2 within, float depth, vec2 slope)
{
    ivec2 texel = ivec2(within);
    vec4 lit = vec4(
        is_lit(texel - ivec2(1, 0), within, depth, slope), is_lit(texel + ivec2(1, 0), within, depth, slope),
        is_lit(texel - ivec2(0, 1), within, depth, slope), is_lit(texel + ivec2(0, 1), within, depth, slope));
    return (dot(lit, vec4(1)) + float(is_lit(texel, within, depth, slope))) / 5;
}
