// The lights of a scene, and the light that reaches a point of a surface.
const int maxLights = 16; // LightBlock.MaxLights

struct Light
{
    vec4 colour;         // linear light times intensity, or radiance of a surface; w: 0 directional, 1 point, 2 spot, 3 ball, 4 quad
    vec4 position;       // relative to the camera, or the unit direction towards the light; w: range
    vec4 axis;           // unit direction of the cone; w: cosine of the angle where the edge begins
                         // or from the middle of a quad to that of a side; w: radius of a ball
    vec4 edge;           // x: cosine of the angle where the edge ends; or from the middle of a quad to that of the next side
};

layout(std140) uniform LightBlock
{
    vec4 skyColour;      // ambient light from above
    vec4 groundColour;   // ambient light from below
    ivec4 lightCount;
    vec4 skyCurvature;   // ambient light in proportion to the square of the normal's height
    vec4 display;        // exposure; 1 for the filmic tone; density of the haze per unit; the share that it scatters
    vec4 fogColour;      // linear light; w: anisotropy of what the haze scatters
    vec4 probePlace;     // of the reflection probe, relative to the camera; w: one divided by the depth that is stored as 0
    vec4 probeDepth;     // x: likewise of 1; 0 where mirrors don't show the probe
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

#ifdef SURFACE_LIGHTS
// The outline of a lamp that has a surface, as seen from a point: clockwise about what leads from the lamp to it.
struct Outline
{
    vec3 centre;         // in units of the lamp's distance
    vec3 right;
    vec3 up;
    bool isRound;
};

// A point of an outline, from 0 to 15: each fourth is a corner. Round ones have the area of their circle, with all points or each second.
vec3 outlinePoint(Outline outline, int i, int step)
{
    i &= 15;
    vec2 p = vec2(1.0, 1.0 - 0.5 * float(i & 3));
    p = (i & 4) != 0 ? vec2(p.y, -p.x) : p;
    p = (i & 8) != 0 ? -p : p;
    float angle = 3.14159265 / 8.0 * float(i);
    p = outline.isRound ? (step == 1 ? 1.0130 : 1.0539) * vec2(cos(angle), -sin(angle)) : p;
    return outline.centre + p.x * outline.right + p.y * outline.up;
}

// The circle in which a cone around a ball touches it. A point within the ball has none.
Outline outlineOf(Light light, vec3 surfacePosition)
{
    vec3 toCentre = light.position.xyz - surfacePosition;
    float distance = max(length(toCentre), 1e-30);
    Outline outline = Outline(toCentre / distance, light.axis.xyz / distance, light.edge.xyz / distance, light.colour.w < 3.5);
    if (outline.isRound)
    {
        float sine = min(light.axis.w / distance, 1.0);
        vec3 c = outline.centre;
        outline.right = sine * normalize(abs(c.y) < 0.9 ? vec3(c.z, 0.0, -c.x) : vec3(0.0, -c.z, c.y));
        outline.up = cross(outline.right, c);
        outline.centre = sqrt(1.0 - sine * sine) * c;
    }

    return outline;
}

// The angle between two vectors times the unit vector that is perpendicular to both. The tangent of an eighth of the angle is taken by the
// sine, so that small angles keep their digits.
vec3 angleBetween(vec3 from, vec3 to)
{
    vec3 u = normalize(from);
    vec3 v = normalize(to);
    vec3 c = cross(u, v);
    float sine2 = dot(c, c);
    float half1 = 1.0 / (1.0 + max(dot(u, v), -0.999999));
    float quarter = half1 / (1.0 + sqrt(1.0 + half1 * half1 * sine2));
    float eighth = quarter / (1.0 + sqrt(1.0 + quarter * quarter * sine2));
    float t = eighth * eighth * sine2;
    return c * (8.0 * eighth * (1.0 - t * (1.0 / 3.0 - t * (1.0 / 5.0 - t * (1.0 / 7.0 - t / 9.0)))));
}

// The vector whose products with normals near n are the irradiance, divided by pi, of an evenly bright surface of the radiance 1: half the
// sum of what the edges of its visible part add, after J. H. Lambert, "Photometria", 1760.
vec3 quadFlux(Outline quad, vec3 n)
{
    vec3 front = cross(quad.right, quad.up);
    float facing = -dot(front, quad.centre);
    if (facing <= 0.0)
    {
        return vec3(0.0);
    }

    if (max(dot(quad.right, quad.right), dot(quad.up, quad.up)) < 1e-4)
    {
        return 4.0 * facing * quad.centre / 3.14159265;
    }

    vec3 sum = vec3(0.0);
    vec3 setting = vec3(0.0);
    vec3 rising = vec3(0.0);
    for (int i = 0; i < 16; i += 4)
    {
        vec3 from = outlinePoint(quad, i, 4);
        vec3 to = outlinePoint(quad, i + 4, 4);
        float height1 = dot(n, from);
        float height2 = dot(n, to);
        vec3 crossing = mix(from, to, height1 / (height1 - height2));
        if (height1 > 0.0 && height2 <= 0.0)
        {
            to = crossing;
            setting = crossing;
        }
        else if (height1 <= 0.0 && height2 > 0.0)
        {
            from = crossing;
            rising = crossing;
        }

        sum += max(height1, height2) > 0.0 ? angleBetween(from, to) : vec3(0.0);
    }

    sum += dot(setting, setting) > 0.0 && dot(rising, rising) > 0.0 ? angleBetween(setting, rising) : vec3(0.0);
    return sum / (2.0 * 3.14159265);
}

// Likewise of a ball: the arc of its outline above the horizon, and the part of the horizon between the ends of that.
vec3 ballFlux(Light light, vec3 surfacePosition, vec3 n)
{
    vec3 toCentre = light.position.xyz - surfacePosition;
    float distance = length(toCentre);
    float sine = light.axis.w / distance;
    if (!(sine < 1.0))
    {
        return vec3(0.0);
    }

    vec3 c = toCentre / distance;
    float height = dot(n, c);
    if (height >= sine)
    {
        return sine * sine * c;
    }

    if (height <= -sine)
    {
        return vec3(0.0);
    }

    vec3 level = n - height * c;
    float across = length(level);
    float cosine = sqrt(1.0 - sine * sine);
    // Of the angle along the outline, from its highest point, where it meets the horizon.
    float cosineEnd = clamp(-cosine * height / (sine * across), -1.0, 1.0);
    float sineEnd = sqrt(1.0 - cosineEnd * cosineEnd);
    // Drivers know arc tangents better than arc cosines.
    float angle = atan(sineEnd, cosineEnd);
    vec3 arc = sine * (sine * angle * c - cosine * sineEnd * level / across);
    float horizon = atan(sine * sineEnd, cosine * across - sine * height * cosineEnd);
    vec3 flux = (arc + horizon * n) / 3.14159265;
    // Of a small ball the last terms cancel each other: it is a disc, whose part above the horizon is integrated by its width.
    float t = height / sine;
    float chord = sqrt(1.0 - t * t);
    float ofDisc = sine * sine * sine * (t * atan(chord, -t) + chord * (2.0 + t * t) / 3.0) / 3.14159265;
    return sine < 0.05 ? ofDisc / (height + sine) * (c + sine * n) : flux;
}

// The length of that vector for any lamp with a surface, and its unit vector.
float fluxOf(Light light, vec3 surfacePosition, vec3 n, out vec3 toLight)
{
    vec3 flux = light.colour.w < 3.5 ? ballFlux(light, surfacePosition, n) : quadFlux(outlineOf(light, surfacePosition), n);
    toLight = direction(flux);
    return length(flux);
}

// From 0 to 1: how much of the shadow counts that is seen from the middle of a lamp. Where that sinks below the horizon of a face, the face
// would darken at once, while it still sees a part of the lamp.
float shadowOf(Light light, vec3 surfacePosition, vec3 n)
{
    float size = light.colour.w < 3.5 ? light.axis.w : abs(dot(n, light.axis.xyz)) + abs(dot(n, light.edge.xyz));
    float height = dot(n, light.position.xyz - surfacePosition);
    return light.colour.w < 2.5 || height >= 0.3 * size ? 1.0 : smoothstep(0.0, 0.3 * size, height);
}

// As incomingLight, of a lamp that has a surface as well: for a normal whose horizon hides what is below it.
vec3 incomingLight(Light light, vec3 surfacePosition, vec3 n, out vec3 toLight)
{
    if (light.colour.w < 2.5)
    {
        return incomingLight(light, surfacePosition, toLight);
    }

    float d = distance(light.position.xyz, surfacePosition) / light.position.w;
    float window = clamp(1.0 - d * d * d * d, 0.0, 1.0);
    return window * window * fluxOf(light, surfacePosition, n, toLight) * light.colour.rgb;
}
#else
vec3 incomingLight(Light light, vec3 surfacePosition, vec3 n, out vec3 toLight)
{
    return incomingLight(light, surfacePosition, toLight);
}
#endif

// The direction from a surface point towards the eye. The projection is orthographic where w does not depend on depth.
vec3 towardsEye(vec3 surfacePosition, vec3 forward, vec4 depthScale)
{
    return depthScale.z != 0.0 ? direction(-surfacePosition) : -forward;
}
