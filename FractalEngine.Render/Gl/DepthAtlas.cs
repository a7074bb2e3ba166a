using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A texture of depths that can be drawn into, read texel by texel without filtering.</summary>
internal sealed class DepthAtlas : GlObject
{
    private readonly int _texture;
    private readonly TextureTarget _kind;

    /// <summary>Allocates the texture and its framebuffer.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="label">Name of the texture, for messages.</param>
    /// <param name="width">Width in texels.</param>
    /// <param name="height">Height in texels.</param>
    /// <param name="isFine">Whether depths are floats of 32 bits; otherwise they have 16 bits, which are read faster.</param>
    /// <param name="samples">Number of samples a texel, each of which shaders can read; 0 without multisampling.</param>
    /// <exception cref="GlException">Size or memory exceed the driver's limits.</exception>
    public DepthAtlas(GlResources resources, string label, int width, int height, bool isFine, int samples = 0)
        : base(resources, label)
    {
        Width = width;
        Height = height;
        IsFine = isFine;
        Samples = samples;
        Framebuffer = GL.GenFramebuffer();
        _texture = GL.GenTexture();
        var format = isFine ? PixelInternalFormat.DepthComponent32f : PixelInternalFormat.DepthComponent16;
        if (samples > 0)
        {
            _kind = TextureTarget.Texture2DMultisample;
            GL.BindTexture(_kind, _texture);
            GL.TexImage2DMultisample(TextureTargetMultisample.Texture2DMultisample, samples, format, width, height, true);
        }
        else
        {
            _kind = TextureTarget.Texture2D;
            Resources.State.BindTexture(_texture);
            GL.TexImage2D(_kind, 0, format, width, height, 0, PixelFormat.DepthComponent, PixelType.Float, IntPtr.Zero);
            GL.TexParameter(_kind, TextureParameterName.TextureMinFilter, (int)TextureMinFilter.Nearest);
            GL.TexParameter(_kind, TextureParameterName.TextureMagFilter, (int)TextureMagFilter.Nearest);
        }

        GL.BindFramebuffer(FramebufferTarget.Framebuffer, Framebuffer);
        GL.FramebufferTexture2D(FramebufferTarget.Framebuffer, FramebufferAttachment.DepthAttachment, _kind, _texture, 0);
        GL.DrawBuffer(DrawBufferMode.None);
        GL.ReadBuffer(ReadBufferMode.None);
        ThrowUnlessComplete($"{width}×{height} texels");
    }

    /// <summary>Width of the texture in texels.</summary>
    public int Width { get; }

    /// <summary>Height of the texture in texels.</summary>
    public int Height { get; }

    /// <summary>Whether depths are floats of 32 bits.</summary>
    public bool IsFine { get; }

    /// <summary>Number of samples a texel; 0 without multisampling.</summary>
    public int Samples { get; }

    /// <summary>OpenGL's name of the framebuffer, for copies.</summary>
    public int Framebuffer { get; }

    /// <summary>Makes this the framebuffer that is drawn into.</summary>
    public void Bind() => GL.BindFramebuffer(FramebufferTarget.Framebuffer, Framebuffer);

    /// <summary>Binds the texture to a texture unit other than the first.</summary>
    public void BindTexture(int unit) => GlState.BindTexture(unit, _texture, _kind);

    /// <summary>Copies a rectangle to the same place of another atlas of the same size.</summary>
    public void CopyTo(DepthAtlas target, int left, int bottom, int right, int top)
    {
        GL.BindFramebuffer(FramebufferTarget.ReadFramebuffer, Framebuffer);
        GL.BindFramebuffer(FramebufferTarget.DrawFramebuffer, target.Framebuffer);
        GL.BlitFramebuffer(
            left, bottom, right, top, left, bottom, right, top, ClearBufferMask.DepthBufferBit, BlitFramebufferFilter.Nearest);
    }

    /// <inheritdoc/>
    protected internal override void Delete()
    {
        GL.DeleteFramebuffer(Framebuffer);
        Resources.State.DeleteTexture(_texture);
    }
}
