using FractalEngine.Parsing.Assets;
using FractalEngine.Render;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>Pictures with one skip switched off.</summary>
/// <param name="Name">As behind <c>--without</c>; of the first one, with all of them on, <c>everything</c>.</param>
/// <param name="Load">How files are loaded.</param>
/// <param name="Settings">How they are prepared and drawn.</param>
/// <param name="Unit">What <paramref name="Count"/> counts.</param>
/// <param name="Count">The skip's own counter.</param>
internal sealed record SkipCase(string Name, LoadOptions Load, RenderSettings Settings, string Unit, Func<SkipSample, long> Count)
{
    /// <summary>All skips on, then each switched off alone.</summary>
    public static IReadOnlyList<SkipCase> All { get; } = List(new(), new() { Samples = 0 });

    private static SkipCase[] List(LoadOptions load, RenderSettings settings) =>
    [
        new("everything skipped", load, settings, "", static _ => 0),
        new("- backs", load, settings with { SkipsBacks = false }, "objects without backs", static sample => sample.Standing.Skips.OneSided),
        new("- outside", load, settings with { Detail = new() { SkipsOutside = false } }, "parts outside", static sample => sample.Standing.Cost.Outside),
        new("- hidden", load, settings with { Detail = new() { SkipsHidden = false } }, "parts hidden or covering nothing", static sample => sample.Standing.Cost.Hidden + sample.Standing.Cost.Uncovering),
        new("- empty-faces", load, settings with { SkipsEmptyFaces = false }, "empty faces left out", static sample => sample.Standing.Skips.EmptyFaces),
        new("- state", load, settings with { SkipsSameState = false }, "state changes a picture", static sample => sample.Standing.Skips.StateChanges.Made),
        new("- buffers", load, settings with { KeepsBuffers = false }, "uploads a standing picture", static sample => sample.Standing.Skips.Uploads.Made),
        new("- sharing", load with { SharesFiles = false }, settings with { SharesTextures = false }, "files and textures", static sample => sample.Standing.Skips.Models + sample.Standing.Skips.Textures),
        new("- sight", load, settings with { PreparesOnSight = false }, "models not prepared", static sample => sample.Standing.Skips.Unprepared),
    ];
}
