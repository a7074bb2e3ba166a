using System.Globalization;
using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Render.Ui.Input;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;
using FractalEngine.Render.Ui.Widgets;
using FractalEngine.Render.Windowing.Events;

namespace FractalEngine.Render.Ui;

/// <summary>
/// A user interface in immediate mode, after the model of microui: a method adds all widgets each time something happens, and what they
/// look like becomes one list of rectangles and glyphs. It needs no window; events are passed to it.
/// </summary>
/// <remarks>
/// Widgets are known by their labels, within the panel or <see cref="Scope"/> that they stand in. The interface takes only input over
/// its own panels, and keys only for the widget that has the keyboard.
/// </remarks>
public sealed class UserInterface
{
    // Builds after an event until nothing changes any more: a widget may act on what stands before it.
    private const int MaxBuilds = 4;

    private readonly Action<UserInterface> _build;
    private readonly UiInput _input = new();
    private readonly UiPainter _painter = new();
    private readonly UiAreas _areas;
    private readonly UiLayout _layout;
    private readonly UiFocus _focus;
    private readonly UiTargets _targets;
    private readonly UiTooltip _tooltip;
    private readonly UiWidgets _widgets;
    private readonly UiTextField _textField;
    private readonly UiSlider _slider;
    private readonly UiMarks _marks;
    private readonly UiMenus _menus;
    private readonly UiPanelBody _panelBody;
    private readonly UiPanels _panels;
    private readonly UiDialogs _dialogs;
    private readonly UiEvents _events;

    /// <summary>Makes an interface that is empty until it is built.</summary>
    /// <param name="build">Adds all widgets.</param>
    /// <param name="readClipboard">Returns the text of the clipboard; null for none.</param>
    /// <param name="writeClipboard">Replaces the text of the clipboard; null for none.</param>
    public UserInterface(Action<UserInterface> build, Func<string>? readClipboard = null, Action<string>? writeClipboard = null)
    {
        ArgumentNullException.ThrowIfNull(build);
        _build = build;
        _areas = new(_painter);
        _layout = new(_painter);
        _focus = new(_input);
        _targets = new(_input, _painter, _focus);
        _tooltip = new(_input, _painter, _targets, _areas);
        _widgets = new(_input, _painter, _layout, _targets, _tooltip);
        _textField = new(_input, _painter, _layout, _targets, _focus, readClipboard, writeClipboard);
        _slider = new(_input, _painter, _layout, _targets, _focus, _tooltip, _textField, text => ReadNumber(text));
        _marks = new(_input, _painter, _targets);
        _menus = new(_input, _painter, _layout, _targets, _focus, _areas);
        _panelBody = new(_input, _painter, _layout, _targets, _focus);
        _panels = new(_input, _painter, _targets, _areas, _widgets, _panelBody);
        _dialogs = new(_input, _painter, _layout, _targets, _focus, _menus, _widgets, _panelBody);
        _events = new(_input, _targets, _focus, _menus, _dialogs, Rebuild);
    }

    /// <summary>Reads the finite number that was typed on a slider; null for a text that is none, which then changes nothing.</summary>
    public Func<string, double?> ReadNumber { get; set; } = static text =>
        double.TryParse(text.Trim(), NumberStyles.Float, CultureInfo.InvariantCulture, out var value) && double.IsFinite(value)
            ? value : null;

    /// <summary>Colours of all widgets.</summary>
    public UiTheme Theme { get => _painter.Theme; set => _painter.Theme = value; }

    /// <summary>Size of text and widgets: 1 for a text of 13 pixels.</summary>
    public double Scale { get => _painter.Scale; set => _painter.Scale = value; }

    /// <summary>Width of the frame in pixels.</summary>
    public int Width => _painter.Bounds.Width;

    /// <summary>Height of the frame in pixels.</summary>
    public int Height => _painter.Bounds.Height;

    /// <summary>Changes whenever the interface looks different, so that it must be presented again.</summary>
    public int Version { get; private set; }

    /// <summary>Changes with each press, key and typed text: all changes within one drag have the same number.</summary>
    public int Interaction => _events.Interaction;

    /// <summary>The part of the frame that no menu bar and no docked panel covers.</summary>
    public UiRect FreeArea => _areas.Free;

    /// <summary>
    /// What <see cref="FreeArea"/> is once all panels are added, for what is added before them so that it stays behind.
    /// </summary>
    public UiRect SceneArea => _areas.Scene;

