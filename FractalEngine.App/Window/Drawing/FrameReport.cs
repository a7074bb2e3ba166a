using System.Globalization;
using FractalEngine.App.Window.Simulation;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Render;
using static System.FormattableString;

namespace FractalEngine.App.Window.Drawing;

/// <summary>
/// The cost of the last frame and the savings of each optimisation, for the panel of statistics. Numbers are formatted only while they
/// are shown.
/// </summary>
/// <param name="Renderer">The renderer that drew the frame.</param>
/// <param name="Culling">The culling settings of the frame; null where every instance was drawn.</param>
/// <param name="DrawTime">The time that drawing the frame took.</param>
/// <param name="Depth">Number of fractal levels between the whole and the camera.</param>
/// <param name="Log10Magnification">Decimal logarithm of the magnification around the camera.</param>
/// <param name="Physics">The physics of the scene, for the number of colliders.</param>
internal readonly record struct FrameReport(
    SceneRenderer Renderer, CullingSettings? Culling, TimeSpan DrawTime, int Depth, double Log10Magnification, ScenePhysics Physics)
{
    /// <summary>Creates the two tables of the report, of names and values.</summary>
    public IReadOnlyList<(string Title, (string Name, string Value)[] Rows)> ToTables(FrameCounts frames)
    {
        var statistics = Renderer.Statistics;
        return [("Last frame", CostRows(statistics)), ("Optimisations", SavingsRows(statistics, frames))];
    }

    /// <summary>Number of distinct instances of all objects together, for people.</summary>
    private string AllInstances => Renderer.Scene.Source.Sum(static model => model.DistinctInstanceCount) is not { } count
        ? "infinitely many"
        : count.ToString(count < 1_000_000_000_000 ? "N0" : "E1", CultureInfo.InvariantCulture);

    private (string Name, string Value)[] CostRows(FrameStatistics statistics)
    {
        var drawTime = DrawTime.TotalMilliseconds;
        var cullTime = statistics.CullWaitTime.TotalMilliseconds;
        return
        [
            ("draw time", Invariant($"{drawTime:F1} ms")),
            ("waited for culling", Invariant($"{cullTime:F1} ms")),
            ("instances", Invariant($"{statistics.InstanceCount:N0} of {AllInstances}")),
            ("draw calls", Invariant($"{statistics.DrawCallCount:N0}")),
            ("triangles", Invariant($"{statistics.TriangleCount:N0}")),
            ("visited nodes", Invariant($"{statistics.Culling.VisitedNodes:N0}")),
            ("proxies", Invariant($"{statistics.Culling.Proxies:N0}")),
            ("fractal depth", Invariant($"{Depth:N0}, magnified {ViewName.Magnification(Log10Magnification)}")),
            ("culling runs", Invariant($"{statistics.CullCount:N0}")),
            ("uploaded", Invariant($"{statistics.UploadedBytes / 1e6:F1} MB")),
        ];
    }

    private (string Name, string Value)[] SavingsRows(FrameStatistics statistics, FrameCounts frames)
    {
        var culling = statistics.Culling;
        var saved = statistics.Optimisations;
        var (builtColliders, allColliders) = Physics.ColliderCounts;
        return
        [
            ("frustum culling", Invariant($"{culling.OutsideFrustum:N0} nodes outside")),
            ("occlusion culling", Invariant($"{culling.Occluded:N0} nodes hidden")),
            ("section", Invariant($"{culling.CutAway:N0} nodes cut away")),
            ("zero coverage", Invariant($"{culling.ZeroCoverage:N0} instances")),
            ("back-face culling", Invariant($"{saved.BackFaceCulledCount:N0} of {saved.ObjectCount:N0} objects")),
            ("degenerate removal", Invariant($"{saved.DegenerateTriangleCount:N0} triangles")),
            ("lazy loading", Invariant($"{saved.PlaceholderCount:N0} of {saved.ModelCount:N0} models pending")),
            ("lazy colliders", Invariant($"{allColliders - builtColliders:N0} of {allColliders:N0} not built")),
            ("sharing", Invariant($"{saved.ObjectCount:N0} objects, {saved.ModelCount:N0} models, {saved.TextureCount:N0} textures")),
            ("buffer reuse", Invariant($"{saved.Uploads.Skipped:N0} uploads skipped, {saved.Uploads.Performed:N0} made")),
            ("shadow maps", Invariant($"{saved.ShadowMaps.Skipped:N0} kept, {saved.ShadowMaps.Performed:N0} drawn")),
            ("light culling", Invariant($"{saved.SkippedShadowMaps:N0} shadow maps skipped")),
            ("caster culling", Invariant($"{saved.SkippedCasters:N0} of {saved.ObjectCount:N0} objects")),
            ("bake skipping", Invariant($"{saved.SkippedBakes:N0} of {saved.ModelCount:N0} models")),
            ("state filtering", Invariant($"{saved.StateChanges.Skipped:N0} calls skipped, {saved.StateChanges.Performed:N0} made")),
            ("idle", Invariant($"{frames.Skipped:N0} frames skipped, {frames.Drawn:N0} drawn, {frames.PresentedAgain:N0} reused")),
        ];
    }
}

/// <summary>How many frames a window has drawn, compared with a loop that draws 60 frames a second.</summary>
/// <param name="Drawn">Number of frames drawn.</param>
/// <param name="PresentedAgain">Number of frames presented again without drawing, below a new overlay.</param>
/// <param name="Skipped">Number of frames neither drawn nor presented, since nothing had changed.</param>
internal readonly record struct FrameCounts(long Drawn, long PresentedAgain, long Skipped);
