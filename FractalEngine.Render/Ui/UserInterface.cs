using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Render.Ui;

/// <summary>
/// A user interface in immediate mode, after the model of microui: a method adds all widgets each time something happens, and what they
/// look like becomes one list of rectangles and glyphs. It needs no window; events are passed to it.
/// </summary>
/// <remarks>
/// Widgets are known by their labels, within the panel or <see cref="Scope"/> that they stand in. The interface takes only input over
/// its own panels, and keys only for the widget that has the keyboard.
/// </remarks>
public sealed partial class UserInterface
{
    // Builds after an event until nothing changes any more: a widget may act on what stands before it.
    private const int MaxBuilds = 4;

    // Characters in a line of a tooltip: beside a panel at least, and at most.
    private const int MinTooltipColumns = 24;
    private const int MaxTooltipColumns = 60;

    // Half a pixel: the shader smooths edges across one, which whole pixels need not.
    private const float SquareCorner = 0.5f;

    private readonly Action<UserInterface> _build;
    private readonly Func<string> _readClipboard;
    private readonly Action<string> _writeClipboard;
    private readonly UiInput _input = new();
    private readonly UiTextEdit _edit = new();
    private readonly List<OverlayQuad>[] _layers = [[], [], []];
    private readonly List<(UiRect Bounds, int Root, int Layer)> _roots = [];
    private readonly List<(UiRect Bounds, int Root, int Layer)> _nextRoots = [];
    private readonly List<int> _focusable = [];
    private readonly Stack<int> _scopes = [];
    private int _width;
    private int _height;
    private int _layer;
    private int _root;
    private int _hoverRoot;
    private int _active;
    private int _focus;
    private int _scrollTo;
    private int _keyCount;
    private int _focusKey = -1;
    private double _pressX;
    private bool _isSceneDrag;
    private bool _buildsAgain;
    private bool _isKeyTaken;
    private UiRect _clip;
    private string? _tooltip;

    // The panel, menu or knob of the widget that it explains.
    private UiRect _tooltipOwner;

    /// <summary>Makes an interface that is empty until it is built.</summary>
    /// <param name="build">Adds all widgets.</param>
    /// <param name="readClipboard">Returns the text of the clipboard; null for none.</param>
    /// <param name="writeClipboard">Replaces the text of the clipboard; null for none.</param>
    public UserInterface(Action<UserInterface> build, Func<string>? readClipboard = null, Action<string>? writeClipboard = null)
    {
        ArgumentNullException.ThrowIfNull(build);
        _build = build;
        _readClipboard = readClipboard ?? (static () => "");
        _writeClipboard = writeClipboard ?? (static _ => { });
        Scale = 1;
    }

    /// <summary>Colours of all widgets.</summary>
    public UiTheme Theme { get; set; } = UiTheme.Dark;

    /// <summary>Size of text and widgets: 1 for a text of 13 pixels.</summary>
    public double Scale
    {
        get;
        set
        {
            field = Math.Clamp(value, 0.5, 4);
            Sheet = GlyphAtlas.Shared.Sheets.MinBy(sheet => Math.Abs(sheet.CellHeight - (16 * field)))!;
        }
    }

    /// <summary>Width of the frame in pixels.</summary>
    public int Width => _width;

    /// <summary>Height of the frame in pixels.</summary>
    public int Height => _height;

    /// <summary>Changes whenever the interface looks different, so that it must be presented again.</summary>
    public int Version { get; private set; }

    /// <summary>Changes with each press, key and typed text: all changes within one drag have the same number.</summary>
    public int Interaction { get; private set; }

    /// <summary>The part of the frame that no menu bar and no docked panel covers.</summary>
    public UiRect FreeArea { get; private set; }

    /// <summary>
    /// What <see cref="FreeArea"/> is once all panels are added, for what is added before them so that it stays behind.
    /// </summary>
    public UiRect SceneArea { get; private set; }

