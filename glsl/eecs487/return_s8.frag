#version 330 core
// The signed sum, weighted, to colors: what is negative is clamped to 0.

uniform isampler2D accumulated;
uniform float weight;

out vec4 color;

void main()
{
    vec4 steps = vec4(texelFetch(accumulated, ivec2(gl_FragCoord.xy), 0));
    color = clamp(floor(steps * weight) * 2 / 255, 0, 1);
}
