#version 330 core
// The shadow_factor of SpotLight_offset.frag alone: 1 is lit, 0 is in full shadow. A test holds the two files equal.
// What faces away from the light is asked about here, too.

in vec2 texcoord;
in vec3 position_lcs;

uniform sampler2D uniform_sampler_diffuse;

// What lies outside of the beam: 0 dark, 1 lit.
uniform float uniform_outside;

// A map that is fitted to what casts; it and its test are in shadow_tests/offset.frag.
struct FittedMap {
    sampler2D depths;
    vec4 rectangle;
    vec4 nearness;
};
uniform FittedMap fitted_map;
float light_share_of_source(FittedMap fitted_map, vec3 position_lcs, vec3 normal_lcs);

out vec4 out_color;

void main(void)
{
    // Before anything is discarded: a slope is taken from the neighbours, too.
    vec3 normal_lcs = cross(dFdx(position_lcs), dFdy(position_lcs));
    if (texture(uniform_sampler_diffuse, texcoord).a < 1.0)
        discard;

    // Beside the beam, or behind the light. There is no near plane, and no far one.
    bool inside_beam = position_lcs.z < 0.0
        && abs(position_lcs.x) <= -position_lcs.z && abs(position_lcs.y) <= -position_lcs.z;
    float shadow_factor = uniform_outside;
    if (inside_beam)
        shadow_factor = light_share_of_source(fitted_map, position_lcs, normal_lcs);

    out_color = vec4(vec3(shadow_factor), 1.0);
}
