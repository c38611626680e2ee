#version 330 core
// The sphere around the light, without lighting.

uniform vec3 lightColor;

out vec4 color;

void main()
{
    color = vec4(lightColor, 1);
}
