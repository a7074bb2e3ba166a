using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui;

/// <content>The menu bar, dialogs and tooltips.</content>
public sealed partial class UserInterface
{
    private const int DialogColumns = 76;

    private readonly List<string> _menuTitles = [];
    private readonly Dictionary<string, int> _dialogHeights = [];
    private string? _openMenu;
    private string? _dialog;
    private bool _isDialogBuilt;
    private int _menuX;
    private int _focusNext;
    private int _menuStep;

    /// <summary>Adds the menu bar at the upper edge of the frame.</summary>
    /// <param name="build">Adds the menus.</param>
    /// <param name="note">Text at the right end of the bar.</param>
    public void MenuBar(Action build, string note = "")
    {
        ArgumentNullException.ThrowIfNull(build);
        ArgumentNullException.ThrowIfNull(note);
        var bar = new UiRect(0, 0, _width, RowHeight);
        FreeArea = FreeArea with { Y = bar.Bottom, Height = Math.Max(0, FreeArea.Height - bar.Height) };
        BeginRoot(IdOf("menu bar"), bar, layer: 0);
        Fill(bar, Theme.Title);
        _menuX = Padding;
        build();
        var left = bar with { X = _menuX, Width = Math.Max(0, bar.Width - _menuX - Padding) };
        if (note.Length * CellWidth <= left.Width)
        {
            Print(note, left, Theme.DimText, UiAlign.Right);
        }
    }

    /// <summary>Adds a menu to the menu bar.</summary>
    /// <param name="title">Title in the bar.</param>
    /// <param name="build">Adds the items while the menu is open.</param>
    /// <param name="columns">Width of an item in characters.</param>
    /// <param name="items">Number of items: what is too high for the frame has several columns.</param>
    public void Menu(string title, Action build, int columns, int items = 1)
    {
        ArgumentNullException.ThrowIfNull(title);
        ArgumentNullException.ThrowIfNull(build);
        var root = _root;
        var rect = new UiRect(_menuX, 0, (title.Length + 2) * CellWidth, RowHeight);
        _menuX = rect.Right;
        _menuTitles.Add(title);
        var isOpen = _openMenu == title;
        // In an open menu the arrows move along the items.
        var touch = Touch(IdOf(title), rect, takesFocus: !isOpen && _openMenu is null && HasFocus);
        if (touch.IsPressed || (touch.IsActivated && !_input.IsReleased))
        {
            OpenMenu(isOpen ? null : title);
        }
        else if (_openMenu is not null && !isOpen && touch.IsHot)
        {
            OpenMenu(title);
        }

        isOpen = _openMenu == title;
        if (isOpen || touch.IsHot)
        {
            Fill(rect, isOpen ? Theme.Selection : Theme.HotControl);
        }

        Print(title, rect, Theme.Text, UiAlign.Middle);
        DrawFocus(touch, rect);
        if (isOpen)
        {
            Scope($"menu {title}", () => AddMenu(rect, columns, items, build));
            _root = root;
            _layer = 0;
            _clip = new(0, 0, _width, _height);
        }
    }

    /// <summary>Adds an item to the menu that is being built.</summary>
    /// <param name="label">Text and identity of the item.</param>
    /// <param name="key">Keys that have the same effect, at the right edge.</param>
    /// <param name="isOn">True to mark the item as switched on.</param>
    /// <param name="isEnabled">False for an item that can't be chosen now.</param>
    /// <returns>True when the item was chosen. The menu closes then.</returns>
    public bool MenuItem(string label, string key = "", bool isOn = false, bool isEnabled = true)
    {
        ArgumentNullException.ThrowIfNull(label);
        ArgumentNullException.ThrowIfNull(key);
        var rect = Next();
        var touch = isEnabled ? Touch(IdOf(label), rect, takesFocus: true) : default;
        _isLastHot = IsHot(rect);
        if (isEnabled && (touch.IsHot || _focus == touch.Id))
        {
            Fill(rect, Theme.Selection, 2);
        }

        var colour = isEnabled ? Theme.Text : Theme.DimText;
        Print(isOn ? "✓" : "", rect with { X = rect.X + Gap, Width = 2 * CellWidth }, colour);
        Print(label, rect with { X = rect.X + (2 * CellWidth), Width = rect.Width - (2 * CellWidth) }, colour);
        Print(key, rect with { Width = rect.Width - Gap }, Theme.DimText == colour ? colour : Theme.Text, UiAlign.Right);
        if (isEnabled)
        {
            MoveFocusByArrows(touch);
        }

        if (touch.IsActivated)
        {
            _openMenu = null;
            _focus = 0;
            _buildsAgain = true;
        }

        return touch.IsActivated;
    }

    /// <summary>Opens a dialog, which <see cref="Dialog"/> adds from now on. It takes all input until it is closed.</summary>
    public void OpenDialog(string title)
    {
        _dialog = title;
        _openMenu = null;
        CommitEdit();
        _focus = 0;
        _focusKey = _keyCount;
        _buildsAgain = true;
    }

