using System.Globalization;
using System.Numerics;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window;

/// <summary>What is written over the picture: what it shows, keys, progress, errors and passing messages.</summary>
internal sealed class WindowOverlay
{
    private static readonly TimeSpan MessageDuration = TimeSpan.FromSeconds(4);

    private static readonly OverlayPanel KeysPanel = OverlayPanel.OfTable(OverlayAnchor.TopRight, "Keys",
    [
        ("W A S D", "fly (or arrows)"),
        ("E Q", "fly up, down"),
        ("Shift Alt", "faster, slower"),
        ("left drag", "orbit"),
        ("right drag", "look around"),
        ("middle drag", "pan (or Shift + left)"),
        ("wheel", "zoom"),
        ("F", "frame the scene"),
        ("1 3 7", "front, right, top"),
        ("5", "perspective, orthographic"),
        ("Enter", "back to the start"),
        ("G X", "grid, wireframe"),
        ("L", "light at vertices, at pixels"),
        ("T", "the paper's way into a fractal"),
        ("Space N", "pause, one step"),
        ("B R", "drop a ball, reset"),
        ("P", "walk, fly"),
        ("C V", "next collider, closest points"),
        ("I", "what a picture takes"),
        ("F12", "screenshot"),
        ("Ctrl+S", "save scene and camera"),
        ("H", "these keys"),
        ("Esc", "close"),
    ]);

    private OverlayPanel? _description;
    private OverlayPanel? _message;
    private FrameReport? _report;

    /// <summary>What is being loaded, and how far; null when nothing is.</summary>
    public (string Text, double Fraction)? Progress { get; set; }

    /// <summary>Why there is no picture; null when there is one.</summary>
    public string? Error { get; set; }

    /// <summary>What is written of the bodies; null where there are none.</summary>
    public string? PhysicsStatus { get; set; }

    /// <summary>Whether the keys are listed.</summary>
    public bool ShowsKeys { get; set; }

    /// <summary>Whether it is written what a picture takes.</summary>
    public bool ShowsStatistics { get; set; }

    /// <summary>Pictures drawn, shown again and not needed, see <see cref="FrameReport.ToPanels"/>.</summary>
    public (long Drawn, long ShownAgain, long NotNeeded) FrameCounts { get; set; }

    /// <summary>When a message will have been shown long enough; null when there is none.</summary>
    public TimeSpan? NextExpiry { get; private set; }

    /// <summary>Everything that is written now.</summary>
    public IReadOnlyList<OverlayPanel> Panels =>
    [
        .. PhysicsStatus is { } physics
        ? [new OverlayPanel(OverlayAnchor.TopLeft, [new OverlayLine(physics, null, OverlayTone.Dim)])]
        : Array.Empty<OverlayPanel>(),
        .. ShowsKeys ? [KeysPanel] : Array.Empty<OverlayPanel>(),
        .. ShowsStatistics && _report is { } report ? report.ToPanels(FrameCounts) : [],
        .. Error is { } error
            ? [new OverlayPanel(OverlayAnchor.Centre,
            [.. error.Split('\n').Select(line => new OverlayLine(line, null, OverlayTone.Warning))])]
            : _description is { } description
            ? [BudgetNotice is { } budgetNotice ? description with { Lines = description.Lines.Add(budgetNotice) } : description]
            : Array.Empty<OverlayPanel>(),
        .. Progress is { } progress
        ? [OverlayPanel.OfProgress($"loading {progress.Text}".TrimEnd(), progress.Fraction)]
        : Array.Empty<OverlayPanel>(),
        .. _message is { } message ? [message] : Array.Empty<OverlayPanel>(),
    ];

    /// <summary>Says that parts are coarser than asked for; null where they are not.</summary>
    private OverlayLine? BudgetNotice =>
        _report is { Culling: { } detail, Renderer.MinProjectedSize: var size } && size > detail.MinProjectedSize
        ? new(string.Create(CultureInfo.InvariantCulture,
        $"more than {detail.InstanceBudget:N0} instances: parts below {size:F1} pixels are drawn as one"), null, OverlayTone.Accent)
        : null;

    /// <summary>Tells what is shown from now on.</summary>
    public void DescribeFile(LoadedFile file, DrawableScene drawable)
    {
        (_report, PhysicsStatus) = (null, null);
        var faces = file.Scene.Objects.Aggregate((BigInteger?)BigInteger.Zero, (sum, placed) => sum + placed.Model.FaceCount);
        _description = new(OverlayAnchor.BottomLeft,
        [
            new($"{Path.GetFileName(file.Path)} · {DecimalText.FormatApproximately(faces)} faces · H: keys", null, OverlayTone.Dim),
            .. drawable.Notices.Select(notice => new OverlayLine(notice, null, OverlayTone.Accent)),
        ]);
    }

    /// <summary>Tells what the last picture took.</summary>
    public void SetReport(FrameReport report) => _report = report;

    /// <summary>Shows a message for a few seconds.</summary>
    public void ShowMessage(string message, TimeSpan now)
    {
        _message = OverlayPanel.OfText(OverlayAnchor.Bottom, message);
        NextExpiry = now + MessageDuration;
    }

    /// <summary>Takes a message away that was shown long enough.</summary>
    /// <returns>True when there was one.</returns>
    public bool Expire(TimeSpan now)
    {
        if (!(now >= NextExpiry))
        {
            return false;
        }

        (_message, NextExpiry) = (null, null);
        return true;
    }
}
