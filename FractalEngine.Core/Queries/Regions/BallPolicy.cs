using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Regions;

/// <summary>Looks for all faces that meet a closed ball.</summary>
/// <param name="centre">In the frame of the query.</param>
/// <param name="radius">Not negative; may be infinite.</param>
/// <param name="maxBoundTests">Number of bounds after which the traversal gives up, beside what found faces add.</param>
/// <param name="hits">Receives the faces.</param>
/// <param name="maxHits">Number of hits after which the traversal ends.</param>
internal struct BallPolicy(Vector centre, double radius, long maxBoundTests, List<BallHit> hits, int maxHits) : ITraversalPolicy
{
    // The way to a face takes some bounds of its own.
    private const long BoundTestsPerHit = 100;

    private readonly Vector256<double> _centre = SimdAffineMap.ToVector256(centre);
    private readonly double _slack = RoundingErrors.Coordinate * centre.MaxAbsComponent();

    // The faces of a leaf share one path.
    private int[] _path = [];

    /// <inheritdoc/>
    public readonly long MaxBoundTests => maxBoundTests + (BoundTestsPerHit * hits.Count);

    /// <inheritdoc/>
    public readonly Vector256<double> MayCountX4(VectorX4 centres, VectorX4 extents, double slack)
    {
        var limit = radius + _slack + slack;
        var outside = VectorX4.Max((centres - VectorX4.Broadcast(_centre)).Absolute() - extents, VectorX4.Zero);
        return ~Vector256.GreaterThan(outside.LengthSquared(), Vector256.Create(limit * limit));
    }

    /// <inheritdoc/>
    public readonly double Measure(in ShapeNode node)
    {
        var limit = radius + _slack + node.Slack;
        var limitSquared = limit * limit;
        return node.Box.DistanceSquared(centre) > limitSquared
            || (node.SubFractal is { } subFractal && Excludes(subFractal, in node, limitSquared))
            ? double.PositiveInfinity
            : (node.Box.Centre - centre).LengthSquared();
    }

    /// <inheritdoc/>
    public bool Visit(int face, Vector a, Vector b, Vector c, in ShapeNode leaf, ReadOnlySpan<int> path)
    {
        var closest = TriangleKernel.ClosestPoint(centre, a, b, c);
        var distance = Math.Sqrt(closest.DistanceSquared);
        if (!(distance <= radius))
        {
            return true;
        }

        _path = path.SequenceEqual(_path) ? _path : path.ToArray();
        hits.Add(new(distance, closest.Point, TriangleKernel.UnitNormal(a, b, c), face, leaf.BaseIndex, _path));
        return hits.Count <= maxHits;
    }

    private readonly bool Excludes(SubFractal subFractal, in ShapeNode node, double limitSquared)
    {
        var map = new SimdAffineMap(node.Map);
        return (subFractal.Clusters is { } clusters && clusters.LowerBoundSquared(_centre, in map) > limitSquared)
            || (subFractal.Solid is { } solid && solid.LowerBoundSquared(_centre, in map, Math.BitIncrement(limitSquared)) > limitSquared);
    }
}
