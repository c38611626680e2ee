#version 330 core
// First pass: the depth is all that is kept.

void main()
{
}
