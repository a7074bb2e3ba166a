namespace FractalEngine.Core.Generation.Building;

/// <summary>A generated face with its smoothing group.</summary>
/// <param name="A">First corner.</param>
/// <param name="B">Second corner.</param>
/// <param name="C">Third corner.</param>
/// <param name="SmoothingGroup">Group of faces that share normals; 0 for a flat face.</param>
internal readonly record struct MeshTriangle(MeshCorner A, MeshCorner B, MeshCorner C, int SmoothingGroup)
{
    /// <summary>Rotates the corners of the face, so that it starts at another one.</summary>
    /// <param name="corner">0 for A, 1 for B, 2 for C.</param>
    public MeshTriangle StartingAt(int corner) => corner switch
    {
        0 => this,
        1 => new(B, C, A, SmoothingGroup),
        _ => new(C, A, B, SmoothingGroup),
    };
}
