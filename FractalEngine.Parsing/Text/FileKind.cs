namespace FractalEngine.Parsing.Text;

/// <summary>Kind of a file, told by the ending of its name.</summary>
public enum FileKind
{
    /// <summary>Mesh whose name ends in <c>.obj</c>, <c>.obj.gz</c>, <c>.ply</c>, <c>.stl</c>, <c>.glb</c> or <c>.gltf</c>.</summary>
    Mesh,

    /// <summary>Description of a fractal whose name ends in <c>.fdo</c>.</summary>
    Fractal,

    /// <summary>Description of a scene whose name ends in <c>.sdo</c>.</summary>
    Scene,
}
