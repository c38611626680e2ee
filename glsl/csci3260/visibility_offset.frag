#version 330 core
// The shadow test of FragmentShaderCode_offset.glsl alone: 1 is lit, 0 is in full shadow, where `visibility` is 0.5. A
// test holds the two files equal. What faces away from the light is asked about here, too.

// In the light's coordinate system: the light shines along -z.
in vec4 ShadowCoord;

out vec4 color;

// A map that is fitted to what casts; it and its test are in shadow_tests/offset.frag.
struct FittedMap {
    sampler2D depths;
    vec4 rectangle;
    vec4 nearness;
};
uniform FittedMap fitted_map;
float light_share_of_rays(FittedMap fitted_map, vec3 position_lcs, vec3 normal_lcs);

void main()
{
    vec3 normal_lcs = cross(dFdx(ShadowCoord.xyz), dFdy(ShadowCoord.xyz));
    float visibility = mix(0.5, 1.0, light_share_of_rays(fitted_map, ShadowCoord.xyz, normal_lcs));

    color = vec4(vec3((visibility - 0.5) / 0.5), 1);
}
