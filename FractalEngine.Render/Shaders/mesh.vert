#version 330 core
// One vertex of one instance: projected by map(v) = axes^-1 * (v - position), and lit by all lights on both faces, unless pixels are lit.
// PER_PIXEL, TEXTURED, GLOSSY, CAMERA_RELATIVE, FRONT_FACES_ONLY, VERTEX_COLOURS, SECTION, GRADED and
// COVERED_SIDES are defined where they apply.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 instanceRow0;
layout(location = 3) in vec4 instanceRow1;
layout(location = 4) in vec4 instanceRow2;
layout(location = 5) in float tint;  // from the object's colour to the other end of its gradient; 0 without a gradient
#if defined(TEXTURED) || defined(DETAILED)
layout(location = 6) in vec2 textureCoordinates;
#endif
#ifdef VERTEX_COLOURS
layout(location = 7) in vec3 vertexColour; // linear light
#endif

#ifdef SKY_PARTS
layout(location = 8) in vec3 skyAbove; // parts of the sky that the instance's sides see, towards x, y and z of the mesh
layout(location = 9) in vec3 skyBelow; // towards -x, -y and -z
#endif
#ifdef COVERED_SIDES
layout(location = 12) in float coveredSides; // sum of 1, 2, 4 for sides towards x, y, z and 8, 16, 32 for the others
#endif
layout(location = 10) in vec4 mapTint; // what maps add to the colour, linear light, and the share w that it keeps; else 0, 0, 0, 1
layout(location = 11) in vec4 paletteColour; // of a gradient with a palette, linear light, and 0; else 0, 0, 0, 1

layout(std140) uniform ObjectBlock
{
    vec4 linear[3];      // columns of the object's map
    vec4 cofactors[3];   // columns of its cofactor matrix, scaled to entries of at most 1
    vec4 translation;    // relative to the camera
    vec4 colour;         // linear light
    vec4 gradientEnd;    // linear light, at the other end of the gradient
};

#include "material.glsl"
#include "lighting.glsl"
#if defined(GLOSSY) && !defined(PER_PIXEL)
#include "gloss.glsl"

// Lights one side of a surface, and returns what it mirrors.
vec3 lightGloss(inout vec3 surface, vec3 n, vec3 position, vec3 toEye, inout vec3 light)
{
    Gloss gloss = glossOf(surface, n, toEye);
    vec3 mirrored = mirroredSurroundings(position, gloss, n, toEye, ambientLight(n));
    for (int i = 0; i < lightCount.x; i++)
    {
        vec3 toLight;
        vec3 incoming = incomingLight(lights[i], position, n, toLight);
        float cosine = dot(n, toLight);
        if (cosine > 0.0)
        {
            addGloss(lights[i], position, gloss, n, toEye, toLight, cosine, incoming, light, mirrored);
        }
    }

    surface = gloss.scattered;
    return mirrored;
}
#endif

uniform vec3 cameraAxes[3]; // right, up and forward: the rows of the inverse axes
uniform vec2 viewScale;     // 1 / (half height * aspect), 1 / half height
uniform vec4 depthScale;    // z = x*depth + y, w = z*depth + w
uniform vec4 flatColour;    // linear light; w: how much of it replaces the lit colour
#ifdef SECTION
uniform vec4 section;       // points relative to the camera with dot(xyz, p) + w < 0 are cut away
#endif

#if defined(PER_PIXEL) || defined(ATMOSPHERE)
out vec3 pixelPosition;     // relative to the camera
#endif
#ifdef PER_PIXEL
out vec3 pixelNormal;
out vec3 pixelColour;       // linear light, before lighting
#else
out vec3 frontColour;
#ifndef FRONT_FACES_ONLY
out vec3 backColour;
#endif
#ifdef GLOSSY
out vec3 frontHighlight;
#ifndef FRONT_FACES_ONLY
out vec3 backHighlight;
#endif
#endif
#endif
#ifdef SKY_PARTS
out vec2 pixelSky;          // part of the sky that the front and the back of the surface see
#endif
#ifdef TEXTURED
out vec2 pixelTextureCoordinates;
#endif

#ifdef GRADED
out vec4 pixelGrade;        // emitted light, and the place in the gradient
#endif
#if defined(DETAILED) && defined(PER_PIXEL)
out vec2 pixelDetail;       // texture coordinates as the mesh has them
#endif

