#version 330 core
// The offset test: a depth map that is fitted to what casts, and whose depths glPolygonOffset has put farther from the
// light. Nothing is subtracted here. It is asked in the light's coordinate system: the light looks along -z. See
// src/shadow_tests/offset.

struct FittedMap {
    sampler2D depths;
    // What the map lies over: its corner, and how many texels there are to a unit, across and up.
    vec4 rectangle;
    // The depth that the map has of a nearness: x - y*nearness. Nearness is 1/depth or, where rays are parallel, z. And y
    // for a gain in nearness, across and up, in depth per texel.
    vec4 nearness;
};

// Which texels are asked: offset_one.frag, offset_five.frag or offset_nine.frag.
float share_of_texels(FittedMap fitted_map, vec2 within, float depth, vec2 slope);

// `slope` is what the surface gains in depth from texel to texel, across and up.
bool is_lit(FittedMap fitted_map, ivec2 texel, vec2 within, float depth, vec2 slope)
{
    texel = clamp(texel, ivec2(0), textureSize(fitted_map.depths, 0) - 1);
    float stored = texelFetch(fitted_map.depths, texel, 0).r;
    // The map knows one point of each texel, its centre. Where the surface is no nearer to the light there than the
    // map's, it is no caster that stands before it; nor where it is not behind it here.
    float depth_at_centre = depth + dot(slope, vec2(texel) + 0.5 - within);
    return depth_at_centre <= stored || depth <= stored;
}

// The share of the light that arrives. `nearness_slope` is what the surface gains in nearness along x and y.
float light_share(FittedMap fitted_map, vec2 place, float nearness, vec2 nearness_slope)
{
    vec2 within = (place - fitted_map.rectangle.xy) * fitted_map.rectangle.zw;
    // Where there is no map there is no caster.
    if (any(lessThan(within, vec2(0))) || any(greaterThan(within, vec2(textureSize(fitted_map.depths, 0)))))
        return 1.0;
    float depth = fitted_map.nearness.x - fitted_map.nearness.y * nearness;
    vec2 slope = -fitted_map.nearness.zw * nearness_slope;
    return share_of_texels(fitted_map, within, depth, slope);
}

// A light that shines from the origin. `normal_lcs` is that of the triangle, of any length and either way round: a
// smoothed one belongs to another plane.
float light_share_of_source(FittedMap fitted_map, vec3 position_lcs, vec3 normal_lcs)
{
    if (position_lcs.z >= 0)
        return 1.0;
    float nearness = -1 / position_lcs.z;
    vec2 slope = normal_lcs.xy / dot(normal_lcs, position_lcs);
    return light_share(fitted_map, position_lcs.xy * nearness, nearness, slope);
}

// Parallel rays, along -z.
float light_share_of_rays(FittedMap fitted_map, vec3 position_lcs, vec3 normal_lcs)
{
    return light_share(fitted_map, position_lcs.xy, position_lcs.z, -normal_lcs.xy / normal_lcs.z);
}
