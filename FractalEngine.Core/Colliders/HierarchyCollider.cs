using FractalEngine.Core.Bvh;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Queries.Regions;

namespace FractalEngine.Core.Colliders;

/// <summary>
/// Finds the closest point of a mesh by a bounding volume hierarchy. Exact, with the same distances and faces as
/// <see cref="SimpleCollider"/> bit for bit, and hundreds of times faster on large meshes.
/// </summary>
public sealed class HierarchyCollider : Collider
{
    private const double MaxBoundFactor = 1e30;

    private readonly Mesh _mesh;
    private readonly TriangleBvh _bvh;
    private readonly double _magnitude;

    /// <summary>Builds a hierarchy of its own, even where the mesh has one already.</summary>
    /// <param name="mesh">Cost: O(n·log n) for n faces, on all cores; the result is the same on any number of them.</param>
    public HierarchyCollider(Mesh mesh)
        : this(mesh, new(mesh))
    {
    }

    internal HierarchyCollider(Mesh mesh, TriangleBvh bvh)
    {
        _mesh = mesh;
        _bvh = bvh;
        _magnitude = QueryScale.Magnitude(mesh);
    }

    /// <inheritdoc/>
    public override bool IsExact => true;

    /// <inheritdoc/>
    public override long StorageBytes => _bvh.StorageBytes;

    /// <inheritdoc/>
    internal override bool SupportsTransformedQueries => true;

    /// <inheritdoc/>
    internal override bool FindClosestTransformed(Vector position, AffineMap map, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest)
    {
        var magnitude = QueryScale.Magnitude(in position, in map, _magnitude);
        if (QueryScale.IsNeeded(magnitude))
        {
            return ScaledQuery.FindClosest(this, in position, in map, magnitude, maxDistance, epsilon, context, out closest);
        }

        var closestTriangle = new ClosestTriangle(DistanceCutoff.FromRadius(maxDistance));
        TransformedTriangleSearch.Find(_bvh, in position, in map, ref closestTriangle, BoundFactor(epsilon));
        if (closestTriangle.FaceIndex < 0 && NeedsExactRetry(maxDistance, epsilon))
        {
            TransformedTriangleSearch.Find(_bvh, in position, in map, ref closestTriangle, 1);
        }

        AddStatistics(context, in closestTriangle);
        if (closestTriangle.FaceIndex < 0)
        {
            closest = default;
            return false;
        }

        closest = ClosestPointFactory.OnInstance(_mesh, closestTriangle.FaceIndex, map, position);
        return closest.Distance <= maxDistance;
    }

    /// <inheritdoc/>
    private protected override ShapeTree CreateShapeTree() => new(_mesh, _bvh);

    /// <inheritdoc/>
    protected override bool FindClosestCore(Vector position, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest)
    {
        var magnitude = Math.Max(position.MaxAbsComponent(), _magnitude);
        if (QueryScale.IsNeeded(magnitude))
        {
            return ScaledQuery.FindClosest(
                this, in position, AffineMap.Identity, magnitude, maxDistance, epsilon, context, out closest);
        }

        var isFound = FindFirst(in position, maxDistance, epsilon, context, out closest);
        return isFound || (NeedsExactRetry(maxDistance, epsilon) && FindFirst(in position, maxDistance, 0, context, out closest));
    }

    private bool FindFirst(in Vector position, double maxDistance, double epsilon, QueryContext context, out ClosestPoint closest)
    {
        var closestTriangle = new ClosestTriangle(DistanceCutoff.FromRadius(maxDistance));
        ClosestTriangleSearch.Find(_bvh, in position, ref closestTriangle, BoundFactor(epsilon), mayDefer: true);
        AddStatistics(context, in closestTriangle);
        closest = closestTriangle.FaceIndex < 0 ? default : ClosestPointFactory.OnMesh(_mesh, closestTriangle.FaceIndex, position);
        return closestTriangle.FaceIndex >= 0 && closest.Distance <= maxDistance;
    }

    /// <summary>(1 + ε)², at most a finite number: a bound of 0 stays 0.</summary>
    private static double BoundFactor(double epsilon) => Math.Min((1 + epsilon) * (1 + epsilon), MaxBoundFactor);

    private static void AddStatistics(QueryContext context, in ClosestTriangle closestTriangle)
    {
        context.ClearPath();
        context.Statistics.FaceTests += closestTriangle.FaceTests;
        context.Statistics.BoundTests += closestTriangle.BoundTests;
    }
}
