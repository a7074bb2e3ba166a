namespace FractalEngine.Core.Geometry;

/// <summary>A run of consecutive faces of a mesh that share their names and their material.</summary>
/// <param name="FirstFace">Index of the first face, from 0.</param>
/// <param name="FaceCount">Number of faces, the first included.</param>
/// <param name="ObjectName">Name given by <c>o</c>, or empty.</param>
/// <param name="GroupName">Names given by <c>g</c>, or empty.</param>
/// <param name="Material">Name of the material given by <c>usemtl</c>, or empty.</param>
/// <param name="SmoothingGroup">Smoothing group given by <c>s</c>; 0 for none.</param>
public sealed record MeshGroup(
    int FirstFace, int FaceCount, string ObjectName, string GroupName, string Material, int SmoothingGroup);
