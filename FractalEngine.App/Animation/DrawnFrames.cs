using FractalEngine.App.Jobs;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Animation;

/// <summary>Draws an image, or the frames of an animation, with OpenGL, before the background of a command.</summary>
/// <param name="prepared">The prepared scene.</param>
/// <param name="job">Size, background and settings of the images.</param>
/// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
internal sealed class DrawnFrames(DrawableScene prepared, RenderJob job) : FrameSource
{
    private readonly Renderer _renderer = Renderer.Offscreen(job.Size.Width, job.Size.Height, job.Settings);
    private DrawableScene _drawable = prepared;
    private LoadedScene _scene = prepared.Source;
    private PathTracer? _tracer;

    public override PixelImage CreateFrame(View view, int part, CancellationToken cancellation)
    {
        cancellation.ThrowIfCancellationRequested();
        return job.Background.IsTransparent
            ? Matting.Combine(DrawOn(view, Colour.Black), DrawOn(view, Colour.White))
            : DrawOn(view, job.Background.Colour);
    }

    public override LightFrame CreateLight(View view, int part, CancellationToken cancellation)
    {
        cancellation.ThrowIfCancellationRequested();
        var layers = job.Format!.Layers;
        // Rays find what the triangles show, without tracing light.
        _tracer = layers.All(static layer => layer == FrameLayer.Colour) ? null
            : _tracer?.WithScene(_scene, view, job.Size.Width, job.Size.Height)
            ?? new(_scene, view, job.Size.Width, job.Size.Height, job.Settings);
        var declared = _drawable.Source.Scene;
        var frame = job.Background.IsTransparent
            ? LightFrame.Combine(LightOn(view, Colour.Black), LightOn(view, Colour.White), declared)
            : new(LightOn(view, job.Background.Colour), declared);
        return frame with { Layers = [.. _tracer?.FindLayers(layers, cancellation) ?? []] };
    }

    public override void Move(AnimatedBodies bodies)
    {
        _scene = bodies.GetScene();
        foreach (var (index, map) in bodies.Maps)
        {
            _renderer.Move(_drawable, index, map);
        }
    }

    public override void Replace(LoadedScene scene)
    {
        var preparation = new ScenePreparation(job.Background.ApplyTo(scene), job.Settings, _drawable);
        preparation.PrepareAll(null, CancellationToken.None);
        if (preparation.HasUnbakedSky(job.Settings))
        {
            preparation.BakeSky(CancellationToken.None);
        }

        _drawable = preparation.Scene;
        _scene = _drawable.Source;
    }

    public override void Dispose()
    {
        _renderer.Dispose();
        base.Dispose();
    }

    private PixelImage DrawOn(View view, Colour? background) => _renderer.Draw(_drawable, Before(view, background));

    private FloatImage LightOn(View view, Colour? background) => _renderer.DrawLight(_drawable, Before(view, background));

    private static View Before(View view, Colour? background) => background is null ? view : view with { Background = background };
}
