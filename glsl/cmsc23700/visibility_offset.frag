#version 330 core
// The shadow test of lighting_offset.frag alone, for one light: 1 is lit, 0 is in shadow, where S_l is 0.5. A test holds
// the two files equal.

in vec3 eyePosition;
// In each light's coordinate system.
in vec3 directionalCoord;
in vec3 spotCoord;

uniform vec3 spotPosition;
uniform vec3 spotDirection;
uniform float spotCosCutoff;

// 1 directional, 2 spotlight.
uniform int light;

out vec4 color;

// Maps that are fitted to what casts; they and their test are in shadow_tests/offset.frag.
struct FittedMap {
    sampler2D depths;
    vec4 rectangle;
    vec4 nearness;
};
uniform FittedMap directionalMap;
uniform FittedMap spotMap;
float light_share_of_rays(FittedMap fitted_map, vec3 position_lcs, vec3 normal_lcs);
float light_share_of_source(FittedMap fitted_map, vec3 position_lcs, vec3 normal_lcs);

float S(float share)
{
    return mix(0.5, 1.0, share);
}

void main()
{
    // The triangle's normal, for each light.
    vec3 directionalNormal = cross(dFdx(directionalCoord), dFdy(directionalCoord));
    vec3 spotNormal = cross(dFdx(spotCoord), dFdy(spotCoord));
    float S_l = 1.0;
    if (light == 1) {
        S_l = S(light_share_of_rays(directionalMap, directionalCoord, directionalNormal));
    } else {
        vec3 L = normalize(spotPosition - eyePosition);
        float spotDot = dot(-L, spotDirection);
        // Outside the cone nothing is asked.
        if (spotDot >= spotCosCutoff)
            S_l = S(light_share_of_source(spotMap, spotCoord, spotNormal));
    }
    color = vec4(vec3((S_l - 0.5) / 0.5), 1.0);
}
