using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>
/// An off-screen framebuffer: colours with a 32-bit depth buffer, multisampled or not; or colours alone, as a texture.
/// </summary>
internal sealed class Framebuffer : GlObject
{
    private readonly int _name;
    private readonly int _colour;
    private readonly int _depth;
    private readonly FrameTexture? _texture;

    /// <summary>Allocates a framebuffer of colours and depths.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="label">Name of the framebuffer, for messages.</param>
    /// <param name="width">Width in pixels, at least 1.</param>
    /// <param name="height">Height in pixels, at least 1.</param>
    /// <param name="samples">Number of samples a pixel; 0 without multisampling.</param>
    /// <param name="hasFloats">Whether colours are 32-bit floats of linear light, instead of 8 bits of sRGB.</param>
    /// <exception cref="GlException">Size or memory exceed the driver's limits.</exception>
    public Framebuffer(GlResources resources, string label, int width, int height, int samples, bool hasFloats = false)
        : this(resources, label, (width, height), hasFloats ? PixelInternalFormat.Rgba32f : PixelInternalFormat.Srgb8Alpha8)
    {
        Samples = samples;
        _colour = CreateRenderbuffer((RenderbufferStorage)Format, samples);
        _depth = CreateRenderbuffer(RenderbufferStorage.DepthComponent32f, samples);
        Attach(FramebufferAttachment.ColorAttachment0, _colour);
        Attach(FramebufferAttachment.DepthAttachment, _depth);
        ThrowUnlessComplete($"{width}×{height} pixels and {samples} samples");
    }

    /// <summary>Allocates a framebuffer of colours alone, which shaders can read.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="label">Name of the framebuffer, for messages.</param>
    /// <param name="width">Width in pixels, at least 1.</param>
    /// <param name="height">Height in pixels, at least 1.</param>
    /// <param name="format">Format of the colours.</param>
    /// <exception cref="GlException">Size or memory exceed the driver's limits.</exception>
    public Framebuffer(GlResources resources, string label, int width, int height, PixelInternalFormat format)
        : this(resources, label, (width, height), format)
    {
        _texture = new(resources, label, width, height, format);
        _texture.Attach();
        ThrowUnlessComplete($"{width}×{height} pixels");
    }

    private Framebuffer(GlResources resources, string label, (int Width, int Height) size, PixelInternalFormat format)
        : base(resources, label)
    {
        (Width, Height) = size;
        Format = format;
        _name = GL.GenFramebuffer();
        GL.BindFramebuffer(FramebufferTarget.Framebuffer, _name);
    }

    /// <summary>Width of the framebuffer in pixels.</summary>
    public int Width { get; }

    /// <summary>Height of the framebuffer in pixels.</summary>
    public int Height { get; }

    /// <summary>Format in which the GPU stores the colours.</summary>
    public PixelInternalFormat Format { get; }

    /// <summary>Number of samples a pixel; 0 without multisampling.</summary>
    public int Samples { get; }

    /// <summary>The colours, of a framebuffer that shaders can read.</summary>
    public FrameTexture Texture => _texture ?? throw new InvalidOperationException($"{this} can't be read by shaders");

    /// <summary>Makes this the current framebuffer, with a viewport that covers it.</summary>
    public void Bind()
    {
        GL.BindFramebuffer(FramebufferTarget.Framebuffer, _name);
        GL.Viewport(0, 0, Width, Height);
    }

    /// <summary>
    /// Averages the samples into another framebuffer of the same size, in linear light, or enlarges pixels of one sample to another size.
    /// </summary>
    public void ResolveTo(Framebuffer target)
    {
        // With this state on, drivers decode before averaging (GL 4.4, §18.3.1). It leaves plain copies unchanged.
        GL.Enable(EnableCap.FramebufferSrgb);
        if ((target.Width, target.Height) == (Width, Height))
        {
            BlitTo(target._name, target.Width, target.Height);
            return;
        }

        GL.BindFramebuffer(FramebufferTarget.ReadFramebuffer, _name);
        GL.BindFramebuffer(FramebufferTarget.DrawFramebuffer, target._name);
        GL.BlitFramebuffer(
            0, 0, Width, Height, 0, 0, target.Width, target.Height, ClearBufferMask.ColorBufferBit, BlitFramebufferFilter.Linear);
    }

    /// <summary>Copies the depths of all samples.</summary>
    /// <param name="target">As large, with as many samples of 32 bits.</param>
    public void CopyDepthsTo(DepthAtlas target) => BlitTo(target.Framebuffer, Width, Height, ClearBufferMask.DepthBufferBit);

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
    public void ReadPixels(Span<byte> pixels) => ReadPixels(pixels, PixelFormat.Rgba, PixelType.UnsignedByte);

    /// <summary>Reads colours of floats back, with the bottom row first.</summary>
    /// <param name="light">Receives red, green and blue, [height × width × 3].</param>
    /// <exception cref="GlException">The driver reports an error.</exception>
    public void ReadLight(Span<float> light) => ReadPixels(light, PixelFormat.Rgb, PixelType.Float);

    private void ReadPixels<T>(Span<T> pixels, PixelFormat format, PixelType type)
        where T : unmanaged
    {
        GL.Disable(EnableCap.FramebufferSrgb);
        GL.BindFramebuffer(FramebufferTarget.ReadFramebuffer, _name);
        GL.PixelStore(PixelStoreParameter.PackAlignment, 1);
        unsafe
        {
            fixed (T* start = pixels)
            {
                GL.ReadPixels(0, 0, Width, Height, format, type, (IntPtr)start);
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
        _texture?.Dispose();
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
