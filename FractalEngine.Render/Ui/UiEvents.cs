using FractalEngine.Render.Ui.Input;
using FractalEngine.Render.Ui.Widgets;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui;

/// <summary>Takes events of the window as input of the widgets, and leaves those to the scene that are none of it.</summary>
internal sealed class UiEvents(UiInput input, UiTargets targets, UiFocus focus, UiMenus menus, UiDialogs dialogs, Action rebuild)
{
    public int Interaction { get; private set; }

    private bool IsOver => dialogs.Opened is not null || targets.IsOverRoot;

    public bool Handle(WindowEvent windowEvent) => windowEvent switch
    {
        MouseMoved moved => HandleMove(moved),
        MousePressed pressed => HandlePress(pressed),
        MouseReleased released => HandleRelease(released),
        WheelTurned wheel => HandleWheel(wheel),
        KeyPressed pressed => HandleKey(pressed),
        KeyReleased released => HandleKeyRelease(released),
        TextEntered entered => HandleText(entered),
        FocusLost => ReleasePointer(),
        _ => false,
    };

    private bool HandleMove(MouseMoved moved)
    {
        var wasOver = IsOver;
        input.X = moved.X;
        input.Y = moved.Y;
        if (targets.IsSceneDrag)
        {
            return false;
        }

        var isOver = IsOver;
        if (isOver || wasOver || targets.Holder != 0)
        {
            rebuild();
        }

        return isOver || targets.Holder != 0;
    }

    private bool HandlePress(MousePressed pressed)
    {
        input.X = pressed.X;
        input.Y = pressed.Y;
        input.Modifiers = pressed.Modifiers;
        Interaction++;
        if (!IsOver)
        {
            var closesMenu = menus.Opened is not null;
            var looksDifferent = closesMenu || focus.Widget != 0;
            targets.IsSceneDrag = !closesMenu;
            menus.Open(null);
            if (looksDifferent)
            {
                rebuild();
            }

            return closesMenu;
        }

        if (pressed.Button == MouseButton.Left)
        {
            input.IsPressed = true;
            input.IsDown = true;
            input.PressX = pressed.X;
            input.PressY = pressed.Y;
            rebuild();
        }

        return true;
    }

    private bool HandleRelease(MouseReleased released)
    {
        input.X = released.X;
        input.Y = released.Y;
        if (targets.IsSceneDrag)
        {
            targets.IsSceneDrag = false;
            return false;
        }

        if (released.Button == MouseButton.Left && input.IsDown)
        {
            input.IsReleased = true;
            input.IsDown = false;
            rebuild();
            return true;
        }

        return IsOver;
    }

    private bool HandleWheel(WheelTurned wheel)
    {
        if (!IsOver)
        {
            return false;
        }

        input.Wheel = wheel.Notches;
        rebuild();
        return true;
    }

    private bool HandleKey(KeyPressed pressed)
    {
        focus.IgnoresText = false;
        input.Modifiers = pressed.Modifiers;
        // A key that is pressed in the middle of a drag belongs to it.
        Interaction += targets.Holder == 0 ? 1 : 0;
        if (pressed.Key == Key.F10 && menus.First is { } first)
        {
            menus.Open(menus.Opened is null ? first : null);
            rebuild();
            return true;
        }

        if (focus.Widget == 0 && !dialogs.IsModal && !(pressed.Key == Key.Tab && focus.HasWidgets))
        {
            return false;
        }

        input.Key = pressed.Key;
        input.IsKeyTaken = false;
        rebuild();
        // Screenshots are taken of dialogs, too.
        return input.IsKeyTaken || (dialogs.Opened is not null && pressed.Key is not (>= Key.F1 and <= Key.F12));
    }

    private bool HandleKeyRelease(KeyReleased released)
    {
        input.Modifiers = released.Modifiers;
        return false;
    }

    private bool HandleText(TextEntered entered)
    {
        if (focus.Edited == 0)
        {
            return dialogs.IsModal;
        }

        if (!focus.IgnoresText)
        {
            Interaction++;
            input.Text = entered.Text;
            rebuild();
        }

        return true;
    }

    private bool ReleasePointer()
    {
        targets.IsSceneDrag = false;
        input.IsDown = false;
        targets.Holder = 0;
        return false;
    }
}
