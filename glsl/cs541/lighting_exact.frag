#version 330 core
// lighting.frag with the exact shadow test in place of the handout's. A test holds the two files equal but for that.

in vec3 normal_vector;
in vec3 light_vector;
in vec3 eye_vector;
in vec2 vtexture_coord;
in vec3 position_lcs;

uniform vec3 ambient_color;
uniform vec3 light_color;
uniform vec3 diffuse_color;
uniform vec3 specular_color;
uniform float shininess;
uniform sampler2D usampler;

// The shape of the light's beam. A point light has none: it lights what is outside of the shadow map, too.
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
    // Only what is in front of the light and inside of its beam can be in shadow. A point light shines everywhere.
    bool inside_beam = position_lcs.z < 0
        && abs(position_lcs.x) <= -position_lcs.z && abs(position_lcs.y) <= -position_lcs.z;
    if (beam == CIRCULAR)
        inside_beam = inside_beam && length(position_lcs.xy) <= -position_lcs.z;

    // The shadow test: is there a triangle between the point and the light? What is dark anyway is not asked about.
    vec3 normal_lcs = cross(dFdx(position_lcs), dFdy(position_lcs));
    bool in_shadow = false;
    if ((inside_beam || beam == NO_BEAM) && dot(normal_vector, light_vector) > 0)
        in_shadow = is_in_shadow_of_source(light_buffer, position_lcs, beam == NO_BEAM, normal_lcs);

    // Local illumination: the light reaches what is in its beam and not in shadow.
    bool illuminated = !in_shadow && (inside_beam || beam == NO_BEAM);
    vec3 surface_color = diffuse_color * texture(usampler, vtexture_coord).rgb;
    vec3 color = ambient_color * surface_color;

    vec3 m = normalize(normal_vector);
    vec3 L = normalize(light_vector);
    float m_dot_L = dot(m, L);
    if (illuminated && m_dot_L > 0) {
        vec3 R = 2*m_dot_L*m - L;
        float R_dot_V = max(dot(R, normalize(eye_vector)), 0);
        color += light_color * m_dot_L * surface_color;
        color += light_color * pow(R_dot_V, shininess) * specular_color;
    }
    frag_color = vec4(color, 1);
}
