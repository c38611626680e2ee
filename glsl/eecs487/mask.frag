#version 330 core
// The fast method: one light's bit. Blending adds it to those of the other lights, the depth test lets it pass once.

uniform vec4 bit;

out vec4 color;

void main()
{
    color = bit;
}
