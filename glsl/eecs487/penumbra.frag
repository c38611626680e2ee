#version 330 core
// The fast method: a wall where a light is shadowed, as the stencil buffer has it. Blended over the wall as all lights
// light it in the mean: color + alpha * wall.

in vec2 place;

// One bit for each light, 32 in a layer.
uniform sampler2DArray masks;
layout(std140) uniform Jitters { vec4 jitters[1024]; };
uniform int numJitters;

// From a place in the window to the direction of its ray; the eye's place. The origin is the light.
uniform mat3 ray;
uniform vec3 eye;
// The wall's implicit function, and the way to the wall's own −1…1 from the world.
uniform vec4 wall;
uniform mat4 wallFromWorld;

uniform vec3 material;
uniform vec3 ambient;
uniform vec3 diffuse;
uniform vec3 shadowColor;
const float linearAttenuation = 0.5;

out vec4 color;

bool isShadowed(int light, vec4 bits)
{
    int byte = int(round(255 * bits[light % 32 / 8]));
    return (byte >> light % 8 & 1) == 1;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 direction = ray * vec3(place, 1);
    vec3 point = eye - direction * (dot(wall, vec4(eye, 1)) / dot(wall.xyz, direction));
    vec2 onWall = abs((wallFromWorld * vec4(point, 1)).xy);
    bool beyondEdges = max(onWall.x, onWall.y) > 1;

    // How the lights that are seen differ from the mean of all.
    int seen = 0;
    vec3 ofSeen = vec3(0), ofAll = vec3(0);
    vec4 bits;
    for (int i = 0; i < numJitters; i++) {
        if (i % 32 == 0)
            bits = texelFetch(masks, ivec3(pixel, i / 32), 0);
        vec3 toLight = jitters[i].xyz - point;
        float d = length(toLight);
        float NdotL = d > 0 ? max(0, dot(wall.xyz, toLight / d)) : 0;
        vec3 lit = clamp(material * (ambient + diffuse * NdotL / (1 + linearAttenuation * d)), 0, 1);
        ofAll += lit;
        if (!isShadowed(i, bits)) {
            ofSeen += lit;
            seen++;
        }
    }
    float share = float(seen) / numJitters;
    vec3 correction = beyondEdges ? vec3(0) : ofSeen / numJitters - share * ofAll / numJitters;
    // Blending clamps this to 0…1, and it stays within as long as the lights differ by less than a shadow does.
    color = vec4((1 - share) * shadowColor + correction, share);
}
