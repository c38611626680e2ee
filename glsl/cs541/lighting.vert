#version 330 core
// Second pass: the scene as the eye sees it, and where each point is in the shadow map.

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

// The light's camera of the first pass.
uniform mat4 shadow_persp_matrix;
uniform mat4 shadow_view_matrix;

out vec3 normal_vector;
out vec3 light_vector;
out vec3 eye_vector;
out vec2 vtexture_coord;
out vec4 vshadow_position;

// Maps the standard cube [-1,1]^3 to the unit cube [0,1]^3: B = T(1/2,1/2,1/2) o H(1/2).
// GLSL takes a matrix column by column: the last line is the translation.
const mat4 B = mat4(0.5, 0.0, 0.0, 0.0,
                    0.0, 0.5, 0.0, 0.0,
                    0.0, 0.0, 0.5, 0.0,
                    0.5, 0.5, 0.5, 1.0);

void main(void)
{
    vec4 world_position = model_matrix * position;
    gl_Position = persp_matrix * (view_matrix * world_position);

    normal_vector = normal_matrix * normal;
    light_vector = light_position - world_position.xyz;
    eye_vector = eye_position - world_position.xyz;
    vtexture_coord = texture_coord;

    // Equation (1) of the handout.
    vshadow_position = B * (shadow_persp_matrix * (shadow_view_matrix * world_position));
}
