namespace FractalEngine.App.Window.Tools;

/// <summary>What the handles of the selected object do.</summary>
internal enum HandleKind
{
    /// <summary>No handles are shown at the selected object.</summary>
    None,

    /// <summary>Handles that move the object along the axes of the world, or in the plane of the frame.</summary>
    Move,

    /// <summary>Handles that turn the object about axes of the world through its middle.</summary>
    Turn,

    /// <summary>Handles that scale the object along its own axes, or all of it, about its middle.</summary>
    Scale,
}
