#version 330 core
// A depth map for the eye: the distance from the light's plane, black at the near plane and white at the far one.
uniform sampler2D shadow_map;
uniform float near;
uniform float far;
in vec2 uv;
out vec4 color;

void main()
{
    float ndc = 2.0 * texture(shadow_map, uv).r - 1.0;
    float distance = 2.0 * near * far / (far + near - ndc * (far - near));
    color = vec4(vec3((distance - near) / (far - near)), 1.0);
}
