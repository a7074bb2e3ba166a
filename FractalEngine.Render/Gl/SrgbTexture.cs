using FractalEngine.Core.Images;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>
/// A picture for surfaces: sRGB, which GL decodes before it filters; with mipmaps, so that what is far away does not flicker.
/// </summary>
internal sealed class SrgbTexture : GlObject
{
    private readonly int _name;
    private bool? _isClamped;

    /// <summary>Uploads a picture. Its top row becomes the first one: texture coordinates run downwards then.</summary>
    /// <exception cref="GlException">The picture is beyond the driver, or the memory does not suffice.</exception>
    public SrgbTexture(GlResources resources, string label, PixelImage image)
        : base(resources, label)
    {
        _name = GL.GenTexture();
        try
        {
            Upload(image);
        }
        catch
        {
            Dispose();
            throw;
        }
    }

    /// <summary>Binds it to the first texture unit.</summary>
    /// <param name="isClamped">Whether it goes on beyond its edges with their colours; otherwise it repeats.</param>
    public void Bind(bool isClamped)
    {
        Resources.State.BindTexture(_name);
        if (Resources.State.Filter.Update(ref _isClamped, isClamped))
        {
            var mode = (int)(isClamped ? TextureWrapMode.ClampToEdge : TextureWrapMode.Repeat);
            GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureWrapS, mode);
            GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureWrapT, mode);
        }
    }

    /// <inheritdoc/>
    protected override void Delete() => Resources.State.DeleteTexture(_name);

    private void Upload(PixelImage image)
    {
        GL.GetInteger(GetPName.MaxTextureSize, out int maxSize);
        if (Math.Max(image.Width, image.Height) > maxSize)
        {
            throw new GlException($"{this} has {image.Width}×{image.Height} pixels: this driver allows {maxSize} pixels a side");
        }

        Resources.State.BindTexture(_name);
        GL.PixelStore(PixelStoreParameter.UnpackAlignment, 1);
        unsafe
        {
            fixed (byte* start = image.Pixels)
            {
                GL.TexImage2D(
                    TextureTarget.Texture2D, 0, PixelInternalFormat.Srgb8Alpha8, image.Width, image.Height, 0,
                    PixelFormat.Rgba, PixelType.UnsignedByte, (IntPtr)start);
            }
        }

        GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureMinFilter, (int)TextureMinFilter.LinearMipmapLinear);
        GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureMagFilter, (int)TextureMagFilter.Linear);
        GL.GenerateMipmap(GenerateMipmapTarget.Texture2D);
        Resources.ThrowOnError($"{this} of {image.Width}×{image.Height} pixels");
    }
}
