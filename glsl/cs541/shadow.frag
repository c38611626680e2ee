#version 330 core
// First pass: nothing to do. The depth comes from gl_Position.

void main(void)
{
}
