#version 330 core
// An image as large as the framebuffer, pixel by pixel. GL decodes its sRGB, and encodes the fragment where the framebuffer does.

uniform sampler2D image;
uniform bool isTopFirst; // else the bottom row is
uniform float opacity;

out vec4 fragment;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int row = isTopFirst ? textureSize(image, 0).y - 1 - pixel.y : pixel.y;
    fragment = vec4(texelFetch(image, ivec2(pixel.x, row), 0).rgb, opacity);
}
