#version 330 core
// Rendering the shadow map: the depth of each fragment.

// DEVIATES: layout, GLSL 330 wants it before `out`; the slides write `out layout(location = 0)`.
layout(location = 0) out float fragmentdepth;

void main()
{
    // Not really needed, OpenGL does it anyway: there is no color buffer for it.
    fragmentdepth = gl_FragCoord.z;
}
