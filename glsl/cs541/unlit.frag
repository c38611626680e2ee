#version 330 core

in vec2 vtexture_coord;

uniform vec3 diffuse_color;
uniform sampler2D usampler;

out vec4 frag_color;

void main(void)
{
    frag_color = vec4(diffuse_color * texture(usampler, vtexture_coord).rgb, 1);
}
