using FractalEngine.Core.Images;
using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>
/// A texture for surfaces in sRGB, which GL decodes before it filters, with mipmaps so that distant surfaces do not flicker.
/// </summary>
internal sealed class SrgbTexture : Texture2D
{
    private bool? _isClamped;

    /// <summary>Uploads an image. Its top row becomes the texture's first, so that texture coordinates run downwards.</summary>
    /// <exception cref="GlException">The image exceeds the driver's limits, or the memory does not suffice.</exception>
    public SrgbTexture(GlResources resources, string label, PixelImage image)
        : base(resources, label)
    {
        DisposeOnFailure(this, () => Upload(image));
    }

    /// <summary>Binds the texture to the first texture unit.</summary>
    /// <param name="isClamped">True to continue the colours of its edges beyond them, false to repeat the texture.</param>
    public void Bind(bool isClamped)
    {
        Bind();
        if (Resources.State.Filter.Update(ref _isClamped, isClamped))
        {
            var mode = (int)(isClamped ? TextureWrapMode.ClampToEdge : TextureWrapMode.Repeat);
            GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureWrapS, mode);
            GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureWrapT, mode);
        }
    }

    private void Upload(PixelImage image)
    {
        GL.GetInteger(GetPName.MaxTextureSize, out int maxSize);
        if (Math.Max(image.Width, image.Height) > maxSize)
        {
            throw new GlException($"{this} has {image.Width}×{image.Height} pixels: this driver allows {maxSize} pixels a side");
        }

        Upload(
            PixelInternalFormat.Srgb8Alpha8, PixelFormat.Rgba, image.Width, image.Height, image.Pixels,
            TextureMinFilter.LinearMipmapLinear, TextureMagFilter.Linear);
        GL.GenerateMipmap(GenerateMipmapTarget.Texture2D);
        Resources.ThrowOnError($"{this} of {image.Width}×{image.Height} pixels");
    }
}
