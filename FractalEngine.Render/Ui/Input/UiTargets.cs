using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui.Input;

/// <summary>
/// What the pointer can hit: widgets, known by their labels, within roots, which are panels, menus, dialogs and knobs. Of several roots
/// at a point it hits the one in front.
/// </summary>
internal sealed class UiTargets(UiInput input, UiPainter painter, UiFocus focus)
{
    private readonly List<(UiRect Bounds, int Id, int Layer)> _roots = [];
    private readonly Stack<int> _scopes = [];
    private int _root;
    private int _hoveredRoot;

    /// <summary>The widget that holds the pointer since the button went down on it; 0 for none.</summary>
    public int Holder { get; set; }

    /// <summary>Whether the button went down in the scene, which has the pointer until the button is released.</summary>
    public bool IsSceneDrag { get; set; }

    /// <summary>Whether the pointer is over the widget that was added last.</summary>
    public bool IsHot { get; private set; }

    public bool IsOverRoot => RootAt(0) != 0;

    /// <summary>Whether the pointer hits the root that is being built.</summary>
    public bool IsRootHot => _hoveredRoot == _root;

    /// <summary>Place of the root that is being built.</summary>
    public UiRect RootBounds => _roots.Find(root => root.Id == _root).Bounds;

    /// <summary>Finds the root under the pointer, as the roots were built last: of a dialog only that.</summary>
    public void Begin(bool isDialog)
    {
        _hoveredRoot = IsSceneDrag ? 0 : RootAt(isDialog ? 2 : 0);
        _roots.Clear();
    }

    public void Finish()
    {
        if (input.IsReleased || !input.IsDown)
        {
            Holder = 0;
        }
    }

    /// <summary>Begins a root, to which all widgets belong from now on, in front of those of lower layers.</summary>
    public void BeginRoot(string label, UiRect bounds, int layer)
    {
        _root = IdOf(label);
        painter.Begin(layer);
        _roots.Add((bounds, _root, layer));
    }

    public void Scope(object name, Action build)
    {
        _scopes.Push(IdOf(FormattableString.Invariant($"{name}")));
        build();
        _scopes.Pop();
    }

    /// <summary>Returns the number of a widget; never 0.</summary>
    public int IdOf(string label)
    {
        // FNV-1a over the scope and the label; 0 means no widget.
        var hash = (uint)(_scopes.TryPeek(out var scope) ? scope : 17);
        foreach (var character in label)
        {
            hash = (hash ^ character) * 16777619;
        }

        return hash == 0 ? 1 : (int)hash;
    }

    /// <summary>Tells whether the pointer is over the widget that is being added, and remembers it for its tooltip.</summary>
    public bool Hover(UiRect rect) => IsHot = IsRootHot && (!input.IsDown || Holder == 0) && IsOver(rect);

    /// <summary>Tells what mouse and keyboard do to a widget.</summary>
    /// <param name="label">Identity of the widget.</param>
    /// <param name="rect">Place of the widget.</param>
    /// <param name="takesFocus">Whether it can have the keyboard.</param>
    /// <param name="isRow">Whether the keys Up and Down move the keyboard to the rows before and after.</param>
    public UiTouch Touch(string label, UiRect rect, bool takesFocus = true, bool isRow = false)
    {
        var id = IdOf(label);
        if (takesFocus)
        {
            focus.Add(id, rect);
        }

        var isHot = Hover(rect);
        var isPressed = isHot && input.IsPressed && Holder == 0;
        if (isPressed)
        {
            Holder = id;
            focus.Commit();
            if (takesFocus)
            {
                focus.Take(id);
            }
        }

        var hasFocus = takesFocus && focus.Widget == id;
        var isActivated = Holder == id && input.IsReleased && IsOver(rect);
        isActivated |= hasFocus && input.TakeKey(Key.Enter, Key.KeypadEnter, Key.Space);
        input.BuildsAgain |= isActivated;
        if (isRow && hasFocus)
        {
            focus.MoveByArrows();
        }

        return new(hasFocus, isHot || Holder == id, isPressed, Holder == id && input.IsDown, isActivated);
    }

    private bool IsOver(UiRect rect) => rect.Intersect(painter.Clip).Contains(input.X, input.Y);

    private int RootAt(int minLayer) => _roots
        .Where(root => root.Layer >= minLayer && root.Bounds.Contains(input.X, input.Y))
        .OrderBy(static root => root.Layer).LastOrDefault().Id;
}
