// The lights of a scene, and the light that reaches a point of a surface.
const int maxLights = 16; // LightBlock.MaxLights

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
    vec4 skyCurvature;   // ambient light in proportion to the square of the normal's height
    vec4 display;        // exposure; 1 for the filmic tone; density of the haze per unit; the share that it scatters
    vec4 fogColour;      // linear light; w: anisotropy of what the haze scatters
    Light lights[maxLights];
    vec4 skySides[6];    // factors of products of the normal's components, where the sky differs from side to side
};

// Ambient light on a surface by its unit normal, without shadows.
vec3 ambientLight(vec3 n)
{
    vec3 light = mix(groundColour.rgb, skyColour.rgb, 0.5 + 0.5 * n.y) + n.y * n.y * skyCurvature.rgb;
#ifdef SKY_SIDES
    // Core's SkyIrradiance. Harmonics of a bright sun may be negative elsewhere.
    light += n.x * skySides[0].rgb + n.z * skySides[1].rgb + n.x * n.y * skySides[2].rgb + n.y * n.z * skySides[3].rgb
        + n.x * n.z * skySides[4].rgb + (n.x * n.x - n.z * n.z) * skySides[5].rgb;
    light = max(light, vec3(0.0));
#endif
    return light;
}

// The unit vector of a vector so short that its square could underflow. Zero stays zero, never NaN.
vec3 direction(vec3 v)
{
    float maxAbsComponent = max(abs(v.x), max(abs(v.y), abs(v.z)));
    return maxAbsComponent > 0.0 ? normalize(v / maxAbsComponent) : vec3(0.0);
}

// Attenuation of a light with a position: as the inverse square of the distance, 1 at a tenth of the range, 0 from the range on.
float falloff(float distance, float range)
{
    float d = max(distance / range, 1e-4);
    float window = clamp(1.0 - d * d * d * d, 0.0, 1.0);
    return 0.01 / (d * d) * window * window / (0.9999 * 0.9999);
}

// The light that reaches a surface point which faces the light, and the direction towards the light.
vec3 incomingLight(Light light, vec3 surfacePosition, out vec3 toLight)
{
    toLight = light.position.xyz;
    float strength = 1.0;
    if (light.colour.w > 0.5)
    {
        vec3 difference = toLight - surfacePosition;
        float distance = length(difference);
        toLight = difference / max(distance, 1e-30);
        strength = falloff(distance, light.position.w);
        if (light.colour.w > 1.5)
        {
            strength *= smoothstep(light.edge.x, light.axis.w, -dot(toLight, light.axis.xyz));
        }
    }

    return strength * light.colour.rgb;
}

// The direction from a surface point towards the eye. The projection is orthographic where w does not depend on depth.
vec3 towardsEye(vec3 surfacePosition, vec3 forward, vec4 depthScale)
{
    return depthScale.z != 0.0 ? direction(-surfacePosition) : -forward;
}
