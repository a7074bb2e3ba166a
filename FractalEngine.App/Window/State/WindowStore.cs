namespace FractalEngine.App.Window.State;

/// <summary>Holds the present state of a window.</summary>
internal sealed class WindowStore
{
    /// <summary>The state; each change replaces it.</summary>
    public WindowState State { get; set; } = new();
}
