#version 330 core
// The frame as it is; blending weighs it and adds it to the accumulation buffer.

uniform sampler2D frame;

out vec4 color;

void main()
{
    color = texelFetch(frame, ivec2(gl_FragCoord.xy), 0);
}
