using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Frame;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Ui;
using FractalEngine.Render.Ui.Drawing;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render;

/// <summary>
/// Draws frames into a multisampled framebuffer of its own, which is then presented in a window or read back as an image. Windows and files
/// take the same path and therefore show the same pixels.
/// </summary>
/// <remarks>
/// The last frame is kept: presenting or reading it again draws nothing. While nothing moves, further frames can be gathered, each moved
/// by a part of a pixel, whose mean is shown then.
/// </remarks>
public sealed class FrameRenderer : IDisposable
{
    // Behind a lens, the first of them is sharp.
    private const int MinLensFrames = 65;

    private readonly RenderContext _context;
    private readonly LinesPass _linesPass;
    private readonly OverlayPass _overlayPass;
    private ImagePass? _imagePass;
    private Framebuffer? _sceneTarget;
    private Framebuffer? _resolvedTarget;
    private Framebuffer? _gatheredTarget;
    private (int Width, int Height, int PixelSize, int Samples, bool KeepsLight) _targetState;
    private int _meanCount;
    private bool _isDisposed;

    /// <summary>Creates the framebuffer-independent resources of a context.</summary>
    /// <param name="context">Context to draw in. It must outlive this renderer.</param>
    public FrameRenderer(RenderContext context)
    {
        context.MakeCurrent();
        _context = context;
        _linesPass = new(context);
        _overlayPass = new(context.Resources);
    }

    /// <summary>
    /// Number of frames that the last one is the mean of: 1 after <see cref="Draw"/>; 0 before the first. Behind a lens the first one,
    /// which is sharp, has no part in the mean of several.
    /// </summary>
    public int GatheredCount { get; private set; }

    /// <summary>Number of frames that an image of a view is made of: those of the settings, and at least 65 behind a lens.</summary>
    public static int FrameCountOf(View view, RenderSettings settings)
    {
        ArgumentNullException.ThrowIfNull(view);
        ArgumentNullException.ThrowIfNull(settings);
        return view.HasLens ? Math.Max(settings.GatheredFrames, MinLensFrames) : settings.GatheredFrames;
    }

    /// <summary>Draws a scene, or the background alone.</summary>
    /// <param name="scene">Scene of the same context; null to draw only the background.</param>
    /// <param name="view">Camera and projection.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    /// <param name="settings">Style, multisampling and optimisations.</param>
    /// <param name="nextView">
    /// View that the next frame will probably have; null for none. Its instances are culled on other threads while this frame is drawn.
    /// </param>
    /// <exception cref="GlException">The frame is larger than the driver allows.</exception>
    /// <remarks>Allocates nothing while scene, size and settings stay the same.</remarks>
    public void Draw(SceneRenderer? scene, View view, int width, int height, RenderSettings settings, View? nextView = null)
    {
        DrawFrame(scene, view, width, height, settings, nextView, offset: default);
        GatheredCount = 1;
    }

    /// <summary>Draws the last frame again, moved by a part of a pixel, and shows the mean of all since <see cref="Draw"/>.</summary>
    /// <remarks>
    /// Edges become a little softer than those of traced images: those of a pixel, behind the same tent. Instances are culled again, and
    /// depth maps kept. Takes 8 bytes a pixel. Behind a lens (<see cref="View.HasLens"/>) each frame is seen from another point of it, with
    /// what is in focus in its place: P. Haeberli and K. Akeley, "The Accumulation Buffer", 1990. Depth maps may be drawn again then.
    /// </remarks>
    /// <param name="scene">The scene of the last frame, unchanged since.</param>
    /// <param name="view">The view of the last frame.</param>
    /// <param name="settings">Its settings.</param>
    /// <exception cref="InvalidOperationException">No frame has been drawn yet.</exception>
    /// <exception cref="GlException">The GPU's memory does not suffice.</exception>
    public void Gather(SceneRenderer scene, View view, RenderSettings settings)
    {
        var (width, height) = _sceneTarget is { } target
            ? (target.Width, target.Height)
            : throw new InvalidOperationException("nothing has been drawn yet");
        if (GatheredCount == 1)
        {
            MakeCurrent();
            _gatheredTarget ??= new(
                _context.Resources, "gathered frames", _targetState.Width, _targetState.Height,
                KeepsLight ? PixelInternalFormat.Rgba32f : PixelInternalFormat.Rgba16f);
            _meanCount = 0;
            if (!view.HasLens)
            {
                AddToMean();
            }
        }

        // Points of Halton's sequence: each next one falls between those before.
        var offset = (TracedCamera.Tent(RadicalInverse(GatheredCount, 2)), TracedCamera.Tent(RadicalInverse(GatheredCount, 3)));
        var isPerspective = view.Projection == Projection.Perspective;
        if (view.HasLens)
        {
            var samples = new SampleSequence(0, GatheredCount - 1, seed: 0);
            var eye = view.LensPoint(samples.Next());
            // What is in focus would move by so many pixels.
            var pixels = view.Viewport(width, height).Height / (2 * view.HalfHeight * view.Camera.FocusDepth);
            offset = (offset.Item1 + (pixels * eye.Right), offset.Item2 + (pixels * eye.Up));
            view = view.WithEyeAt(eye);
        }

        DrawFrame(
            scene, isPerspective ? view : view.MovedBy(offset, width, height), _targetState.Width, _targetState.Height, settings, null,
            isPerspective ? offset : default);
        GatheredCount++;
        AddToMean();
    }

