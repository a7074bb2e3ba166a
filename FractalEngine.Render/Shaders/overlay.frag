#version 330 core
// A glyph, texel by pixel, or a plain rectangle with smooth round corners.

flat in vec4 colour;
flat in vec2 glyphAndRadius;
flat in vec2 size;
in vec2 place;

uniform sampler2D glyphs; // cells of the font, columns side by side
uniform ivec2 cell;       // pixels
uniform int columns;

out vec4 fragment;

void main()
{
    float coverage;
    if (glyphAndRadius.x >= 0.0)
    {
        int glyph = int(glyphAndRadius.x + 0.5);
        ivec2 corner = ivec2(glyph % columns, glyph / columns) * cell;
        coverage = texelFetch(glyphs, corner + clamp(ivec2(place), ivec2(0), cell - 1), 0).r;
    }
    else
    {
        float radius = glyphAndRadius.y;
        vec2 beyond = max(abs(place - 0.5 * size) - 0.5 * size + radius, 0.0);
        coverage = clamp(radius + 0.5 - length(beyond), 0.0, 1.0);
    }

    fragment = vec4(colour.rgb, colour.a * coverage);
}
