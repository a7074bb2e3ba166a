using FractalEngine.Core.Images;
using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>
/// A texture for surfaces, in sRGB, which GL decodes before it filters, or of plain numbers; with mipmaps so that distant surfaces do not
/// flicker.
/// </summary>
internal sealed class SurfaceTexture : Texture2D
{
    private bool? _isClamped;

    /// <summary>Uploads an image. Its top row becomes the texture's first, so that texture coordinates run downwards.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="label">Name of the texture, for messages.</param>
    /// <param name="image">Pixels.</param>
    /// <param name="isSrgb">Whether these are colours.</param>
    /// <exception cref="GlException">The image exceeds the driver's limits, or the memory does not suffice.</exception>
    public SurfaceTexture(GlResources resources, string label, PixelImage image, bool isSrgb = true)
        : base(resources, label)
    {
        DisposeOnFailure(this, () => Upload(image, isSrgb));
    }

    /// <summary>Binds the texture to a texture unit.</summary>
    /// <param name="isClamped">True to continue the colours of its edges beyond them, false to repeat the texture.</param>
    /// <param name="unit">The texture unit.</param>
    public void Bind(bool isClamped, int unit = 0)
    {
        if (unit == 0)
        {
            Bind();
        }
        else
        {
            BindTo(unit);
        }

        if (Resources.State.Filter.Update(ref _isClamped, isClamped))
        {
            // On its own unit: the first one has the colours of the same surface.
            GL.ActiveTexture(TextureUnit.Texture0 + unit);
            var mode = (int)(isClamped ? TextureWrapMode.ClampToEdge : TextureWrapMode.Repeat);
            GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureWrapS, mode);
            GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureWrapT, mode);
            GL.ActiveTexture(TextureUnit.Texture0);
        }
    }

    private void Upload(PixelImage image, bool isSrgb)
    {
        GL.GetInteger(GetPName.MaxTextureSize, out int maxSize);
        if (Math.Max(image.Width, image.Height) > maxSize)
        {
            throw new GlException($"{this} has {image.Width}×{image.Height} pixels: this driver allows {maxSize} pixels a side");
        }

        Upload(
            isSrgb ? PixelInternalFormat.Srgb8Alpha8 : PixelInternalFormat.Rgba8, PixelFormat.Rgba, image.Width, image.Height, image.Pixels,
            TextureMinFilter.LinearMipmapLinear, TextureMagFilter.Linear);
        GL.GenerateMipmap(GenerateMipmapTarget.Texture2D);
        Resources.ThrowOnError($"{this} of {image.Width}×{image.Height} pixels");
    }
}
