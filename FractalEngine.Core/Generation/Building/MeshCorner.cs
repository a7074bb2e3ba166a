namespace FractalEngine.Core.Generation.Building;

/// <summary>A corner of a generated face.</summary>
/// <param name="PositionIndex">Index of the corner's position.</param>
/// <param name="CoordinateIndex">Index of the corner's texture coordinate.</param>
internal readonly record struct MeshCorner(int PositionIndex, int CoordinateIndex);
