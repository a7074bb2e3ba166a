// The air that the eye looks through. Behind lighting.glsl.
uniform vec3 cameraAxes[3]; // right, up and forward: the rows of the inverse axes
uniform vec2 viewScale;     // 1 / (half height * aspect), 1 / half height
uniform vec4 depthScale;    // z = x*depth + y, w = z*depth + w
uniform ivec4 viewport;     // first pixel from below, width and height
#ifdef SAMPLES
uniform sampler2DMS depths; // of the whole frame
#else
uniform sampler2D depths;
#define SAMPLES 1
#endif

// How far the eye looks where it meets no surface.
const float endless = 1e30;

// How far an image that is moved on the screen shows other points: the first two axes then lean forward.
vec2 lean()
{
    return vec2(dot(cameraAxes[0], cameraAxes[2]), dot(cameraAxes[1], cameraAxes[2]));
}

// What a pixel of the viewport shows in the plane at depth 1, from its middle; without perspective at any depth.
vec2 planePoint(ivec2 pixel)
{
    return ((2.0 * vec2(pixel) + 1.0) / vec2(viewport.zw) - 1.0) / viewScale - lean();
}

// The distance of the surface at a sample of a pixel of the viewport. An orthographic view measures it from its plane.
float distanceAt(ivec2 pixel, int index)
{
    float stored = texelFetch(depths, viewport.xy + pixel, index).r;
    bool isReversed = depthScale.x < 0.0;
    if (stored == (isReversed ? 0.0 : 1.0))
    {
        return endless;
    }

    float z = isReversed ? stored : 2.0 * stored - 1.0;
    float depth = (depthScale.y - z * depthScale.w) / (z * depthScale.z - depthScale.x);
    return depthScale.z != 0.0 ? depth * length(vec3(planePoint(pixel), 1.0)) : max(depth, 0.0);
}

// The part of light that is lost on a way.
float lostPart(float distance)
{
    float x = display.z * distance;
    return x < 1e-3 ? x * (1.0 - 0.5 * x) : 1.0 - exp(-x);
}
