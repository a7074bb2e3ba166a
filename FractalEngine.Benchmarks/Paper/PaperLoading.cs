using System.Diagnostics;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;

namespace FractalEngine.Benchmarks.Paper;

/// <summary>
/// How long from a file's text to arrays that the GPU takes as they are: files read, parsed, normals and vertices made, instances placed.
/// Median of some runs.
/// </summary>
internal static class PaperLoading
{
    private const int Runs = 10;

    // More than the paper's largest model needs.
    private const int MaxInstances = 4_000_000;
    private const long MaxTriangles = 50_000_000;

    /// <summary>As the engine does it: a fractal's instances are chosen picture by picture.</summary>
    public static double MeasureSeconds(string file) => MeasureMedian(file, new());

    /// <summary>As the paper does it: every instance's matrix is made.</summary>
    public static double MeasureSecondsWithEveryInstance(string file) =>
        MeasureMedian(file, new() { Culling = null, InstanceBudget = MaxInstances, TriangleBudget = MaxTriangles });

    private static double MeasureMedian(string file, RenderSettings settings)
    {
        var seconds = new double[Runs];
        for (var run = 0; run < Runs; run++)
        {
            var start = Stopwatch.GetTimestamp();
            var drawable = DrawableScene.Prepare(PaperModel.Load(file).Scene, settings);
            seconds[run] = Stopwatch.GetElapsedTime(start).TotalSeconds;
            if (drawable.Notices.Length > 0)
            {
                throw new InvalidOperationException(drawable.Notices[0]);
            }
        }

        Array.Sort(seconds);
        return (seconds[(Runs - 1) / 2] + seconds[Runs / 2]) / 2;
    }
}
