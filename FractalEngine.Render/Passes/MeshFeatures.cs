namespace FractalEngine.Render.Passes;

/// <summary>
/// What the shader of surfaces has to do beyond light on one colour. Each combination is a program of its own, so that nobody pays for what
/// is not there.
/// </summary>
[Flags]
internal enum MeshFeatures
{
    /// <summary>Light at the vertices, one colour.</summary>
    None = 0,

    /// <summary>Light at every pixel.</summary>
    PerPixel = 1,

    /// <summary>A picture.</summary>
    Textured = 2,

    /// <summary>A highlight.</summary>
    Glossy = 4,

    /// <summary>Instances lead to world axes about the camera: the object's own map is in them.</summary>
    CameraRelative = 8,

    /// <summary>Only fronts are drawn, so that backs need no light.</summary>
    FrontFacesOnly = 16,
}
