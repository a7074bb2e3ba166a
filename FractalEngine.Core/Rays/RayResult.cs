using System.Collections.Immutable;

namespace FractalEngine.Core.Rays;

/// <summary>The result for one ray of a <c>RayBatch</c>.</summary>
/// <param name="ObjectIndex">Index of the object in the scene; −1 where the ray hits none.</param>
/// <param name="Hit">The hit in world space; it means nothing where there is none.</param>
/// <param name="InstancePath">
/// For each level of a fractal, the outermost first, the index of the transformation in its set. Empty for a mesh.
/// </param>
public readonly record struct RayResult(int ObjectIndex, RayHit Hit, ImmutableArray<int> InstancePath)
{
    /// <summary>The result of a ray that hits nothing.</summary>
    public static RayResult None => new(-1, default, []);

    /// <summary>True where the ray hits an object.</summary>
    public bool IsHit => ObjectIndex >= 0;
}
