using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Ui.Overlays;
using static System.FormattableString;

namespace FractalEngine.App.Window.Drawing;

/// <summary>The texts over the frame: file description, progress, errors and temporary messages.</summary>
internal sealed class WindowOverlay
{
    private static readonly TimeSpan MessageDuration = TimeSpan.FromSeconds(4);

    private static readonly TimeSpan ProblemDuration = TimeSpan.FromSeconds(12);

    // As many as the graph of a wide panel has columns.
    private const int MaxFrameTimes = 160;

    private readonly Queue<double> _frameTimes = [];
    private string _fileText = "";
    private OverlayPanel? _description;
    private OverlayPanel? _message;
    private FrameReport? _report;

    /// <summary>The file being loaded, and the completed fraction from 0 to 1; null while nothing is loaded.</summary>
    public (string Text, double Fraction)? Progress { get; set; }

    /// <summary>The error of a file that can't be shown, until it is mended; null if there is none.</summary>
    public string? Error { get; set; }

    /// <summary>The open question; null for none.</summary>
    public OverlayPanel? Prompt { get; set; }

    /// <summary>Names the view, see <see cref="ViewName"/>.</summary>
    public string ViewText { get; set; } = "";

    /// <summary>Tells how far the traced image is; null for nothing.</summary>
    public string? TraceText { get; set; }

    /// <summary>Lines about the bodies of the scene; null if there are none to show.</summary>
    public string? PhysicsStatus { get; set; }

    /// <summary>Whether the bodies are described elsewhere, so that no lines about them are shown.</summary>
    public bool HidesPhysics { get; set; }

    /// <summary>Times of the last frames in milliseconds, the latest at the end.</summary>
    public IReadOnlyCollection<double> FrameTimes => _frameTimes;

    /// <summary>The statistics of the last frame, as tables of names and values; none before the first.</summary>
    public IReadOnlyList<(string Title, (string Name, string Value)[] Rows)> ReportTables => _report?.ToTables(FrameCounts) ?? [];

    /// <summary>Numbers of frames since the window was opened, for the statistics.</summary>
    public FrameCounts FrameCounts { get; set; }

    /// <summary>The time at which the present message disappears; null if there is none.</summary>
    public TimeSpan? NextExpiry { get; private set; }

    public IReadOnlyList<OverlayPanel> Panels
    {
        get
        {
            var panels = new List<OverlayPanel>();
            if (PhysicsStatus is { } status && !HidesPhysics)
            {
                panels.Add(new(OverlayAnchor.TopLeft, [new OverlayLine(status, null, OverlayTone.Dim)]));
            }

            if (_description is { } description && !(MessageReplacesStatus && _message is not null))
            {
                var trace = TraceText is { } text ? $" · {text}" : "";
                var lines = description.Lines.Insert(0, new($"{_fileText}{ViewText}{trace} · H: keys", null, OverlayTone.Dim));
                panels.Add(description with { Lines = BudgetNotice is { } notice ? lines.Add(notice) : lines });
            }

            if (Error is { } error)
            {
                // Above the description the last good scene stays in view.
                panels.Add(OfError(_description is null ? OverlayAnchor.Centre : OverlayAnchor.BottomLeft, error));
            }

            if (Progress is { } progress)
            {
                panels.Add(OverlayPanel.OfProgress($"loading {progress.Text}".TrimEnd(), progress.Fraction));
            }

            if (_message is { } message)
            {
                panels.Add(message);
            }

            if (Prompt is { } prompt)
            {
                panels.Add(prompt);
            }

            return panels;
        }
    }

    /// <summary>Whether a message stands in the place of the status, since there is no room for both beside the panels.</summary>
    public bool MessageReplacesStatus { get; set; }

    /// <summary>A line for frames that are coarser than the settings ask for; null for all others.</summary>
    private OverlayLine? BudgetNotice
    {
        get
        {
            if (_report is not { Culling: { } culling, Renderer.MinProjectedSize: var minProjectedSize }
                || minProjectedSize <= culling.MinProjectedSize)
            {
                return null;
            }

            var text = Invariant(
                $"more than {culling.InstanceBudget:N0} instances: sub-fractals below {minProjectedSize:F1} pixels are drawn as proxies");
            return new(text, null, OverlayTone.Accent);
        }
    }

    /// <summary>Describes the file that is shown from now on.</summary>
    /// <param name="file">The loaded file.</param>
    /// <param name="drawable">Its prepared scene, whose notices are shown too.</param>
    public void DescribeFile(LoadedFile file, DrawableScene drawable)
    {
        _report = null;
        PhysicsStatus = null;
        _fileText = $"{Path.GetFileName(file.Path)} · {FaceCountText.Of(file.Scene)} · ";
        _description = new(
            OverlayAnchor.BottomLeft, [.. drawable.Notices.Select(static notice => new OverlayLine(notice, null, OverlayTone.Accent))]);
    }

    /// <summary>Replaces the statistics by those of the last frame.</summary>
    public void SetReport(FrameReport report)
    {
        _report = report;
        _frameTimes.Enqueue(report.DrawTime.TotalMilliseconds);
        if (_frameTimes.Count > MaxFrameTimes)
        {
            _frameTimes.Dequeue();
        }
    }

    /// <summary>Shows a message for a few seconds.</summary>
    /// <param name="message">A line for the user, or several.</param>
    /// <param name="now">The present time.</param>
    public void ShowMessage(string message, TimeSpan now)
    {
        _message = OverlayPanel.OfText(OverlayAnchor.Bottom, message.Split('\n'));
        NextExpiry = now + MessageDuration;
    }

    /// <summary>Shows an error for some time, over a scene that stays, and writes it to stderr.</summary>
    public void ShowProblem(string error, TimeSpan now)
    {
        Console.Error.WriteLine(error);
        _message = OfError(OverlayAnchor.Bottom, error);
        NextExpiry = now + ProblemDuration;
    }

    /// <summary>Shows a message for a few seconds, and writes it to stderr.</summary>
    /// <inheritdoc cref="ShowMessage"/>
    public void Report(string message, TimeSpan now)
    {
        Console.Error.WriteLine(message);
        ShowMessage(message, now);
    }

    private static OverlayPanel OfError(OverlayAnchor anchor, string error) =>
        new(anchor, [.. error.Split('\n').Select(static line => new OverlayLine(line, null, OverlayTone.Warning))]);

    /// <summary>Removes the message if its time is over.</summary>
    /// <returns>True when a message was removed.</returns>
    public bool Expire(TimeSpan now)
    {
        if (NextExpiry is not { } expiry || now < expiry)
        {
            return false;
        }

        _message = null;
        NextExpiry = null;
        return true;
    }
}
