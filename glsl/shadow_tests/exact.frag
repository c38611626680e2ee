#version 330 core
// The exact test: whether a triangle stands between a point and the light. It is asked of the light buffer, in the
// light's coordinate system: the light looks along -z. See src/shadow_tests/exact.

struct LightBuffer {
    // For each cell: nearer than .x all is lit, farther than .y all is dark (both as nearness, in the bits of a float);
    // its list is the nodes from .z to .w.
    usamplerBuffer cells;
    // A node is a plane, in the bits of floats, with the node where to go on if the ray is on its positive side. First
    // three for each triangle: the planes through the light and its edges. Then the lists: the planes of casters, which
    // lead to their edges.
    isamplerBuffer nodes;
    // What the cells lie over: its corner, and how many cells there are to a unit, across and up.
    vec4 rectangle;
    // Cells on each side.
    int side;
};

// Where the last edge leads to: behind all nodes.
const int DARK = 0x7fffffff;
// In a list, beside where to go on: the caster faces the light.
const int FACES_LIGHT = int(0x80000000);

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

    // A point is not behind its own triangle; but if that faces away, it is in its own shadow, however its normals are
    // smoothed.
    int own = 3*triangle;
    // One plane in each round, and not one caster: pixels that are drawn together wait for each other, and most of them
    // need no round at all. For the same reason a round is short, and fetches once. Where a ray passes an edge on the
    // wrong side, the list goes on; lists are behind all edges.
    int first = int(content.z);
    int end = int(content.w);
    int at = lit || dark ? end : first;
    int next = first;
    while (at < end) {
        ivec4 node = texelFetch(light_buffer.nodes, at);
        float product = dot(intBitsToFloat(node.xyz), ray);
        bool passed = product >= (at < first ? 0 : reach) && node.w != (own | FACES_LIGHT);
        next = max(next, at + 1);
        at = node.w == own ? DARK : passed ? node.w & ~FACES_LIGHT : next;
    }
    return dark || at == DARK;
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
