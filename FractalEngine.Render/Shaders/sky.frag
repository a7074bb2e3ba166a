#version 330 core
// The sky behind everything, as Core's Sky describes it.

#include "lighting.glsl"
#include "display.glsl"

uniform vec3 zenith;  // linear light
uniform vec3 horizon;
uniform vec3 ground;

in vec3 pixelDirection;

out vec4 fragment;

void main()
{
    float height = normalize(pixelDirection).y;
    vec3 light = height >= 0.0 ? mix(horizon, zenith, height) : mix(horizon, ground, sqrt(-height));
    fragment = vec4(toScreen(light), 1.0);
}
