#version 330 core
// The shadow map: the scene as viewed from the light.

layout(location = 0) in vec3 position;

// To the clip space of the light; of the marker at the light: of the camera.
uniform mat4 uniform_mvp;

void main(void)
{
    gl_Position = uniform_mvp * vec4(position, 1.0);
}
