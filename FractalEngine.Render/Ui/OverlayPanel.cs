using System.Collections.Immutable;

namespace FractalEngine.Render.Ui;

/// <summary>Text on a translucent panel over the picture.</summary>
/// <param name="Anchor">Where it stands.</param>
/// <param name="Lines">From the top.</param>
public sealed record OverlayPanel(OverlayAnchor Anchor, ImmutableArray<OverlayLine> Lines)
{
    /// <summary>A heading above the lines, or null.</summary>
    public string? Title { get; init; }

    /// <summary>How far something has come, from 0 to 1: a bar below the lines. Null for none.</summary>
    public double? Progress { get; init; }

    /// <summary>A panel of plain lines.</summary>
    public static OverlayPanel OfText(OverlayAnchor anchor, params ReadOnlySpan<string> lines) =>
        new(anchor, [.. lines.ToArray().Select(line => new OverlayLine(line))]);

    /// <summary>A panel of rows with two columns, such as keys and what they do.</summary>
    public static OverlayPanel OfTable(OverlayAnchor anchor, string title, IEnumerable<(string First, string Second)> rows) =>
        new(anchor, [.. rows.Select(row => new OverlayLine(row.First, row.Second))]) { Title = title };

    /// <summary>A panel with a label and a bar, in the middle.</summary>
    /// <param name="label">What is going on.</param>
    /// <param name="fraction">From 0 to 1.</param>
    public static OverlayPanel OfProgress(string label, double fraction) =>
        new(OverlayAnchor.Centre, [new OverlayLine(label)]) { Progress = fraction };

    /// <inheritdoc/>
    public bool Equals(OverlayPanel? other) =>
        other is not null && Anchor == other.Anchor && Title == other.Title && Progress.Equals(other.Progress)
        && Lines.SequenceEqual(other.Lines);

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Anchor, Title, Progress, Lines.Length);
}
