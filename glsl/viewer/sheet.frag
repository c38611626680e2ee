#version 330 core
// The sheet with the texts. Its first row is its top one.
uniform sampler2D sheet;
in vec2 uv;
out vec4 color;

void main()
{
    color = texture(sheet, vec2(uv.x, 1.0 - uv.y));
}
