using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.Input;
using FractalEngine.App.Window.State;
using FractalEngine.Render;
using FractalEngine.Render.Windowing;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window;

/// <summary>Passes each event of a window to the panels, else to the open question, else to the scene.</summary>
/// <param name="window">The window, whose size the frame has.</param>
/// <param name="frames">Knows where the answers of a question were drawn.</param>
/// <param name="actions">Runs what keys and menus stand for.</param>
/// <param name="prompts">Shows questions.</param>
internal sealed class EventDispatch(RenderWindow window, FrameRenderer frames, WindowActions actions, PromptHost prompts)
{
    private readonly TextComposition _composition = new();

    /// <summary>Passes an event to the first that takes it: panels, the open question, or the scene.</summary>
    /// <param name="physicalEvent">The event, before the user's key bindings.</param>
    /// <param name="now">The present time, in which clicks follow each other.</param>
    public Redraw Dispatch(WindowEvent physicalEvent, TimeSpan now)
    {
        var redraw = Redraw.None;
        if (_composition.Takes(physicalEvent, prompts.Current is not null || actions.Panels.Ui.HasFocus))
        {
            return redraw;
        }

        if (prompts.Current is null && HandleByInterface(physicalEvent, ref redraw))
        {
            return redraw;
        }

        var windowEvent = actions.Panels.Bindings.Translate(physicalEvent);
        var promptBefore = prompts.Current;
        if (promptBefore is not null && windowEvent is MousePressed pressed)
        {
            // A click beside the lines of a question is none on the scene behind it.
            if (pressed.Button == MouseButton.Left && frames.AnswerAt(promptBefore.Panel, pressed.X, pressed.Y) is { } answer)
            {
                prompts.Answer(answer);
            }

            redraw |= Redraw.Overlay;
        }
        else if (!prompts.Handle(windowEvent))
        {
            redraw |= Handle(windowEvent, now);
            if (windowEvent is KeyPressed)
            {
                prompts.KeyHandled();
            }
        }
        else
        {
            redraw |= Redraw.Overlay;
        }

        actions.Overlay.Prompt = prompts.Current?.Panel;
        if (prompts.Current != promptBefore)
        {
            // Keys that are held now are released while the question is open, or were pressed for it.
            actions.Document?.ReleaseKeys();
            actions.Panels.ReleasePointer();
            redraw |= Redraw.Overlay;
        }

        return redraw;
    }

    /// <summary>Passes an event to menus and panels, and runs what was chosen there.</summary>
    /// <returns>True when the scene must not see the event.</returns>
    private bool HandleByInterface(WindowEvent windowEvent, ref Redraw redraw)
    {
        var ui = actions.Panels.Ui;
        var version = ui.Version;
        var isTaken = ui.Handle(windowEvent);
        while (actions.TakeChosen() is { } action)
        {
            redraw |= actions.Run(action) | Redraw.Overlay;
        }

        redraw |= ui.Version != version ? Redraw.Overlay : Redraw.None;
        // A drag of a panel is saved when it ends.
        if (isTaken && windowEvent is not MouseMoved)
        {
            actions.Panels.SaveSettings();
        }

        return isTaken;
    }

    private Redraw Handle(WindowEvent windowEvent, TimeSpan now)
    {
        var document = actions.Document;
        var redraw = Redraw.None;
        switch (windowEvent)
        {
            case KeyPressed { Key: Key.Escape } when document?.Tool is { Selected: not null } or { Measure.IsActive: true }:
                return actions.ClearSelection();
            case CloseRequested:
            case KeyPressed { Key: Key.Escape } when prompts.Current is null:
                actions.Files.Close();
                return redraw;
            case KeyPressed { Key: Key.Escape }:
                return redraw;
            case WindowResized:
                redraw = Redraw.Scene;
                break;
            case WindowExposed or VisibilityChanged:
                redraw = Redraw.Overlay;
                break;
            case FileDropped dropped:
                actions.Files.Open(PathText.Shorten(dropped.Path));
                break;
            case KeyPressed { IsRepeat: false } pressed:
                redraw = actions.Handle(pressed);
                actions.Panels.SaveSettings();
                break;
        }

        var (width, height) = (Math.Max(1, window.Width), Math.Max(1, window.Height));
        var move = windowEvent is KeyPressed key ? ActionTable.Find(key)?.MoveCamera : null;
        if (document?.Handle(windowEvent, width, height, move) == true)
        {
            redraw |= Redraw.Scene;
        }

        return document?.Tool.Handle(windowEvent, (width, height), now) is not { } message ? redraw
            : redraw | actions.Show(message) | Redraw.Scene;
    }
}
