#version 330 core
// Second pass: each vertex in eye space, for per-pixel lighting, and its texture coordinates for the shadow maps.

in vec3 position;
in vec3 normal;
// Of the instance: where a ball is in the box, (0, 0, 0) for everything else; and its color.
layout(location = 3) in vec3 center;
layout(location = 4) in vec3 color;

uniform mat4 modelView;
uniform mat3 normalMatrix;
uniform mat4 projection;
// From eye space to each light's clipping space, and from there to 0…1.
uniform mat4 directionalTextureMatrix;
uniform mat4 spotTextureMatrix;

out vec3 eyePosition;
out vec3 eyeNormal;
out vec3 C_in;
out vec4 directionalCoord;
out vec4 spotCoord;
// For explain.frag alone: which ball.
flat out int instance;

void main()
{
    vec4 eye = modelView * vec4(position + center, 1.0);
    gl_Position = projection * eye;

    eyePosition = eye.xyz;
    eyeNormal = normalMatrix * normal;
    C_in = color;
    directionalCoord = directionalTextureMatrix * eye;
    spotCoord = spotTextureMatrix * eye;
    instance = gl_InstanceID;
}
