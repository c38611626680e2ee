#version 330 core
// Using the shadow map: each vertex as the current camera sees it, and as the light source sees it.

layout(location = 0) in vec3 vertexPosition_modelspace;
layout(location = 1) in vec3 vertexNormal_modelspace;
layout(location = 2) in vec2 vertexUV;

uniform mat4 MVP;
uniform mat4 DepthBiasMVP;
// To world space, with its origin at the eye.
uniform mat4 M;
uniform mat3 normalMatrix;

out vec3 Position_worldspace;
out vec3 Normal_worldspace;
out vec2 UV;
out vec4 ShadowCoord;

void main()
{
    // Output position of the vertex, in clip space: MVP * position
    gl_Position = MVP * vec4(vertexPosition_modelspace, 1);

    // Same, but with the light's view matrix
    ShadowCoord = DepthBiasMVP * vec4(vertexPosition_modelspace, 1);

    Position_worldspace = (M * vec4(vertexPosition_modelspace, 1)).xyz;
    Normal_worldspace = normalMatrix * vertexNormal_modelspace;
    UV = vertexUV;
}
