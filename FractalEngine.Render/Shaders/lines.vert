#version 330 core
// Lines in world space, given relative to a point near them.

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 colour; // linear light and opacity

uniform vec3 cameraAxes[3]; // right, up and forward: the rows of the inverse axes
uniform vec2 viewScale;     // 1 / (half height * aspect), 1 / half height
uniform vec4 depthScale;    // z = x*depth + y, w = z*depth + w
uniform vec3 offset;        // of the point the lines are relative to, from the camera

out vec4 lineColour;

void main()
{
    vec3 place = position + offset;
    vec3 seen = vec3(dot(cameraAxes[0], place), dot(cameraAxes[1], place), dot(cameraAxes[2], place));
    gl_Position = vec4(seen.xy * viewScale, depthScale.x * seen.z + depthScale.y, depthScale.z * seen.z + depthScale.w);
    lineColour = colour;
}
