#version 330 core
// The shadow test of lighting_exact.frag alone, for one light: 1 is lit, 0 is in shadow, where S_l is 0.5. A test holds
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

// Which triangles each ray of a light can meet; it and its test are in shadow_tests/exact.frag.
struct LightBuffer {
    usamplerBuffer cells;
    isamplerBuffer nodes;
    vec4 rectangle;
    int side;
};
uniform LightBuffer directionalBuffer;
uniform LightBuffer spotBuffer;
bool is_in_shadow_of_rays(LightBuffer light_buffer, vec3 position_lcs, vec3 normal_lcs);
bool is_in_shadow_of_source(LightBuffer light_buffer, vec3 position_lcs, bool all_directions, vec3 normal_lcs);

float S(bool in_shadow)
{
    return in_shadow ? 0.5 : 1.0;
}

void main()
{
    // The triangle's normal, for each light.
    vec3 directionalNormal = cross(dFdx(directionalCoord), dFdy(directionalCoord));
    vec3 spotNormal = cross(dFdx(spotCoord), dFdy(spotCoord));
    float S_l = 1.0;
    if (light == 1) {
        S_l = S(is_in_shadow_of_rays(directionalBuffer, directionalCoord, directionalNormal));
    } else {
        vec3 L = normalize(spotPosition - eyePosition);
        float spotDot = dot(-L, spotDirection);
        // Outside the cone nothing is asked.
        if (spotDot >= spotCosCutoff)
            S_l = S(is_in_shadow_of_source(spotBuffer, spotCoord, false, spotNormal));
    }
    color = vec4(vec3((S_l - 0.5) / 0.5), 1.0);
}
