using System.Collections.Immutable;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries;

/// <summary>The closest point of a shape or a scene together with the instance and the object that it lies on.</summary>
/// <param name="Distance">Distance of the point from the position, scene units; 0 on the surface.</param>
/// <param name="Point">The closest point, in the frame of the query.</param>
/// <param name="Normal">The unit normal of the face, by its winding. Where several faces are equally close, that of one of them.</param>
/// <param name="FaceIndex">Index of the face, see <see cref="ClosestPoint.FaceIndex"/>.</param>
/// <param name="InstancePath">
/// For each level of a fractal, the outermost first, the index of the transformation in its set. Empty for a mesh, and where a collider
/// has expanded the fractal. Shorter than the depth of the fractal where deeper levels are below the precision of the result, or below
/// identities without end.
/// </param>
/// <param name="ObjectIndex">Index of the object in its scene; 0 where a single shape was queried.</param>
public sealed record ClosestHit(
    double Distance, Vector Point, Vector Normal, int FaceIndex, ImmutableArray<int> InstancePath, int ObjectIndex = 0)
{
    /// <summary>
    /// Index of the base mesh with the face among those of the fractal; 0 where there is only one, or a collider has expanded the fractal.
    /// </summary>
    public int MeshIndex { get; init; }

    internal static ClosestHit Of(in ClosestPoint closest, QueryContext context) => new(
        closest.Distance, closest.Point, closest.Normal, closest.FaceIndex, [.. context.InstancePath], context.ObjectIndex)
    {
        MeshIndex = context.MeshIndex,
    };

    /// <summary>Tells whether all numbers of both hits are equal, the paths included.</summary>
    public bool Equals(ClosestHit? other) =>
        other is not null && Distance.Equals(other.Distance) && Point == other.Point && Normal == other.Normal
        && FaceIndex == other.FaceIndex && MeshIndex == other.MeshIndex && ObjectIndex == other.ObjectIndex
        && InstancePath.AsSpan().SequenceEqual(other.InstancePath.AsSpan());

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Distance, Point, FaceIndex, ObjectIndex, InstancePath.Length);
}
