#version 330 core
// Rendering with the spotlight: each vertex as the eye sees it.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texture_coord;

// To world space, whose origin is moved to the eye; then to the eye's own space, and to clip space.
uniform mat4 uniform_m;
uniform mat4 uniform_v;
uniform mat4 uniform_p;
uniform mat3 uniform_normal_matrix_ecs;

out vec3 position_ecs;
out vec3 normal_ecs;
out vec2 texcoord;

void main(void)
{
    vec4 ecs = uniform_v * (uniform_m * vec4(position, 1.0));
    gl_Position = uniform_p * ecs;
    position_ecs = ecs.xyz;
    normal_ecs = uniform_normal_matrix_ecs * normal;
    texcoord = texture_coord;
}
