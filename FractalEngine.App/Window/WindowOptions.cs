using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;

namespace FractalEngine.App.Window;

/// <summary>What a window is told when it is opened, whatever file it shows.</summary>
internal sealed record WindowOptions
{
    /// <summary>How files are loaded.</summary>
    public LoadOptions Load { get; init; } = new();

    /// <summary>How scenes are prepared and drawn at first; keys change some of it.</summary>
    public RenderSettings Settings { get; init; } = new();

    /// <summary>Whatever the scene says; null for what it says.</summary>
    public Projection? Projection { get; init; }

    /// <summary>The length of the queue with which the paper's way into a fractal is followed.</summary>
    public int TrailLength { get; init; } = 3;

    /// <summary>Width and height of the contents, pixels.</summary>
    public (int Width, int Height) Size { get; init; } = (1280, 720);

    /// <summary>
    /// Draws nothing while nothing has changed or nobody sees the window. Where false, 60 pictures a second are drawn all the same, for
    /// comparison.
    /// </summary>
    public bool IdleWhenUnchanged { get; init; } = true;
}
