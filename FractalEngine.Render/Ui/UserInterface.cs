using System.Runtime.InteropServices;
using FractalEngine.Render.Ui.Overlays;
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
public sealed partial class UserInterface
{
    // Builds after an event until nothing changes any more: a widget may act on what stands before it.
    private const int MaxBuilds = 4;

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
    private UiRect _viewArea;
    private string? _tooltip;

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

    /// <summary>
    /// The part of the frame in whose middle a scene is seen: between the columns of panels that are not folded, or all of it where these
    /// leave too little.
    /// </summary>
    public UiRect ViewArea { get; private set; }

    /// <summary>The part of the frame for texts over it: the free one where that is wide enough, else all below the menu bar.</summary>
    internal UiRect OverlayArea => HasRoomIn(FreeArea) || FreeArea.Height <= 0 ? FreeArea : new(0, FreeArea.Y, _width, FreeArea.Height);

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
        _viewArea = _clip;
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

        ViewArea = HasRoomIn(_viewArea) ? _viewArea : new(0, 0, _width, _height);
        if (SceneArea != FreeArea)
        {
            SceneArea = FreeArea;
            _buildsAgain = true;
        }

        FinishArrows();
        DrawTooltip();
        _roots.Clear();
        _roots.AddRange(_nextRoots);
    }

    private bool HasRoomIn(UiRect area) => area.Width >= 0.4 * _width;

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
}
