using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>
/// An off-screen framebuffer with 8-bit sRGB colour and optionally a 32-bit depth buffer, multisampled or not.
/// </summary>
internal sealed class Framebuffer : GlObject
{
    private readonly int _name;
    private readonly int _colour;
    private readonly int _depth;

    /// <summary>Allocates a framebuffer and its attachments.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="label">Name of the framebuffer, for messages.</param>
    /// <param name="width">Width in pixels, at least 1.</param>
    /// <param name="height">Height in pixels, at least 1.</param>
    /// <param name="samples">Number of samples a pixel; 0 without multisampling.</param>
    /// <param name="hasDepth">Whether there is a depth buffer.</param>
    /// <exception cref="GlException">Size or memory exceed the driver's limits.</exception>
    public Framebuffer(GlResources resources, string label, int width, int height, int samples, bool hasDepth)
        : base(resources, label)
    {
        Width = width;
        Height = height;
        Samples = samples;
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

    /// <summary>Width of the framebuffer in pixels.</summary>
    public int Width { get; }

    /// <summary>Height of the framebuffer in pixels.</summary>
    public int Height { get; }

    /// <summary>Number of samples a pixel; 0 without multisampling.</summary>
    public int Samples { get; }

    /// <summary>Makes this the current framebuffer, with a viewport that covers it.</summary>
    public void Bind()
    {
        GL.BindFramebuffer(FramebufferTarget.Framebuffer, _name);
        GL.Viewport(0, 0, Width, Height);
    }

    /// <summary>Averages the samples into another framebuffer of the same size, in linear light.</summary>
    public void ResolveTo(Framebuffer target)
    {
        // With this state on, drivers decode before averaging (GL 4.4, §18.3.1). It leaves plain copies unchanged.
        GL.Enable(EnableCap.FramebufferSrgb);
        BlitTo(target._name, target.Width, target.Height);
    }

    /// <summary>Copies what is shown into textures of the same size: colours averaged likewise, and the depths of all samples.</summary>
    /// <param name="colours">sRGB, 8 bits.</param>
    /// <param name="depths">Floats of 32 bits, with as many samples.</param>
    public void ResolveTo(RenderTexture colours, RenderTexture depths)
    {
        GL.Enable(EnableCap.FramebufferSrgb);
        BlitTo(colours.Framebuffer, Width, Height);
        BlitTo(depths.Framebuffer, Width, Height, ClearBufferMask.DepthBufferBit);
    }

    /// <summary>Copies the pixels unchanged to the window's own framebuffer.</summary>
    /// <param name="width">Width of the window in pixels.</param>
    /// <param name="height">Height of the window in pixels.</param>
    public void CopyToWindow(int width, int height)
    {
        GL.Disable(EnableCap.FramebufferSrgb);
        BlitTo(0, width, height);
    }

    /// <summary>Reads the colours back, with the bottom row first.</summary>
    /// <param name="pixels">Receives RGBA bytes, [height × width × 4].</param>
    /// <exception cref="GlException">The driver reports an error.</exception>
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
    protected internal override void Delete()
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

    /// <summary>Copies the common part of two framebuffers, aligned at the upper left corner.</summary>
    private void BlitTo(int target, int width, int height, ClearBufferMask content = ClearBufferMask.ColorBufferBit)
    {
        GL.BindFramebuffer(FramebufferTarget.ReadFramebuffer, _name);
        GL.BindFramebuffer(FramebufferTarget.DrawFramebuffer, target);
        var commonWidth = Math.Min(width, Width);
        var commonHeight = Math.Min(height, Height);
        GL.BlitFramebuffer(
            0, Height - commonHeight, commonWidth, Height,
            0, height - commonHeight, commonWidth, height,
            content, BlitFramebufferFilter.Nearest);
    }
}
