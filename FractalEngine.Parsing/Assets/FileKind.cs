namespace FractalEngine.Parsing.Assets;

/// <summary>What a file holds, told by its ending.</summary>
public enum FileKind
{
    /// <summary><c>.obj</c></summary>
    Mesh,

    /// <summary><c>.fdo</c></summary>
    Fractal,

    /// <summary><c>.sdo</c></summary>
    Scene,
}
