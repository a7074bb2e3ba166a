using FractalEngine.Core.Geometry;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Passes;
using FractalEngine.Render.Pictures;
using FractalEngine.Render.Ui;
using FractalEngine.Render.Windowing;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render;

/// <summary>
/// Makes pictures of scenes: draws into a multisampled picture of its own, which is then shown in a window or read back. Windows and
/// files take the same path, so they show the same pixels.
/// </summary>
/// <remarks>What was drawn last is kept: presenting or reading it again costs no drawing.</remarks>
public sealed class FrameRenderer : IDisposable
{
    // Bars beside the picture are this much darker than the background, in linear light.
    private const double BarShade = 0.45;

    private readonly RenderContext _context;
    private readonly LinesPass _lines;
    private readonly OverlayPass _overlay;
    private Framebuffer? _drawn;
    private Framebuffer? _resolved;
    private int _samples;

    /// <summary>For a context.</summary>
    public FrameRenderer(RenderContext context)
    {
        context.MakeCurrent();
        _context = context;
        _lines = new(context);
        _overlay = new(context.Resources);
    }

    /// <summary>Draws a scene, or the background alone.</summary>
    /// <param name="scene">Null while there is none yet.</param>
    /// <param name="view">Camera and projection.</param>
    /// <param name="width">Of the picture, pixels.</param>
    /// <param name="height">Of the picture, pixels.</param>
    /// <param name="settings">How it is drawn.</param>
    /// <param name="next">The view that is likely to be drawn next: what it needs is chosen on other threads while this one is drawn. Null for none.</param>
    /// <exception cref="GlException">The picture is larger than the driver allows.</exception>
    public void Draw(SceneRenderer? scene, View view, int width, int height, RenderSettings settings, View? next = null)
    {
        _context.MakeCurrent();
        _context.Follow(settings);
        var target = Target(width, height, Math.Clamp(settings.Samples, 0, _context.MaximumSamples));
        target.Bind();
        var (x, y, shownWidth, shownHeight) = view.Viewport(width, height);
        var background = scene?.Scene.Source.Scene.Background ?? settings.Background;
        Clear(background, (x, height - y - shownHeight, shownWidth, shownHeight), (width, height));
        if (scene is null)
        {
            return;
        }

        GL.Enable(EnableCap.FramebufferSrgb);
        GL.Enable(EnableCap.DepthTest);
        GL.DepthFunc(_context.HasReversedDepth ? DepthFunction.Greater : DepthFunction.Less);
        GL.FrontFace(FrontFaceDirection.Cw);
        var aspect = view.ShownAspect(width, height);
        var bounds = LinesPass.BoundsWith(scene.Bounds, settings);
        scene.Draw(view, (shownWidth, shownHeight), aspect, bounds, settings, next);
        if (view.Zoom is null)
        {
            _lines.Draw(view, aspect, scene.Bounds, settings);
            _lines.Draw(view, aspect, bounds, scene.Lines);
        }

        GL.Disable(EnableCap.DepthTest);
    }

    /// <summary>Waits until everything has been drawn, for who measures time.</summary>
    public void Finish()
    {
        _context.MakeCurrent();
        GL.Finish();
    }

    /// <summary>Shows what was drawn last in a window.</summary>
    /// <param name="window">Of this renderer's context.</param>
    /// <param name="overlay">Panels over the picture. They can change while the scene need not be drawn again.</param>
    public void Present(RenderWindow window, params IReadOnlyList<OverlayPanel> overlay)
    {
        Resolve(overlay).CopyToWindow(window.Width, window.Height);
        window.SwapBuffers();
    }

    /// <summary>Reads what was drawn last.</summary>
    /// <param name="overlay">Panels over the picture; none for the scene alone.</param>
    public PixelImage Capture(params IReadOnlyList<OverlayPanel> overlay)
    {
        var picture = Resolve(overlay);
        var rows = new byte[4 * picture.Width * picture.Height];
        picture.Read(rows);
        return PixelImage.FromBottomUp(picture.Width, picture.Height, rows);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _drawn?.Dispose();
        _resolved?.Dispose();
        _lines.Dispose();
        _overlay.Dispose();
    }

    /// <summary>Fills the picture. The sRGB values are written as they are, so that the background is exact.</summary>
    private void Clear(Colour background, (int X, int Y, int Width, int Height) shown, (int Width, int Height) size)
    {
        GL.Disable(EnableCap.FramebufferSrgb);
        GL.DepthMask(true);
        GL.ClearDepth(_context.HasReversedDepth ? 0.0 : 1.0);
        if ((shown.Width, shown.Height) != size)
        {
            SetClearColour(Shaded(background));
            GL.Clear(ClearBufferMask.ColorBufferBit);
        }

        GL.Enable(EnableCap.ScissorTest);
        GL.Scissor(shown.X, shown.Y, shown.Width, shown.Height);
        SetClearColour(background);
        GL.Clear(ClearBufferMask.ColorBufferBit | ClearBufferMask.DepthBufferBit);
        GL.Disable(EnableCap.ScissorTest);
        GL.Viewport(shown.X, shown.Y, shown.Width, shown.Height);
    }

    private static void SetClearColour(Colour colour) =>
        GL.ClearColor((float)colour.Red, (float)colour.Green, (float)colour.Blue, 1);

    private static Colour Shaded(Colour colour) => new(BarShade * colour.Red, BarShade * colour.Green, BarShade * colour.Blue);

    private Framebuffer Target(int width, int height, int samples)
    {
        if (_drawn is not null && (_drawn.Width, _drawn.Height, _samples) == (width, height, samples))
        {
            return _drawn;
        }

        if (width < 1 || height < 1 || Math.Max(width, height) > _context.MaximumSize)
        {
            throw new GlException(
                $"a picture of {width}×{height} pixels cannot be drawn: this driver allows 1 to {_context.MaximumSize} pixels a side");
        }

        _drawn?.Dispose();
        _resolved?.Dispose();
        (_drawn, _resolved) = (null, null);
        _drawn = new(_context.Resources, "scene", width, height, samples, withDepth: true);
        _resolved = new(_context.Resources, "picture", width, height, 0, withDepth: false);
        _samples = samples;
        return _drawn;
    }

    private Framebuffer Resolve(IReadOnlyList<OverlayPanel> overlay)
    {
        if (_drawn is null || _resolved is null)
        {
            throw new InvalidOperationException("nothing has been drawn yet");
        }

        _context.MakeCurrent();
        _drawn.ResolveTo(_resolved);
        _resolved.Bind();
        _overlay.Draw(overlay, _resolved.Width, _resolved.Height);
        return _resolved;
    }
}
