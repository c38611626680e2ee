#version 330 core
// A shadow on a wall: one color, without light.

uniform vec3 shadowColor;
// As in wall.frag.
uniform vec3 planeDepth;

// Four steps of a 24-bit depth buffer, in case that the two shaders round differently.
const float nearer = 1.0 / 4194304.0;

out vec4 color;

void main()
{
    color = vec4(shadowColor, 1);
    // DEVIATES: polygon offset, the course moves shadows by (-1, -5), which large projected triangles round away; here wall
    // and shadow have the plane's own depth at a pixel, whatever their triangles are.
    gl_FragDepth = dot(planeDepth, vec3(gl_FragCoord.xy, 1)) - nearer;
}