    /// <summary>The part of the frame for texts over it: the free one where that is wide enough, else all below the menu bar.</summary>
    internal UiRect OverlayArea => FreeArea.Width >= 0.4 * _width || FreeArea.Height <= 0
        ? FreeArea
        : new(0, FreeArea.Y, _width, FreeArea.Height);

    /// <summary>True while a widget has the keyboard.</summary>
    public bool HasFocus => _focus != 0;

    /// <summary>True while a menu or a dialog is open.</summary>
    public bool IsModal => _openMenu is not null || _dialog is not null;

    /// <summary>Rectangles and glyphs in drawing order.</summary>
    internal List<OverlayQuad> Quads { get; private set; } = [];

    /// <summary>Sheet that the glyphs are taken from.</summary>
    internal GlyphSheet Sheet { get; private set; } = GlyphAtlas.Shared.Sheets[0];

    private int CellWidth => Sheet.CellWidth;

    private int LineHeight => Sheet.CellHeight;

    /// <summary>Height of a row of widgets, without the gap below.</summary>
    private int RowHeight => LineHeight + (2 * Gap);

    private int Gap => Math.Max(1, LineHeight / 8);

    private int Padding => Math.Max(3, CellWidth * 3 / 4);

    /// <summary>Returns the scale for a frame: 1 up to 1280 × 720 pixels, growing half as fast as the frame beyond.</summary>
    public static double ScaleFor(int width, int height) => Math.Max(1, 0.5 + (0.5 * Math.Min(width / 1280.0, height / 720.0)));

    /// <summary>Builds the interface anew, since what it shows may have changed.</summary>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    public void Update(int width, int height)
    {
        _width = width;
        _height = height;
        Rebuild();
    }

    /// <summary>Processes an event of the window.</summary>
    /// <returns>True when the event belongs to the interface, and the scene must not see it.</returns>
    public bool Handle(WindowEvent windowEvent)
    {
        switch (windowEvent)
        {
            case MouseMoved moved:
                return HandleMove(moved);
            case MousePressed pressed:
                return HandlePress(pressed);
            case MouseReleased released:
                return HandleRelease(released);
            case WheelTurned wheel:
                if (!IsOver(_input.X, _input.Y))
                {
                    return false;
                }

                _input.Wheel = wheel.Notches;
                Rebuild();
                return true;
            case KeyPressed pressed:
                return HandleKey(pressed);
            case KeyReleased released:
                _input.Modifiers = released.Modifiers;
                return false;
            case TextEntered entered:
                return HandleText(entered);
            case FocusLost:
                _isSceneDrag = false;
                _input.IsDown = false;
                _active = 0;
                return false;
            default:
                return false;
        }
    }

    /// <summary>Gives the keyboard back to the scene.</summary>
    public void ClearFocus()
    {
        _focus = 0;
        _buildsAgain = true;
    }

    /// <summary>Adds widgets whose labels are known only within this scope.</summary>
    /// <param name="name">Name or number of the scope.</param>
    /// <param name="build">Adds the widgets.</param>
    public void Scope(object name, Action build)
    {
        ArgumentNullException.ThrowIfNull(build);
        _scopes.Push(IdOf(FormattableString.Invariant($"{name}")));
        build();
        _scopes.Pop();
    }

    private bool HandleMove(MouseMoved moved)
    {
        var wasOver = IsOver(_input.X, _input.Y);
        _input.X = moved.X;
        _input.Y = moved.Y;
        if (_isSceneDrag)
        {
            return false;
        }

        var isOver = IsOver(moved.X, moved.Y);
        if (isOver || wasOver || _active != 0)
        {
            Rebuild();
        }

        return isOver || _active != 0;
    }

    private bool HandlePress(MousePressed pressed)
    {
        _input.X = pressed.X;
        _input.Y = pressed.Y;
        _input.Modifiers = pressed.Modifiers;
        var isOver = IsOver(pressed.X, pressed.Y);
        Interaction++;
        if (!isOver)
        {
            var closesMenu = _openMenu is not null;
            _openMenu = null;
            var lookedDifferent = closesMenu || _focus != 0;
            CommitEdit();
            _focus = 0;
            _isSceneDrag = !closesMenu && _dialog is null;
            if (lookedDifferent)
            {
                Rebuild();
            }

            return !_isSceneDrag;
        }

        if (pressed.Button == MouseButton.Left)
        {
            _input.IsPressed = true;
            _input.IsDown = true;
            _pressX = pressed.X;
            Rebuild();
        }

        return true;
    }