    private void AddToMean()
    {
        _imagePass ??= new(_context.Resources);
        _sceneTarget!.ResolveTo(_resolvedTarget!);
        _gatheredTarget!.Bind();
        _imagePass.Draw(_resolvedTarget!.Texture, 1.0 / ++_meanCount);
    }

    private static double RadicalInverse(int number, int radix)
    {
        var (inverse, unit) = (0.0, 1.0);
        for (; number > 0; number /= radix)
        {
            unit /= radix;
            inverse += unit * (number % radix);
        }

        return inverse;
    }

    private void DrawFrame(
        SceneRenderer? scene, View view, int width, int height, RenderSettings settings, View? nextView, (double X, double Y) offset)
    {
        MakeCurrent();
        scene?.MakeCurrent();
        _context.ApplySettings(settings);
        var target = EnsureTarget(width, height, settings);
        (width, height) = (target.Width, target.Height);
        var frame = FrameView.Create(view, width, height, scene?.ClipPlanes(view, width, height, settings)) with { Offset = offset };
        if (scene?.ProbeBefore(in frame, settings) is { } probe)
        {
            DrawProbe(probe, scene, settings with
            {
                Samples = 0,
                KeepsLight = true,
                Culling = settings.Culling is { } culling ? culling with { OcclusionCulling = false } : null,
            });
        }

        scene?.UpdateShadows(in frame, settings);
        target.Bind();
        Clear(
            view.Background ?? scene?.Scene.Source.Scene.Background ?? settings.Background,
            settings.KeepsLight && scene is not null ? DisplayTransform.Of(scene.Scene.Source.Scene) : null, in frame, width, height);
        if (scene is null)
        {
            return;
        }

        FrameView? nextFrame = nextView is null
            ? null
            : FrameView.Create(nextView, width, height, scene.ClipPlanes(nextView, width, height, settings));
        DrawObjects(scene, in frame, nextFrame, settings);
        if (view.DeepZoom is null)
        {
            _linesPass.DrawGridAndAxes(in frame, scene.Bounds, settings);
        }

        _linesPass.DrawSegments(in frame, scene.Lines);
        scene.DrawAir(in frame, target, settings);
        GL.Disable(EnableCap.DepthTest);
    }

    private void DrawObjects(SceneRenderer scene, in FrameView frame, FrameView? nextFrame, RenderSettings settings)
    {
        GL.Enable(EnableCap.FramebufferSrgb);
        GL.Enable(EnableCap.DepthTest);
        GL.DepthFunc(_context.HasReversedDepth ? DepthFunction.Greater : DepthFunction.Less);
        GL.FrontFace(frame.View.Camera.Handedness == Handedness.Left ? FrontFaceDirection.Cw : FrontFaceDirection.Ccw);
        scene.Draw(in frame, nextFrame, settings);
    }

