using FractalEngine.App.Options;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.State;

/// <summary>The options of a window, which hold for every file that it shows.</summary>
internal sealed record WindowOptions
{
    /// <summary>Number of samples of each pixel of a traced image, unless stated otherwise.</summary>
    public const int DefaultTraceSampleCount = 256;

    public LoadOptions Load { get; init; } = new();

    /// <summary>The initial render settings, some of which keys can change.</summary>
    public RenderSettings Settings { get; init; } = new();

    /// <summary>The initial projection; null for that of the scene.</summary>
    public Projection? Projection { get; init; }

    /// <summary>The plane that cuts every file open at first; null for none.</summary>
    public SectionPlane? Section { get; init; }

    /// <summary>Length of the trail of the paper's zoom into a fractal.</summary>
    public int TrailLength { get; init; } = 3;

    /// <summary>Whether views that stand still are traced from the start; null for what the settings remember.</summary>
    public bool? IsTraced { get; init; }

    /// <summary>Number of samples of each pixel of a traced image.</summary>
    public int TraceSampleCount { get; init; } = DefaultTraceSampleCount;

    /// <summary>Whether noise is taken out of the traced image.</summary>
    public bool DenoisesTrace { get; init; } = true;

    /// <summary>Width and height of the window's contents in pixels.</summary>
    public (int Width, int Height) Size { get; init; } = SharedOptions.DefaultResolution;

    /// <summary>Whether files are loaded again when they change.</summary>
    public bool WatchesFiles { get; init; } = true;

    /// <summary>Full path of what the window remembers of panels and keys; null to remember nothing.</summary>
    public string? SettingsPath { get; init; }

    /// <summary>Full path of the list of recent files; null to keep none.</summary>
    public string? RecentFilesPath { get; init; }
}
