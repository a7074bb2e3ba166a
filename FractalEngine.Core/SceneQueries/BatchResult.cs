using FractalEngine.Core.Geometry.Triangles;

namespace FractalEngine.Core.SceneQueries;

/// <summary>The result for one position of a <see cref="BatchQuery"/>.</summary>
/// <param name="IsFound">False when nothing lies within the distance; then the point means nothing.</param>
/// <param name="Closest">The closest point.</param>
/// <param name="FaceTests">Number of faces tested for this position.</param>
/// <param name="BoundTests">Number of bounding volumes tested for this position.</param>
/// <param name="ObjectIndex">Index of the object in a scene; 0 for a single shape, and −1 where nothing is found.</param>
public readonly record struct BatchResult(bool IsFound, ClosestPoint Closest, long FaceTests, long BoundTests, int ObjectIndex);
