#version 330 core
#extension GL_ARB_texture_gather : enable
// The colour of the visible face. Front faces are wound clockwise on the screen in a left-handed scene, the other way in a
// right-handed one. PER_PIXEL, TEXTURED, GLOSSY, FRONT_FACES_ONLY, CUT_OUT, EMISSIVE, ATMOSPHERE, SHADOWS, POINT_SHADOWS,
// SHADOW_SLICES, SECTION, SKY_PARTS and GRADED are defined where they apply.

#include "material.glsl"
#if defined(PER_PIXEL) || defined(ATMOSPHERE)
#include "lighting.glsl"

uniform vec3 cameraAxes[3]; // right, up and forward: the rows of the inverse axes
uniform vec4 depthScale;    // z = x*depth + y, w = z*depth + w

in vec3 pixelPosition;
#endif
#ifdef ATMOSPHERE
#include "display.glsl"
#endif
#if defined(DETAILED) && defined(PER_PIXEL)
#include "detail.glsl"
#endif
#if defined(GLOSSY) && defined(PER_PIXEL)
#include "gloss.glsl"
#endif
#ifdef SHADOWS
#include "shadows.glsl"
#endif
#ifdef PER_PIXEL
in vec3 pixelNormal;
in vec3 pixelColour;
#ifdef SKY_PARTS
in vec2 pixelSky;

// The part of direct light that falls on the surfaces around an open place, on the mean: some face away, some are in shadow. In a hole it
// falls with the part of the sky that is seen.
const float directPart = 0.2;

// The light from all around within a hole. What hides the sky has about the same colour, and shines back what it gets: the sky that is
// seen here, and a part of the direct light. So e = part * sky + (1 - part) * albedo * (directPart * part * direct + e).
vec3 lightInHole(vec3 sky, float part, vec3 direct, vec3 albedo)
{
    vec3 returned = (1.0 - part) * min(albedo, 0.95);
    return (part * sky + returned * directPart * part * direct) / (1.0 - returned);
}
#endif
#else
in vec3 frontColour;
#ifdef GLOSSY
in vec3 frontHighlight;
#endif
#ifndef FRONT_FACES_ONLY
in vec3 backColour;
#ifdef GLOSSY
in vec3 backHighlight;
#endif
#endif
#endif
#ifdef GRADED
in vec4 pixelGrade;
#endif
#ifdef TEXTURED
in vec2 pixelTextureCoordinates;

uniform sampler2D surfaceTexture;
#endif

out vec4 fragment;          // multiplied by its opacity

#if defined(SECTION) && defined(PER_PIXEL)
uniform vec4 section;       // points relative to the camera with dot(xyz, p) + w < 0 are cut away
uniform float innerFace;    // which face of a solid's triangles is inside: -1 back, 1 front; 0 where the surface is open

// So much nearer is what is seen of a cut solid's inner side than what touches it from outside, as neighbours in a fractal do.
const float capBias = 1e-5;

// Where the eye looks through the plane into a solid, the point of the plane before the inner side that it sees; otherwise the point
// itself. Sets the depth: nearest is what lies behind the plane, so that the depth stays that of the inner side.
vec3 fillSection(vec3 position, out bool isCap)
{
    float depth = dot(position, cameraAxes[2]);
    vec3 eye = depthScale.z != 0.0 ? vec3(0.0) : position - depth * cameraAxes[2];
    float atEye = dot(section.xyz, eye) + section.w;
    float atPixel = dot(section.xyz, position) + section.w;
    isCap = atEye < 0.0 && innerFace != 0.0 && gl_FrontFacing == (innerFace > 0.0);
    gl_FragDepth = gl_FragCoord.z;
    if (isCap)
    {
        float nearer = depth * (1.0 - capBias);
        float z = (depthScale.x * nearer + depthScale.y) / (depthScale.z * nearer + depthScale.w);
        // Reversed depths are stored as they are. At the edge of a steep face, the middle of a pixel may lie beyond the far plane.
        gl_FragDepth = clamp(depthScale.x < 0.0 ? z : 0.5 * z + 0.5, 1e-6, 1.0 - 1e-6);
    }

    return isCap ? mix(eye, position, atEye / (atEye - max(atPixel, 0.0))) : position;
}
#endif

#ifdef PER_PIXEL
// Adds what one light does. Its index is constant: see LightBlock.SymbolsOf.
#ifdef GLOSSY
void addLight(
    int i, vec3 position, vec3 n, vec3 faceNormal, Gloss gloss, vec3 toEye, inout vec3 light, inout vec3 direct, inout vec3 highlights)
