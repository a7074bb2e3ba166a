using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Windowing.Events;

namespace FractalEngine.App.Window.Input;

/// <summary>A question to the user over the frame. While it is open it receives all keys. It needs no window.</summary>
internal abstract class Prompt
{
    /// <summary>True once the user has answered.</summary>
    public bool IsClosed { get; private set; }

    public abstract OverlayPanel Panel { get; }

    public abstract void HandleKey(KeyPressed pressed);

    public virtual void HandleText(string text)
    {
    }

    /// <summary>Processes a click on a line of the panel.</summary>
    public virtual void HandleAnswer(int answer)
    {
    }

    /// <summary>Closes the question once it is answered.</summary>
    protected void Close() => IsClosed = true;
}
