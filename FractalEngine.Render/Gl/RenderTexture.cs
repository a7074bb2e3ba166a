using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A texture of depths or colours that can be drawn into, read texel by texel without filtering.</summary>
internal sealed class RenderTexture : GlObject
{
    private readonly int _texture;
    private readonly TextureTarget _kind;

    /// <summary>Allocates the texture and its framebuffer.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="label">Name of the texture, for messages.</param>
    /// <param name="width">Width in texels.</param>
    /// <param name="height">Height in texels.</param>
    /// <param name="format">Depths or colours, and their precision. Depths of 16 bits are read faster than those of 32.</param>
    /// <param name="samples">Number of samples a texel, each of which can be read; 0 without multisampling.</param>
    /// <exception cref="GlException">Size or memory exceed the driver's limits.</exception>
    public RenderTexture(GlResources resources, string label, int width, int height, PixelInternalFormat format, int samples = 0)
        : base(resources, label)
    {
        Width = width;
        Height = height;
        Format = format;
        Samples = samples;
        Framebuffer = GL.GenFramebuffer();
        _texture = GL.GenTexture();
        _kind = samples > 0 ? TextureTarget.Texture2DMultisample : TextureTarget.Texture2D;
        var isDepth = format is PixelInternalFormat.DepthComponent16 or PixelInternalFormat.DepthComponent32f;
        if (samples > 0)
        {
            GL.BindTexture(_kind, _texture);
            GL.TexImage2DMultisample(TextureTargetMultisample.Texture2DMultisample, samples, format, width, height, true);
        }
        else
        {
            Resources.State.BindTexture(_texture);
            var components = isDepth ? PixelFormat.DepthComponent : PixelFormat.Rgba;
            GL.TexImage2D(_kind, 0, format, width, height, 0, components, PixelType.Float, IntPtr.Zero);
            GL.TexParameter(_kind, TextureParameterName.TextureMinFilter, (int)TextureMinFilter.Nearest);
            GL.TexParameter(_kind, TextureParameterName.TextureMagFilter, (int)TextureMagFilter.Nearest);
        }

        Bind();
        GL.FramebufferTexture2D(
            FramebufferTarget.Framebuffer, isDepth ? FramebufferAttachment.DepthAttachment : FramebufferAttachment.ColorAttachment0,
            _kind, _texture, 0);
        if (isDepth)
        {
            GL.DrawBuffer(DrawBufferMode.None);
            GL.ReadBuffer(ReadBufferMode.None);
        }

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

    /// <summary>Depths or colours, and their precision.</summary>
    public PixelInternalFormat Format { get; }

    /// <summary>Number of samples a texel; 0 without multisampling.</summary>
    public int Samples { get; }

    /// <summary>Name of the framebuffer, for copies.</summary>
    public int Framebuffer { get; }

    /// <summary>Makes this the framebuffer that is drawn into.</summary>
    public void Bind() => GL.BindFramebuffer(FramebufferTarget.Framebuffer, Framebuffer);

    /// <summary>Binds the texture to a texture unit other than the first.</summary>
    public void BindTexture(int unit) => GlState.BindTexture(unit, _texture, _kind);

    /// <summary>Copies a rectangle of depths to the same place of another texture of the same size.</summary>
    public void CopyTo(RenderTexture target, int left, int bottom, int right, int top)
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
