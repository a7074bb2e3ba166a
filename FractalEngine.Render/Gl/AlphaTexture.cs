using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A picture of one component, 8 bits, read texel by texel without filtering.</summary>
internal sealed class AlphaTexture : GlObject
{
    private readonly int _name;

    /// <summary>Uploads a picture.</summary>
    /// <param name="resources">Of the current context.</param>
    /// <param name="label">For messages.</param>
    /// <param name="width">Texels.</param>
    /// <param name="height">Texels.</param>
    /// <param name="texels">[height × width].</param>
    public AlphaTexture(GlResources resources, string label, int width, int height, ReadOnlySpan<byte> texels)
        : base(resources, label)
    {
        _name = GL.GenTexture();
        Resources.State.BindTexture(_name);
        GL.PixelStore(PixelStoreParameter.UnpackAlignment, 1);
        unsafe
        {
            fixed (byte* start = texels)
            {
                GL.TexImage2D(
                    TextureTarget.Texture2D, 0, PixelInternalFormat.R8, width, height, 0, PixelFormat.Red, PixelType.UnsignedByte,
                    (IntPtr)start);
            }
        }

        GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureMinFilter, (int)TextureMinFilter.Nearest);
        GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureMagFilter, (int)TextureMagFilter.Nearest);
    }

    /// <summary>Binds it to the first texture unit.</summary>
    public void Bind() => Resources.State.BindTexture(_name);

    /// <inheritdoc/>
    protected override void Delete() => Resources.State.DeleteTexture(_name);
}
