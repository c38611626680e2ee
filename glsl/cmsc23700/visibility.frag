#version 330 core
// The shadow test of lighting.frag alone, for one light: 1 is lit, 0 is in shadow, where S_l is 0.5. A test holds the
// two files equal.

in vec3 eyePosition;
in vec4 directionalCoord;
in vec4 spotCoord;

uniform bool shadows;

uniform sampler2D directionalMap;
uniform float directionalBias;

uniform vec3 spotPosition;
uniform vec3 spotDirection;
uniform float spotCosCutoff;
uniform sampler2D spotMap;
uniform float spotBias;

// 1 directional, 2 spotlight.
uniform int light;

out vec4 color;

float S(sampler2D shadowMap, vec4 coord, float bias)
{
    if (!shadows)
        return 1.0;
    vec3 place = coord.xyz / coord.w;
    float depth = min(place.z, 1.0);
    return texture(shadowMap, place.xy).r < depth - bias ? 0.5 : 1.0;
}

void main()
{
    float S_l = 1.0;
    if (light == 1) {
        S_l = S(directionalMap, directionalCoord, directionalBias);
    } else {
        vec3 L = normalize(spotPosition - eyePosition);
        float spotDot = dot(-L, spotDirection);
        // Outside the cone nothing is asked of the map.
        if (spotDot >= spotCosCutoff)
            S_l = S(spotMap, spotCoord, spotBias);
    }
    color = vec4(vec3((S_l - 0.5) / 0.5), 1.0);
}
