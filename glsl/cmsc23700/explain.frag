#version 330 core
// The intermediate values of lighting.frag's shadow test for one light, for `shadowlab explain`. A frame buffer holds
// bytes: each drawing shows one value, the 32 bits of the float as the four bytes of the color.

in vec3 eyePosition;
in vec4 directionalCoord;
in vec4 spotCoord;
flat in int instance;

uniform sampler2D directionalMap;
uniform float directionalBias;

uniform vec3 spotPosition;
uniform vec3 spotDirection;
uniform float spotCosCutoff;
uniform sampler2D spotMap;
uniform float spotBias;

// 1 directional, 2 spotlight.
uniform int light;
// Counted from 1: what the clear color leaves is no object. Balls follow each other from their first.
uniform int objectNumber;
// Which of the values below.
uniform int valueNumber;

out vec4 color;

void main()
{
    vec3 L = normalize(spotPosition - eyePosition);
    float spotDot = dot(-L, spotDirection);

    vec4 coord = light == 1 ? directionalCoord : spotCoord;
    float bias = light == 1 ? directionalBias : spotBias;
    vec3 place = coord.xyz / coord.w;
    float nearer = min(place.z, 1.0) - bias;
    float stored = light == 1 ? texture(directionalMap, place.xy).r : texture(spotMap, place.xy).r;
    bool asked = light == 1 || spotDot >= spotCosCutoff;
    float S_l = asked && stored < nearer ? 0.5 : 1.0;

    float values[16] = float[16](
        objectNumber + instance, gl_PrimitiveID,
        eyePosition.x, eyePosition.y, eyePosition.z,
        coord.x, coord.y, coord.z, coord.w,
        place.x, place.y, place.z,
        spotDot, nearer, stored, S_l);
    uint bits = floatBitsToUint(values[valueNumber]);
    uvec4 bytes = uvec4(bits, bits >> 8, bits >> 16, bits >> 24) & 255u;
    color = vec4(bytes) / 255.0;
}
