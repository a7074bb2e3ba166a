#version 330 core
// One vertex of one instance: to the screen by map(v) = axes^-1 * (v - position), lit by all lights on both of its sides.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 instanceRow0;
layout(location = 3) in vec4 instanceRow1;
layout(location = 4) in vec4 instanceRow2;

layout(std140) uniform ObjectBlock
{
    vec4 linear[3];      // columns of the object's map
    vec4 cofactors[3];   // columns of its cofactor matrix, scaled to entries of at most 1
    vec4 translation;    // relative to the camera
    vec4 colour;         // linear light
};

const int maximumLights = 16;

struct Light
{
    vec4 colour;         // linear light times intensity; w: 0 directional, 1 point, 2 spot
    vec4 position;       // relative to the camera, or the unit direction towards the light; w: range
    vec4 axis;           // unit direction of the cone; w: cosine of the angle where the edge begins
    vec4 edge;           // x: cosine of the angle where the edge ends
};

layout(std140) uniform LightBlock
{
    vec4 skyColour;      // ambient light from above
    vec4 groundColour;   // ambient light from below
    ivec4 lightCount;
    Light lights[maximumLights];
};

uniform vec3 cameraAxes[3]; // right, up and forward: the rows of the inverse axes
uniform vec2 viewScale;     // 1 / (half height * aspect), 1 / half height
uniform vec4 depthScale;    // z = x*depth + y, w = z*depth + w
uniform vec4 flatColour;     // linear light; w: how much of it replaces the lit colour

out vec3 frontColour;
out vec3 backColour;

// A normal may be tiny: its square could underflow. Zero stays zero, never NaN.
vec3 direction(vec3 v)
{
    float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
    return largest > 0.0 ? normalize(v / largest) : vec3(0.0);
}

// How much of a light with a place arrives: as the square of the distance, 1 at a tenth of the range, 0 from the range on.
float falloff(float distance, float range)
{
    float d = max(distance / range, 1e-4);
    float window = clamp(1.0 - d * d * d * d, 0.0, 1.0);
    return 0.01 / (d * d) * window * window / (0.9999 * 0.9999);
}

void addLight(Light light, vec3 place, vec3 n, inout vec3 front, inout vec3 back)
{
    vec3 toLight = light.position.xyz;
    float strength = 1.0;
    if (light.colour.w > 0.5)
    {
        vec3 difference = toLight - place;
        float distance = length(difference);
        toLight = difference / max(distance, 1e-30);
        strength = falloff(distance, light.position.w);
        if (light.colour.w > 1.5)
        {
            strength *= smoothstep(light.edge.x, light.axis.w, -dot(toLight, light.axis.xyz));
        }
    }

    float cosine = dot(n, toLight);
    front += max(cosine, 0.0) * strength * light.colour.rgb;
    back += max(-cosine, 0.0) * strength * light.colour.rgb;
}

void main()
{
    vec4 local = vec4(position, 1.0);
    vec3 inModel = vec3(dot(instanceRow0, local), dot(instanceRow1, local), dot(instanceRow2, local));
    vec3 place = linear[0].xyz * inModel.x + linear[1].xyz * inModel.y + linear[2].xyz * inModel.z + translation.xyz;

    vec3 seen = vec3(dot(cameraAxes[0], place), dot(cameraAxes[1], place), dot(cameraAxes[2], place));
    gl_Position = vec4(seen.xy * viewScale, depthScale.x * seen.z + depthScale.y, depthScale.z * seen.z + depthScale.w);

    // The cofactor matrix takes the cross product of two edges to that of their images, also under skew, mirrors and flattening:
    // the normal stays on the side from which the triangle is seen as a front face.
    vec3 c0 = vec3(instanceRow0.x, instanceRow1.x, instanceRow2.x);
    vec3 c1 = vec3(instanceRow0.y, instanceRow1.y, instanceRow2.y);
    vec3 c2 = vec3(instanceRow0.z, instanceRow1.z, instanceRow2.z);
    vec3 n = direction(cross(c1, c2) * normal.x + cross(c2, c0) * normal.y + cross(c0, c1) * normal.z);
    n = direction(cofactors[0].xyz * n.x + cofactors[1].xyz * n.y + cofactors[2].xyz * n.z);

    float upwards = 0.5 + 0.5 * n.y;
    vec3 front = mix(groundColour.rgb, skyColour.rgb, upwards);
    vec3 back = mix(skyColour.rgb, groundColour.rgb, upwards);
    for (int i = 0; i < lightCount.x; i++)
    {
        addLight(lights[i], place, n, front, back);
    }

    frontColour = mix(colour.rgb * front, flatColour.rgb, flatColour.a);
    backColour = mix(colour.rgb * back, flatColour.rgb, flatColour.a);
}
