using FractalEngine.Core.Maths;

namespace FractalEngine.Render;

/// <summary>A ball that is no object of the scene.</summary>
/// <param name="Centre">World space.</param>
/// <param name="Radius">Scene units.</param>
public readonly record struct SphereInstance(Vector Centre, double Radius);
