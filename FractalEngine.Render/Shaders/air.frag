#version 330 core
#extension GL_ARB_texture_gather : enable
// The light of suns and lamps that the air scatters once towards the eye, for every second pixel of every second row: as if the whole way
// lost all light; and the distance to the surface behind. SHADOWS, POINT_SHADOWS and SHADOW_SLICES are defined where they apply.
#define AIR

#include "lighting.glsl"
#include "air.glsl"
#ifdef SHADOWS
#include "shadows.glsl"
#endif

out vec4 fragment;

// Points of the way for each light. With those of 4 by 4 neighbours, which lie between them, there are 256.
const int steps = 16;

// As Core's Fog.Phase, times pi: an intensity of 1 stands for the irradiance pi.
float phase(float cosine)
{
    float g = fogColour.w;
    float squared = 1.0 + g * g - 2.0 * g * cosine;
    return 0.25 * (1.0 - g * g) / (squared * sqrt(squared));
}

vec3 lightAt(int i, vec3 position, vec3 ray)
{
    vec3 toLight;
    vec3 incoming = incomingLight(lights[i], position, toLight);
#ifdef SHADOWS
    // A point of the air faces all lights.
    incoming *= lightThatArrives(i, position, toLight, toLight);
#endif
    return phase(dot(toLight, ray)) * incoming;
}

// Parallel light at points as dense as what they scatter and what arrives of that.
vec3 scatteredOfSun(int i, vec3 eye, vec3 ray, float end, float offset)
{
    float lost = lostPart(end);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < steps; k++)
    {
        float x = lost * (float(k) + offset) / float(steps);
        float passed = (x < 1e-3 ? x * (1.0 + 0.5 * x) : -log(1.0 - x)) / display.z;
        sum += lightAt(i, eye + passed * ray, ray);
    }

    return sum / float(steps);
}

// A lamp at points of equal angles, as the lamp sees them (C. Kulla and M. Fajardo, EGSR 2012), within its range.
vec3 scatteredOfLamp(int i, vec3 eye, vec3 ray, float end, float offset)
{
    vec3 toLamp = lights[i].position.xyz - eye;
    float range = lights[i].position.w;
    float closest = dot(toLamp, ray);
    float aside = length(toLamp - closest * ray);
    float halfWay = range * sqrt(max(1.0 - aside * aside / (range * range), 0.0));
    float width = max(aside, 1e-4 * range);
    float first = atan((max(closest - halfWay, 0.0) - closest) / width);
    float last = atan((min(closest + halfWay, end) - closest) / width);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < steps && last > first; k++)
    {
        float tangent = tan(mix(first, last, (float(k) + offset) / float(steps)));
        float passed = closest + width * tangent;
        sum += width * (1.0 + tangent * tangent) * exp(-display.z * passed) * lightAt(i, eye + passed * ray, ray);
    }

    return max(last - first, 0.0) * display.z / max(lostPart(end), 1e-30) * sum / float(steps);
}

#define ADD_LIGHT(i) light += lights[i].colour.w > 0.5 ? scatteredOfLamp(i, eye, ray, end, offset) : scatteredOfSun(i, eye, ray, end, offset);

void main()
{
    ivec2 cell = ivec2(gl_FragCoord.xy);
    ivec2 pixel = min(2 * cell, viewport.zw - 1);
    vec2 plane = planePoint(pixel);
    vec3 aside = plane.x * cameraAxes[0] + plane.y * cameraAxes[1] - dot(plane, lean()) * cameraAxes[2];
    bool isPerspective = depthScale.z != 0.0;
    vec3 eye = isPerspective ? vec3(0.0) : aside;
    vec3 ray = isPerspective ? normalize(aside + cameraAxes[2]) : cameraAxes[2];
    float end = distanceAt(pixel, 0);
    // Ranks of an ordered 4 x 4 pattern.
    int x = cell.x ^ cell.y;
    int rank = ((x & 1) << 3) | ((cell.y & 1) << 2) | (x & 2) | ((cell.y & 2) >> 1);
    float offset = (float(rank) + 0.5) / 16.0;
    vec3 light = vec3(0.0);
    EACH_LIGHT(ADD_LIGHT)
    fragment = vec4(display.w * light, end);
}
