using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>Looks for a face that meets a closed box.</summary>
/// <param name="box">In the frame of the query, not empty.</param>
/// <param name="isRounded">True where the corners of faces are rounded along chains of maps.</param>
/// <param name="maxBoundTests">Number of bounds after which the walk gives up.</param>
internal readonly struct BoxVisitor(BoundingBox box, bool isRounded, long maxBoundTests) : IShapeVisitor
{
    private readonly ShapeNode _boxNode = new(null, 0, default, isBase: true, AffineMap.Identity, box, 0);

    /// <inheritdoc/>
    public long MaxBoundTests => maxBoundTests;

    /// <inheritdoc/>
    public double Measure(in ShapeNode node)
    {
        var slack = node.Slack + _boxNode.Slack;
        if (!TriangleBoxTest.Meets(node.Box, box, slack)
            || ConvexPairDistance.LowerBoundSquared(in node, in _boxNode, slack * slack) > slack * slack)
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
