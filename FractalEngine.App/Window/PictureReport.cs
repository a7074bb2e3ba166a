using FractalEngine.Core.Detail;
using FractalEngine.Render;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window;

/// <summary>What the last picture took and what was left out, as key I shows it. Plain values: counted and written out only where it is shown.</summary>
/// <param name="Renderer">Drew it.</param>
/// <param name="Detail">What was left out of its instances; null for nothing.</param>
/// <param name="Time">How long it took to draw.</param>
/// <param name="Depth">Levels that the camera has gone down.</param>
/// <param name="Enlargement">Decimal logarithm.</param>
/// <param name="Physics">Has or has not built colliders.</param>
internal readonly record struct PictureReport(SceneRenderer Renderer, DetailSettings? Detail, TimeSpan Time, int Depth, double Enlargement, ScenePhysics Physics)
{
    /// <summary>Two panels.</summary>
    /// <param name="pictures">Drawn so far; shown again without drawing, below another text; and not shown since nothing had changed, that a loop of 60 a second would have drawn.</param>
    public IReadOnlyList<OverlayPanel> ToPanels((long Drawn, long ShownAgain, long NotNeeded) pictures)
    {
        var statistics = Renderer.Statistics;
        var (cost, skips, colliders) = (statistics.Cost, statistics.Skips, Physics.ColliderCounts);
        return
        [
            OverlayPanel.OfTable(OverlayAnchor.BottomRight, "Last picture",
            [
                ("time", Invariant($"{Time.TotalMilliseconds:F1} ms, {statistics.WaitedFor.TotalMilliseconds:F1} choosing")),
                ("instances", Invariant($"{statistics.Instances:N0}")),
                ("triangles", Invariant($"{statistics.Triangles:N0}")),
                ("parts looked at", Invariant($"{cost.Nodes:N0}")),
                ("drawn as one", Invariant($"{cost.StandIns:N0}")),
                ("depth", Invariant($"{Depth:N0}, enlarged 10^{Enlargement:F1}")),
                ("choices so far", Invariant($"{statistics.Choices:N0}")),
                ("moved to GPU", Invariant($"{statistics.UploadedBytes / 1e6:F1} MB")),
            ]),
            OverlayPanel.OfTable(OverlayAnchor.TopLeft, "Left out",
            [
                ("outside", Invariant($"{cost.Outside:N0} parts")),
                ("hidden", Invariant($"{cost.Hidden:N0} parts")),
                ("covering nothing", Invariant($"{cost.Uncovering:N0} parts")),
                ("backs", Invariant($"of {skips.OneSided:N0} of {skips.Objects:N0} objects")),
                ("empty faces", Invariant($"{skips.EmptyFaces:N0}")),
                ("not in sight yet", Invariant($"{skips.Unprepared:N0} of {skips.Models:N0} models")),
                ("not asked yet", Invariant($"{colliders.All - colliders.Built:N0} of {colliders.All:N0} colliders")),
                ("shared", Invariant($"{skips.Objects:N0} objects, {skips.Models:N0} files, {skips.Textures:N0} textures")),
                ("uploads", Invariant($"{skips.Uploads.Skipped:N0}; {skips.Uploads.Made:N0} made")),
                ("state changes", Invariant($"{skips.StateChanges.Skipped:N0}; {skips.StateChanges.Made:N0} made")),
                ("pictures at 60/s", Invariant($"{pictures.NotNeeded:N0}; {pictures.Drawn:N0} drawn, {pictures.ShownAgain:N0} shown again")),
            ]),
        ];
    }

    private static string Invariant(FormattableString text) => FormattableString.Invariant(text);
}
