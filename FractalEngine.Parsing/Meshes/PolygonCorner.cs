namespace FractalEngine.Parsing.Meshes;

/// <summary>One corner of a polygon as indices into the elements of the file.</summary>
/// <param name="PositionIndex">Index of the position, from 0.</param>
/// <param name="TextureCoordinateIndex">Index of the texture coordinate, from 0, or <see cref="None"/>.</param>
/// <param name="NormalIndex">Index of the normal, from 0, or <see cref="None"/>.</param>
internal readonly record struct PolygonCorner(int PositionIndex, int TextureCoordinateIndex, int NormalIndex)
{
    /// <summary>Index of an element that the corner lacks.</summary>
    public const int None = -1;
}
