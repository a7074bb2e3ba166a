using FractalEngine.Core.Visibility;
using FractalEngine.Render;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window;

/// <summary>
/// What the last picture took and what was left out, as key I shows it. Plain values: counted and written out only where it is shown.
/// </summary>
/// <param name="Renderer">Drew it.</param>
/// <param name="Culling">What was left out of its instances; null for nothing.</param>
/// <param name="DrawTime">How long it took to draw.</param>
/// <param name="Depth">Levels that the camera has gone down.</param>
/// <param name="Log10Magnification">Decimal logarithm.</param>
/// <param name="Physics">Has or has not built colliders.</param>
internal readonly record struct FrameReport(SceneRenderer Renderer, CullingSettings? Culling, TimeSpan DrawTime, int Depth,
    double Log10Magnification, ScenePhysics Physics)
{
    /// <summary>Two panels.</summary>
    /// <param name="frames">
    /// Drawn so far; shown again without drawing, below another text; and not shown since nothing had changed, that a loop of 60 a second
    /// would have drawn.
    /// </param>
    public IReadOnlyList<OverlayPanel> ToPanels((long Drawn, long ShownAgain, long NotNeeded) frames)
    {
        var statistics = Renderer.Statistics;
        var (culling, optimisations, colliders) = (statistics.Culling, statistics.Optimisations, Physics.ColliderCounts);
        return
        [
            OverlayPanel.OfTable(OverlayAnchor.BottomRight, "Last picture",
            [
                ("time", Invariant($"{DrawTime.TotalMilliseconds:F1} ms, {statistics.CullWaitTime.TotalMilliseconds:F1} choosing")),
                ("instances", Invariant($"{statistics.InstanceCount:N0}")),
                ("triangles", Invariant($"{statistics.TriangleCount:N0}")),
                ("parts looked at", Invariant($"{culling.VisitedNodes:N0}")),
                ("drawn as one", Invariant($"{culling.Proxies:N0}")),
                ("depth", Invariant($"{Depth:N0}, enlarged 10^{Log10Magnification:F1}")),
                ("choices so far", Invariant($"{statistics.CullCount:N0}")),
                ("moved to GPU", Invariant($"{statistics.UploadedBytes / 1e6:F1} MB")),
            ]),
            OverlayPanel.OfTable(OverlayAnchor.TopLeft, "Left out",
            [
                ("outside", Invariant($"{culling.OutsideFrustum:N0} parts")),
                ("hidden", Invariant($"{culling.Occluded:N0} parts")),
                ("covering nothing", Invariant($"{culling.ZeroCoverage:N0} parts")),
                ("backs", Invariant($"of {optimisations.BackFaceCulledCount:N0} of {optimisations.ObjectCount:N0} objects")),
                ("empty faces", Invariant($"{optimisations.DegenerateTriangleCount:N0}")),
                ("not in sight yet", Invariant($"{optimisations.PlaceholderCount:N0} of {optimisations.ModelCount:N0} models")),
                ("not asked yet", Invariant($"{colliders.All - colliders.Built:N0} of {colliders.All:N0} colliders")),
                ("shared",
                Invariant(
                    $"{optimisations.ObjectCount:N0} objects, {optimisations.ModelCount:N0} files, {optimisations.TextureCount:N0} textures")),
                ("uploads", Invariant($"{optimisations.Uploads.Skipped:N0}; {optimisations.Uploads.Performed:N0} made")),
                ("state changes", Invariant($"{optimisations.StateChanges.Skipped:N0}; {optimisations.StateChanges.Performed:N0} made")),
                ("pictures at 60/s", Invariant($"{frames.NotNeeded:N0}; {frames.Drawn:N0} drawn, {frames.ShownAgain:N0} shown again")),
            ]),
        ];
    }

    private static string Invariant(FormattableString text) => FormattableString.Invariant(text);
}
