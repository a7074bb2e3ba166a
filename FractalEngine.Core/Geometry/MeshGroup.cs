namespace FractalEngine.Core.Geometry;

/// <summary>A run of consecutive faces of a mesh that share their names and their material.</summary>
/// <param name="FirstFace">Number of the first face, from 0.</param>
/// <param name="FaceCount">How many faces follow, the first included.</param>
/// <param name="ObjectName">The name given by <c>o</c>, or empty.</param>
/// <param name="GroupName">The names given by <c>g</c>, or empty.</param>
/// <param name="Material">The material named by <c>usemtl</c>, or empty.</param>
/// <param name="SmoothingGroup">The group given by <c>s</c>: 0 for none.</param>
public sealed record MeshGroup(
    int FirstFace, int FaceCount, string ObjectName, string GroupName, string Material, int SmoothingGroup);
