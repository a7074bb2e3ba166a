namespace FractalEngine.App.Window.State;

/// <summary>What a window does once when its state has changed.</summary>
internal enum WindowEffect
{
    /// <summary>Writes an error to stderr.</summary>
    Print,

    /// <summary>Writes a message to stderr, and shows it for a few seconds.</summary>
    Report,

    /// <summary>Writes an error to stderr, and shows it for some time over the scene.</summary>
    ShowProblem,

    /// <summary>Watches the files that the load which has just ended has come to.</summary>
    WatchFiles,
}
