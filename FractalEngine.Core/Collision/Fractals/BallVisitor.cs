using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>Looks for the faces that meet a closed ball: for all of them, or for one.</summary>
/// <param name="centre">In the frame of the query.</param>
/// <param name="radius">Not negative; may be infinite.</param>
/// <param name="maxBoundTests">Number of bounds after which the walk gives up, beside what found faces add.</param>
/// <param name="hits">Receives all faces; null to end at the first.</param>
/// <param name="maxHits">Number of hits after which the walk ends.</param>
internal struct BallVisitor(Vector centre, double radius, long maxBoundTests, List<BallHit>? hits = null, int maxHits = 0) : IShapeVisitor
{
    // The way to a face takes some bounds of its own.
    private const long BoundTestsPerHit = 100;

    private readonly Vector256<double> _centre = SimdAffineMap.ToVector256(centre);
    private readonly double _slack = RoundingErrors.Coordinate * centre.MaxAbsComponent();

    /// <inheritdoc/>
    public readonly long MaxBoundTests => maxBoundTests + (BoundTestsPerHit * (hits?.Count ?? 0));

    /// <inheritdoc/>
    public readonly double Measure(in ShapeNode node)
    {
        var limit = radius + _slack + node.Slack;
        var limitSquared = limit * limit;
        if (node.Box.DistanceSquared(centre) > limitSquared
            || (node.SubFractal is { } subFractal && Excludes(subFractal, in node, limitSquared)))
        {
            return double.PositiveInfinity;
        }

        return hits is null && IsInside(node.Box, node.Slack) ? double.NegativeInfinity : (node.Box.Centre - centre).LengthSquared();
    }

    /// <inheritdoc/>
    public readonly bool Visit(int face, Vector a, Vector b, Vector c, in ShapeNode leaf, ReadOnlySpan<int> path)
    {
        var closest = TriangleKernel.ClosestPoint(centre, a, b, c);
        var distance = Math.Sqrt(closest.DistanceSquared);
        if (!(distance <= radius))
        {
            return true;
        }

        hits?.Add(new(distance, closest.Point, TriangleKernel.UnitNormal(a, b, c), face, path.ToArray()));
        return hits is not null && hits.Count <= maxHits;
    }

    private readonly bool Excludes(SubFractal subFractal, in ShapeNode node, double limitSquared)
    {
        var map = new SimdAffineMap(node.Map);
        return (subFractal.Clusters is { } clusters && clusters.LowerBoundSquared(_centre, in map) > limitSquared)
            || (subFractal.Solid is { } solid && solid.LowerBoundSquared(_centre, in map, Math.BitIncrement(limitSquared)) > limitSquared);
    }

    private readonly bool IsInside(BoundingBox box, double slack)
    {
        var farthest = Vector.Max((box.Minimum - centre).Absolute(), (box.Maximum - centre).Absolute());
        return farthest.Length() + slack + _slack <= radius;
    }
}
