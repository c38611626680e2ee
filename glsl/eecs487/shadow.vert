#version 330 core
// Projects a caster onto a wall: the matrix holds shadowMat. Also places what is drawn in one color.

in vec3 position;

uniform mat4 modelViewProjection;
// The wall's implicit function, in the caster's own space.
uniform vec4 wall;

void main()
{
    gl_Position = modelViewProjection * vec4(position, 1);
    // DEVIATES: behind the wall, what stands there is between no point of it and the light, and is cut off.
    gl_ClipDistance[0] = dot(wall, vec4(position, 1));
}
