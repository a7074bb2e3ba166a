#version 330 core
// A glyph, texel by pixel, or a plain rectangle with smooth round corners.

flat in vec4 colour;
flat in vec2 glyphAndRadius;
flat in vec2 size;
in vec2 localPosition;

uniform sampler2D glyphs; // cells of the font, columns side by side
uniform ivec2 cellSize;   // pixels
uniform int columns;

out vec4 fragment;

void main()
{
    float coverage;
    if (glyphAndRadius.x >= 0.0)
    {
        int glyph = int(glyphAndRadius.x + 0.5);
        ivec2 corner = ivec2(glyph % columns, glyph / columns) * cellSize;
        coverage = texelFetch(glyphs, corner + clamp(ivec2(localPosition), ivec2(0), cellSize - 1), 0).r;
    }
    else
    {
        // How far outside the rectangle that the corners' centres span.
        float radius = glyphAndRadius.y;
        vec2 outside = max(abs(localPosition - 0.5 * size) - 0.5 * size + radius, 0.0);
        coverage = clamp(radius + 0.5 - length(outside), 0.0, 1.0);
    }

    fragment = vec4(colour.rgb, colour.a * coverage);
}
