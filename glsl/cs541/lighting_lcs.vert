#version 330 core
// lighting.vert for the offset and the exact shadow test: where each point is as the light sees it, not where it is in the
// handout's map. A test holds the two files equal but for that.

// DEVIATES: `attribute`, GLSL 330 core says `in`; the handout itself has `out` beside `attribute`.
in vec4 position;
in vec3 normal;
in vec2 texture_coord;

uniform mat4 persp_matrix;
uniform mat4 view_matrix;
uniform mat4 model_matrix;
uniform mat3 normal_matrix;

uniform vec3 eye_position;
uniform vec3 light_position;

// Object space to the light's coordinate system: the light looks along -z, and its beam is |x|, |y| <= -z.
uniform mat4 light_model_matrix;

out vec3 normal_vector;
out vec3 light_vector;
out vec3 eye_vector;
out vec2 vtexture_coord;
out vec3 position_lcs;

void main(void)
{
    vec4 world_position = model_matrix * position;
    gl_Position = persp_matrix * (view_matrix * world_position);

    normal_vector = normal_matrix * normal;
    light_vector = light_position - world_position.xyz;
    eye_vector = eye_position - world_position.xyz;
    vtexture_coord = texture_coord;

    position_lcs = (light_model_matrix * position).xyz;
}
