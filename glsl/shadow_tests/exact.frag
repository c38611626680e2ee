#version 330 core
// The exact test: whether a triangle stands between a point and the light. It is asked of the light buffer, in the
// light's coordinate system: the light looks along -z. See src/shadow_tests/exact.

// For each cell: nearer than .x all is lit, farther than .y all is dark (both as nearness, in the bits of a float); its
// list of casters begins at .z and has .w entries.
uniform usamplerBuffer light_buffer_cells;
// First a bit for each triangle, whether it faces the light; then the lists.
uniform usamplerBuffer light_buffer_indices;
// For each caster four vectors: its plane, and the planes through the light and each of its edges. With the first one
// comes the caster's own number.
uniform samplerBuffer light_buffer_triangles;
// What the cells lie over: its corner, and how many cells there are to a unit, across and up.
uniform vec4 light_buffer_rectangle;
// Cells on each side.
uniform int light_buffer_side;

bool is_on_inner_side(int place, vec3 ray)
{
    return dot(texelFetch(light_buffer_triangles, place).xyz, ray) >= 0;
}

// `ray` leads from the light through the point; on a caster's plane its product with the plane is `reach`.
bool is_in_shadow(int face, vec2 place, float nearness, vec3 ray, float reach, int triangle)
{
    // A surface that faces away from the light is in its own shadow, however its normals are smoothed.
    uint facing = texelFetch(light_buffer_indices, triangle >> 5).x >> (triangle & 31);
    if ((facing & 1u) == 0u)
        return true;

    // Where there is no cell there is no caster.
    vec2 within = (place - light_buffer_rectangle.xy) * light_buffer_rectangle.zw;
    if (any(lessThan(within, vec2(0))) || any(greaterThan(within, vec2(light_buffer_side))))
        return false;
    ivec2 column_and_row = min(ivec2(within), light_buffer_side - 1);
    int cell = (face * light_buffer_side + column_and_row.y) * light_buffer_side + column_and_row.x;

    uvec4 content = texelFetch(light_buffer_cells, cell);
    if (nearness > uintBitsToFloat(content.x))
        return false;
    if (nearness < uintBitsToFloat(content.y))
        return true;
    int first = int(content.z), end = first + int(content.w);
    for (int i = first; i < end; i++) {
        int caster = 4 * int(texelFetch(light_buffer_indices, i).x);
        vec4 plane = texelFetch(light_buffer_triangles, caster);
        if (dot(plane.xyz, ray) > reach && int(plane.w) != triangle
            && is_on_inner_side(caster + 1, ray)
            && is_on_inner_side(caster + 2, ray)
            && is_on_inner_side(caster + 3, ray))
            return true;
    }
    return false;
}

// A light that shines from the origin: in a beam along -z, or in all directions, with six faces of cells around it.
bool is_in_shadow_of_source(vec3 position_lcs, bool all_directions, int triangle)
{
    vec3 size = abs(position_lcs);
    int axis = 2;
    if (all_directions && max(size.x, size.y) > size.z)
        axis = size.x > size.y ? 0 : 1;
    vec3 turned = axis == 0 ? position_lcs.yzx : axis == 1 ? position_lcs.zxy : position_lcs.xyz;
    int face = all_directions ? 2*axis + (turned.z < 0 ? 1 : 0) : 0;
    float nearness = 1 / abs(turned.z);
    return is_in_shadow(face, turned.xy * nearness, nearness, position_lcs, 1, triangle);
}

// Parallel rays, along -z.
bool is_in_shadow_of_rays(vec3 position_lcs, int triangle)
{
    vec3 ray = vec3(position_lcs.xy, -1);
    return is_in_shadow(0, position_lcs.xy, position_lcs.z, ray, position_lcs.z, triangle);
}
