#version 330 core
// The shadow_factor of SpotLight_exact.frag alone: 1 is lit, 0 is in full shadow. A test holds the two files equal. What
// faces away from the light is asked about here, too, and is in shadow.

in vec2 texcoord;
in vec3 position_lcs;

uniform sampler2D uniform_sampler_diffuse;

// What lies outside of the beam: 0 dark, 1 lit.
uniform float uniform_outside;

// Which triangles each ray of the light can meet; it and its test are in shadow_tests/exact.frag.
struct LightBuffer {
    usamplerBuffer cells;
    isamplerBuffer nodes;
    vec4 rectangle;
    int side;
};
uniform LightBuffer light_buffer;
bool is_in_shadow_of_source(LightBuffer light_buffer, vec3 position_lcs, bool all_directions, vec3 normal_lcs);

out vec4 out_color;

void main(void)
{
    // Before anything is discarded: a normal is taken from the neighbours, too.
    vec3 normal_lcs = cross(dFdx(position_lcs), dFdy(position_lcs));
    if (texture(uniform_sampler_diffuse, texcoord).a < 1.0)
        discard;

    // Beside the beam, or behind the light. There is no near plane, and no far one.
    bool inside_beam = position_lcs.z < 0.0
        && abs(position_lcs.x) <= -position_lcs.z && abs(position_lcs.y) <= -position_lcs.z;
    float shadow_factor = uniform_outside;
    if (inside_beam) {
        shadow_factor = 1.0;
        if (is_in_shadow_of_source(light_buffer, position_lcs, false, normal_lcs))
            shadow_factor = 0.0;
    }

    out_color = vec4(vec3(shadow_factor), 1.0);
}
