#version 330 core
// The exact test: whether a triangle stands between a point and the light. It is asked of the light buffer, in the
// light's coordinate system: the light looks along -z. See src/shadow_tests/exact.

struct LightBuffer {
    // For each cell: nearer than .x all is lit, farther than .y all is dark (both as nearness, in the bits of a float);
    // its list of casters begins at .z and has .w entries.
    usamplerBuffer cells;
    usamplerBuffer lists;
    // For each caster four planes as a ray is tested against them: its own, and those through the light and each of its
    // edges. With the first one comes the triangle's number, from 1, negative where it faces away from the light.
    samplerBuffer casters;
    // What the cells lie over: its corner, and how many cells there are to a unit, across and up.
    vec4 rectangle;
    // Cells on each side.
    int side;
};

// `ray` leads from the light through the point; on a caster's plane its product with the plane is `reach`. Nearness is
// 1/depth or, where rays are parallel, z.
bool is_in_shadow(LightBuffer light_buffer, int face, vec2 place, float nearness, vec3 ray, float reach, int triangle)
{
    vec2 within = (place - light_buffer.rectangle.xy) * light_buffer.rectangle.zw;
    // Where there is no cell there is no caster.
    bool outside = any(lessThan(within, vec2(0))) || any(greaterThan(within, vec2(light_buffer.side)));
    ivec2 column_and_row = clamp(ivec2(within), 0, light_buffer.side - 1);
    int cell = (face * light_buffer.side + column_and_row.y) * light_buffer.side + column_and_row.x;

    uvec4 content = texelFetch(light_buffer.cells, cell);
    bool lit = outside || nearness > uintBitsToFloat(content.x);
    bool dark = !lit && nearness < uintBitsToFloat(content.y);

    // One plane in each round, and not one caster: pixels that are drawn together wait for each other, and most of them
    // need no round at all.
    int entry = int(content.z);
    int end = lit || dark ? entry : entry + int(content.w);
    int step = 0;
    while (entry < end) {
        int caster = int(texelFetch(light_buffer.lists, entry).x);
        vec4 plane = texelFetch(light_buffer.casters, 4*caster + step);
        float product = dot(plane.xyz, ray);
        bool passed = step == 0 ? product > reach : product >= 0;
        // A point is not behind its own triangle; but if that faces away, it is in its own shadow, however its normals
        // are smoothed.
        int number = int(plane.w);
        bool own = abs(number) == triangle + 1;
        dark = own ? number < 0 : passed && step == 3;
        step = passed && !own ? step + 1 : 0;
        entry = dark ? end : step > 0 ? entry : entry + 1;
    }
    return dark;
}

// A light that shines from the origin: in a beam along -z, or in all directions, with six faces of cells around it.
bool is_in_shadow_of_source(LightBuffer light_buffer, vec3 position_lcs, bool all_directions, int triangle)
{
    vec3 size = abs(position_lcs);
    int axis = 2;
    if (all_directions && max(size.x, size.y) > size.z)
        axis = size.x > size.y ? 0 : 1;
    vec3 turned = axis == 0 ? position_lcs.yzx : axis == 1 ? position_lcs.zxy : position_lcs.xyz;
    int face = all_directions ? 2*axis + (turned.z < 0 ? 1 : 0) : 0;
    float nearness = 1 / abs(turned.z);
    return is_in_shadow(light_buffer, face, turned.xy * nearness, nearness, position_lcs, 1, triangle);
}

// Parallel rays, along -z.
bool is_in_shadow_of_rays(LightBuffer light_buffer, vec3 position_lcs, int triangle)
{
    vec3 ray = vec3(position_lcs.xy, -1);
    return is_in_shadow(light_buffer, 0, position_lcs.xy, position_lcs.z, ray, position_lcs.z, triangle);
}
