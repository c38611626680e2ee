#version 330 core
// One triangle over the whole window; its corners come from gl_VertexID.

// −1…1 across the window.
out vec2 place;

void main()
{
    place = vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1);
    gl_Position = vec4(place, 0, 1);
}
