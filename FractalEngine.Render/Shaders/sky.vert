#version 330 core
// A triangle that covers the viewport, made from the vertex index, and the directions in which its pixels look.

uniform vec3 cameraAxes[3]; // right, up and forward: the rows of the inverse axes
uniform vec2 halfSize;      // half width and half height at depth 1; 0 in an orthographic view
uniform vec2 offset;        // how far the image is moved, in halves of the viewport

out vec3 pixelDirection;

void main()
{
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    vec2 place = corner - offset;
    pixelDirection = place.x * halfSize.x * cameraAxes[0] + place.y * halfSize.y * cameraAxes[1] + cameraAxes[2];
    gl_Position = vec4(corner, 0.0, 1.0);
}
