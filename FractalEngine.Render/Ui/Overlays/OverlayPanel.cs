using System.Collections.Immutable;

namespace FractalEngine.Render.Ui.Overlays;

/// <summary>Text on a translucent panel over a frame.</summary>
/// <param name="Anchor">Position of the panel in the frame.</param>
/// <param name="Lines">Lines of the panel, from the top.</param>
public sealed record OverlayPanel(OverlayAnchor Anchor, ImmutableArray<OverlayLine> Lines)
{
    /// <summary>Heading above the lines; null for none.</summary>
    public string? Title { get; init; }

    /// <summary>Completed fraction from 0 to 1, shown as a bar below the lines; null for no bar.</summary>
    public double? Progress { get; init; }

    /// <summary>Whether the panel waits for an answer, and lies over menus and panels until it has one.</summary>
    public bool IsQuestion { get; init; }

    /// <summary>Creates a panel of plain lines.</summary>
    public static OverlayPanel OfText(OverlayAnchor anchor, params ReadOnlySpan<string> lines) =>
        new(anchor, [.. lines.ToArray().Select(line => new OverlayLine(line))]);

    /// <summary>Creates a panel with a label and a progress bar in the centre.</summary>
    /// <param name="label">Description of the work in progress.</param>
    /// <param name="fraction">Completed fraction, from 0 to 1.</param>
    public static OverlayPanel OfProgress(string label, double fraction) =>
        new(OverlayAnchor.Centre, [new OverlayLine(label)]) { Progress = fraction };

    /// <inheritdoc/>
    public bool Equals(OverlayPanel? other) =>
        other is not null && (Anchor, IsQuestion, Title) == (other.Anchor, other.IsQuestion, other.Title) && Progress.Equals(other.Progress)
        && Lines.SequenceEqual(other.Lines);

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Anchor, Title, Progress, Lines.Length);
}
