using FractalEngine.Parsing.Assets;
using FractalEngine.Render;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>Pictures with one skip switched off.</summary>
/// <param name="Name">As behind <c>--without</c>; of the first one, with all of them on, <c>everything</c>.</param>
/// <param name="Load">How files are loaded.</param>
/// <param name="Settings">How they are prepared and drawn.</param>
/// <param name="Unit">What <paramref name="CounterOf"/> counts.</param>
/// <param name="CounterOf">The skip's own counter.</param>
internal sealed record OptimisationCase(string Name, LoadOptions Load, RenderSettings Settings, string Unit, Func<OptimisationSample,
    long> CounterOf)
{
    /// <summary>All skips on, then each switched off alone.</summary>
    public static IReadOnlyList<OptimisationCase> All { get; } = CreateAll(new(), new() { Samples = 0 });

    private static OptimisationCase[] CreateAll(LoadOptions load, RenderSettings settings) =>
    [
        new("everything skipped", load, settings, "", static _ => 0),
        new("- backs", load, settings with { BackFaceCulling = false }, "objects without backs",
        static sample => sample.StillStatistics.Optimisations.BackFaceCulledCount),
        new("- outside", load, settings with { Culling = new() { FrustumCulling = false } }, "parts outside",
        static sample => sample.StillStatistics.Culling.OutsideFrustum),
        new("- hidden", load, settings with { Culling = new() { OcclusionCulling = false } }, "parts hidden or covering nothing",
        static sample => sample.StillStatistics.Culling.Occluded + sample.StillStatistics.Culling.ZeroCoverage),
        new("- empty-faces", load, settings with { RemoveDegenerateTriangles = false }, "empty faces left out",
        static sample => sample.StillStatistics.Optimisations.DegenerateTriangleCount),
        new("- state", load, settings with { FilterRedundantState = false }, "state changes a picture",
        static sample => sample.StillStatistics.Optimisations.StateChanges.Performed),
        new("- buffers", load, settings with { ReuseBuffers = false }, "uploads a standing picture",
        static sample => sample.StillStatistics.Optimisations.Uploads.Performed),
        new("- sharing", load with { ShareModels = false }, settings with { ShareTextures = false }, "files and textures",
        static sample => sample.StillStatistics.Optimisations.ModelCount + sample.StillStatistics.Optimisations.TextureCount),
        new("- sight", load, settings with { LazyLoading = false }, "models not prepared",
        static sample => sample.StillStatistics.Optimisations.PlaceholderCount),
    ];
}
