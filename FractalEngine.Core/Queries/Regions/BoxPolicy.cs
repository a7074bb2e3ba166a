using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Regions;

/// <summary>Looks for a face that meets a closed box.</summary>
/// <param name="box">In the frame of the query, not empty.</param>
/// <param name="isRounded">True where the corners of faces are rounded along chains of maps.</param>
/// <param name="maxBoundTests">Number of bounds after which the traversal gives up.</param>
internal readonly struct BoxPolicy(BoundingBox box, bool isRounded, long maxBoundTests) : ITraversalPolicy
{
    private readonly ShapeNode _boxNode = new(null, default, default, baseIndex: 0, AffineMap.Identity, box, 0);

    /// <inheritdoc/>
    public long MaxBoundTests => maxBoundTests;

    /// <inheritdoc/>
    public Vector256<double> MayCountX4(VectorX4 centres, VectorX4 extents, double slack)
    {
        var limit = slack + _boxNode.Slack;
        var reach = VectorX4.Broadcast((0.5 * box.Size) + (limit * Vector.One)) + extents;
        var fromCentre = (centres - VectorX4.Broadcast(box.Centre)).Absolute();
        return ~(Vector256.GreaterThan(fromCentre.X, reach.X) | Vector256.GreaterThan(fromCentre.Y, reach.Y)
            | Vector256.GreaterThan(fromCentre.Z, reach.Z));
    }

    /// <inheritdoc/>
    public double Measure(in ShapeNode node)
    {
        var slack = node.Slack + _boxNode.Slack;
        if (!TriangleBoxTest.Meets(node.Box, box, slack)
            || (!node.IsBoundedByBox && ConvexPairDistance.LowerBoundSquared(in node, in _boxNode, slack * slack) > slack * slack))
        {
            return double.PositiveInfinity;
        }

        var isInside = BoundingBox.Union(BoundingVolume.Inflate(node.Box, slack), box) == box;
        return isInside ? double.NegativeInfinity : box.DistanceSquared(node.Box.Centre);
    }

    /// <inheritdoc/>
    public bool Visit(int face, Vector a, Vector b, Vector c, in ShapeNode leaf, ReadOnlySpan<int> path) =>
        !TriangleBoxTest.Meets(a, b, c, box, isRounded ? leaf.Slack : 0);
}
