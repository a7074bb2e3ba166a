using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.State;
using FractalEngine.App.Window.Widgets;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Panels;

/// <summary>Builds the menu bar, the panels and the list of keys of a window.</summary>
internal sealed class WindowInterface
{
    // Below this width at scale 1, two columns of panels leave no room for texts between them, which stand below them then.
    private const double MinWidthForTexts = 1000;

    private readonly WindowActions _actions;
    private readonly PanelLayout _panels;
    private readonly KeyList _keyList;
    private readonly AxisGizmo _gizmo;
    private readonly TransformHandles _handles;
    private readonly SectionHandle _sectionHandle;

    /// <summary>Adds the panels to the layout of a window.</summary>
    /// <param name="actions">Runs what is chosen in menus.</param>
    public WindowInterface(WindowActions actions)
    {
        _actions = actions;
        _panels = actions.Panels;
        _keyList = new(actions);
        _gizmo = new(actions);
        _handles = new(actions);
        _sectionHandle = new(actions);
        _panels.Add("scene", new("Scene", OfDocument(new ScenePanel(actions).Build)) { Dock = UiDock.Left });
        _panels.Add("fractal", new("Fractal", new FractalPanel(actions).Build) { Dock = UiDock.Left });
        _panels.Add("view", new("View", new ViewPanel(actions).Build) { Dock = UiDock.Right });
        _panels.Add("selection", new("Selection", OfDocument(new SelectionPanel(actions).Build)) { Dock = UiDock.Right });
        _panels.Add("physics", new("Physics", OfDocument(new PhysicsPanel(actions).Build)) { Dock = UiDock.Right });
        _panels.Add("statistics", new("Statistics", new StatisticsPanel(actions).Build) { Dock = UiDock.Right });
    }

    /// <summary>Adds the menu bar, panels and handles while they are shown, and the list of keys.</summary>
    public void Build(UserInterface ui)
    {
        if (_panels.IsShown)
        {
            MarkDimensions(ui);
            // Behind all panels.
            _gizmo.Build(ui);
            _sectionHandle.Build(ui);
            _handles.Build(ui);
            ui.MenuBar(() => BuildMenus(ui));
        }

        // Also where all others are hidden.
        var running = _actions.Jobs.Select((job, index) => job.PanelIn(ui, index)).OfType<UiPanel>();
        ui.Panels([.. _panels.IsShown ? _panels.All : [], .. running], ui.FreeArea.Width < MinWidthForTexts * ui.Scale ? 2 : 0);

        _keyList.Build(ui);
    }

    private Action<UserInterface> OfDocument(Action<UserInterface, Document> build) => ui =>
    {
        if (_actions.Document is { } document)
        {
            build(ui, document);
            return;
        }

        ui.Label("no scene", isDim: true);
    };

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
                && frame.Project(map(middle), ui.Width, ui.Height) is var (x, y, _))
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
            var columns = actions.Max(action => action.Name.Length + _panels.Bindings.TextOf(action).Length);
            ui.Menu(menu, () => BuildItems(ui, actions), columns, actions.Length);
        }
    }

    private void BuildItems(UserInterface ui, WindowAction[] actions)
    {
        foreach (var action in actions)
        {
            var isOn = action.IsOn?.Invoke(_actions) == true;
            if (ui.MenuItem(action.Name, _panels.Bindings.TextOf(action), isOn, action.IsAvailable(_actions)))
            {
                _actions.Choose(action);
            }

            ui.Tooltip(action.PlainHelp);
        }
    }
}
