using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Views;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>Settings with one optimisation switched off.</summary>
/// <param name="Name">A dash and the name of the optimisation; of the first case, which has all on, a description.</param>
/// <param name="Load">Options for loading files.</param>
/// <param name="Settings">Settings for preparing and drawing.</param>
/// <param name="Unit">What <paramref name="CounterOf"/> counts; empty for the first case.</param>
/// <param name="CounterOf">Reads the optimisation's own counter from a sample.</param>
internal sealed record OptimisationCase(
    string Name, LoadOptions Load, RenderSettings Settings, string Unit, Func<OptimisationSample, long> CounterOf)
{
    /// <summary>
    /// Most instances of a frame: so many that no case reaches them. With fewer, a frame of more instances shows less detail, and its image
    /// would tell of that.
    /// </summary>
    public const int InstanceBudget = 20_000_000;

    /// <summary>All optimisations on, then each switched off alone.</summary>
    public static IReadOnlyList<OptimisationCase> All { get; } = CreateAll(
        new(), new() { Samples = 0, Culling = new() { InstanceBudget = InstanceBudget } }, new() { InstanceBudget = InstanceBudget });

    private static OptimisationCase[] CreateAll(LoadOptions load, RenderSettings settings, CullingSettings culling) =>
    [
        new("all optimisations", load, settings, "", static _ => 0),
        new("- backface-culling", load, settings with { BackFaceCulling = false }, "back-face culled objects",
            static sample => sample.StillStatistics.Optimisations.BackFaceCulledCount),
        new("- frustum-culling", load, settings with { Culling = culling with { FrustumCulling = false } }, "nodes outside",
            static sample => sample.StillStatistics.Culling.OutsideFrustum),
        new("- occlusion-culling", load, settings with { Culling = culling with { OcclusionCulling = false } },
            "nodes hidden or without coverage",
            static sample => sample.StillStatistics.Culling.Occluded + sample.StillStatistics.Culling.ZeroCoverage),
        new("- light-culling", load, settings with { LightCulling = false }, "shadow maps skipped",
            static sample => sample.StillStatistics.Optimisations.SkippedShadowMaps),
        new("- caster-culling", load, settings with { CasterCulling = false }, "casters skipped",
            static sample => sample.StillStatistics.Optimisations.SkippedCasters),
        new("- bake-skipping", load, settings with { BakeSkipping = false }, "bakes skipped",
            static sample => sample.StillStatistics.Optimisations.SkippedBakes),
        new("- degenerate-removal", load, settings with { RemoveDegenerateTriangles = false }, "degenerate triangles removed",
            static sample => sample.StillStatistics.Optimisations.DegenerateTriangleCount),
        new("- state-filtering", load, settings with { FilterRedundantState = false }, "state changes per frame",
            static sample => sample.StillStatistics.Optimisations.StateChanges.Performed),
        new("- buffer-reuse", load, settings with { ReuseBuffers = false }, "uploads per still frame",
            static sample => sample.StillStatistics.Optimisations.Uploads.Performed),
        new("- mesh-sharing", load with { ShareModels = false }, settings with { ShareTextures = false }, "models and textures",
            static sample => sample.StillStatistics.Optimisations.ModelCount + sample.StillStatistics.Optimisations.TextureCount),
        new("- lazy-loading", load, settings with { LazyLoading = false }, "models not prepared",
            static sample => sample.StillStatistics.Optimisations.PlaceholderCount),
    ];
}