    /// <summary>
    /// The part of the frame in whose middle a scene is seen: between the columns of panels that are not folded, or all of it where these
    /// leave too little.
    /// </summary>
    public UiRect ViewArea => _areas.View;

    /// <summary>The part of the frame for texts over it: the free one where that is wide enough, else all below the menu bar.</summary>
    internal UiRect OverlayArea => _areas.Overlay;

    /// <summary>True while a widget has the keyboard.</summary>
    public bool HasFocus => _focus.Widget != 0;

    /// <summary>True while a menu or a dialog is open.</summary>
    public bool IsModal => _dialogs.IsModal;

    /// <summary>Whether a widget is being explained, in front of all texts.</summary>
    internal bool HasTooltip => _tooltip.IsShown;

    /// <summary>Rectangles and glyphs in drawing order.</summary>
    internal List<OverlayQuad> Quads { get; private set; } = [];

    /// <summary>Sheet that the glyphs are taken from.</summary>
    internal GlyphSheet Sheet => _painter.Sheet;

    /// <summary>Returns the scale for a frame: 1 up to 1280 × 720 pixels, growing half as fast as the frame beyond.</summary>
    public static double ScaleFor(int width, int height) => Math.Max(1, 0.5 + (0.5 * Math.Min(width / 1280.0, height / 720.0)));

    /// <summary>Builds the interface anew, since what it shows may have changed.</summary>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    public void Update(int width, int height)
    {
        _painter.Bounds = new(0, 0, width, height);
        Rebuild();
    }

    /// <summary>Processes an event of the window.</summary>
    /// <returns>True when the event belongs to the interface, and the scene must not see it.</returns>
    public bool Handle(WindowEvent windowEvent) => _events.Handle(windowEvent);

    /// <summary>Adds widgets whose labels are known only within this scope.</summary>
    /// <param name="name">Name or number of the scope.</param>
    /// <param name="build">Adds the widgets.</param>
    public void Scope(object name, Action build) => _targets.Scope(name, build);

    /// <summary>Divides the next row. Further rows are divided likewise, until the next call.</summary>
    /// <param name="widths">Width of each column: its number of characters, or its share of what is left where it is 1 or less.</param>
    public void Row(params ReadOnlySpan<double> widths) => _layout.Row(widths);

    /// <summary>Adds as many rows as a list has entries, of which only those in view are built.</summary>
    /// <param name="count">Number of entries, each of one row.</param>
    /// <param name="build">Adds the row of an entry, by its index from 0.</param>
    public void Rows(int count, Action<int> build)
    {
        ArgumentNullException.ThrowIfNull(build);
        _layout.Rows(count, i => Scope(i, () => build(i)));
    }

    /// <summary>Adds a text. What does not fit is shown while the pointer is over it.</summary>
    public void Label(string text, bool isDim = false) => _widgets.Label(text, isDim ? Theme.DimText : Theme.Text);

    /// <summary>Adds a text at the right edge of its place, as numbers stand.</summary>
    public void Value(string text) => _widgets.Label(text, Theme.Text, align: 1);

    /// <summary>Adds the heading of what follows, in as many lines as it needs.</summary>
    public void Heading(string text) => _widgets.Heading(text);

    /// <summary>Adds a text in as many lines as its place needs.</summary>
    /// <param name="text">Words that are wrapped at blanks.</param>
    /// <param name="isWarning">True for a text that the user should notice.</param>
    /// <param name="isDim">True for a text of less importance.</param>
    public void Paragraph(string text, bool isWarning = false, bool isDim = false) =>
        _widgets.Paragraph(text, isWarning ? Theme.Warning : isDim ? Theme.DimText : Theme.Text);

    /// <summary>Adds a button that can be pressed.</summary>
    /// <param name="label">Text and identity of the button.</param>
    /// <param name="isEnabled">False for a button that can't be pressed now.</param>
    /// <returns>True when the button was pressed.</returns>
    public bool Button(string label, bool isEnabled = true) => _widgets.Button(label, isEnabled);

    /// <summary>Adds a check box with its label.</summary>
    /// <param name="label">Text and identity of the box.</param>
    /// <param name="isChecked">Whether the box is checked so far.</param>
    /// <returns>True when the box was switched.</returns>
    public bool CheckBox(string label, bool isChecked) => _widgets.CheckBox(label, isChecked);

