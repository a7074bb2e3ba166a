namespace FractalEngine.Core.Scenes.Cameras;

/// <summary>How depth becomes size on the screen (paper §4.1.4).</summary>
public enum Projection
{
    /// <summary>Sizes shrink with distance.</summary>
    Perspective,

    /// <summary>Sizes stay the same at every distance.</summary>
    Orthographic,
}
