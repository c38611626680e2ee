#version 330 core
// Rendering with the spotlight: ambient light, and diffuse light where the point is not in shadow.

in vec3 position_ecs;
in vec3 normal_ecs;
in vec2 texcoord;

// DEVIATES: texture units 1 to 3, the course's normal, specular and emission maps are left out: no scene here has one.
uniform sampler2D uniform_sampler_diffuse;
uniform vec3 uniform_diffuse_color;
uniform vec3 uniform_ambient_color;

uniform vec3 uniform_light_color;
uniform vec3 uniform_light_position_ecs;
// The way that the light looks, of length 1.
uniform vec3 uniform_light_direction_ecs;

uniform bool uniform_shadows;
// Which of the three functions gives the shadow_factor.
const int NONE = 0, PCF_5 = 1, PCF_9 = 2;
uniform int uniform_filter;

// These are in is_point_in_shadow.frag.
vec4 to_light_space(vec3 position_ecs);
float is_point_in_shadow(vec4 position_lcs);
float is_point_in_shadow_pcf_5(vec4 position_lcs);
float is_point_in_shadow_pcf_9(vec4 position_lcs);

out vec4 out_color;

void main(void)
{
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

    float shadow_factor = 1.0;
    if (uniform_shadows) {
        vec4 position_lcs = to_light_space(position_ecs);
        if (uniform_filter == PCF_9)
            shadow_factor = is_point_in_shadow_pcf_9(position_lcs);
        else if (uniform_filter == PCF_5)
            shadow_factor = is_point_in_shadow_pcf_5(position_lcs);
        else
            shadow_factor = is_point_in_shadow(position_lcs);
    }

    vec3 diffuse = uniform_light_color * diffuse_color * n_dot_l * attenuation * spot_effect;
    out_color = vec4(uniform_ambient_color * diffuse_color + shadow_factor * diffuse, 1.0);
}
