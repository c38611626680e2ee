#version 330 core
// The exact test: whether a triangle stands between a point and the light. It is asked of the light buffer, in the
// light's coordinate system: the light looks along -z. See src/shadow_tests/exact.

struct LightBuffer {
    // For each cell: nearer than .x all is lit, farther than .y all is dark (both as nearness, in the bits of a float);
    // its list is the nodes from .z to .w.
    usamplerBuffer cells;
    // A node is a plane, in the bits of floats, with the node where to go on if the ray is on its positive side. First
    // three for each triangle: the planes through the light and its edges. Then the lists: the planes of casters, which
    // lead to their edges; and, in long ones, planes that lead past some of the list.
    isamplerBuffer nodes;
    // What the cells lie over: its corner, and how many cells there are to a unit, across and up.
    vec4 rectangle;
    // Cells on each side.
    int side;
};

// Where the last edge leads to: behind all nodes. And the bits of every place to go on.
const int DARK = 0x3fffffff;
// In a list, beside where to go on: the caster faces the light.
const int FACES_LIGHT = int(0x80000000);
// Or: it is no caster's plane, but one through the light, as those of edges are.
const int SLAB = 0x40000000;

// A point lies in a plane that it is no farther from than this, as a share of the largest terms: some 160 roundings, since
// drivers interpolate over a whole triangle. And two planes that differ by less than this, as a share, are one.
const float IN_PLANE = 1e-5, ONE_PLANE = 0.1;

// `ray` leads from the light through the point; on a caster's plane its product with the plane is `reach`. So it is on
// `own_plane`, the point's own triangle's. Nearness is 1/depth or, where rays are parallel, z.
bool is_in_shadow(LightBuffer light_buffer, int face, vec2 place, float nearness, vec3 ray, float reach, vec3 own_plane)
{
    vec2 within = (place - light_buffer.rectangle.xy) * light_buffer.rectangle.zw;
    // Where there is no cell there is no caster.
    bool outside = any(lessThan(within, vec2(0))) || any(greaterThan(within, vec2(light_buffer.side)));
    ivec2 column_and_row = clamp(ivec2(within), 0, light_buffer.side - 1);
    int cell = (face * light_buffer.side + column_and_row.y) * light_buffer.side + column_and_row.x;

    uvec4 content = texelFetch(light_buffer.cells, cell);
    bool lit = outside || nearness > uintBitsToFloat(content.x);
    bool dark = !lit && nearness < uintBitsToFloat(content.y);

    // A point is not behind its own triangle, which the list may have if that faces the light: it is in its plane.
    float own_reach = reach + IN_PLANE * (1 + dot(abs(own_plane), abs(ray)));
    float apart = ONE_PLANE * ONE_PLANE * dot(own_plane, own_plane);

    // One plane in each round, and not one caster: pixels that are drawn together wait for each other, and most of them
    // need no round at all. For the same reason a round is short, and fetches once. Where a ray passes an edge on the
    // wrong side, the list goes on; lists are behind all edges.
    int first = int(content.z);
    int end = int(content.w);
    int at = lit || dark ? end : first;
    int next = first;
    while (at < end) {
        ivec4 node = texelFetch(light_buffer.nodes, at);
        vec3 plane = intBitsToFloat(node.xyz);
        float product = dot(plane, ray);
        vec3 difference = plane - own_plane;
        bool own = node.w < 0 && product < own_reach && dot(difference, difference) < apart;
        next = max(next, at + 1);
        bool through_light = at < first || (node.w & SLAB) != 0;
        at = product >= (through_light ? 0 : reach) && !own ? node.w & DARK : next;
    }
    return dark || at == DARK;
}

// Whether the point's own triangle turns its back to the light: then it is in its own shadow, however its normals are
// smoothed. Not where that is hard to say.
bool faces_away(vec3 normal_lcs, vec3 ray)
{
    float cosine = dot(normal_lcs, ray) * inversesqrt(dot(normal_lcs, normal_lcs) * dot(ray, ray));
    return (gl_FrontFacing ? cosine : -cosine) > 1e-3;
}

// A light that shines from the origin: in a beam along -z, or in all directions, with six faces of cells around it.
// `normal_lcs` is that of the triangle, of any length, on the side that is seen.
bool is_in_shadow_of_source(LightBuffer light_buffer, vec3 position_lcs, bool all_directions, vec3 normal_lcs)
{
    vec3 size = abs(position_lcs);
    int axis = 2;
    if (all_directions && max(size.x, size.y) > size.z)
        axis = size.x > size.y ? 0 : 1;
    vec3 turned = axis == 0 ? position_lcs.yzx : axis == 1 ? position_lcs.zxy : position_lcs.xyz;
    int face = all_directions ? 2*axis + (turned.z < 0 ? 1 : 0) : 0;
    float nearness = 1 / abs(turned.z);
    vec3 own_plane = normal_lcs / dot(normal_lcs, position_lcs);
    return faces_away(normal_lcs, position_lcs)
        || is_in_shadow(light_buffer, face, turned.xy * nearness, nearness, position_lcs, 1, own_plane);
}

// Parallel rays, along -z.
bool is_in_shadow_of_rays(LightBuffer light_buffer, vec3 position_lcs, vec3 normal_lcs)
{
    vec3 ray = vec3(position_lcs.xy, -1);
    vec3 own_plane = vec3(normal_lcs.xy, dot(normal_lcs, position_lcs)) / -normal_lcs.z;
    return faces_away(normal_lcs, vec3(0, 0, -1))
        || is_in_shadow(light_buffer, 0, position_lcs.xy, position_lcs.z, ray, position_lcs.z, own_plane);
}
