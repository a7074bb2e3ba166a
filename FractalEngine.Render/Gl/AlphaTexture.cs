using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A texture of one 8-bit component, read texel by texel without filtering.</summary>
internal sealed class AlphaTexture : Texture2D
{
    /// <summary>Uploads the texels of a texture.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="label">Name of the texture, for messages.</param>
    /// <param name="width">Width in texels.</param>
    /// <param name="height">Height in texels.</param>
    /// <param name="texels">One byte a texel, [height × width].</param>
    public AlphaTexture(GlResources resources, string label, int width, int height, ReadOnlySpan<byte> texels)
        : base(resources, label) => Upload(
            PixelInternalFormat.R8, PixelFormat.Red, width, height, texels, TextureMinFilter.Nearest, TextureMagFilter.Nearest);
}
