namespace FractalEngine.Parsing.Assets;

/// <summary>Kind of a file, told by the ending of its name.</summary>
public enum FileKind
{
    /// <summary>Wavefront mesh whose name ends in <c>.obj</c>.</summary>
    Mesh,

    /// <summary>Description of a fractal whose name ends in <c>.fdo</c>.</summary>
    Fractal,

    /// <summary>Description of a scene whose name ends in <c>.sdo</c>.</summary>
    Scene,
}
