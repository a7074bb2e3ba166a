using System.Collections.Immutable;
using System.Globalization;
using System.Text;
using FractalEngine.App.Window.Files;
using FractalEngine.Render.Ui;
using static System.FormattableString;

namespace FractalEngine.App.Window.Actions;

/// <summary>What the window remembers from one run to the next: panels, colours, size of text and changed keys.</summary>
/// <remarks>
/// One setting a line: <c>theme light</c>, <c>scale 1.5</c>, <c>menu hidden</c>, <c>still drawn</c>,
/// <c>panel scene open folded floating 20 60</c>, <c>key grid Ctrl+G</c>.
/// </remarks>
internal sealed record WindowSettings
{
    /// <summary>Whether text is dark on light ground.</summary>
    public bool IsLight { get; init; }

    /// <summary>Size of the text; null to follow the size of the frame.</summary>
    public double? Scale { get; init; }

    /// <summary>Whether views that stand still are traced.</summary>
    public bool IsTraced { get; init; } = true;

    public bool ShowsMenu { get; init; } = true;

    public ImmutableSortedDictionary<string, PanelState> Panels { get; init; } = ImmutableSortedDictionary<string, PanelState>.Empty;

    /// <summary>Keys that differ from the table of actions, by the ids of the actions.</summary>
    public ImmutableDictionary<string, KeyChord> Keys { get; init; } = ImmutableDictionary<string, KeyChord>.Empty;

    /// <summary>Full path of the settings of this user; null where the system has no settings folder.</summary>
    public static string? DefaultPath => UserFile.PathOf("window.txt");

    /// <summary>Reads settings. A broken file counts as missing, with one message.</summary>
    /// <param name="path">Full path of the file; null for the defaults.</param>
    /// <param name="report">Shows a message about a file that can't be used.</param>
    public static WindowSettings Read(string? path, Action<string> report) =>
        UserFile.Read(path, new WindowSettings(), Parse, "the settings are", report);

    /// <summary>Reads settings from a text.</summary>
    /// <exception cref="InvalidDataException">A line is no setting; the message names it.</exception>
    public static WindowSettings Parse(string text)
    {
        var settings = new WindowSettings();
        foreach (var (index, line) in text.Split('\n').Index())
        {
            var words = line.Split(' ', StringSplitOptions.RemoveEmptyEntries | StringSplitOptions.TrimEntries);
            if (words.Length > 0 && !words[0].StartsWith('#'))
            {
                settings = settings.With(words) ?? throw new InvalidDataException($"line {index + 1} is no setting: {line.Trim()}");
            }
        }

        return settings;
    }

    /// <summary>Writes settings, and says so where that fails.</summary>
    /// <param name="path">Full path of the file; null to keep nothing.</param>
    /// <param name="report">Shows a message about a file that can't be written.</param>
    public void Write(string? path, Action<string> report) => UserFile.Write(path, ToText(), "the settings", report);

    public string ToText()
    {
        var text = new StringBuilder("# Settings of the window. Lines `key ID KEYS` change keys; the manual lists the actions.\n");
        text.Append(IsLight ? "theme light\n" : "theme dark\n");
        text.Append(CultureInfo.InvariantCulture, $"scale {(Scale is { } scale ? scale : "auto")}\n");
        text.Append(ShowsMenu ? "menu shown\n" : "menu hidden\n");
        text.Append(IsTraced ? "still traced\n" : "still drawn\n");
        foreach (var (name, panel) in Panels)
        {
            text.Append(CultureInfo.InvariantCulture, $"panel {name} {panel}\n");
        }

        foreach (var (id, chord) in Keys.OrderBy(static pair => pair.Key, StringComparer.Ordinal))
        {
            text.Append(CultureInfo.InvariantCulture, $"key {id} {chord.ToString().Replace(' ', '_')}\n");
        }

        return text.ToString();
    }

    private WindowSettings? With(string[] words) => words switch
    {
        ["theme", "light" or "dark"] => this with { IsLight = words[1] == "light" },
        ["menu", "shown" or "hidden"] => this with { ShowsMenu = words[1] == "shown" },
        ["still", "traced" or "drawn"] => this with { IsTraced = words[1] == "traced" },
        ["scale", "auto"] => this with { Scale = null },
        ["scale", var number] => double.TryParse(number, NumberStyles.Float, CultureInfo.InvariantCulture, out var scale)
            && scale is >= 0.5 and <= 4 ? this with { Scale = scale } : null,
        ["panel", var name, .. var rest] => PanelState.Parse(rest) is { } panel ? this with { Panels = Panels.SetItem(name, panel) } : null,
        ["key", var id, var chord] => KeyChord.TryParse(chord.Replace('_', ' '), out var keys)
            && ActionTable.All.Any(action => action.Id == id) ? this with { Keys = Keys.SetItem(id, keys) } : null,
        _ => null,
    };

    /// <summary>The state of a panel that is remembered.</summary>
    /// <param name="IsOpen">Whether it is shown.</param>
    /// <param name="IsFolded">Whether only its title is shown.</param>
    /// <param name="Dock">Where it stands.</param>
    /// <param name="X">Left edge of a floating panel.</param>
    /// <param name="Y">Top edge of a floating panel.</param>
    internal sealed record PanelState(bool IsOpen, bool IsFolded, UiDock Dock, double X, double Y)
    {
        public static PanelState Of(UiPanel panel) =>
            new(panel.IsOpen, panel.IsFolded, panel.Dock, Math.Round(panel.X), Math.Round(panel.Y));

        /// <summary>Reads the words of a line; null if they are none.</summary>
        public static PanelState? Parse(ReadOnlySpan<string> words)
        {
            return words.Length == 5 && words[0] is "open" or "closed" && words[1] is "folded" or "unfolded"
                && Enum.TryParse<UiDock>(words[2], ignoreCase: true, out var dock) && Enum.IsDefined(dock)
                && double.TryParse(words[3], NumberStyles.Float, CultureInfo.InvariantCulture, out var x) && double.IsFinite(x)
                && double.TryParse(words[4], NumberStyles.Float, CultureInfo.InvariantCulture, out var y) && double.IsFinite(y)
                ? new(words[0] == "open", words[1] == "folded", dock, x, y)
                : null;
        }

        public void ApplyTo(UiPanel panel)
        {
            panel.IsOpen = IsOpen;
            panel.IsFolded = IsFolded;
            panel.Dock = Dock;
            panel.X = X;
            panel.Y = Y;
        }

        public override string ToString() => Invariant(
            $"{(IsOpen ? "open" : "closed")} {(IsFolded ? "folded" : "unfolded")} {Dock.ToString().ToLowerInvariant()} {X} {Y}");
    }
}
