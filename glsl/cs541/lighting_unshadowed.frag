#version 330 core
// lighting.frag without the shadow test, for shadows=off: a software driver looks the map up whatever `shadows` is. A
// test holds the two files equal but for that.

in vec3 normal_vector;
in vec3 light_vector;
in vec3 eye_vector;
in vec2 vtexture_coord;
in vec4 vshadow_position;

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

void main(void)
{
    // What is in front of the light and inside of its beam.
    vec2 uv = vshadow_position.xy/vshadow_position.w;
    bool inside_beam = vshadow_position.w > 0
        && 0 <= uv.x && uv.x <= 1 && 0 <= uv.y && uv.y <= 1;
    if (beam == CIRCULAR)
        inside_beam = inside_beam && distance(uv, vec2(0.5)) <= 0.5;

    // Local illumination: the light reaches what is in its beam.
    bool illuminated = inside_beam || beam == NO_BEAM;
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
