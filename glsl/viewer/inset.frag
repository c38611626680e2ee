#version 330 core
// A depth map for the eye: the distance from the light's plane, black at the near plane and white at the far one.
uniform sampler2D shadow_map;
uniform float near;
uniform float far;
// Whether the depths are even already.
uniform bool orthographic;
in vec2 uv;
out vec4 color;

void main()
{
    float depth = texture(shadow_map, uv).r;
    float ndc = 2.0 * depth - 1.0;
    float distance = 2.0 * near * far / (far + near - ndc * (far - near));
    float even = orthographic ? depth : (distance - near) / (far - near);
    color = vec4(vec3(even), 1.0);
}
