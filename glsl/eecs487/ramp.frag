#version 330 core
// A quad with color ranging from red at the top to black at the bottom: 255 254 253 ... 3 2 1 0.

in vec2 place;

out vec4 color;

void main()
{
    float up = 0.5 * place.y + 0.5;
    color = vec4(min(floor(256 * up), 255) / 255, 0, 0, 1);
}
