#version 330 core
// One vertex of one instance in the view of a light, for its depth alone.
// CAMERA_RELATIVE and CUT_OUT are defined where they apply.

layout(location = 0) in vec3 position;
layout(location = 2) in vec4 instanceRow0;
layout(location = 3) in vec4 instanceRow1;
layout(location = 4) in vec4 instanceRow2;
#ifdef CUT_OUT
layout(location = 6) in vec2 textureCoordinates;
#endif

layout(std140) uniform ObjectBlock
{
    vec4 linear[3];      // columns of the object's map
    vec4 cofactors[3];
    vec4 translation;    // relative to the light's eye
    vec4 colour;
    vec4 gradientEnd;
};

uniform vec3 lightAxes[3];      // right, up and forward: the rows of the inverse axes
uniform vec2 viewScale;         // 1 / half width, 1 / half height
uniform vec4 depthScale;        // z = x*depth + y, w = z*depth + w
uniform vec4 section;           // points relative to the light's eye with dot(xyz, p) + w < 0 are cut away, if clipping is on
#ifdef CUT_OUT
uniform vec4 textureTransform;  // scale and offset of texture coordinates

out vec2 pixelTextureCoordinates;
#endif

void main()
{
    vec4 local = vec4(position, 1.0);
    vec3 relative = vec3(dot(instanceRow0, local), dot(instanceRow1, local), dot(instanceRow2, local));
#ifndef CAMERA_RELATIVE
    relative = linear[0].xyz * relative.x + linear[1].xyz * relative.y + linear[2].xyz * relative.z + translation.xyz;
#endif
    vec3 view = vec3(dot(lightAxes[0], relative), dot(lightAxes[1], relative), dot(lightAxes[2], relative));
    gl_Position = vec4(view.xy * viewScale, depthScale.x * view.z + depthScale.y, depthScale.z * view.z + depthScale.w);
    gl_ClipDistance[0] = dot(section.xyz, relative) + section.w;
#ifdef CUT_OUT
    vec2 scaledCoordinates = textureCoordinates * textureTransform.xy + textureTransform.zw;
    pixelTextureCoordinates = vec2(scaledCoordinates.x, 1.0 - scaledCoordinates.y);
#endif
}
