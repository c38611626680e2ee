#version 330 core
// The marker at the light source: white, and neither lit nor shadowed.

out vec4 out_color;

void main(void)
{
    out_color = vec4(1.0);
}
