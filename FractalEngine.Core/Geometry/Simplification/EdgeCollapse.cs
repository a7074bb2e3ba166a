using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>Where the two ends of an edge are merged, and what that costs.</summary>
/// <param name="Offset">From the first end of the edge to the merged vertex.</param>
/// <param name="Cost">By which collapses are ordered: the error, and a little for the length of the edge.</param>
/// <param name="MaxCost">Cost at which the collapse is made although it breaks a rule.</param>
internal readonly record struct EdgeCollapse(Vector Offset, double Cost, double MaxCost)
{
    // Squared distances of all faces around an edge, as parts of its length squared. The first orders edges of flat surfaces by length;
    // what is gained by the second is no reason to move a vertex.
    private const double LengthPenalty = 1e-6;
    private const double Tolerance = 1e-13;

    // What breaks a rule costs as much as if all faces around the edge moved by a seventh of its length, and twice the error.
    private const double BrokenRulePenalty = 0.02;
    private const double BrokenRuleFactor = 2;

    // Farther from the middle of the edge, in its lengths, the planes meet by accident.
    private const double MaxDistance = 2;

    /// <summary>Plans the collapse of an edge: to the position with the smallest error, or to an end that is as good.</summary>
    /// <param name="edge">From the first end to the second.</param>
    /// <param name="quadric1">Quadric of the first end, with its origin there.</param>
    /// <param name="quadric2">Quadric of the second end, with its origin there.</param>
    public static EdgeCollapse Plan(Vector edge, in Quadric quadric1, in Quadric quadric2)
    {
        var sum = quadric1 + quadric2.WithOrigin(-edge);
        var lengthSquared = edge.LengthSquared();
        var middle = 0.5 * edge;
        var offset = sum.Minimize(middle);
        if (!((offset - middle).LengthSquared() <= MaxDistance * MaxDistance * lengthSquared))
        {
            offset = middle;
        }

        var scale = sum.Weight * lengthSquared;
        var (error, error1, error2) = (sum.ErrorAt(offset), sum.Constant, sum.ErrorAt(edge));
        if (Math.Min(error1, error2) <= error + (Tolerance * scale))
        {
            (offset, error) = error1 <= error2 ? (Vector.Zero, error1) : (edge, error2);
        }

        return new(offset, error + (LengthPenalty * scale), (BrokenRuleFactor * error) + (BrokenRulePenalty * scale));
    }
}
