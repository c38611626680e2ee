#version 330 core
// The shadow test of lighting.frag alone: 1 is lit, 0 is in shadow. A test holds the two files equal.

in vec4 vshadow_position;

uniform sampler2D shadow_sampler;
uniform float epsilon;
uniform bool shadows;

const int NO_BEAM = 0, RECTANGULAR = 1, CIRCULAR = 2;
uniform int beam;

out vec4 frag_color;

void main(void)
{
    vec2 uv = vshadow_position.xy/vshadow_position.w;
    float shadow_depth = texture(shadow_sampler,uv).z;
    float point_depth = vshadow_position.z/vshadow_position.w;
    point_depth = point_depth - epsilon;

    bool inside_beam = vshadow_position.w > 0
        && 0 <= uv.x && uv.x <= 1 && 0 <= uv.y && uv.y <= 1;
    if (beam == CIRCULAR)
        inside_beam = inside_beam && distance(uv, vec2(0.5)) <= 0.5;
    bool in_shadow = shadows && inside_beam && shadow_depth < point_depth;

    frag_color = vec4(vec3(in_shadow ? 0 : 1), 1);
}
