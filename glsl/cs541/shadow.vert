#version 330 core
// First pass: the scene as the light sees it.

// DEVIATES: `attribute`, GLSL 330 core says `in`.
in vec4 position;

uniform mat4 persp_matrix;
uniform mat4 view_matrix;
uniform mat4 model_matrix;

void main(void)
{
    gl_Position = persp_matrix * (view_matrix * (model_matrix * position));
}
