#version 330 core
// Evenly bright surfaces.

#include "lighting.glsl"
#include "display.glsl"

uniform vec3 cameraAxes[3]; // right, up and forward: the rows of the inverse axes
uniform vec4 depthScale;    // z = x*depth + y, w = z*depth + w

in vec3 pixelPosition;
flat in vec3 radiance;

out vec4 fragment;

void main()
{
    // An orthographic view measures the distance from its plane.
    float distance = depthScale.z != 0.0 ? length(pixelPosition) : max(dot(pixelPosition, cameraAxes[2]), 0.0);
    fragment = vec4(toScreen(throughHaze(radiance, distance)), 1.0);
}
