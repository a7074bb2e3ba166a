namespace FractalEngine.Parsing.Meshes;

/// <summary>One corner of a polygon: numbers from 0 of its position, texture coordinate and normal.</summary>
internal readonly record struct ObjCorner(int PositionIndex, int TextureCoordinateIndex, int NormalIndex)
{
    /// <summary>The number of what a corner does not have.</summary>
    public const int None = -1;
}
