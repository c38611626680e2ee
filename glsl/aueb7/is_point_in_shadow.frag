#version 330 core
// The shadow test: 1 where a point is lit, 0 where it is in shadow, and with Percentage Closer Filtering what lies
// between. Linked with each main that needs it: SpotLight.frag, visibility.frag, explain.frag.

uniform mat4 uniform_view_inverse;
uniform mat4 uniform_light_view_projection;
uniform sampler2D uniform_sampler_shadow_map;

// Moves a point towards the light, in depth: against the shadow map's own coarseness.
uniform float constant_depth_bias;
// How far the samples of PCF are from the central one, in texels.
uniform float uniform_sample_step;
// What lies outside of the shadow map: 0 dark, 1 lit.
uniform float uniform_outside;

// From the eye's space to the shadow map's: x, y and depth are 0 to 1 on the map; w is below 0 behind the light.
vec4 to_light_space(vec3 position_ecs)
{
    vec4 position_wcs = uniform_view_inverse * vec4(position_ecs, 1.0);
    vec4 position_lcs = uniform_light_view_projection * position_wcs;
    position_lcs.xyz = 0.5 * (position_lcs.xyz / position_lcs.w) + 0.5;
    return position_lcs;
}

// Beside the map, before its near plane, beyond its far plane, or behind the light.
bool is_outside(vec4 position_lcs)
{
    return position_lcs.w <= 0.0
        || any(lessThan(position_lcs.xyz, vec3(0.0))) || any(greaterThan(position_lcs.xyz, vec3(1.0)));
}

float is_point_in_shadow(vec4 position_lcs)
{
    if (is_outside(position_lcs))
        return uniform_outside;

    float shadow_map_z = texture(uniform_sampler_shadow_map, position_lcs.xy).r;
    if (shadow_map_z < position_lcs.z - constant_depth_bias)
        return 0.0;
    return 1.0;
}

// One texel in uv space is 1.0 / texture_size.
vec2 sample_step()
{
    return uniform_sample_step / vec2(textureSize(uniform_sampler_shadow_map, 0));
}

float is_point_in_shadow_pcf_5(vec4 position_lcs)
{
    vec2 s = sample_step();
    float total_sum = 0.0;
    // center, top, bottom, left, right
    total_sum += is_point_in_shadow(position_lcs);
    total_sum += is_point_in_shadow(position_lcs + vec4(0.0, s.y, 0.0, 0.0));
    total_sum += is_point_in_shadow(position_lcs + vec4(0.0, -s.y, 0.0, 0.0));
    total_sum += is_point_in_shadow(position_lcs + vec4(-s.x, 0.0, 0.0, 0.0));
    total_sum += is_point_in_shadow(position_lcs + vec4(s.x, 0.0, 0.0, 0.0));
    return total_sum / 5.0;
}

float is_point_in_shadow_pcf_9(vec4 position_lcs)
{
    vec2 s = sample_step();
    float total_sum = 0.0;
    // center, top, bottom, left, right
    total_sum += is_point_in_shadow(position_lcs);
    total_sum += is_point_in_shadow(position_lcs + vec4(0.0, s.y, 0.0, 0.0));
    total_sum += is_point_in_shadow(position_lcs + vec4(0.0, -s.y, 0.0, 0.0));
    total_sum += is_point_in_shadow(position_lcs + vec4(-s.x, 0.0, 0.0, 0.0));
    total_sum += is_point_in_shadow(position_lcs + vec4(s.x, 0.0, 0.0, 0.0));
    // the diagonals
    total_sum += is_point_in_shadow(position_lcs + vec4(-s.x, s.y, 0.0, 0.0));
    total_sum += is_point_in_shadow(position_lcs + vec4(s.x, s.y, 0.0, 0.0));
    total_sum += is_point_in_shadow(position_lcs + vec4(-s.x, -s.y, 0.0, 0.0));
    total_sum += is_point_in_shadow(position_lcs + vec4(s.x, -s.y, 0.0, 0.0));
    return total_sum / 9.0;
}
