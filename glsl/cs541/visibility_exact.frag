#version 330 core
// The shadow test of lighting_exact.frag alone: 1 is lit, 0 is in shadow. A test holds the two files equal. What faces
// away from the light is asked about here, too, and is in shadow.

in vec3 position_lcs;


const int NO_BEAM = 0, RECTANGULAR = 1, CIRCULAR = 2;
uniform int beam;

out vec4 frag_color;

// Which triangles each ray of the light can meet; it and its test are in shadow_tests/exact.frag.
struct LightBuffer {
    usamplerBuffer cells;
    isamplerBuffer nodes;
    vec4 rectangle;
    int side;
};
uniform LightBuffer light_buffer;
bool is_in_shadow_of_source(LightBuffer light_buffer, vec3 position_lcs, bool all_directions, vec3 normal_lcs);

void main(void)
{
    bool inside_beam = position_lcs.z < 0
        && abs(position_lcs.x) <= -position_lcs.z && abs(position_lcs.y) <= -position_lcs.z;
    if (beam == CIRCULAR)
        inside_beam = inside_beam && length(position_lcs.xy) <= -position_lcs.z;

    vec3 normal_lcs = cross(dFdx(position_lcs), dFdy(position_lcs));
    bool in_shadow = false;
    if (inside_beam || beam == NO_BEAM)
        in_shadow = is_in_shadow_of_source(light_buffer, position_lcs, beam == NO_BEAM, normal_lcs);

    frag_color = vec4(vec3(in_shadow ? 0 : 1), 1);
}
