using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui.Input;

/// <summary>Which widget has the keyboard, whether one types into it, and how keys move on to another.</summary>
internal sealed class UiFocus(UiInput input)
{
    private readonly List<int> _widgets = [];
    private int _scrollTo;
    private bool _movesDown;

    /// <summary>The widget that has the keyboard; 0 for none.</summary>
    public int Widget { get; private set; }

    /// <summary>The field whose text is edited; 0 for none. It has the keyboard.</summary>
    public int Edited { get; private set; }

    /// <summary>The field whose text was edited, and which takes it over when it is built next.</summary>
    public int Committed { get; set; }

    /// <summary>Whether text belongs to the key before it, which has just given the keyboard to the field.</summary>
    public bool IgnoresText { get; set; }

    /// <summary>The rows that a panel is scrolled to; null to leave it.</summary>
    public UiRect? Revealed { get; set; }

    /// <summary>Whether there is a widget that takes the keyboard.</summary>
    public bool HasWidgets => _widgets.Count > 0;

    public bool IsEditing(int id) => Edited == id || Committed == id;

    public void Begin() => _widgets.Clear();

    /// <summary>Adds a widget that takes the keyboard, and to whose place its panel scrolls then, if it has one.</summary>
    public void Add(int id, UiRect? rect = null)
    {
        _widgets.Add(id);
        if (rect is { } place && _scrollTo == id)
        {
            Reveal(place);
        }
    }

    public void Reveal(UiRect rect)
    {
        _scrollTo = 0;
        Revealed = rect;
    }

    /// <summary>Gives the keyboard to a widget.</summary>
    public void Take(int id)
    {
        if (Widget != id)
        {
            Widget = id;
            Edited = 0;
            IgnoresText = !input.IsPressed;
            input.BuildsAgain = true;
        }
    }

    /// <summary>Begins to edit the text of a field.</summary>
    public void Edit(int id)
    {
        Commit();
        Take(id);
        Edited = id;
    }

    /// <summary>Ends editing, so that the field takes its text over when it is built next.</summary>
    public void Commit()
    {
        if (Edited != 0)
        {
            Committed = Edited;
            Edited = 0;
            input.BuildsAgain = true;
        }
    }

    /// <summary>Gives the keyboard back to the scene. What is being edited is lost, unless it was committed.</summary>
    public void Clear()
    {
        Widget = 0;
        Edited = 0;
        input.BuildsAgain = true;
    }

    /// <summary>Lets the keys Up and Down move the keyboard to the row before or after.</summary>
    public void MoveByArrows()
    {
        if (input.TakeKey(Key.Up))
        {
            Take(_widgets[Math.Max(0, _widgets.IndexOf(Widget) - 1)]);
        }

        _movesDown |= input.TakeKey(Key.Down);
    }

    /// <summary>Moves the keyboard on by Tab and Down once all widgets are added, and takes it from a widget that is gone.</summary>
    public void Finish()
    {
        if (HasWidgets && input.TakeKey(Key.Tab))
        {
            Commit();
            var index = _widgets.IndexOf(Widget);
            MoveTo(input.IsShiftHeld ? (index <= 0 ? _widgets.Count - 1 : index - 1) : (index + 1) % _widgets.Count);
        }

        if (!_widgets.Contains(Widget))
        {
            Widget = 0;
            Edited = 0;
        }

        if (_movesDown)
        {
            MoveTo(Math.Min(_widgets.IndexOf(Widget) + 1, _widgets.Count - 1));
        }

        _movesDown = false;
    }

    private void MoveTo(int index)
    {
        Take(_widgets[index]);
        _scrollTo = Widget;
    }
}
