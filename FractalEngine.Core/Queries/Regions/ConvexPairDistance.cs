using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Regions;

/// <summary>Bounds the distance of two parts of shapes by the distance of convex solids around them.</summary>
/// <remarks>
/// The algorithm of Gilbert, Johnson and Keerthi (1988) on the differences of their points, as <see cref="ConvexSolid"/> does for one.
/// Each step's direction gives a lower bound that holds whatever the rounding of the simplex.
/// </remarks>
internal static class ConvexPairDistance
{
    private const int MaxSteps = 24;

    // The distance is exact to this part when a step comes no closer.
    private const double ConvergenceTolerance = 1e-14;

    /// <summary>Computes a lower bound of the squared distance of two nodes.</summary>
    /// <param name="node1">The first node.</param>
    /// <param name="node2">The second node, in the same frame.</param>
    /// <param name="cutoffSquared">The method may return early above this value.</param>
    public static double LowerBoundSquared(in ShapeNode node1, in ShapeNode node2, double cutoffSquared)
    {
        var simplex = new SimplexDistance();
        var direction = node1.Box.Centre - node2.Box.Centre;
        var bound = 0.0;
        for (var step = 0; step < MaxSteps; step++)
        {
            var lengthSquared = direction.LengthSquared();
            if (!(lengthSquared > 0))
            {
                // The solids meet, or are beyond the range of a double.
                return bound;
            }

            var difference = node1.FindLowestPoint(direction, out var margin1) - node2.FindLowestPoint(-direction, out var margin2);
            var height = Vector.Dot(direction, difference);
            var separation = height - margin1 - margin2;
            if (separation > 0)
            {
                bound = Math.Max(bound, separation * (separation / lengthSquared));
            }

            if (bound > cutoffSquared || lengthSquared - height <= ConvergenceTolerance * lengthSquared || !simplex.TryAdd(difference))
            {
                return bound;
            }

            direction = simplex.FindClosestToOrigin();
        }

        return bound;
    }
}
