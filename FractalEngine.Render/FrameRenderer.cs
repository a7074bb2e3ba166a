using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Passes;
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
    private const double LetterboxShade = 0.45;

    private readonly RenderContext _context;
    private readonly LinesPass _linesPass;
    private readonly OverlayPass _overlayPass;
    private Framebuffer? _sceneTarget;
    private Framebuffer? _resolvedTarget;
    private int _sampleCount;

    /// <summary>For a context.</summary>
    public FrameRenderer(RenderContext context)
    {
        context.MakeCurrent();
        _context = context;
        _linesPass = new(context);
        _overlayPass = new(context.Resources);
    }

    /// <summary>Draws a scene, or the background alone.</summary>
    /// <param name="scene">Null while there is none yet.</param>
    /// <param name="view">Camera and projection.</param>
    /// <param name="width">Of the picture, pixels.</param>
    /// <param name="height">Of the picture, pixels.</param>
    /// <param name="settings">How it is drawn.</param>
    /// <param name="nextView">
    /// The view that is likely to be drawn next: what it needs is chosen on other threads while this one is drawn. Null for none.
    /// </param>
    /// <exception cref="GlException">The picture is larger than the driver allows.</exception>
    public void Draw(SceneRenderer? scene, View view, int width, int height, RenderSettings settings, View? nextView = null)
    {
        _context.MakeCurrent();
        _context.ApplySettings(settings);
        var target = EnsureTarget(width, height, Math.Clamp(settings.Samples, 0, _context.MaxSampleCount));
        target.Bind();
        var (x, y, viewportWidth, viewportHeight) = view.Viewport(width, height);
        var background = scene?.Scene.Source.Scene.Background ?? settings.Background;
        Clear(background, (x, height - y - viewportHeight, viewportWidth, viewportHeight), (width, height));
        if (scene is null)
        {
            return;
        }

        GL.Enable(EnableCap.FramebufferSrgb);
        GL.Enable(EnableCap.DepthTest);
        GL.DepthFunc(_context.HasReversedDepth ? DepthFunction.Greater : DepthFunction.Less);
        GL.FrontFace(FrontFaceDirection.Cw);
        var aspect = view.EffectiveAspect(width, height);
        var bounds = LinesPass.BoundsIncludingLines(scene.Bounds, settings);
        scene.Draw(view, (viewportWidth, viewportHeight), aspect, bounds, settings, nextView);
        if (view.DeepZoom is null)
        {
            _linesPass.Draw(view, aspect, scene.Bounds, settings);
            _linesPass.Draw(view, aspect, bounds, scene.Lines);
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
        var frame = Resolve(overlay);
        var pixels = new byte[4 * frame.Width * frame.Height];
        frame.ReadPixels(pixels);
        return PixelImage.FromBottomUp(frame.Width, frame.Height, pixels);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _sceneTarget?.Dispose();
        _resolvedTarget?.Dispose();
        _linesPass.Dispose();
        _overlayPass.Dispose();
    }

    /// <summary>Fills the picture. The sRGB values are written as they are, so that the background is exact.</summary>
    private void Clear(Colour background, (int X, int Y, int Width, int Height) viewport, (int Width, int Height) frameSize)
    {
        GL.Disable(EnableCap.FramebufferSrgb);
        GL.DepthMask(true);
        GL.ClearDepth(_context.HasReversedDepth ? 0.0 : 1.0);
        if ((viewport.Width, viewport.Height) != frameSize)
        {
            SetClearColour(LetterboxColour(background));
            GL.Clear(ClearBufferMask.ColorBufferBit);
        }

        GL.Enable(EnableCap.ScissorTest);
        GL.Scissor(viewport.X, viewport.Y, viewport.Width, viewport.Height);
        SetClearColour(background);
        GL.Clear(ClearBufferMask.ColorBufferBit | ClearBufferMask.DepthBufferBit);
        GL.Disable(EnableCap.ScissorTest);
        GL.Viewport(viewport.X, viewport.Y, viewport.Width, viewport.Height);
    }

    private static void SetClearColour(Colour colour) =>
        GL.ClearColor((float)colour.Red, (float)colour.Green, (float)colour.Blue, 1);

    private static Colour LetterboxColour(Colour colour) =>
        new(LetterboxShade * colour.Red, LetterboxShade * colour.Green, LetterboxShade * colour.Blue);

    private Framebuffer EnsureTarget(int width, int height, int sampleCount)
    {
        if (_sceneTarget is not null && (_sceneTarget.Width, _sceneTarget.Height, _sampleCount) == (width, height, sampleCount))
        {
            return _sceneTarget;
        }

        if (width < 1 || height < 1 || Math.Max(width, height) > _context.MaxFrameSize)
        {
            throw new GlException(
                $"a picture of {width}×{height} pixels cannot be drawn: this driver allows 1 to {_context.MaxFrameSize} pixels a side");
        }

        _sceneTarget?.Dispose();
        _resolvedTarget?.Dispose();
        (_sceneTarget, _resolvedTarget) = (null, null);
        _sceneTarget = new(_context.Resources, "scene", width, height, sampleCount, hasDepth: true);
        _resolvedTarget = new(_context.Resources, "picture", width, height, 0, hasDepth: false);
        _sampleCount = sampleCount;
        return _sceneTarget;
    }

    private Framebuffer Resolve(IReadOnlyList<OverlayPanel> overlay)
    {
        if (_sceneTarget is null || _resolvedTarget is null)
        {
            throw new InvalidOperationException("nothing has been drawn yet");
        }

        _context.MakeCurrent();
        _sceneTarget.ResolveTo(_resolvedTarget);
        _resolvedTarget.Bind();
        _overlayPass.Draw(overlay, _resolvedTarget.Width, _resolvedTarget.Height);
        return _resolvedTarget;
    }
}
