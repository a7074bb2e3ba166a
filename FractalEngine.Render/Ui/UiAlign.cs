namespace FractalEngine.Render.Ui;

/// <summary>Where a text stands in its place.</summary>
internal enum UiAlign
{
    /// <summary>At the left edge.</summary>
    Left,

    /// <summary>In the middle of the width.</summary>
    Middle,

    /// <summary>At the right edge.</summary>
    Right,
}
