using FractalEngine.App.Jobs;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Animation;

/// <summary>Traces the frames of an animation. What was prepared of its models is shared.</summary>
/// <param name="prepared">A tracer of the scene, whose preparation the frames share.</param>
/// <param name="job">Size, background and settings of the frames.</param>
/// <param name="trace">Samples and seed of each frame.</param>
internal sealed class TracedFrames(PathTracer prepared, RenderJob job, TracedImage trace) : FrameSource
{
    private PathTracer _tracer = prepared;
    private LoadedScene? _movedScene;

    public override PixelImage CreateFrame(View view, CancellationToken cancellation)
    {
        Trace(view, cancellation);
        return _tracer.Denoise(cancellation: cancellation);
    }

    public override LightFrame CreateLight(View view, CancellationToken cancellation)
    {
        Trace(view, cancellation);
        return _tracer.ToLightFrame(job.Format!.Layers, cancellation);
    }

    private void Trace(View view, CancellationToken cancellation)
    {
        _tracer = _movedScene is { } scene
            ? trace.CreateTracer(scene, view, job, _tracer)
            : _tracer.WithView(view, job.Size.Width, job.Size.Height);
        _movedScene = null;
        trace.AddSamples(_tracer, cancellation);
    }

    public override void Move(AnimatedBodies bodies) => _movedScene = bodies.GetScene();
}
