#version 330 core
// The shadow test of FragmentShaderCode_exact.glsl alone: 1 is lit, 0 is in full shadow, where `visibility` is 0.5. A
// test holds the two files equal. What faces away from the light is asked about here, too, and is in shadow.

// In the light's coordinate system: the light shines along -z.
in vec4 ShadowCoord;

out vec4 color;

// Which triangles each ray of the light can meet; it and its test are in shadow_tests/exact.frag.
struct LightBuffer {
    usamplerBuffer cells;
    isamplerBuffer nodes;
    vec4 rectangle;
    int side;
};
uniform LightBuffer light_buffer;
bool is_in_shadow_of_rays(LightBuffer light_buffer, vec3 position_lcs, vec3 normal_lcs);

void main()
{
    vec3 normal_lcs = cross(dFdx(ShadowCoord.xyz), dFdy(ShadowCoord.xyz));
    float visibility = 1.0;
    if (is_in_shadow_of_rays(light_buffer, ShadowCoord.xyz, normal_lcs))
        visibility = 0.5;

    color = vec4(vec3((visibility - 0.5) / 0.5), 1);
}