    private bool HandleRelease(MouseReleased released)
    {
        _input.X = released.X;
        _input.Y = released.Y;
        if (_isSceneDrag)
        {
            _isSceneDrag = false;
            return false;
        }

        if (released.Button == MouseButton.Left && _input.IsDown)
        {
            _input.IsReleased = true;
            _input.IsDown = false;
            Rebuild();
            return true;
        }

        return IsOver(released.X, released.Y);
    }

    private bool HandleKey(KeyPressed pressed)
    {
        _keyCount++;
        _input.Modifiers = pressed.Modifiers;
        // A key that is pressed in the middle of a drag belongs to it.
        Interaction += _active == 0 ? 1 : 0;
        var startsMenu = pressed.Key == Key.F10 && _menuTitles.Count > 0;
        if (_focus == 0 && !IsModal && !startsMenu && !(pressed.Key == Key.Tab && _focusable.Count > 0))
        {
            return false;
        }

        if (startsMenu)
        {
            OpenMenu(_openMenu is null ? _menuTitles[0] : null);
            Rebuild();
            return true;
        }

        _input.Key = pressed.Key;
        _isKeyTaken = false;
        Rebuild();
        // Screenshots are taken of dialogs, too.
        return _isKeyTaken || (_dialog is not null && pressed.Key is not (>= Key.F1 and <= Key.F12));
    }

    private bool HandleText(TextEntered entered)
    {
        if (_editing == 0)
        {
            return IsModal;
        }

        // The text of a key follows the key. It does not belong to a field that the key has just entered.
        if (_focusKey != _keyCount)
        {
            Interaction++;
            _input.Text = entered.Text;
            Rebuild();
        }

        return true;
    }

    private bool IsOver(double x, double y) => _dialog is not null || RootAt(x, y) != 0;

    private int RootAt(double x, double y)
    {
        var best = 0;
        var bestLayer = _dialog is not null ? 2 : 0;
        foreach (var (bounds, root, layer) in _roots)
        {
            if (layer >= bestLayer && bounds.Contains(x, y))
            {
                best = root;
                bestLayer = layer;
            }
        }

        return best;
    }

    private void Rebuild()
    {
        for (var i = 0; i < MaxBuilds; i++)
        {
            _buildsAgain = false;
            BuildOnce();
            _input.ClearEvents();
            if (!_buildsAgain)
            {
                break;
            }
        }

        var quads = _layers.SelectMany(static layer => layer).ToList();
        var bytes = MemoryMarshal.AsBytes(CollectionsMarshal.AsSpan(quads));
        if (!bytes.SequenceEqual(MemoryMarshal.AsBytes(CollectionsMarshal.AsSpan(Quads))))
        {
            Quads = quads;
            Version++;
        }
    }

    private void BuildOnce()
    {
        _nextRoots.Clear();
        _focusable.Clear();
        _menuTitles.Clear();
        Array.ForEach(_layers, static layer => layer.Clear());
        _clip = new(0, 0, _width, _height);
        _tooltip = null;
        _hoverRoot = _isSceneDrag ? 0 : RootAt(_input.X, _input.Y);
        FreeArea = _clip;
        var wasDialog = _dialog;
        _isDialogBuilt = false;
        _build(this);
        if (!_isDialogBuilt && wasDialog is not null)
        {
            _dialog = null;
            _focus = 0;
            _buildsAgain = true;
        }

        HandleRemainingKeys();
        if (_input.IsReleased || !_input.IsDown)
        {
            _active = 0;
        }

        if (_focus != 0 && !_focusable.Contains(_focus))
        {
            _focus = 0;
            _editing = 0;
        }

        if (SceneArea != FreeArea)
        {
            SceneArea = FreeArea;
            _buildsAgain = true;
        }

        DrawTooltip();
        _roots.Clear();
        _roots.AddRange(_nextRoots);
    }

