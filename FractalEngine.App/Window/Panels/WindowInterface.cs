using System.Collections.Immutable;
using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.Tools;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Ui;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window.Panels;

/// <summary>The menu bar, the panels and the list of keys of a window.</summary>
internal sealed class WindowInterface
{
    private const double ScaleStep = 1.25;

    // Below this width at scale 1, two columns of panels leave no room for texts between them, which stand below them then.
    private const double MinWidthForTexts = 1000;

    // The widest texts about bodies, and the knobs of the axes.
    private const double MinWidthForPhysics = 620;

    private readonly WindowActions _actions;
    private readonly Action<string> _report;
    private readonly string? _settingsPath;
    private readonly ImmutableArray<(string Name, UiPanel Panel)> _panels;
    private readonly Queue<WindowAction> _chosen = [];
    private readonly KeyList _keyList;
    private readonly AxisGizmo _gizmo;
    private readonly TransformHandles _handles;
    private readonly SectionHandle _sectionHandle;
    private WindowSettings _settings;
    private int _width;
    private int _height;

    /// <summary>Makes the interface of a window, with what it remembers of the last one.</summary>
    /// <param name="actions">Runs what is chosen in menus.</param>
    /// <param name="window">The window with the clipboard.</param>
    /// <param name="settingsPath">Full path of the settings; null to remember nothing.</param>
    /// <param name="report">Shows a message.</param>
    public WindowInterface(WindowActions actions, RenderWindow window, string? settingsPath, Action<string> report)
    {
        _actions = actions;
        _report = report;
        _settingsPath = settingsPath;
        _settings = WindowSettings.Read(settingsPath, report);
        Bindings = new(_settings.Keys);
        _keyList = new(Bindings, Choose);
        _gizmo = new(actions);
        _handles = new(actions);
        _sectionHandle = new(actions);
        _panels =
        [
            ("scene", new("Scene", new ScenePanel(actions).Build) { Dock = UiDock.Left }),
            ("fractal", new("Fractal", new FractalPanel(actions).Build) { Dock = UiDock.Left }),
            ("view", new("View", new ViewPanel(actions, Choose).Build) { Dock = UiDock.Right }),
            ("selection", new("Selection", new SelectionPanel(actions, Choose).Build) { Dock = UiDock.Right }),
            ("physics", new("Physics", new PhysicsPanel(actions, Choose).Build) { Dock = UiDock.Right }),
            ("statistics", new("Statistics", new StatisticsPanel(actions).Build) { Dock = UiDock.Right }),
        ];
        foreach (var (name, panel) in _panels)
        {
            _settings.Panels.GetValueOrDefault(name)?.ApplyTo(panel);
        }

        Ui = new(Build, () => window.ClipboardText, text => window.ClipboardText = text);
    }

    /// <summary>The widgets as they were built last.</summary>
    public UserInterface Ui { get; }

    /// <summary>The keys that the settings have changed.</summary>
    public KeyBindings Bindings { get; }

    /// <summary>Builds the widgets anew, since what they show may have changed.</summary>
    public void Update(int width, int height)
    {
        (_width, _height) = (width, height);
        Ui.Scale = _settings.Scale ?? UserInterface.ScaleFor(width, height);
        Ui.Theme = _settings.IsLight ? UiTheme.Light : UiTheme.Dark;
        Ui.Update(width, height);
    }

    /// <summary>Passes an event to the widgets.</summary>
    /// <returns>True when the scene must not see it.</returns>
    public bool Handle(WindowEvent windowEvent) => Ui.Handle(windowEvent);

    /// <summary>Ends what the pointer is doing to widgets, such as to point at one, since something lies before them.</summary>
    public void ReleasePointer()
    {
        Ui.Handle(new FocusLost());
        Ui.Handle(new MouseMoved(-1, -1, 0, 0));
    }

