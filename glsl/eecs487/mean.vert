#version 330 core
// The fast method: lighting.vert for all jittered lights at once, and their mean.

in vec3 position;
in vec3 normal;

uniform mat4 modelViewProjection;
// To a world whose origin is the light at its own place.
uniform mat4 modelFromLight;
uniform mat3 normalMatrix;

uniform vec3 material;
uniform vec3 ambient;
uniform vec3 diffuse;
const float linearAttenuation = 0.5;

// By how much each light is jittered; 1024 is what every driver has room for.
layout(std140) uniform Jitters { vec4 jitters[1024]; };
uniform int numJitters;

out vec3 vertexColor;

void main()
{
    gl_Position = modelViewProjection * vec4(position, 1);

    vec3 N = normalize(normalMatrix * normal);
    vec3 vertex = (modelFromLight * vec4(position, 1)).xyz;
    vec3 sum = vec3(0);
    for (int i = 0; i < numJitters; i++) {
        vec3 toLight = jitters[i].xyz - vertex;
        float d = length(toLight);
        float NdotL = d > 0 ? max(0, dot(N, toLight / d)) : 0;
        sum += clamp(material * (ambient + diffuse * NdotL / (1 + linearAttenuation * d)), 0, 1);
    }
    vertexColor = sum / numJitters;
}