    /// <summary>Moves the keyboard on, closes menus, and gives the keyboard back to the scene.</summary>
    private void HandleRemainingKeys()
    {
        if (_input.Key == Key.Tab && _focusable.Count > 0)
        {
            CommitEdit();
            var index = _focusable.IndexOf(_focus);
            var next = _input.IsShiftHeld ? (index <= 0 ? _focusable.Count - 1 : index - 1) : (index + 1) % _focusable.Count;
            TakeFocus(_focusable[next]);
            _scrollTo = _focus;
            _isKeyTaken = true;
        }
        else if (_input.Key == Key.Escape && (_focus != 0 || _openMenu is not null || _dialog is not null))
        {
            if (_openMenu is null)
            {
                _dialog = null;
            }

            _openMenu = null;
            _editing = 0;
            _focus = 0;
            _isKeyTaken = true;
            _buildsAgain = true;
        }
    }

    private void TakeFocus(int id)
    {
        if (_focus != id)
        {
            _focus = id;
            _editing = 0;
            _focusKey = _input.IsPressed ? -1 : _keyCount;
            _buildsAgain = true;
        }
    }

    private int IdOf(string label)
    {
        // FNV-1a over the scope and the label; 0 means no widget.
        var hash = (uint)(_scopes.TryPeek(out var scope) ? scope : 17);
        foreach (var character in label)
        {
            hash = (hash ^ character) * 16777619;
        }

        return hash == 0 ? 1 : (int)hash;
    }

    private static (float, float, float, float) Tint(Colour colour, float opacity = 1) =>
        ((float)colour.Red, (float)colour.Green, (float)colour.Blue, opacity);

    private void Fill(UiRect rect, Colour colour, float radius = SquareCorner, float opacity = 1)
    {
        var visible = rect.Intersect(_clip);
        if (visible is { Width: > 0, Height: > 0 })
        {
            _layers[_layer].Add(new(
                visible.X, visible.Y, visible.Width, visible.Height, Tint(colour, opacity), -1,
                visible == rect ? radius : SquareCorner));
        }
    }

    private void Frame(UiRect rect, Colour colour)
    {
        var line = Math.Max(1, LineHeight / 16);
        Fill(new(rect.X, rect.Y, rect.Width, line), colour);
        Fill(new(rect.X, rect.Bottom - line, rect.Width, line), colour);
        Fill(new(rect.X, rect.Y, line, rect.Height), colour);
        Fill(new(rect.Right - line, rect.Y, line, rect.Height), colour);
    }

    /// <summary>Draws text into a rectangle, in its vertical middle. What does not fit ends in an ellipsis.</summary>
    /// <returns>False when the text did not fit.</returns>
    private bool Print(string text, UiRect rect, Colour colour, UiAlign align = UiAlign.Left)
    {
        var columns = rect.Width / CellWidth;
        var fits = text.Length <= columns;
        if (!fits)
        {
            text = columns <= 0 ? "" : text[..(columns - 1)] + "…";
        }

        var free = rect.Width - (text.Length * CellWidth);
        var x = rect.X + (align == UiAlign.Left ? 0 : align == UiAlign.Right ? free : free / 2);
        var y = rect.Y + ((rect.Height - LineHeight) / 2);
        if (y < _clip.Y || y + LineHeight > _clip.Bottom)
        {
            return fits;
        }

        var tint = Tint(colour);
        for (var i = 0; i < text.Length; i++)
        {
            var left = x + (i * CellWidth);
            if (text[i] != ' ' && left >= _clip.X && left + CellWidth <= _clip.Right)
            {
                _layers[_layer].Add(new(left, y, CellWidth, LineHeight, tint, GlyphAtlas.Shared.GlyphOf(text[i]), 0));
            }
        }

        return fits;
    }
}
