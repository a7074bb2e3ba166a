#version 330 core
// Lines in world axes, given relative to a point near them.

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 colour; // linear light and opacity

uniform vec3 cameraAxes[3]; // right, up and forward: the rows of the inverse axes
uniform vec2 viewScale;     // 1 / (half height * aspect), 1 / half height
uniform vec4 depthScale;    // z = x*depth + y, w = z*depth + w
uniform vec3 offset;        // from the camera to the point that the lines are relative to

out vec4 lineColour;

void main()
{
    vec3 relative = position + offset; // to the camera
    vec3 viewPosition = vec3(dot(cameraAxes[0], relative), dot(cameraAxes[1], relative), dot(cameraAxes[2], relative));
    gl_Position = vec4(
        viewPosition.xy * viewScale, depthScale.x * viewPosition.z + depthScale.y, depthScale.z * viewPosition.z + depthScale.w);
    lineColour = colour;
}
