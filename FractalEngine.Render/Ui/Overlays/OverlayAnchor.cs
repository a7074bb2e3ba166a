namespace FractalEngine.Render.Ui.Overlays;

/// <summary>Positions of panels in a frame. Panels with the same anchor are stacked.</summary>
public enum OverlayAnchor
{
    /// <summary>The upper left corner of the frame.</summary>
    TopLeft,

    /// <summary>The lower left corner of the frame.</summary>
    BottomLeft,

    /// <summary>The middle of the lower edge.</summary>
    Bottom,

    /// <summary>The centre of the frame.</summary>
    Centre,
}
