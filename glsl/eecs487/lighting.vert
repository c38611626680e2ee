#version 330 core
// The fixed pipeline's lighting, once per vertex: material times (ambient + attenuated diffuse light), one-sided, clamped.

in vec3 position;
in vec3 normal;

// To clip space.
uniform mat4 modelViewProjection;
// To a world whose origin is the light.
uniform mat4 modelFromLight;
uniform mat3 normalMatrix;

uniform vec3 material;
// GL_LIGHT_MODEL_AMBIENT
uniform vec3 ambient;
// GL_DIFFUSE, GL_LINEAR_ATTENUATION
uniform vec3 diffuse;
const float linearAttenuation = 0.5;

out vec3 vertexColor;

void main()
{
    gl_Position = modelViewProjection * vec4(position, 1);

    vec3 N = normalize(normalMatrix * normal);
    vec3 toLight = -(modelFromLight * vec4(position, 1)).xyz;
    float d = length(toLight);
    float NdotL = d > 0 ? max(0, dot(N, toLight / d)) : 0;

    vertexColor = clamp(material * (ambient + diffuse * NdotL / (1 + linearAttenuation * d)), 0, 1);
}