    /// <summary>Draws all that is seen from a reflection probe. Solids around it must not hide the rest.</summary>
    private void DrawProbe(ReflectionProbe probe, SceneRenderer scene, RenderSettings settings)
    {
        for (var side = 0; side < ReflectionProbe.SideCount; side++)
        {
            var frame = probe.ViewOf(side, scene.Bounds);
            scene.UpdateShadows(in frame, settings);
            probe.Bind(side);
            Clear(default, null, in frame, frame.Width, frame.Height);
            DrawObjects(scene, in frame, null, settings);
        }

        probe.End(settings);
    }

    /// <summary>Waits until the GPU has drawn everything, for measurements of time.</summary>
    public void Finish()
    {
        MakeCurrent();
        GL.Finish();
    }

    /// <summary>Returns what a click on a panel of the last frame answers, see <see cref="OverlayLine.Answer"/>.</summary>
    /// <param name="panel">The panel, the only one of the frame with answers.</param>
    /// <param name="x">Pixels of the frame from its left edge.</param>
    /// <param name="y">Pixels of the frame from its upper edge.</param>
    /// <returns>Null beside all lines that answer something, and where the panel is not on the screen yet.</returns>
    public int? AnswerAt(OverlayPanel panel, double x, double y) => _overlayPass.AnswerAt(panel, x, y);

    /// <summary>Presents the last frame in a window, below an image and a user interface.</summary>
    /// <param name="window">Window of this renderer's context.</param>
    /// <param name="layer">Image over the frame; null for none.</param>
    /// <param name="ui">User interface over both, as it was built last; null for none.</param>
    /// <param name="overlay">Panels over all of these. All three can change without drawing the scene again.</param>
    /// <exception cref="InvalidOperationException">No frame has been drawn yet.</exception>
    /// <exception cref="ArgumentException">The image has another size than the frame.</exception>
    public void Present(
        RenderWindow window, ImageLayer? layer = null, UserInterface? ui = null, params IReadOnlyList<OverlayPanel> overlay)
    {
        Resolve(layer, ui, overlay).CopyToWindow(window.Width, window.Height);
        window.SwapBuffers();
    }

    /// <summary>Reads the last frame back as an image, below another image and a user interface.</summary>
    /// <param name="layer">Image over the frame; null for none.</param>
    /// <param name="ui">User interface over both, as it was built last; null for none.</param>
    /// <param name="overlay">Panels over all of these; none for the scene alone.</param>
    /// <exception cref="InvalidOperationException">No frame has been drawn yet.</exception>
    /// <exception cref="ArgumentException">The image has another size than the frame.</exception>
    /// <exception cref="GlException">The driver reports an error while the pixels are read.</exception>
    public PixelImage Capture(ImageLayer? layer = null, UserInterface? ui = null, params IReadOnlyList<OverlayPanel> overlay)
    {
        var frame = Resolve(layer, ui, overlay);
        var pixels = new byte[4 * frame.Width * frame.Height];
        frame.ReadPixels(pixels);
        return PixelImage.FromBottomUp(frame.Width, frame.Height, pixels);
    }

    /// <summary>Reads the light of the last frame back, drawn with <see cref="RenderSettings.KeepsLight"/>.</summary>
    /// <exception cref="InvalidOperationException">No frame has been drawn yet, or without that setting.</exception>
    /// <exception cref="GlException">The driver reports an error while the light is read.</exception>
    public FloatImage CaptureLight()
    {
        if (!KeepsLight)
        {
            throw new InvalidOperationException("no frame has been drawn whose light is kept");
        }

        var frame = Resolve(null, null, []);
        var stride = 3 * frame.Width;
        var light = new float[stride * frame.Height];
        frame.ReadLight(light);
        var image = new FloatImage(frame.Width, frame.Height, new float[light.Length]);
        // OpenGL counts rows from the bottom.
        for (var y = 0; y < frame.Height; y++)
        {
            light.AsSpan(y * stride, stride).CopyTo(image.Pixels.AsSpan((frame.Height - 1 - y) * stride));
        }

        return image;
    }

    /// <summary>Deletes the framebuffers and shaders. Harmless when repeated.</summary>
    public void Dispose()
    {
        _isDisposed = true;
        GlObject.DisposeAll(_sceneTarget, _resolvedTarget, _gatheredTarget, _linesPass, _overlayPass, _imagePass);
    }

    private void MakeCurrent()
    {
        ObjectDisposedException.ThrowIf(_isDisposed, this);
        _context.MakeCurrent();
    }

