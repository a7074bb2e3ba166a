#version 330 core
// One vertex of one instance: to the screen by map(v) = axes^-1 * (v - position), lit by all lights on both of its sides, unless each pixel is.
// PER_PIXEL, TEXTURED, GLOSSY, IN_WORLD and FRONT_ONLY are defined where they apply.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 instanceRow0;
layout(location = 3) in vec4 instanceRow1;
layout(location = 4) in vec4 instanceRow2;
layout(location = 5) in float tint;  // from the object's colour to the other end of its gradient; 0 where there is none
#ifdef TEXTURED
layout(location = 6) in vec2 texturePosition;
#endif

layout(std140) uniform ObjectBlock
{
    vec4 linear[3];      // columns of the object's map
    vec4 cofactors[3];   // columns of its cofactor matrix, scaled to entries of at most 1
    vec4 translation;    // relative to the camera
    vec4 colour;         // linear light
    vec4 farColour;      // linear light, at the other end of the gradient
};

#include "material.glsl"
#include "lighting.glsl"

uniform vec3 cameraAxes[3]; // right, up and forward: the rows of the inverse axes
uniform vec2 viewScale;     // 1 / (half height * aspect), 1 / half height
uniform vec4 depthScale;    // z = x*depth + y, w = z*depth + w
uniform vec4 flatColour;     // linear light; w: how much of it replaces the lit colour

#ifdef PER_PIXEL
out vec3 pixelPlace;        // relative to the camera
out vec3 pixelNormal;
out vec3 pixelColour;       // linear light, before any light falls on it
#else
out vec3 frontColour;
#ifndef FRONT_ONLY
out vec3 backColour;
#endif
#ifdef GLOSSY
out vec3 frontHighlight;
#ifndef FRONT_ONLY
out vec3 backHighlight;
#endif
#endif
#endif
#ifdef TEXTURED
out vec2 picturePosition;
#endif

void main()
{
    vec4 local = vec4(position, 1.0);
    vec3 inModel = vec3(dot(instanceRow0, local), dot(instanceRow1, local), dot(instanceRow2, local));
#ifdef IN_WORLD
    vec3 place = inModel;
#else
    vec3 place = linear[0].xyz * inModel.x + linear[1].xyz * inModel.y + linear[2].xyz * inModel.z + translation.xyz;
#endif

    vec3 seen = vec3(dot(cameraAxes[0], place), dot(cameraAxes[1], place), dot(cameraAxes[2], place));
    gl_Position = vec4(seen.xy * viewScale, depthScale.x * seen.z + depthScale.y, depthScale.z * seen.z + depthScale.w);

    // The cofactor matrix takes the cross product of two edges to that of their images, also under skew, mirrors and flattening:
    // the normal stays on the side from which the triangle is seen as a front face.
    vec3 c0 = vec3(instanceRow0.x, instanceRow1.x, instanceRow2.x);
    vec3 c1 = vec3(instanceRow0.y, instanceRow1.y, instanceRow2.y);
    vec3 c2 = vec3(instanceRow0.z, instanceRow1.z, instanceRow2.z);
    vec3 n = direction(cross(c1, c2) * normal.x + cross(c2, c0) * normal.y + cross(c0, c1) * normal.z);
#ifndef IN_WORLD
    n = direction(cofactors[0].xyz * n.x + cofactors[1].xyz * n.y + cofactors[2].xyz * n.z);
#endif

    vec3 surface = mix(mix(colour.rgb, farColour.rgb, tint), material[0].rgb, material[2].w);
#ifdef TEXTURED
    // Pictures are stored from the top, texture coordinates count from the bottom.
    vec2 inPicture = texturePosition * material[3].xy + material[3].zw;
    picturePosition = vec2(inPicture.x, 1.0 - inPicture.y);
#endif

#ifdef PER_PIXEL
    pixelPlace = place;
    pixelNormal = n;
    pixelColour = surface;
#else
    float upwards = 0.5 + 0.5 * n.y;
    vec3 front = material[2].rgb * mix(groundColour.rgb, skyColour.rgb, upwards);
#ifndef FRONT_ONLY
    vec3 back = material[2].rgb * mix(skyColour.rgb, groundColour.rgb, upwards);
#endif
#ifdef GLOSSY
    vec3 toEye = towardsEye(place, cameraAxes[2], depthScale);
    frontHighlight = vec3(0.0);
#ifndef FRONT_ONLY
    backHighlight = vec3(0.0);
#endif
#endif
    for (int i = 0; i < lightCount.x; i++)
    {
        vec3 toLight;
        vec3 light = arriving(lights[i], place, toLight);
        float cosine = dot(n, toLight);
        front += max(cosine, 0.0) * light;
#ifndef FRONT_ONLY
        back += max(-cosine, 0.0) * light;
#endif
#ifdef GLOSSY
        float side = sign(cosine);
        vec3 returned = highlight(side * n, toLight, toEye, material[1].w) * light * material[1].rgb;
        frontHighlight += max(side, 0.0) * returned;
#ifndef FRONT_ONLY
        backHighlight += max(-side, 0.0) * returned;
#endif
#endif
    }

    frontColour = mix(surface * front, flatColour.rgb, flatColour.a);
#ifndef FRONT_ONLY
    backColour = mix(surface * back, flatColour.rgb, flatColour.a);
#endif
#endif
}
