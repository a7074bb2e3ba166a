using System.Runtime.CompilerServices;
using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.SceneQueries;

/// <summary>The collider of one object of a scene, with its place in the world.</summary>
/// <param name="index">Index of the object in the scene, from 0.</param>
/// <param name="collider">In the frame of its model, shared by all objects that show it.</param>
/// <param name="similarity">Maps that frame to world space.</param>
/// <param name="generalMap">Used instead of the similarity where the object's matrix is none; else null.</param>
/// <param name="bounds">In world space.</param>
internal sealed class ColliderInstance(
    int index, Lazy<Collider> collider, Similarity similarity, AffineMap? generalMap, BoundingBox bounds)
    : ObjectBvhLeaf(index, bounds)
{
    // Apart, since few objects have one, and a query among many waits for memory.
    private readonly StrongBox<AffineMap>? _generalMap = generalMap is { } map ? new(map) : null;

    /// <summary>In the frame of the model; built at the first query.</summary>
    public Lazy<Collider> Collider => collider;

    /// <summary>Maps the frame of the collider to world space.</summary>
    public AffineMap ObjectToWorld => _generalMap?.Value ?? similarity.Map;

    /// <summary>Computes the distance of the object's box, which is no more than that of its faces.</summary>
    public double BoundDistance(Vector position)
    {
        var bounds = Bounds;
        var distance = Math.Sqrt(bounds.DistanceSquared(position));
        // Where squares leave the range of a double, the distance along an axis is a bound too.
        return double.IsPositiveInfinity(distance) && !bounds.IsEmpty
            ? Vector.Max(bounds.Minimum - position, position - bounds.Maximum).MaxAbsComponent()
            : distance;
    }

    /// <summary>Finds the closest point of the object in world space.</summary>
    public bool TryFindClosest(Vector position, double maxDistance, QueryContext context, out ClosestPoint closest, double epsilon)
    {
        if (_generalMap is not null)
        {
            return TryFindTransformed(position, in _generalMap.Value, maxDistance, context, out closest, epsilon);
        }

        var localPosition = similarity.ToLocal(position);
        if (!(localPosition.MaxAbsComponent() <= Core.Colliders.Collider.MaxCoordinate) && collider.Value.SupportsTransformedQueries)
        {
            return TryFindTransformed(position, similarity.Map, maxDistance, context, out closest, epsilon);
        }

        var isFound = collider.Value.TryFindClosest(
            localPosition, maxDistance / similarity.Scale, context, out var localClosest, epsilon);
        closest = isFound ? similarity.ToWorld(localClosest) : default;
        return isFound;
    }

    private bool TryFindTransformed(
        Vector position, in AffineMap map, double maxDistance, QueryContext context, out ClosestPoint closest, double epsilon)
    {
        if (!collider.Value.FindClosestTransformed(position, map, maxDistance, epsilon, context, out closest))
        {
            return false;
        }

        ScaledQuery.ThrowIfInfinite(closest.Distance);
        closest = closest with { ErrorBound = collider.Value.CompleteErrorBound(position, in closest, epsilon) };
        return true;
    }
}
