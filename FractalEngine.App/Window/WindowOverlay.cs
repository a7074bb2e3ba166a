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
    private static readonly TimeSpan MessageTime = TimeSpan.FromSeconds(4);

    private static readonly OverlayPanel Keys = OverlayPanel.OfTable(OverlayAnchor.TopRight, "Keys",
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
    private PictureReport? _report;

    /// <summary>What is being loaded, and how far; null when nothing is.</summary>
    public (string Text, double Fraction)? Progress { get; set; }

    /// <summary>Why there is no picture; null when there is one.</summary>
    public string? Error { get; set; }

    /// <summary>What is written of the bodies; null where there are none.</summary>
    public string? Physics { get; set; }

    /// <summary>Whether the keys are listed.</summary>
    public bool ShowsKeys { get; set; }

    /// <summary>Whether it is written what a picture takes.</summary>
    public bool ShowsStatistics { get; set; }

    /// <summary>Pictures drawn, shown again and not needed, see <see cref="PictureReport.ToPanels"/>.</summary>
    public (long Drawn, long ShownAgain, long NotNeeded) Pictures { get; set; }

    /// <summary>When a message will have been shown long enough; null when there is none.</summary>
    public TimeSpan? NextExpiry { get; private set; }

    /// <summary>Everything that is written now.</summary>
    public IReadOnlyList<OverlayPanel> Panels =>
    [
        .. Physics is { } physics ? [new OverlayPanel(OverlayAnchor.TopLeft, [new OverlayLine(physics, null, OverlayTone.Dim)])] : Array.Empty<OverlayPanel>(),
        .. ShowsKeys ? [Keys] : Array.Empty<OverlayPanel>(),
        .. ShowsStatistics && _report is { } report ? report.ToPanels(Pictures) : [],
        .. Error is { } error
            ? [new OverlayPanel(OverlayAnchor.Centre, [.. error.Split('\n').Select(line => new OverlayLine(line, null, OverlayTone.Warning))])]
            : _description is { } description ? [Coarser is { } coarser ? description with { Lines = description.Lines.Add(coarser) } : description] : Array.Empty<OverlayPanel>(),
        .. Progress is { } progress ? [OverlayPanel.OfProgress($"loading {progress.Text}".TrimEnd(), progress.Fraction)] : Array.Empty<OverlayPanel>(),
        .. _message is { } message ? [message] : Array.Empty<OverlayPanel>(),
    ];

    /// <summary>Says that parts are coarser than asked for; null where they are not.</summary>
    private OverlayLine? Coarser => _report is { Detail: { } detail, Renderer.PixelSize: var size } && size > detail.PixelSize
        ? new(string.Create(CultureInfo.InvariantCulture, $"more than {detail.InstanceBudget:N0} instances: parts below {size:F1} pixels are drawn as one"), null, OverlayTone.Accent)
        : null;

    /// <summary>Tells what is shown from now on.</summary>
    public void Describe(LoadedFile file, DrawableScene drawable)
    {
        (_report, Physics) = (null, null);
        var faces = file.Scene.Objects.Aggregate((BigInteger?)BigInteger.Zero, (sum, placed) => sum + placed.Model.FaceCount);
        _description = new(OverlayAnchor.BottomLeft,
        [
            new($"{Path.GetFileName(file.Path)} · {DecimalText.Approximate(faces)} faces · H: keys", null, OverlayTone.Dim),
            .. drawable.Notices.Select(notice => new OverlayLine(notice, null, OverlayTone.Accent)),
        ]);
    }

    /// <summary>Tells what the last picture took.</summary>
    public void Measure(PictureReport report) => _report = report;

    /// <summary>Shows a message for a few seconds.</summary>
    public void Say(string message, TimeSpan now)
    {
        _message = OverlayPanel.OfText(OverlayAnchor.Bottom, message);
        NextExpiry = now + MessageTime;
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