#else
void addLight(int i, vec3 position, vec3 n, vec3 faceNormal, inout vec3 light, inout vec3 direct)
#endif
{
    vec3 toLight;
    vec3 incoming = incomingLight(lights[i], position, n, toLight);
    float cosine = dot(n, toLight);
#ifdef SKY_PARTS
    direct += incoming;
#endif
#ifdef SHADOWS
    if (cosine > 0.0)
    {
        float arriving = lightThatArrives(i, position, faceNormal, toLight);
#ifdef SURFACE_LIGHTS
        arriving = mix(1.0, arriving, shadowOf(lights[i], position, faceNormal));
#endif
        incoming *= arriving;
    }
#endif
#ifdef GLOSSY
    if (cosine > 0.0)
    {
        addGloss(lights[i], position, gloss, n, toEye, toLight, cosine, incoming, light, highlights);
    }
#else
    light += max(cosine, 0.0) * incoming;
#endif
}

#ifdef GLOSSY
#define ADD_LIGHT(i) addLight(i, position, n, faceNormal, gloss, toEye, light, direct, highlights);
#else
#define ADD_LIGHT(i) addLight(i, position, n, faceNormal, light, direct);
#endif
#endif

void main()
{
#ifdef GRADED
    grade(pixelGrade.w);
#endif
    float opacity = material[0].w;
#ifdef TEXTURED
    // A hole in the texture is a hole in the surface and has no highlight. Clear glass, by its opacity, keeps its highlight.
    vec4 texel = texture(surfaceTexture, pixelTextureCoordinates);
#ifdef CUT_OUT
    if (texel.a < 0.5)
    {
        discard;
    }
#else
    opacity *= texel.a;
#endif
#endif
    vec3 highlights = vec3(0.0);
#if defined(PER_PIXEL) || defined(ATMOSPHERE)
    vec3 position = pixelPosition;
#endif
#ifdef PER_PIXEL
    vec3 n = direction(gl_FrontFacing ? pixelNormal : -pixelNormal);
    vec3 faceNormal = n;
#ifdef SHADOWS
    faceNormal = faceNormalTowardsEye(position, depthScale.z != 0.0 ? -position : -cameraAxes[2], n);
#endif
#ifdef SECTION
    bool isCap;
    position = fillSection(position, isCap);
    if (isCap)
    {
        n = -section.xyz;
        faceNormal = n;
    }
#endif
#ifdef DETAILED
    n = bend(n, pixelPosition, towardsEye(position, cameraAxes[2], depthScale));
#endif
    vec3 ambient = ambientLight(n);
    vec3 light = material[2].rgb * ambient;
    vec3 direct = vec3(0.0);
    vec3 surface = pixelColour;
#ifdef TEXTURED
    surface *= texel.rgb;
#endif
#ifdef GLOSSY
    vec3 toEye = towardsEye(position, cameraAxes[2], depthScale);
    Gloss gloss = glossOf(surface, n, toEye);
    vec3 mirrored = mirroredSurroundings(position, gloss, n, toEye, ambient);
    surface = gloss.scattered;
#endif
#ifdef SKY_PARTS
    vec3 sky = light;
    light = vec3(0.0);
#endif
    EACH_LIGHT(ADD_LIGHT)

#ifdef SKY_PARTS
    float seenSky = clamp(gl_FrontFacing ? pixelSky.x : pixelSky.y, 0.0, 1.0);
#ifdef SECTION
    seenSky = isCap ? 1.0 : seenSky;
#endif
    light += lightInHole(sky, seenSky, direct, pixelColour);
#ifdef GLOSSY
    mirrored *= seenSky;
#endif
#endif
#ifdef GLOSSY
    highlights += mirrored;
#endif
    vec3 colour = surface * light;
#else
#ifdef FRONT_FACES_ONLY
    vec3 colour = frontColour;
#ifdef GLOSSY
    highlights = frontHighlight;
#endif
#else
    vec3 colour = gl_FrontFacing ? frontColour : backColour;
#ifdef GLOSSY
    highlights = gl_FrontFacing ? frontHighlight : backHighlight;
#endif
#endif
#endif

#if defined(TEXTURED) && !defined(PER_PIXEL)
    colour *= texel.rgb;
#endif
#if defined(TEXTURED) && !defined(CUT_OUT)
    highlights *= texel.a;
#endif
#ifdef EMISSIVE
    colour += material[4].rgb;
#endif
#ifdef GRADED
    colour += pixelGrade.rgb;
#endif
    vec3 shown = colour * opacity + highlights;
    float coverage = opacity;
#if defined(GLOSSY) && defined(PER_PIXEL)
    // What is mirrored does not come through.
    float covered = 1.0 - (1.0 - material[0].w) * dot(throughCoat(gloss.facets), vec3(1.0 / 3.0));
#if defined(TEXTURED) && !defined(CUT_OUT)
    covered *= texel.a;
#endif
    coverage = covered;
#endif
#ifdef ATMOSPHERE
    // An orthographic view measures the distance from its plane.
    float distance = depthScale.z != 0.0 ? length(position) : max(dot(position, cameraAxes[2]), 0.0);
    // Where clear glass has a highlight, that covers what is behind.
    coverage = clamp(max(coverage, max(highlights.r, max(highlights.g, highlights.b))), 1e-4, 1.0);
    shown = coverage * toScreen(throughHaze(shown / coverage, distance));
#endif
    fragment = vec4(shown, coverage);
}
