#version 330 core
// Nothing but the depth; holes of foliage let light through. CUT_OUT is defined where it applies.

#ifdef CUT_OUT
in vec2 pixelTextureCoordinates;

uniform sampler2D surfaceTexture;
#endif

void main()
{
#ifdef CUT_OUT
    if (texture(surfaceTexture, pixelTextureCoordinates).a < 0.5)
    {
        discard;
    }
#endif
}