    /// <summary>Closes the open dialog, if there is one.</summary>
    public void CloseDialog()
    {
        _dialog = null;
        _editing = 0;
        _focus = 0;
        _buildsAgain = true;
    }

    /// <summary>Adds a dialog in the middle of the frame, if it is the open one.</summary>
    /// <param name="title">Title by which it was opened.</param>
    /// <param name="head">Adds the widgets above the list; they never scroll.</param>
    /// <param name="panel">The list below, which scrolls.</param>
    /// <returns>True while the dialog is open.</returns>
    public bool Dialog(string title, Action head, UiPanel panel)
    {
        ArgumentNullException.ThrowIfNull(head);
        ArgumentNullException.ThrowIfNull(panel);
        if (_dialog != title)
        {
            return false;
        }

        _isDialogBuilt = true;
        var width = Math.Min((DialogColumns * CellWidth) + (2 * Padding), _width - (2 * Gap));
        var headHeight = _dialogHeights.GetValueOrDefault(title);
        var height = Math.Min(TitleHeight + headHeight + panel.ContentHeight + (4 * Padding), _height - (2 * RowHeight));
        var bounds = new UiRect((_width - width) / 2, Math.Max(0, (_height - height) / 2), width, height);
        Scope(title, () =>
        {
            BeginRoot(IdOf("dialog"), new(0, 0, _width, _height), layer: 2);
            Fill(bounds, Theme.Panel);
            var bar = bounds with { Height = TitleHeight };
            Fill(bar, Theme.Title);
            Print(title, bar.Inset(Padding) with { Y = bar.Y, Height = bar.Height }, Theme.Accent);
            var isClosed = AddCloseButton(bar);
            _area = new(bounds.X + Padding, bounds.Y + TitleHeight + Padding, bounds.Width - (2 * Padding), bounds.Height);
            _cursorY = _area.Y;
            Row(1);
            head();
            FinishRow();
            if (_cursorY - _area.Y != headHeight)
            {
                _dialogHeights[title] = _cursorY - _area.Y;
                _buildsAgain = true;
            }

            panel.Bounds = bounds;
            AddBody(panel, new(bounds.X, _cursorY, bounds.Width, bounds.Bottom - _cursorY));
            _clip = new(0, 0, _width, _height);
            Frame(bounds, Theme.Border);
            if (isClosed || (_input.IsPressed && !bounds.Contains(_input.X, _input.Y)))
            {
                CloseDialog();
            }
        });
        return _dialog == title;
    }

    private void OpenMenu(string? title)
    {
        CommitEdit();
        _openMenu = title;
        _focus = 0;
        _focusNext = title is null ? 0 : -1;
        _buildsAgain = true;
    }

    private void AddMenu(UiRect title, int columns, int items, Action build)
    {
        var before = _focusable.Count;
        var rows = Math.Max(1, (_height - title.Bottom - (3 * Gap)) / RowPitch);
        var columnCount = (Math.Max(1, items) + rows - 1) / rows;
        var width = Math.Min((columnCount * (columns + 4) * CellWidth) + (2 * Gap), _width);
        var x = Math.Max(0, Math.Min(title.X, _width - width));
        var height = _dialogHeights.GetValueOrDefault(_openMenu!);
        var bounds = new UiRect(x, title.Bottom, width, height + (2 * Gap));
        BeginRoot(IdOf("menu"), bounds, layer: 1);
        Fill(bounds, Theme.Panel);
        _area = bounds.Inset(Gap);
        _cursorY = _area.Y;
        Row([.. Enumerable.Repeat(1.0, columnCount)]);
        build();
        FinishRow();
        if (_cursorY - _area.Y != height && _openMenu is not null)
        {
            _dialogHeights[_openMenu] = _cursorY - _area.Y;
            _buildsAgain = true;
        }

        Frame(bounds, Theme.Border);
        if (_focusNext == -1 && _focusable.Count > before)
        {
            _focusNext = 0;
            TakeFocus(_focusable[before]);
        }

        SwitchMenuByArrows();
    }

    /// <summary>Moves the keyboard on and opens the next menu, as arrow keys have asked for while the widgets were added.</summary>
    private void FinishArrows()
    {
        if (_focusNext is not (0 or -1) && _focusable.IndexOf(_focusNext) is >= 0 and var index)
        {
            TakeFocus(_focusable[Math.Min(index + 1, _focusable.Count - 1)]);
            _scrollTo = _focus;
        }

        _focusNext = _focusNext == -1 ? -1 : 0;
        if (_menuStep != 0 && _openMenu is not null)
        {
            var current = _menuTitles.IndexOf(_openMenu);
            OpenMenu(_menuTitles[(current + _menuStep + _menuTitles.Count) % _menuTitles.Count]);
        }

        _menuStep = 0;
    }

    private void SwitchMenuByArrows()
    {
        var direction = (_input.TakeKey(Key.Right) ? 1 : 0) - (_input.TakeKey(Key.Left) ? 1 : 0);
        if (direction != 0 && _openMenu is not null)
        {
            _isKeyTaken = true;
            _menuStep = direction;
        }
    }
}