    /// <summary>Returns the next action that was chosen in a menu or a panel; null for none.</summary>
    public WindowAction? TakeChosen() => _chosen.TryDequeue(out var action) ? action : null;

    /// <summary>Tells whether a panel is shown.</summary>
    public bool IsOpen(string name) => PanelOf(name).IsOpen;

    /// <summary>Opens a panel that is closed, and closes one that is open; its place is remembered.</summary>
    public void Toggle(string name)
    {
        var panel = PanelOf(name);
        panel.IsOpen = !panel.IsOpen;
    }

    /// <summary>Opens a panel, and unfolds it.</summary>
    public void Open(string name)
    {
        var panel = PanelOf(name);
        (panel.IsOpen, panel.IsFolded) = (true, false);
    }

    /// <summary>Whether the menu bar and the panels are shown.</summary>
    public bool IsShown => _settings.ShowsMenu;

    /// <summary>Whether there is room for texts between the panels.</summary>
    public bool HasRoomForTexts => Ui.FreeArea.Width >= 0.4 * _width;

    /// <summary>Whether there is room for the texts about bodies beside the knobs of the axes.</summary>
    public bool HasRoomForPhysics => !IsOpen("physics") && SceneWidth >= MinWidthForPhysics;

    /// <summary>Shows or hides the menu bar and all panels.</summary>
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

    /// <summary>Shows the list of keys with its search.</summary>
    public void OpenKeys()
    {
        _keyList.Clear();
        Ui.OpenDialog(KeyList.Title);
        // At once, since the next key may already be a search.
        Update(_width, _height);
    }

    /// <summary>Writes the settings if they have changed.</summary>
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

    private WindowSettings? _saved;

    // Pixels at scale 1.
    private double SceneWidth => Ui.SceneArea.Width / Ui.Scale;

    private UiPanel PanelOf(string name) => _panels.First(pair => pair.Name == name).Panel;

    private void Choose(WindowAction action) => _chosen.Enqueue(action);

    private void Build(UserInterface ui)
    {
        if (IsShown)
        {
            MarkDimensions(ui);
            // Behind all panels.
            _gizmo.Build(ui);
            _sectionHandle.Build(ui);
            _handles.Build(ui);
            ui.MenuBar(() => BuildMenus(ui));
            ui.Panels([.. _panels.Select(static pair => pair.Panel)], ui.FreeArea.Width < MinWidthForTexts * ui.Scale ? 2 : 0);
        }

        _keyList.Build(ui);
    }

    /// <summary>Writes the measured lengths beside their lines.</summary>
    private void MarkDimensions(UserInterface ui)
    {
        if (_actions.Document is not { LatestView: { } view } document)
        {
            return;
        }

        foreach (var dimension in document.Tool.Measure.Dimensions)
        {
            var middle = 0.5 * (dimension.From + dimension.To);
            var frame = document.VisibleDepth > 0 ? view with { Camera = view.Camera with { Position = Vector.Zero } } : view;
            if (document.MapToDrawnFrame(dimension.Viewpoint) is { } map
                && frame.Project(map(middle), _width, _height) is var (x, y, _))
            {
                ui.Mark(dimension.LengthText, x, y);
            }
        }
    }

    private void BuildMenus(UserInterface ui)
    {
        foreach (var menu in ActionTable.Menus)
        {
            var actions = ActionTable.All.Where(action => action.Menu == menu && action.IsCommand).ToArray();
            var columns = actions.Max(action => action.Name.Length + Bindings.TextOf(action).Length);
            ui.Menu(menu, () => BuildItems(ui, actions), columns, actions.Length);
        }
    }

    private void BuildItems(UserInterface ui, WindowAction[] actions)
    {
        foreach (var action in actions)
        {
            if (ui.MenuItem(action.Name, Bindings.TextOf(action), action.IsOn?.Invoke(_actions) == true, action.IsAvailable(_actions)))
            {
                Choose(action);
            }

            ui.Tooltip(action.PlainHelp);
        }
    }
}
