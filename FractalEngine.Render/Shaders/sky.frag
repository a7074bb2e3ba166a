#version 330 core
// The sky behind everything, as Core's ColourRadiance and ImageRadiance describe it.

#include "lighting.glsl"
#include "display.glsl"

#ifdef SKY_IMAGE
uniform sampler2D skyImage; // linear light: rows from above to below, columns once around
uniform vec2 place;        // x: where the direction ahead is, from the left; y: the sign of its z
uniform float scale;

const float pi = 3.14159265;

vec3 skyLight(vec3 direction)
{
    float u = place.x + atan(direction.x, place.y * direction.z) / (2.0 * pi);
    return scale * textureLod(skyImage, vec2(u, acos(clamp(direction.y, -1.0, 1.0)) / pi), 0.0).rgb;
}
#else
uniform vec3 zenith;  // linear light
uniform vec3 horizon;
uniform vec3 ground;

vec3 skyLight(vec3 direction)
{
    return direction.y >= 0.0 ? mix(horizon, zenith, direction.y) : mix(horizon, ground, sqrt(-direction.y));
}
#endif

in vec3 pixelDirection;

out vec4 fragment;

// What keeps a slow gradient from showing bands: less than half a step of the screen's 256 values more or less, by B. Bayer's ordered
// 8 x 8 pattern ("An optimum method for two-level rendition of continuous-tone pictures", 1973). Render.Images.OrderedDither is the same.
float dither(ivec2 pixel)
{
    int x = pixel.x ^ pixel.y;
    int rank = ((x & 1) << 5) | ((pixel.y & 1) << 4) | ((x & 2) << 2) | ((pixel.y & 2) << 1) | ((x & 4) >> 1) | ((pixel.y & 4) >> 2);
    return (float(rank) + 0.5) / 64.0 - 0.5;
}

void main()
{
    vec3 shown = toScreen(skyLight(normalize(pixelDirection)));
    // Steps of sRGB (IEC 61966-2-1) in linear light.
    vec3 step256 = max(2.4 / 1.055 * pow(shown, vec3(1.4 / 2.4)), vec3(1.0 / 12.92)) / 255.0;
    fragment = vec4(shown + dither(ivec2(gl_FragCoord.xy)) * step256, 1.0);
}
