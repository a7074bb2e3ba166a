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
    private LoadedScene? _nextScene;

    public override PixelImage CreateFrame(View view, int part, CancellationToken cancellation)
    {
        Trace(view, part, cancellation);
        return _tracer.Denoise(cancellation: cancellation);
    }

    public override LightFrame CreateLight(View view, int part, CancellationToken cancellation)
    {
        Trace(view, part, cancellation);
        return _tracer.ToLightFrame(job.Format!.Layers, cancellation);
    }

    private void Trace(View view, int part, CancellationToken cancellation)
    {
        if (_nextScene is { } scene)
        {
            _tracer = trace.CreateTracer(scene, view, job, _tracer);
        }

        _tracer = _tracer.WithView(view, job.Size.Width, job.Size.Height, trace.Seed + part);
        _nextScene = null;
        trace.AddSamples(_tracer, cancellation);
    }

    public override void Move(AnimatedBodies bodies) => Replace(bodies.GetScene());

    public override void Replace(LoadedScene scene) => _nextScene = scene;
}