    /// <summary>Adds a row of a list.</summary>
    /// <param name="label">Text and identity of the row.</param>
    /// <param name="isSelected">Whether the row is the selected one.</param>
    /// <param name="depth">Depth in a tree, from 0.</param>
    /// <returns>True when the row was clicked.</returns>
    public bool Selectable(string label, bool isSelected, int depth = 0) => _widgets.Selectable(label, isSelected, depth);

    /// <summary>Adds a branch of a tree, which opens and closes.</summary>
    /// <returns>True while the branch is open, and what is below it should be added.</returns>
    public bool Branch(string label, ref bool isOpen) => _widgets.Branch(label, ref isOpen);

    /// <summary>Adds a bar that shows how far something is.</summary>
    /// <param name="fraction">Completed fraction, from 0 to 1.</param>
    /// <param name="label">Text over the bar.</param>
    public void Progress(double fraction, string label) => _widgets.Progress(fraction, label);

    /// <summary>Adds a graph of columns, the last value at the right edge.</summary>
    /// <param name="values">Values from the oldest to the latest.</param>
    /// <param name="maximum">Value of a column as high as the graph.</param>
    /// <param name="rows">Height of the graph in rows.</param>
    public void Graph(IReadOnlyCollection<double> values, double maximum, int rows = 3) => _widgets.Graph(values, maximum, rows);

    /// <summary>Adds a field of one colour.</summary>
    public void Swatch(Colour colour) => _widgets.Swatch(colour);

    /// <summary>Adds a line of text that the user edits.</summary>
    /// <param name="label">Identity of the field; shown dim while the field is empty.</param>
    /// <param name="text">The text, which is changed with each character.</param>
    /// <param name="takesKeyboard">True to give the field the keyboard.</param>
    /// <returns>True when the text was changed.</returns>
    public bool TextField(string label, ref string text, bool takesKeyboard = false) => TextField(label, ref text, out _, takesKeyboard);

    /// <summary>Adds a line of text that the user edits.</summary>
    /// <param name="label">Identity of the field; shown dim while the field is empty.</param>
    /// <param name="text">The text, which is changed with each character.</param>
    /// <param name="isCommitted">True when Enter was pressed, or the keyboard has left the field.</param>
    /// <param name="takesKeyboard">True to give the field the keyboard.</param>
    /// <returns>True when the text was changed.</returns>
    public bool TextField(string label, ref string text, out bool isCommitted, bool takesKeyboard = false) =>
        _textField.Add(label, ref text, out isCommitted, takesKeyboard);

    /// <summary>
    /// Adds a number that is set by dragging, by the keys Left and Right, or typed: a click or Enter begins to type.
    /// </summary>
    /// <param name="label">Text before the slider, and its identity.</param>
    /// <param name="value">The number, which is changed.</param>
    /// <param name="minimum">The number at the left end.</param>
    /// <param name="maximum">The number at the right end.</param>
    /// <param name="step">Dragging gives multiples of this; 0 for a thousandth of the range.</param>
    /// <param name="isBounded">
    /// Whether typed numbers must lie between the ends, too. Other sliders keep the ends that they began with while the number lies
    /// within, so that their filled part does not jump where the ends follow the number.
    /// </param>
    /// <returns>True when the number was changed.</returns>
    public bool Slider(string label, ref double value, double minimum, double maximum, double step = 0, bool isBounded = true) =>
        _slider.Add(label, ref value, minimum, maximum, step, isBounded);

    /// <summary>Explains the last widget while the pointer is over it.</summary>
    public void Tooltip(string text) => _tooltip.Explain(text);

    /// <summary>Writes a text at a point of the frame, behind all panels. It takes no input.</summary>
    /// <param name="text">A few words or a number.</param>
    /// <param name="x">Pixels from the left edge of the frame to the middle of the text.</param>
    /// <param name="y">Pixels from the upper edge of the frame to the middle of the text.</param>
    public void Mark(string text, double x, double y) => _marks.AddText(text, x, y);

    /// <summary>Adds a round button anywhere in the frame, before what was added earlier.</summary>
    /// <param name="label">One or two characters, and the identity of the button.</param>
    /// <param name="x">Pixels from the left edge of the frame to the middle.</param>
    /// <param name="y">Pixels from the upper edge of the frame to the middle.</param>
    /// <param name="colour">Ground of the button; dark, since the text is light.</param>
    /// <returns>True when the button was pressed.</returns>
    public bool Knob(string label, double x, double y, Colour colour) => _marks.AddKnob(label, label, x, y, colour).IsActivated;

