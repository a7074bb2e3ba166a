using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Draws sets of contracting maps by chance, in one of three styles.</summary>
/// <remarks>
/// Branches begin on the axis of a base that stands on the origin. Fixed points are corners of its box. Else maps move anywhere. Ratios and
/// rotations are such as people write in half of the cases, and any in the others.
/// </remarks>
/// <param name="random">Where all chance comes from.</param>
/// <param name="minRatio">The least that a map may scale by.</param>
/// <param name="isSkewed">Whether maps may have unequal scales, shears and mirrors.</param>
internal sealed class MapDrawer(SeededRandom random, double minRatio, bool isSkewed)
{
    /// <summary>The least and greatest ratio of any map here.</summary>
    public const double SmallestRatio = 0.2, LargestRatio = 0.9;

    // Maps that are closer than this, in any entry, would give elements that are hard to tell apart even by eye.
    private const double MinDifference = 0.03;

    private static readonly double[] NiceRatios =
        [0.2, 0.25, 0.3, 1.0 / 3, 0.4, 0.5, 0.6, (Math.Sqrt(5) - 1) / 2, 2.0 / 3, 0.7, 0.75, 0.8, 0.85, 0.9];

    private readonly double _spread = random.Between(0.4, 1.4);
    private readonly int _style = random.Index(3);

    /// <summary>Draws a set of maps of which no two are alike.</summary>
    public ImmutableArray<AffineMap> Draw(int count)
    {
        var maps = new List<AffineMap>();
        while (maps.Count < count)
        {
            var map = DrawMap(isSkewed && (maps.Count == 0 || random.Chance(0.7)));
            if (maps.TrueForAll(other => Difference(map, other) > MinDifference))
            {
                maps.Add(map);
            }
        }

        return [.. maps];
    }

    /// <summary>Draws a ratio between the least allowed one and 0.9.</summary>
    public double DrawRatio()
    {
        var nice = NiceRatios.Where(ratio => ratio >= minRatio).ToArray();
        return nice.Length > 0 && random.Chance(0.5) ? random.Pick<double>(nice) : random.Written(minRatio, LargestRatio);
    }

    /// <summary>Draws the identity, a rotation that people write, or any.</summary>
    public static Matrix DrawRotation(SeededRandom random) =>
        random.Chance(0.2) ? Matrix.Identity : random.Chance(0.45) ? random.NiceRotation() : random.GenericRotation();

    /// <summary>Computes the largest difference of two maps in any entry.</summary>
    public static double Difference(AffineMap map1, AffineMap map2) => Math.Max(
        (map1.Linear + (-1.0 * map2.Linear)).MaxAbsEntry(), (map1.Translation - map2.Translation).MaxAbsComponent());

    private AffineMap DrawMap(bool skewed)
    {
        var ratio = DrawRatio();
        var linear = ratio * (skewed ? DrawRotation(random) * DrawSkew() : DrawRotation(random));
        return _style switch
        {
            0 => DrawBranch(ratio, skewed),
            1 => FixCorner(linear),
            _ => new(linear, new(Coordinate(), Coordinate(), Coordinate())),
        };
    }

    private AffineMap DrawBranch(double ratio, bool skewed)
    {
        var angles = new Vector(0, random.Written(0, 360), random.Written(5, 65));
        var turn = angles.LocalAxesFromDegrees();
        var height = random.Chance(0.4) ? 1 : random.Written(0.4, 1);
        return new(ratio * (skewed ? turn * DrawSkew() : turn), new(0, height, 0));
    }

    private AffineMap FixCorner(Matrix linear)
    {
        var corner = new Vector(random.Pick(-0.5, 0, 0.5), random.Pick(0, 0.5, 1), random.Pick(-0.5, 0, 0.5));
        var fixedPoint = (0.6 + _spread) * corner;
        return new(linear, fixedPoint - (linear * fixedPoint));
    }

    private double Coordinate() => random.Written(-_spread, _spread);

    /// <summary>Draws unequal scales, a shear, a mirror or several of them, which lengthen nothing.</summary>
    private Matrix DrawSkew()
    {
        var what = random.Integer(1, 7);
        var factors = (what & 1) != 0
            ? new Vector(random.Written(0.45, 1), random.Written(0.45, 1), random.Written(0.45, 1)) : Vector.One;
        if ((what & 2) != 0)
        {
            factors = random.Pick(new Vector(-1, 1, 1), new Vector(1, 1, -1), new Vector(-1, -1, -1)).Stretch(factors);
        }

        var shear = (what & 4) != 0
            ? new Matrix(Vector.I, new(random.Written(-0.6, 0.6), 1, 0), new(0, random.Written(-0.4, 0.4), 1)) : Matrix.Identity;
        var skew = shear * Matrix.Diagonal(factors);
        return skew / skew.OperatorNorm();
    }
}
