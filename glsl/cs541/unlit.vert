#version 330 core
// The sky dome and the light's own marker: textured, and neither lit nor shadowed.

in vec4 position;
in vec2 texture_coord;

uniform mat4 persp_matrix;
uniform mat4 view_matrix;
uniform mat4 model_matrix;

out vec2 vtexture_coord;

void main(void)
{
    gl_Position = persp_matrix * (view_matrix * (model_matrix * position));
    vtexture_coord = texture_coord;
}
