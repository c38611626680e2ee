#version 330 core
// A wall: smooth shading, and a depth that its shadows will find again.

in vec3 vertexColor;

// The depth of the wall's plane at a pixel: it grows evenly across the window.
uniform vec3 planeDepth;

out vec4 color;

void main()
{
    color = vec4(vertexColor, 1);
    gl_FragDepth = dot(planeDepth, vec3(gl_FragCoord.xy, 1));
}
