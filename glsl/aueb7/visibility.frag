#version 330 core
// The shadow_factor of SpotLight.frag alone: 1 is lit, 0 is in full shadow. A test holds the two files equal.

in vec3 position_ecs;
in vec2 texcoord;

uniform sampler2D uniform_sampler_diffuse;
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
    if (texture(uniform_sampler_diffuse, texcoord).a < 1.0)
        discard;

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
    out_color = vec4(vec3(shadow_factor), 1.0);
}
