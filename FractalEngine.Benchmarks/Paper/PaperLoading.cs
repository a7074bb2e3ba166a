using System.Diagnostics;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.Benchmarks.Paper;

/// <summary>
/// Measures the time from a file's text to arrays that the GPU takes as they are: files are read and parsed, normals and vertices computed,
/// instances placed. The light within fractals is not needed for a first picture, and not measured. The median of some runs counts.
/// </summary>
internal static class PaperLoading
{
    private const int Runs = 10;

    // More than the paper's largest model needs.
    private const int MaxInstances = 4_000_000;
    private const long MaxTriangles = 50_000_000;

    /// <summary>Measures the seconds that the engine takes, which culls a fractal's instances frame by frame.</summary>
    public static double MeasureSeconds(string file) => MeasureMedian(file, new());

    /// <summary>Measures the seconds that it takes as in the paper, where every instance's matrix is computed.</summary>
    public static double MeasureSecondsWithEveryInstance(string file) =>
        MeasureMedian(file, new() { Culling = null, InstanceBudget = MaxInstances, TriangleBudget = MaxTriangles });

    private static double MeasureMedian(string file, RenderSettings settings)
    {
        var seconds = new double[Runs];
        for (var run = 0; run < Runs; run++)
        {
            var start = Stopwatch.GetTimestamp();
            var preparation = new ScenePreparation(PaperModel.Load(file).Scene, settings);
            preparation.PrepareAll(null, CancellationToken.None);
            seconds[run] = Stopwatch.GetElapsedTime(start).TotalSeconds;
            if (preparation.Scene.Notices.Length > 0)
            {
                throw new InvalidOperationException(preparation.Scene.Notices[0]);
            }
        }

        Array.Sort(seconds);
        return (seconds[(Runs - 1) / 2] + seconds[Runs / 2]) / 2;
    }
}
