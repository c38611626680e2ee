#version 330 core
// SpotLight.vert for the tests in the light's coordinate system: each vertex as the light sees it, too. A test holds the
// two files equal but for that.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texture_coord;

// To world space, whose origin is moved to the eye; then to the eye's own space, and to clip space.
uniform mat4 uniform_m;
uniform mat4 uniform_v;
uniform mat4 uniform_p;
uniform mat3 uniform_normal_matrix_ecs;
// To the light's own space: it looks along -z, and its beam is |x|, |y| <= -z.
uniform mat4 uniform_light_m;

out vec3 position_ecs;
out vec3 normal_ecs;
out vec2 texcoord;
out vec3 position_lcs;

void main(void)
{
    vec4 ecs = uniform_v * (uniform_m * vec4(position, 1.0));
    gl_Position = uniform_p * ecs;
    position_ecs = ecs.xyz;
    normal_ecs = uniform_normal_matrix_ecs * normal;
    texcoord = texture_coord;
    position_lcs = (uniform_light_m * vec4(position, 1.0)).xyz;
}
