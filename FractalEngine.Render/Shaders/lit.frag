#version 330 core
// A frame, with the light that the air before it scatters.

#include "lighting.glsl"
#include "display.glsl"
#include "air.glsl"

uniform sampler2D frame; // GL decodes its sRGB
uniform sampler2D air;   // of air.frag

out vec4 fragment;

// The light of the air before a surface.
vec3 lightBefore(float end, ivec2 pixel)
{
    // One point of each rank of the pattern. Those before and behind an edge look through other air.
    ivec2 first = ((pixel + 1) >> 1) - 2;
    ivec2 last = textureSize(air, 0) - 1;
    float scale = 20.0 / end;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 16; i++)
    {
        vec4 point = texelFetch(air, clamp(first + ivec2(i & 3, i >> 2), ivec2(0), last), 0);
        float difference = scale * (point.w - end);
        float closeness = 1.0 / (1.0 + difference * difference);
        // All count alike where none is close.
        sum += (closeness * closeness + 1e-9) * vec4(point.rgb, 1.0);
    }

    return lostPart(end) * sum.rgb / sum.w;
}

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 pixel = texel - viewport.xy;
    float nearest = endless;
    float farthest = 0.0;
    float distances[SAMPLES];
    for (int i = 0; i < SAMPLES; i++)
    {
        distances[i] = distanceAt(pixel, i);
        nearest = min(nearest, distances[i]);
        farthest = max(farthest, distances[i]);
    }

    vec3 light = lightBefore(nearest, pixel);
    if (farthest > 1.01 * nearest)
    {
        // A pixel at an edge shows two surfaces.
        float farther = 0.0;
        for (int i = 0; i < SAMPLES; i++)
        {
            farther += distances[i] - nearest > farthest - distances[i] ? 1.0 / float(SAMPLES) : 0.0;
        }

        light = mix(light, lightBefore(farthest, pixel), farther);
    }

    vec4 shown = texelFetch(frame, texel, 0);
    fragment = vec4(toScreen(toScene(shown.rgb) + light), shown.a);
}
