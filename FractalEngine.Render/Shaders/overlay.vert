#version 330 core
// A rectangle of the overlay for each instance; its four corners come from the vertex index.

layout(location = 0) in vec4 rectangle; // pixels from the upper left corner: x, y, width, height
layout(location = 1) in vec4 tint;      // sRGB and opacity
layout(location = 2) in vec2 kind;      // the glyph's index or -1; the radius of the corners in pixels

uniform vec2 frameSize; // pixels

flat out vec4 colour;
flat out vec2 glyphAndRadius;
flat out vec2 size;
out vec2 localPosition; // from the rectangle's upper left corner, pixels

void main()
{
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    colour = tint;
    glyphAndRadius = kind;
    size = rectangle.zw;
    localPosition = corner * size;
    vec2 pixel = rectangle.xy + localPosition;
    gl_Position = vec4(2.0 * pixel.x / frameSize.x - 1.0, 1.0 - 2.0 * pixel.y / frameSize.y, 0.0, 1.0);
}
