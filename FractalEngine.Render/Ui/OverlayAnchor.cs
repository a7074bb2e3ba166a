namespace FractalEngine.Render.Ui;

/// <summary>Where in the picture a panel stands. Panels with the same anchor are stacked.</summary>
public enum OverlayAnchor
{
    /// <summary>In the upper left corner.</summary>
    TopLeft,

    /// <summary>In the upper right corner.</summary>
    TopRight,

    /// <summary>In the lower left corner.</summary>
    BottomLeft,

    /// <summary>In the lower right corner.</summary>
    BottomRight,

    /// <summary>In the middle of the lower edge.</summary>
    Bottom,

    /// <summary>In the middle.</summary>
    Centre,
}
