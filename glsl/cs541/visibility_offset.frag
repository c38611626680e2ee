#version 330 core
// The shadow test of lighting_offset.frag alone: 1 is lit, 0 is in shadow. A test holds the two files equal. What faces
// away from the light is asked about here, too.

in vec3 position_lcs;

const int NO_BEAM = 0, RECTANGULAR = 1, CIRCULAR = 2;
uniform int beam;

out vec4 frag_color;

// A map that is fitted to what casts; it and its test are in shadow_tests/offset.frag.
struct FittedMap {
    sampler2D depths;
    vec4 rectangle;
    vec4 nearness;
};
uniform FittedMap fitted_map;
float light_share_of_source(FittedMap fitted_map, vec3 position_lcs, vec3 normal_lcs);

void main(void)
{
    bool inside_beam = position_lcs.z < 0
        && abs(position_lcs.x) <= -position_lcs.z && abs(position_lcs.y) <= -position_lcs.z;
    if (beam == CIRCULAR)
        inside_beam = inside_beam && length(position_lcs.xy) <= -position_lcs.z;

    vec3 normal_lcs = cross(dFdx(position_lcs), dFdy(position_lcs));
    bool in_shadow = false;
    if (inside_beam || beam == NO_BEAM)
        in_shadow = light_share_of_source(fitted_map, position_lcs, normal_lcs) < 0.5;

    frag_color = vec4(vec3(in_shadow ? 0 : 1), 1);
}