    /// <summary>Adds a round handle anywhere in the frame, which is dragged.</summary>
    /// <param name="label">One or two characters.</param>
    /// <param name="name">Identity of the handle.</param>
    /// <param name="x">Pixels from the left edge of the frame to the middle.</param>
    /// <param name="y">Pixels from the upper edge of the frame to the middle.</param>
    /// <param name="colour">Ground of the handle; dark, since the text is light.</param>
    /// <remarks>The handle keeps the pointer until the button is released, wherever it is added meanwhile.</remarks>
    public UiHandle Handle(string label, string name, double x, double y, Colour colour) => _marks.AddHandle(label, name, x, y, colour);

    /// <summary>Adds the menu bar at the upper edge of the frame.</summary>
    /// <param name="build">Adds the menus.</param>
    /// <param name="note">Text at the right end of the bar.</param>
    public void MenuBar(Action build, string note = "") => _menus.AddBar(build, note);

    /// <summary>Adds a menu to the menu bar.</summary>
    /// <param name="title">Title in the bar.</param>
    /// <param name="build">Adds the items while the menu is open.</param>
    /// <param name="columns">Width of an item in characters.</param>
    /// <param name="items">Number of items: what is too high for the frame has several columns.</param>
    public void Menu(string title, Action build, int columns, int items = 1) => _menus.Add(title, build, columns, items);

    /// <summary>Adds an item to the menu that is being built.</summary>
    /// <param name="label">Text and identity of the item.</param>
    /// <param name="key">Keys that have the same effect, at the right edge.</param>
    /// <param name="isOn">True to mark the item as switched on.</param>
    /// <param name="isEnabled">False for an item that can't be chosen now.</param>
    /// <returns>True when the item was chosen. The menu closes then.</returns>
    public bool MenuItem(string label, string key = "", bool isOn = false, bool isEnabled = true) =>
        _menus.AddItem(label, key, isOn, isEnabled);

    /// <summary>Opens a dialog, which <see cref="Dialog"/> adds from now on. It takes all input until it is closed.</summary>
    public void OpenDialog(string title) => _dialogs.Open(title);

    /// <summary>Closes the open dialog, if there is one.</summary>
    public void CloseDialog() => _dialogs.Close();

    /// <summary>Adds a dialog in the middle of the frame, if it is the open one.</summary>
    /// <param name="title">Title by which it was opened.</param>
    /// <param name="head">Adds the widgets above the list; they never scroll.</param>
    /// <param name="panel">The list below, which scrolls.</param>
    /// <returns>True while the dialog is open.</returns>
    public bool Dialog(string title, Action head, UiPanel panel) => _dialogs.Add(this, title, head, panel);

    /// <summary>Adds panels: the docked ones in columns that share the height of the frame, the floating ones in front.</summary>
    /// <param name="panels">Panels in their order within a column; closed ones are left out.</param>
    /// <param name="bottomMargin">Rows of text that stay free at the lower edge of the frame.</param>
    public void Panels(ImmutableArray<UiPanel> panels, int bottomMargin = 0) => _panels.Add(this, panels, bottomMargin);

    /// <summary>Scrolls the panel that is being built until the next rows are in view.</summary>
    /// <param name="rows">Number of rows, of which the first counts most.</param>
    public void ScrollHere(int rows) => _panelBody.ScrollHere(rows);

    private void Rebuild()
    {
        for (var i = 0; i == 0 || (_input.BuildsAgain && i < MaxBuilds); i++)
        {
            _input.BuildsAgain = false;
            _painter.Clear();
            _areas.Begin();
            _focus.Begin();
            _targets.Begin(_dialogs.Opened is not null);
            _tooltip.Begin();
            _menus.Begin();
            _dialogs.Begin();
            _build(this);
            _dialogs.Finish();
            _targets.Finish();
            _focus.Finish();
            _menus.Finish();
            _input.BuildsAgain |= _areas.Finish();
            _tooltip.Paint(IsModal);
            _input.ClearEvents();
        }

        var quads = _painter.ToQuads();
        var bytes = MemoryMarshal.AsBytes(CollectionsMarshal.AsSpan(quads));
        if (!bytes.SequenceEqual(MemoryMarshal.AsBytes(CollectionsMarshal.AsSpan(Quads))))
        {
            Quads = quads;
            Version++;
        }
    }
}
