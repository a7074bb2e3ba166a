using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.State;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window;

/// <content>Passes events to questions, panels, tools and the camera.</content>
internal sealed partial class SceneWindow
{
    /// <summary>Passes an event to the open question, or else to the scene.</summary>
    private void Dispatch(WindowEvent physicalEvent)
    {
        _actions.Document = Document;
        if (_prompts.Current is null && HandleByInterface(physicalEvent))
        {
            return;
        }

        var windowEvent = _panels.Bindings.Translate(physicalEvent);
        var promptBefore = _prompts.Current;
        if (promptBefore is not null && windowEvent is MousePressed pressed)
        {
            // A click beside the lines of a question is none on the scene behind it.
            if (pressed.Button == MouseButton.Left && _frameRenderer.AnswerAt(promptBefore.Panel, pressed.X, pressed.Y) is { } answer)
            {
                _prompts.Answer(answer);
            }

            _redraw |= Redraw.Overlay;
        }
        else if (!_prompts.Handle(windowEvent))
        {
            Handle(windowEvent);
            if (windowEvent is KeyPressed)
            {
                _prompts.KeyHandled();
            }
        }
        else
        {
            _redraw |= Redraw.Overlay;
        }

        _overlay.Prompt = _prompts.Current?.Panel;
        if (_prompts.Current != promptBefore)
        {
            // Keys that are held now are released while the question is open, or were pressed for it.
            Document?.ReleaseKeys();
            _panels.ReleasePointer();
            _redraw |= Redraw.Overlay;
        }
    }

    /// <summary>Passes an event to menus and panels, and runs what was chosen there.</summary>
    /// <returns>True when the scene must not see the event.</returns>
    private bool HandleByInterface(WindowEvent windowEvent)
    {
        var version = _panels.Ui.Version;
        var isTaken = _panels.Ui.Handle(windowEvent);
        while (_actions.TakeChosen() is { } action)
        {
            _redraw |= _actions.Run(action) | Redraw.Overlay;
        }

        _redraw |= _actions.TakeRequested();
        if (_panels.Ui.Version != version)
        {
            _redraw |= Redraw.Overlay;
        }

        // A drag of a panel is saved when it ends.
        if (isTaken && windowEvent is not MouseMoved)
        {
            _panels.SaveSettings();
        }

        return isTaken;
    }

    private void Handle(WindowEvent windowEvent)
    {
        var wasMoving = Document?.IsMoving == true;
        switch (windowEvent)
        {
            case KeyPressed { Key: Key.Escape } when Document?.Tool is { Selected: not null } or { Measure.IsActive: true }:
                _redraw |= _actions.ClearSelection();
                return;
            case CloseRequested:
            case KeyPressed { Key: Key.Escape } when _prompts.Current is null:
                _files.Close();
                return;
            case KeyPressed { Key: Key.Escape }:
                return;
            case WindowResized:
                _redraw |= Redraw.Scene;
                break;
            case WindowExposed:
                _redraw |= Redraw.Overlay;
                break;
            case VisibilityChanged visibility:
                _isVisible = visibility.IsVisible;
                _redraw |= Redraw.Overlay;
                break;
            case FileDropped dropped:
                _files.Open(PathText.Shorten(dropped.Path));
                break;
            case KeyPressed { IsRepeat: false } pressed:
                _redraw |= _actions.Handle(pressed);
                _panels.SaveSettings();
                break;
        }

        var move = windowEvent is KeyPressed key ? ActionTable.Find(key)?.MoveCamera : null;
        if (Document?.Handle(windowEvent, Math.Max(1, _window.Width), Math.Max(1, _window.Height), move) == true)
        {
            _redraw |= Redraw.Scene;
        }

        // A slow frame between two clicks does not part a double click.
        var time = _clock.Elapsed - _refreshTime;
        if (Document?.Tool.Handle(windowEvent, (Math.Max(1, _window.Width), Math.Max(1, _window.Height)), time) is { } message)
        {
            _overlay.ShowMessage(message, _clock.Elapsed);
            _redraw |= Redraw.Scene;
        }

        if (!wasMoving)
        {
            // Time begins to count with the event that starts a movement.
            _lastAdvance = _clock.Elapsed;
        }
    }
}
