namespace FractalEngine.Core.Generation;

/// <summary>A corner of a face: the numbers of its position and texture coordinate.</summary>
internal readonly record struct MeshCorner(int PositionIndex, int CoordinateIndex);

/// <summary>A face with the group of faces that it is smooth with; 0 for none.</summary>
internal readonly record struct MeshTriangle(MeshCorner A, MeshCorner B, MeshCorner C, int SmoothingGroup)
{
    /// <summary>The same face, beginning with another corner: 0 is A, 1 is B, 2 is C.</summary>
    public MeshTriangle StartingAt(int corner) => corner switch
    {
        0 => this,
        1 => new(B, C, A, SmoothingGroup),
        _ => new(C, A, B, SmoothingGroup),
    };
}
