namespace FractalEngine.Parsing.Meshes;

/// <summary>Elements of consecutive lines of a mesh file, in arrays of exact size. Polygons are not triangulated yet.</summary>
/// <remarks>
/// An index counts from 0 in the file, or is <see cref="PolygonCorner.None"/>, or counts from <see cref="BlockStart"/> in the block: where
/// a line counts backwards, the elements before the block are not counted yet when the line is read.
/// </remarks>
internal sealed class MeshBlock
{
    /// <summary>Stands for the first element of the block in indices relative to it. More than any file has elements below −1.</summary>
    public const int BlockStart = -(1 << 30);

    /// <summary>Numbers of elements in all blocks before this one.</summary>
    public ElementCounts Before { get; set; }

    /// <summary>Numbers of elements in this block.</summary>
    public required ElementCounts Counts { get; init; }

    /// <summary>Coordinates of the vertices in the block, [vertices × 3].</summary>
    public required double[] Positions { get; init; }

    /// <summary>Colours of the vertices in the block, sRGB, [vertices × 3]; empty when no vertex has any.</summary>
    public required double[] Colours { get; init; }

    /// <summary>Texture coordinates in the block, [n × 2].</summary>
    public required double[] TextureCoordinates { get; init; }

    /// <summary>Normals in the block, of any length, [n × 3].</summary>
    public required double[] Normals { get; init; }

    /// <summary>Index of the position of each corner of each polygon.</summary>
    public required int[] PositionIndices { get; init; }

    /// <summary>Index of the texture coordinate of each corner; empty when no corner has any.</summary>
    public required int[] TextureIndices { get; init; }

    /// <summary>Index of the normal of each corner; empty when no corner has any.</summary>
    public required int[] NormalIndices { get; init; }

    /// <summary>Number of corners of each polygon; empty when all are triangles.</summary>
    public required ushort[] PolygonSizes { get; init; }

    /// <summary>Whether some index counts from <see cref="BlockStart"/>.</summary>
    public bool HasRelativeIndices { get; init; }

    /// <summary>Whether the indices are those of the mesh as they stand.</summary>
    public bool IsResolved => PolygonSizes.Length == 0 && !HasRelativeIndices;
}
