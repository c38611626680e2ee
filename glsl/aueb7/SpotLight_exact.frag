#version 330 core
// SpotLight.frag with the exact shadow test in place of the exercises'. A test holds the two files equal but for that.

in vec3 position_ecs;
in vec3 normal_ecs;
in vec2 texcoord;
in vec3 position_lcs;

uniform sampler2D uniform_sampler_diffuse;
uniform vec3 uniform_diffuse_color;
uniform vec3 uniform_ambient_color;

uniform vec3 uniform_light_color;
uniform vec3 uniform_light_position_ecs;
// The way that the light looks, of length 1.
uniform vec3 uniform_light_direction_ecs;

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
    vec4 texture_color = texture(uniform_sampler_diffuse, texcoord);
    if (texture_color.a < 1.0)
        discard;
    vec3 diffuse_color = uniform_diffuse_color * texture_color.rgb;

    // The light's strength falls with the distance, and with the angle to the spotlight's axis. There is no cut-off.
    vec3 to_light = uniform_light_position_ecs - position_ecs;
    vec3 light_direction = normalize(to_light);
    float n_dot_l = max(dot(normalize(normal_ecs), light_direction), 0.0);
    float attenuation = 1.0 / (1.0 + 0.01 * length(to_light));
    float spot_effect = max(dot(-light_direction, uniform_light_direction_ecs), 0.0);

    // Beside the beam, or behind the light. There is no near plane, and no far one.
    bool inside_beam = position_lcs.z < 0.0
        && abs(position_lcs.x) <= -position_lcs.z && abs(position_lcs.y) <= -position_lcs.z;
    // Is there a triangle between the point and the light? What is dark anyway is not asked about.
    float shadow_factor = uniform_outside;
    if (inside_beam) {
        shadow_factor = 1.0;
        if (n_dot_l > 0.0 && is_in_shadow_of_source(light_buffer, position_lcs, false, normal_lcs))
            shadow_factor = 0.0;
    }

    vec3 diffuse = uniform_light_color * diffuse_color * n_dot_l * attenuation * spot_effect;
    out_color = vec4(uniform_ambient_color * diffuse_color + shadow_factor * diffuse, 1.0);
}
