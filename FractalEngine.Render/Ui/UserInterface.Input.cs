using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui;

/// <content>Events, and what mouse and keyboard do to widgets.</content>
public sealed partial class UserInterface
{
    private double _pressY;
    private bool _isLastHot;

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

    private bool IsHot(UiRect rect) =>
        _hoverRoot == _root && (!_input.IsDown || _active == 0) && _dragged is null
        && rect.Intersect(_clip).Contains(_input.X, _input.Y);

    /// <summary>Tells what mouse and keyboard do to a widget.</summary>
    private UiTouch Touch(int id, UiRect rect, bool takesFocus)
    {
        if (takesFocus)
        {
            _focusable.Add(id);
            if (_scrollTo == id)
            {
                _scrolledRect = rect;
            }
        }

        var isHot = IsHot(rect);
        _isLastHot = isHot;
        var isPressed = isHot && _input.IsPressed && _active == 0;
        if (isPressed)
        {
            _active = id;
            _pressY = _input.Y;
            CommitEdit();
            if (takesFocus)
            {
                TakeFocus(id);
            }
        }

        var isActivated = _active == id && _input.IsReleased && rect.Intersect(_clip).Contains(_input.X, _input.Y);
        if (_focus == id && takesFocus && (_input.Key is Key.Enter or Key.KeypadEnter or Key.Space))
        {
            _input.Key = Key.Unknown;
            _isKeyTaken = true;
            isActivated = true;
        }

        _buildsAgain |= isActivated;
        return new(id, isHot || _active == id, isPressed, _active == id && _input.IsDown, isActivated);
    }

    /// <summary>Lets the keys Up and Down move the keyboard to the row before or after.</summary>
    private void MoveFocusByArrows(UiTouch touch)
    {
        if (_focus != touch.Id)
        {
            return;
        }

        if (_input.TakeKey(Key.Up))
        {
            _isKeyTaken = true;
            TakeFocus(_focusable[Math.Max(0, _focusable.IndexOf(touch.Id) - 1)]);
        }
        else if (_input.TakeKey(Key.Down))
        {
            _isKeyTaken = true;
            _focusNext = touch.Id;
        }
    }
}
