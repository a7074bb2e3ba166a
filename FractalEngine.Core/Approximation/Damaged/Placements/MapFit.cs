using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged.Placements;

/// <summary>The affine map that takes some placements nearest to others, by least squares over the vertices of their elements.</summary>
/// <remarks>
/// Vertices of a template have the covariance 1, so that the axes of placements count as all vertices do. Sums are about a centre.
/// </remarks>
internal sealed class MapFit(Vector centre)
{
    // Normals of flat elements are known for similarities only: they count where nothing else does.
    private const double NormalWeight = 1e-8;

    private Matrix _products;
    private Matrix _squares;
    private Vector _from;
    private Vector _to;
    private double _weight;

    /// <summary>Number of pairs of placements that were added.</summary>
    public int Count { get; private set; }

    /// <summary>Adds a pair of placements.</summary>
    /// <param name="from">The placement that the map is applied to.</param>
    /// <param name="to">The placement that it should become, after the symmetry that it was found by.</param>
    /// <param name="isFlat">Whether the template is flat.</param>
    /// <param name="weight">How much the pair counts.</param>
    public void Add(AffineMap from, AffineMap to, bool isFlat, double weight)
    {
        var (x, z) = (from.Translation - centre, to.Translation - centre);
        var normal = isFlat ? NormalWeight : 1;
        _products += weight * (Matrix.Outer(z, x) + Matrix.Outer(to.Linear.V1, from.Linear.V1) + Matrix.Outer(to.Linear.V2, from.Linear.V2)
            + (normal * Matrix.Outer(to.Linear.V3, from.Linear.V3)));
        _squares += weight * (Matrix.Outer(x, x) + Matrix.Outer(from.Linear.V1, from.Linear.V1)
            + Matrix.Outer(from.Linear.V2, from.Linear.V2)
            + (normal * Matrix.Outer(from.Linear.V3, from.Linear.V3)));
        (_from, _to, _weight) = (_from + (weight * x), _to + (weight * z), _weight + weight);
        Count++;
    }

    /// <summary>Returns the map; the one before counts a little where pairs tell nothing.</summary>
    public AffineMap Solve(AffineMap before)
    {
        if (Count == 0)
        {
            return before;
        }

        var (x, z) = (_from / _weight, _to / _weight);
        var squares = _squares - (_weight * Matrix.Outer(x, x));
        var little = 1e-12 * (squares.V1.X + squares.V2.Y + squares.V3.Z);
        var linear = (_products - (_weight * Matrix.Outer(z, x)) + (little * before.Linear))
            * (squares + (little * Matrix.Identity)).Inverse();
        return new(linear, centre + z - (linear * (centre + x)));
    }
}
