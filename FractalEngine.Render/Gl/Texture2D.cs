using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A two-dimensional texture of one level or more.</summary>
internal abstract class Texture2D : GlObject
{
    /// <summary>Creates an empty texture.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="label">Name of the texture, for messages.</param>
    protected Texture2D(GlResources resources, string label)
        : base(resources, label) => Name = GL.GenTexture();

    /// <summary>OpenGL's name of the texture.</summary>
    protected int Name { get; }

    /// <summary>Binds the texture to the first texture unit.</summary>
    public void Bind() => Resources.State.BindTexture(Name);

    /// <summary>Binds the texture to a texture unit other than the first.</summary>
    public void BindTo(int unit) => State.GlState.BindTexture(unit, Name);

    /// <summary>Binds the texture, uploads its first level, and sets its filters.</summary>
    /// <param name="internalFormat">Format in which the GPU stores the texture.</param>
    /// <param name="format">Components of the given pixels, one byte each.</param>
    /// <param name="width">Width in texels.</param>
    /// <param name="height">Height in texels.</param>
    /// <param name="pixels">Rows without padding, [height × width × components].</param>
    /// <param name="minFilter">Filter for texels smaller than a pixel.</param>
    /// <param name="magFilter">Filter for texels larger than a pixel.</param>
    protected unsafe void Upload(
        PixelInternalFormat internalFormat, PixelFormat format, int width, int height, ReadOnlySpan<byte> pixels,
        TextureMinFilter minFilter, TextureMagFilter magFilter)
    {
        Bind();
        GL.PixelStore(PixelStoreParameter.UnpackAlignment, 1);
        fixed (byte* start = pixels)
        {
            GL.TexImage2D(
                TextureTarget.Texture2D, 0, internalFormat, width, height, 0, format, PixelType.UnsignedByte, (IntPtr)start);
        }

        GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureMinFilter, (int)minFilter);
        GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureMagFilter, (int)magFilter);
    }

    /// <inheritdoc/>
    protected internal override void Delete() => Resources.State.DeleteTexture(Name);
}
