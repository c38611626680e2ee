#version 330 core
// lighting.vert for the offset and the exact shadow test: where each vertex is as the lights see it, in place of its
// texture coordinates for the shadow maps. A test holds the two files equal but for that.

in vec3 position;
in vec3 normal;
// Of the instance: where a ball is in the box, (0, 0, 0) for everything else; and its color.
layout(location = 3) in vec3 center;
layout(location = 4) in vec3 color;

uniform mat4 modelView;
uniform mat3 normalMatrix;
uniform mat4 projection;
// Object space to each light's coordinate system: it shines along -z.
uniform mat4 directionalModelMatrix;
uniform mat4 spotModelMatrix;

out vec3 eyePosition;
out vec3 eyeNormal;
out vec3 C_in;
out vec3 directionalCoord;
out vec3 spotCoord;

void main()
{
    vec4 eye = modelView * vec4(position + center, 1.0);
    gl_Position = projection * eye;

    eyePosition = eye.xyz;
    eyeNormal = normalMatrix * normal;
    C_in = color;
    directionalCoord = (directionalModelMatrix * vec4(position + center, 1.0)).xyz;
    spotCoord = (spotModelMatrix * vec4(position + center, 1.0)).xyz;
}
