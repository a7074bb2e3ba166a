using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render.Tracing;

/// <summary>Traces a point of a scene.</summary>
internal static class TracedMean
{
    // Of an image of many samples: a sample of one pixel alone costs more to begin than to trace.
    private const int Side = 8;

    /// <summary>Computes the mean radiance that a view sees which is as narrow as a point.</summary>
    public static Vector Of(LoadedScene scene, View view, int samples)
    {
        var side = samples >= Side * Side ? Side : 1;
        var tracer = new PathTracer(scene, view, side, side);
        for (var i = 0; i < samples / (side * side); i++)
        {
            tracer.AddSample();
        }

        return Enumerable.Range(0, side * side).Aggregate(
            Vector.Zero, (sum, i) => sum + (tracer.RadianceAt(i % side, i / side) / (side * side)));
    }
}