    /// <summary>Fills the frame with the background. Its sRGB values are written unchanged, so that the background is exact.</summary>
    /// <param name="background">Colour of the background.</param>
    /// <param name="display">What shows the frame's light, which the background becomes; null for a frame of colours.</param>
    /// <param name="frame">View of the frame.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    private void Clear(Colour background, DisplayTransform? display, in FrameView frame, int width, int height)
    {
        GL.Disable(EnableCap.FramebufferSrgb);
        GL.DepthMask(true);
        GL.ClearDepth(_context.HasReversedDepth ? 0.0 : 1.0);
        if ((frame.Width, frame.Height) != (width, height))
        {
            SetClearColour(RenderSettings.LetterboxColour(background), display);
            GL.Clear(ClearBufferMask.ColorBufferBit);
        }

        // OpenGL counts rows from the bottom.
        var bottom = height - frame.Y - frame.Height;
        GL.Enable(EnableCap.ScissorTest);
        GL.Scissor(frame.X, bottom, frame.Width, frame.Height);
        SetClearColour(background, display, frame.IsProbe ? 0 : 1);
        GL.Clear(ClearBufferMask.ColorBufferBit | ClearBufferMask.DepthBufferBit);
        GL.Disable(EnableCap.ScissorTest);
        GL.Viewport(frame.X, bottom, frame.Width, frame.Height);
    }

    private static void SetClearColour(Colour colour, DisplayTransform? display, float opacity = 1)
    {
        var (red, green, blue) = display?.Invert(colour.ToLinearVector()) ?? new(colour.Red, colour.Green, colour.Blue);
        GL.ClearColor((float)red, (float)green, (float)blue, opacity);
    }

    private bool KeepsLight => _sceneTarget?.Format == PixelInternalFormat.Rgba32f;

    /// <summary>Returns a framebuffer of the requested size, replacing the last one where that differs.</summary>
    private Framebuffer EnsureTarget(int width, int height, RenderSettings settings)
    {
        var sampleCount = EffectiveCulling.SampleCount(settings, _context.MaxSampleCount);
        var state = (width, height, settings.PixelSize, sampleCount, settings.KeepsLight);
        if (_sceneTarget is not null && _targetState == state)
        {
            return _sceneTarget;
        }

        if (width < 1 || height < 1 || Math.Max(width, height) > _context.MaxFrameSize)
        {
            throw new GlException(
                $"a frame of {width}×{height} pixels cannot be drawn: this driver allows 1 to {_context.MaxFrameSize} pixels a side");
        }

        _sceneTarget?.Dispose();
        _resolvedTarget?.Dispose();
        _gatheredTarget?.Dispose();
        // Stays null if one of the allocations fails.
        (_sceneTarget, _resolvedTarget, _gatheredTarget) = (null, null, null);
        var (drawnWidth, drawnHeight) = (1 + ((width - 1) / settings.PixelSize), 1 + ((height - 1) / settings.PixelSize));
        _sceneTarget = new(_context.Resources, "scene", drawnWidth, drawnHeight, sampleCount, settings.KeepsLight);
        _resolvedTarget = new(_context.Resources, "resolved frame", width, height, _sceneTarget.Format);
        _targetState = state;
        return _sceneTarget;
    }

    private Framebuffer Resolve(ImageLayer? layer, UserInterface? ui, IReadOnlyList<OverlayPanel> overlay)
    {
        if (_sceneTarget is null || _resolvedTarget is null)
        {
            throw new InvalidOperationException("nothing has been drawn yet");
        }

        if (layer is { Image: var image } && (image.Width, image.Height) != (_resolvedTarget.Width, _resolvedTarget.Height))
        {
            throw new ArgumentException("expected an image of the size of the frame", nameof(layer));
        }

        MakeCurrent();
        if (GatheredCount > 1)
        {
            _resolvedTarget.Bind();
            _imagePass!.Draw(_gatheredTarget!.Texture, 1);
        }
        else
        {
            _sceneTarget.ResolveTo(_resolvedTarget);
            _resolvedTarget.Bind();
        }

        if (layer is not null)
        {
            _imagePass ??= new(_context.Resources);
            _imagePass.Draw(layer);
        }

        _overlayPass.Draw(ui, overlay, _resolvedTarget.Width, _resolvedTarget.Height);
        return _resolvedTarget;
    }
}
