using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>An off-screen picture: sRGB colour of 8 bits and, where asked for, depth of 32 bits; multisampled or not.</summary>
internal sealed class Framebuffer : GlObject
{
    private readonly int _name;
    private readonly int _colour;
    private readonly int _depth;

    /// <summary>Allocates a picture.</summary>
    /// <param name="resources">Of the current context.</param>
    /// <param name="label">For messages.</param>
    /// <param name="width">Pixels, at least 1.</param>
    /// <param name="height">Pixels, at least 1.</param>
    /// <param name="samples">Samples a pixel; 0 for a plain picture.</param>
    /// <param name="hasDepth">Whether there is a depth buffer.</param>
    /// <exception cref="GlException">The size or the memory is beyond the driver.</exception>
    public Framebuffer(GlResources resources, string label, int width, int height, int samples, bool hasDepth)
        : base(resources, label)
    {
        (Width, Height) = (width, height);
        _name = GL.GenFramebuffer();
        _colour = CreateRenderbuffer(RenderbufferStorage.Srgb8Alpha8, samples);
        _depth = hasDepth ? CreateRenderbuffer(RenderbufferStorage.DepthComponent32f, samples) : 0;
        GL.BindFramebuffer(FramebufferTarget.Framebuffer, _name);
        Attach(FramebufferAttachment.ColorAttachment0, _colour);
        if (hasDepth)
        {
            Attach(FramebufferAttachment.DepthAttachment, _depth);
        }

        var status = GL.CheckFramebufferStatus(FramebufferTarget.Framebuffer);
        if (status != FramebufferErrorCode.FramebufferComplete || GL.GetError() != ErrorCode.NoError)
        {
            Dispose();
            throw new GlException($"{this} of {width}×{height} pixels and {samples} samples is beyond the driver ({status})");
        }
    }

    /// <summary>Pixels.</summary>
    public int Width { get; }

    /// <summary>Pixels.</summary>
    public int Height { get; }

    /// <summary>Draws go here from now on, into all of it.</summary>
    public void Bind()
    {
        GL.BindFramebuffer(FramebufferTarget.Framebuffer, _name);
        GL.Viewport(0, 0, Width, Height);
    }

    /// <summary>Averages the samples into another picture of the same size, in linear light.</summary>
    public void ResolveTo(Framebuffer target)
    {
        // With this state on, drivers decode before averaging (GL 4.4, §18.3.1); a plain copy is not changed by it.
        GL.Enable(EnableCap.FramebufferSrgb);
        BlitTo(target._name, target.Width, target.Height);
    }

    /// <summary>Copies the picture, byte for byte, to the window's own framebuffer.</summary>
    /// <param name="width">The window's width in pixels.</param>
    /// <param name="height">The window's height in pixels.</param>
    public void CopyToWindow(int width, int height)
    {
        GL.Disable(EnableCap.FramebufferSrgb);
        BlitTo(0, width, height);
    }

    /// <summary>Reads the colours back, bottom row first.</summary>
    /// <param name="pixels">RGBA, [height × width × 4].</param>
    public void ReadPixels(Span<byte> pixels)
    {
        GL.Disable(EnableCap.FramebufferSrgb);
        GL.BindFramebuffer(FramebufferTarget.ReadFramebuffer, _name);
        GL.PixelStore(PixelStoreParameter.PackAlignment, 1);
        unsafe
        {
            fixed (byte* start = pixels)
            {
                GL.ReadPixels(0, 0, Width, Height, PixelFormat.Rgba, PixelType.UnsignedByte, (IntPtr)start);
            }
        }

        Resources.ThrowOnError($"reading {this}");
    }

    /// <inheritdoc/>
    protected override void Delete()
    {
        GL.DeleteFramebuffer(_name);
        GL.DeleteRenderbuffer(_colour);
        GL.DeleteRenderbuffer(_depth);
    }

    private static void Attach(FramebufferAttachment attachment, int renderbuffer) =>
        GL.FramebufferRenderbuffer(FramebufferTarget.Framebuffer, attachment, RenderbufferTarget.Renderbuffer, renderbuffer);

    private int CreateRenderbuffer(RenderbufferStorage format, int samples)
    {
        var name = GL.GenRenderbuffer();
        GL.BindRenderbuffer(RenderbufferTarget.Renderbuffer, name);
        GL.RenderbufferStorageMultisample(RenderbufferTarget.Renderbuffer, samples, format, Width, Height);
        return name;
    }

    private void BlitTo(int target, int width, int height)
    {
        GL.BindFramebuffer(FramebufferTarget.ReadFramebuffer, _name);
        GL.BindFramebuffer(FramebufferTarget.DrawFramebuffer, target);
        var (commonWidth, commonHeight) = (Math.Min(width, Width), Math.Min(height, Height));
        GL.BlitFramebuffer(
            0, Height - commonHeight, commonWidth, Height,
            0, height - commonHeight, commonWidth, height,
            ClearBufferMask.ColorBufferBit, BlitFramebufferFilter.Nearest);
    }
}