void main()
{
#ifdef GRADED
    grade(tint);
#endif
#ifdef COVERED_SIDES
    // Where boxes meet whose sides are left out, floats of their places differ in the last digits, and nothing is behind a gap. So each is
    // larger by some units in the last place of the distance from the camera, along each axis whatever its scale.
    vec3 scales = sqrt(instanceRow0.xyz * instanceRow0.xyz + instanceRow1.xyz * instanceRow1.xyz + instanceRow2.xyz * instanceRow2.xyz);
    float gap = coveredSides > 0.0 ? 5e-7 * length(vec3(instanceRow0.w, instanceRow1.w, instanceRow2.w)) : 0.0;
    vec4 local = vec4(position + sign(position) * gap / max(scales, 1e-30), 1.0);
#else
    vec4 local = vec4(position, 1.0);
#endif
    vec3 inModel = vec3(dot(instanceRow0, local), dot(instanceRow1, local), dot(instanceRow2, local));
#ifdef CAMERA_RELATIVE
    vec3 relative = inModel;
#else
    vec3 relative = linear[0].xyz * inModel.x + linear[1].xyz * inModel.y + linear[2].xyz * inModel.z + translation.xyz;
#endif

    vec3 viewPosition = vec3(dot(cameraAxes[0], relative), dot(cameraAxes[1], relative), dot(cameraAxes[2], relative));
    gl_Position = vec4(
        viewPosition.xy * viewScale, depthScale.x * viewPosition.z + depthScale.y, depthScale.z * viewPosition.z + depthScale.w);
#ifdef SECTION
    gl_ClipDistance[0] = dot(section.xyz, relative) + section.w;
#endif

#ifdef COVERED_SIDES
    // All corners of a side that is never seen are one point, so that its triangles end here. Normals lie along the axes.
    float side = dot(max(normal, 0.0), vec3(1.0, 2.0, 4.0)) + dot(max(-normal, 0.0), vec3(8.0, 16.0, 32.0));
    gl_Position = (int(coveredSides) & int(side + 0.5)) != 0 ? vec4(0.0, 0.0, 0.0, 1.0) : gl_Position;
#endif

    // The cofactor matrix maps the cross product of two edges to that of the mapped edges, also under skewed, mirrored and flat maps:
    // the normal stays on the side from which the triangle is seen as a front face.
    vec3 c0 = vec3(instanceRow0.x, instanceRow1.x, instanceRow2.x);
    vec3 c1 = vec3(instanceRow0.y, instanceRow1.y, instanceRow2.y);
    vec3 c2 = vec3(instanceRow0.z, instanceRow1.z, instanceRow2.z);
    vec3 n = direction(cross(c1, c2) * normal.x + cross(c2, c0) * normal.y + cross(c0, c1) * normal.z);
#ifndef CAMERA_RELATIVE
    n = direction(cofactors[0].xyz * n.x + cofactors[1].xyz * n.y + cofactors[2].xyz * n.z);
#endif

#ifdef SKY_PARTS
    vec3 squares = normal * normal / max(dot(normal, normal), 1e-30);
    vec3 isAbove = step(0.0, normal);
    pixelSky = vec2(dot(squares, mix(skyBelow, skyAbove, isAbove)), dot(squares, mix(skyAbove, skyBelow, isAbove)));
#endif

    vec3 surface = paletteColour.rgb + paletteColour.w * mix(colour.rgb, gradientEnd.rgb, tint);
    surface = mix(surface, material[0].rgb, material[2].w);
#ifdef VERTEX_COLOURS
    surface *= vertexColour;
#endif
    surface = mapTint.rgb + mapTint.w * surface;
#ifdef GRADED
    pixelGrade = vec4(mix(gradedEnds.z, gradedEnds.w, tint) * surface, tint);
#endif
#ifdef TEXTURED
    // Textures are stored from the top, texture coordinates count from the bottom.
    vec2 scaledCoordinates = textureCoordinates * material[3].xy + material[3].zw;
    pixelTextureCoordinates = vec2(scaledCoordinates.x, 1.0 - scaledCoordinates.y);
#endif

#if defined(DETAILED) && defined(PER_PIXEL)
    pixelDetail = textureCoordinates;
#endif
#if defined(PER_PIXEL) || defined(ATMOSPHERE)
    pixelPosition = relative;
#endif
#ifdef PER_PIXEL
    pixelNormal = n;
    pixelColour = surface;
#else
    vec3 front = material[2].rgb * ambientLight(n);
    vec3 frontSurface = surface;
#ifndef FRONT_FACES_ONLY
    vec3 back = material[2].rgb * ambientLight(-n);
    vec3 backSurface = surface;
#endif
#ifdef GLOSSY
    vec3 toEye = towardsEye(relative, cameraAxes[2], depthScale);
    frontHighlight = lightGloss(frontSurface, n, relative, toEye, front);
#ifndef FRONT_FACES_ONLY
    backHighlight = lightGloss(backSurface, -n, relative, toEye, back);
#endif
#else
    for (int i = 0; i < lightCount.x; i++)
    {
        vec3 toLight;
        vec3 light = incomingLight(lights[i], relative, n, toLight);
        float cosine = dot(n, toLight);
        front += max(cosine, 0.0) * light;
#ifndef FRONT_FACES_ONLY
#ifdef SURFACE_LIGHTS
        light = incomingLight(lights[i], relative, -n, toLight);
        cosine = dot(n, toLight);
#endif
        back += max(-cosine, 0.0) * light;
#endif
    }
#endif

    frontColour = mix(frontSurface * front, flatColour.rgb, flatColour.a);
#ifndef FRONT_FACES_ONLY
    backColour = mix(backSurface * back, flatColour.rgb, flatColour.a);
#endif
#endif
}
