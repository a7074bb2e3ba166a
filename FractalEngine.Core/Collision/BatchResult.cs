
namespace FractalEngine.Core.Collision;

/// <summary>The answer to one position of a <see cref="BatchQuery"/>.</summary>
/// <param name="IsFound">False when nothing lies within the distance; then the point means nothing.</param>
/// <param name="Closest">The nearest point.</param>
/// <param name="FaceTests">Faces looked at for this position.</param>
/// <param name="BoundTests">Bounding volumes looked at for this position.</param>
public readonly record struct BatchResult(bool IsFound, ClosestPoint Closest, long FaceTests, long BoundTests);
