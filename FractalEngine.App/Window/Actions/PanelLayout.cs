using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Ui;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Windowing;
using FractalEngine.Render.Windowing.Events;

namespace FractalEngine.App.Window.Actions;

/// <summary>Which panels of a window are shown, and how: what is remembered from one window to the next.</summary>
internal sealed class PanelLayout
{
    /// <summary>Names the dialog of the keys, at its head and in <see cref="UserInterface.OpenDialog"/>.</summary>
    public const string KeysTitle = "Keys";

    private const double ScaleStep = 1.25;

    // The widest texts about bodies, and the knobs of the axes, in pixels at scale 1.
    private const double MinWidthForPhysics = 620;

    private readonly List<(string Name, UiPanel Panel)> _panels = [];
    private readonly RenderWindow _window;
    private readonly string? _settingsPath;
    private readonly Action<string> _report;
    private WindowSettings _settings;
    private WindowSettings? _saved;

    /// <summary>Makes the layout of a window, with what it remembers of the last one.</summary>
    /// <param name="window">The window, with the clipboard and the size of texts.</param>
    /// <param name="settingsPath">Full path of the settings; null to remember nothing.</param>
    /// <param name="report">Shows a message.</param>
    /// <param name="build">Adds all widgets.</param>
    public PanelLayout(RenderWindow window, string? settingsPath, Action<string> report, Action<UserInterface> build)
    {
        _window = window;
        _settingsPath = settingsPath;
        _report = report;
        _settings = WindowSettings.Read(settingsPath, report);
        Bindings = new(_settings.Keys);
        Ui = new(build, () => window.ClipboardText, text => window.ClipboardText = text) { ReadNumber = ReadNumber };
    }

    /// <summary>Reads a number that was typed, or tells why it is none.</summary>
    private double? ReadNumber(string text)
    {
        try
        {
            return NumberExpression.Compute(text);
        }
        catch (SourceException exception)
        {
            _report($"'{text}' is no number: {exception.Diagnostic.Message}");
            return null;
        }
    }

    /// <summary>The widgets as they were built last.</summary>
    public UserInterface Ui { get; }

    public KeyBindings Bindings { get; }

    /// <summary>All panels, in the order in which they were added.</summary>
    public IEnumerable<UiPanel> All => _panels.Select(static pair => pair.Panel);

    /// <summary>True from the command that shows the list of keys until the list is built.</summary>
    public bool IsKeyListNew { get; set; }

    /// <summary>Adds a panel, as it was in the last window.</summary>
    /// <param name="name">Name in the settings file.</param>
    /// <param name="panel">The panel as it is at first.</param>
    public void Add(string name, UiPanel panel)
    {
        _settings.Panels.GetValueOrDefault(name)?.ApplyTo(panel);
        _panels.Add((name, panel));
    }

    /// <summary>Builds the widgets anew, since what they show may have changed.</summary>
    public void Update(int width, int height)
    {
        Ui.Scale = _settings.Scale ?? Math.Max(_window.ContentScale, UserInterface.ScaleFor(width, height));
        Ui.Theme = _settings.IsLight ? UiTheme.Light : UiTheme.Dark;
        Ui.Update(width, height);
    }

    /// <summary>Ends what the pointer is doing to widgets, such as to point at one, since something lies before them.</summary>
    public void ReleasePointer()
    {
        Ui.Handle(new FocusLost());
        Ui.Handle(new MouseMoved(-1, -1, 0, 0));
    }

    public bool IsOpen(string name) => PanelOf(name).IsOpen;

    /// <summary>Opens a panel that is closed, and closes one that is open; its place is remembered.</summary>
    public void Toggle(string name)
    {
        var panel = PanelOf(name);
        panel.IsOpen = !panel.IsOpen;
    }

    public void Open(string name)
    {
        var panel = PanelOf(name);
        (panel.IsOpen, panel.IsFolded) = (true, false);
    }

    public bool IsShown => _settings.ShowsMenu;

    public bool HasRoomForTexts => Ui.FreeArea.Width >= 0.4 * Ui.Width;

    /// <summary>Whether there is room for the texts about bodies beside the knobs of the axes.</summary>
    public bool HasRoomForPhysics => !IsOpen("physics") && Ui.SceneArea.Width / Ui.Scale >= MinWidthForPhysics;

    public void ToggleAll() => _settings = _settings with { ShowsMenu = !_settings.ShowsMenu };

    /// <summary>Whether text is dark on light ground.</summary>
    public bool IsLight => _settings.IsLight;

    /// <summary>Switches between light and dark colours.</summary>
    public void ToggleTheme() => _settings = _settings with { IsLight = !_settings.IsLight };

    /// <summary>Whether views that stand still are traced, as the user has chosen last.</summary>
    public bool IsTraced
    {
        get => _settings.IsTraced;
        set => _settings = _settings with { IsTraced = value };
    }

    /// <summary>Makes the text larger or smaller by a step.</summary>
    public string ChangeScale(int steps)
    {
        _settings = _settings with { Scale = Math.Clamp(Math.Round(Ui.Scale * Math.Pow(ScaleStep, steps), 2), 0.8, 3) };
        return FormattableString.Invariant($"size of the text: {100 * _settings.Scale:F0} %");
    }

    public void OpenKeys()
    {
        IsKeyListNew = true;
        Ui.OpenDialog(KeysTitle);
        // At once, since the next key may already be a search.
        Update(Ui.Width, Ui.Height);
    }

    public void SaveSettings()
    {
        var panels = _settings.Panels.SetItems(
            _panels.Select(static pair => KeyValuePair.Create(pair.Name, WindowSettings.PanelState.Of(pair.Panel))));
        var present = _settings with { Panels = panels };
        if (present.ToText() != _settings.ToText() || !ReferenceEquals(_settings, _saved))
        {
            var isFirst = _saved is null && present.ToText() == _settings.ToText();
            _settings = present;
            _saved = present;
            if (!isFirst)
            {
                present.Write(_settingsPath, _report);
            }
        }
    }

    private UiPanel PanelOf(string name) => _panels.First(pair => pair.Name == name).Panel;
}
