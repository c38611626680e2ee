#version 330 core
// Rendering the shadow map: the scene from the light's point of view.

// Input vertex data, different for all executions of this shader.
// DEVIATES: layout, GLSL 330 wants it before `in`; the slides write `in layout(location = 0)`.
layout(location = 0) in vec3 position_modelSpace;

// Values that stay constant for the whole mesh.
uniform mat4 depthMVP;

void main()
{
    gl_Position = depthMVP * vec4(position_modelSpace, 1);
}
