using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A texture of depths that can be drawn into, read texel by texel without filtering.</summary>
internal sealed class DepthAtlas : GlObject
{
    private readonly int _framebuffer;
    private readonly int _texture;

    /// <summary>Allocates the texture and its framebuffer.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="label">Name of the texture, for messages.</param>
    /// <param name="width">Width in texels.</param>
    /// <param name="height">Height in texels.</param>
    /// <param name="isFine">Whether depths are floats of 32 bits; otherwise they have 16 bits, which are read faster.</param>
    /// <exception cref="GlException">Size or memory exceed the driver's limits.</exception>
    public DepthAtlas(GlResources resources, string label, int width, int height, bool isFine)
        : base(resources, label)
    {
        Width = width;
        Height = height;
        IsFine = isFine;
        _framebuffer = GL.GenFramebuffer();
        _texture = GL.GenTexture();
        Resources.State.BindTexture(_texture);
        var format = isFine ? PixelInternalFormat.DepthComponent32f : PixelInternalFormat.DepthComponent16;
        GL.TexImage2D(
            TextureTarget.Texture2D, 0, format, width, height, 0, PixelFormat.DepthComponent, PixelType.Float, IntPtr.Zero);
        GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureMinFilter, (int)TextureMinFilter.Nearest);
        GL.TexParameter(TextureTarget.Texture2D, TextureParameterName.TextureMagFilter, (int)TextureMagFilter.Nearest);
        GL.BindFramebuffer(FramebufferTarget.Framebuffer, _framebuffer);
        GL.FramebufferTexture2D(
            FramebufferTarget.Framebuffer, FramebufferAttachment.DepthAttachment, TextureTarget.Texture2D, _texture, 0);
        GL.DrawBuffer(DrawBufferMode.None);
        GL.ReadBuffer(ReadBufferMode.None);
        var status = GL.CheckFramebufferStatus(FramebufferTarget.Framebuffer);
        if (status != FramebufferErrorCode.FramebufferComplete || GL.GetError() != ErrorCode.NoError)
        {
            Dispose();
            throw new GlException($"{this} of {width}×{height} texels is beyond the driver ({status})");
        }
    }

    /// <summary>Width of the texture in texels.</summary>
    public int Width { get; }

    /// <summary>Height of the texture in texels.</summary>
    public int Height { get; }

    /// <summary>Whether depths are floats of 32 bits.</summary>
    public bool IsFine { get; }

    /// <summary>Makes this the framebuffer that is drawn into.</summary>
    public void Bind() => GL.BindFramebuffer(FramebufferTarget.Framebuffer, _framebuffer);

    /// <summary>Binds the texture to a texture unit other than the first.</summary>
    public void BindTexture(int unit) => GlState.BindTexture(unit, _texture);

    /// <summary>Copies a rectangle to the same place of another atlas of the same size.</summary>
    public void CopyTo(DepthAtlas target, int left, int bottom, int right, int top)
    {
        GL.BindFramebuffer(FramebufferTarget.ReadFramebuffer, _framebuffer);
        GL.BindFramebuffer(FramebufferTarget.DrawFramebuffer, target._framebuffer);
        GL.BlitFramebuffer(
            left, bottom, right, top, left, bottom, right, top, ClearBufferMask.DepthBufferBit, BlitFramebufferFilter.Nearest);
    }

    /// <inheritdoc/>
    protected internal override void Delete()
    {
        GL.DeleteFramebuffer(_framebuffer);
        Resources.State.DeleteTexture(_texture);
    }
}
