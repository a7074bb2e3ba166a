using FractalEngine.Render.Ui.Input;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;

namespace FractalEngine.Render.Ui.Widgets;

/// <summary>The menu bar, and its menu that is open.</summary>
internal sealed class UiMenus(UiInput input, UiPainter painter, UiLayout layout, UiTargets targets, UiFocus focus, UiAreas areas)
{
    private readonly List<string> _titles = [];
    private readonly Dictionary<string, int> _heights = [];
    private bool _focusesItem;
    private int _x;
    private int _step;

    /// <summary>Title of the open menu; null for none.</summary>
    public string? Opened { get; private set; }

    /// <summary>Title of the first menu; null without menus.</summary>
    public string? First => _titles.FirstOrDefault();

    private UiTheme Theme => painter.Theme;

    private UiRect Bar => painter.Bounds with { Height = painter.RowHeight };

    public void Begin() => _titles.Clear();

    /// <summary>Opens a menu, whose first item gets the keyboard; null closes the open one.</summary>
    public void Open(string? title)
    {
        focus.Commit();
        focus.Clear();
        Opened = title;
        _focusesItem = title is not null;
    }

    public void AddBar(Action build, string note)
    {
        areas.TakeTop(Bar.Height);
        BeginBar();
        painter.Fill(Bar, Theme.Title);
        _x = painter.Padding;
        build();
        var left = Bar with { X = _x, Width = Math.Max(0, Bar.Width - _x - painter.Padding) };
        if (note.Length * painter.CellWidth <= left.Width)
        {
            painter.Print(note, left, Theme.DimText, align: 1);
        }
    }

    public void Add(string title, Action build, int columns, int items)
    {
        var rect = Bar with { X = _x, Width = (title.Length + 2) * painter.CellWidth };
        _x = rect.Right;
        _titles.Add(title);
        // In an open menu the arrows move along the items.
        var touch = targets.Touch(title, rect, takesFocus: Opened is null && focus.Widget != 0);
        if (touch.IsPressed || (touch.IsActivated && !input.IsReleased))
        {
            Open(Opened == title ? null : title);
        }
        else if (Opened is not null && Opened != title && touch.IsHot)
        {
            Open(title);
        }

        var isOpen = Opened == title;
        if (isOpen || touch.IsHot)
        {
            painter.Fill(rect, isOpen ? Theme.Selection : Theme.HotControl);
        }

        painter.Print(title, rect, Theme.Text, align: 0.5);
        painter.FrameFocus(rect, touch.HasFocus);
        if (isOpen)
        {
            targets.Scope($"menu {title}", () => AddOpen(title, rect, columns, items, build));
            BeginBar();
        }
    }

    public bool AddItem(string label, string key, bool isOn, bool isEnabled)
    {
        var rect = layout.Next();
        var touch = isEnabled ? targets.Touch(label, rect, isRow: true) : default;
        targets.Hover(rect);
        if (_focusesItem && isEnabled)
        {
            _focusesItem = false;
            focus.Take(targets.IdOf(label));
        }

        if (touch.IsHot || touch.HasFocus)
        {
            painter.Fill(rect, Theme.Selection, 2);
        }

        var colour = isEnabled ? Theme.Text : Theme.DimText;
        var indent = 2 * painter.CellWidth;
        painter.Print(isOn ? "✓" : "", rect with { X = rect.X + painter.Gap, Width = indent }, colour);
        painter.Print(label, rect with { X = rect.X + indent, Width = rect.Width - indent }, colour);
        // In a narrow frame, the key gives way to the label.
        if ((label.Length + key.Length + 3) * painter.CellWidth <= rect.Width - painter.Gap)
        {
            painter.Print(key, rect with { Width = rect.Width - painter.Gap }, colour, align: 1);
        }

        if (touch.IsActivated)
        {
            Open(null);
        }

        return touch.IsActivated;
    }

    /// <summary>Opens the next menu, if a key has asked for it while the menus were added.</summary>
    public void Finish()
    {
        if (_step != 0 && Opened is not null)
        {
            Open(_titles[(_titles.IndexOf(Opened) + _step + _titles.Count) % _titles.Count]);
        }

        _step = 0;
    }

    private void BeginBar() => targets.BeginRoot("menu bar", Bar, layer: 0);

    private void AddOpen(string title, UiRect place, int columns, int items, Action build)
    {
        var gap = painter.Gap;
        var frame = painter.Bounds;
        var rows = Math.Max(1, (frame.Height - place.Bottom - (3 * gap)) / painter.RowPitch);
        var columnCount = (Math.Max(1, items) + rows - 1) / rows;
        var width = Math.Min((columnCount * (columns + 4) * painter.CellWidth) + (2 * gap), frame.Width);
        var x = Math.Max(0, Math.Min(place.X, frame.Width - width));
        var height = _heights.GetValueOrDefault(title);
        var bounds = new UiRect(x, place.Bottom, width, height + (2 * gap));
        targets.BeginRoot("menu", bounds, layer: 1);
        painter.Fill(bounds, Theme.Panel);
        _heights[title] = layout.Build(bounds.Inset(gap), 0, build, [.. Enumerable.Repeat(1.0, columnCount)]);
        input.BuildsAgain |= _heights[title] != height;
        painter.Frame(bounds, Theme.Border);
        _step = input.TakeDirection();
    }
}
