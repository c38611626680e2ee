#version 330 core
// First pass: the scene from the light's point of view.
// DEVIATES: fixed pipeline, the handout draws the first pass without shaders, which a core profile does not do.

in vec3 position;
// Of the instance: where a ball is in the box; (0, 0, 0) for everything else.
layout(location = 3) in vec3 center;

uniform mat4 lightModelViewProjection;

void main()
{
    gl_Position = lightModelViewProjection * vec4(position + center, 1.0);
}
