#version 330 core
// An accumulation buffer of 8 bits with sign, as hardware had it: adds the weighted frame to the sum so far.

uniform sampler2D frame;
uniform isampler2D accumulated;
uniform float weight;

out ivec4 sum;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    // 1 is 128 steps: of a byte's 8 bits the sign leaves 7, and what lies below them is cut off.
    vec4 steps = round(255 * texelFetch(frame, pixel, 0)) / 2;
    ivec4 next = texelFetch(accumulated, pixel, 0) + ivec4(steps * weight);
    // −128 … 127: what is beyond comes in again at the other end.
    sum = (next + 128 & 255) - 128;
}
