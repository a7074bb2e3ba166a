using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars;

/// <summary>Solves s·h = g·s for pairs of maps h and g: of all maps s that do, the one nearest to a uniform scaling.</summary>
internal static class ConjugationSolver
{
    private const int Unknowns = 12;
    // Maps that flatten are none, though conditions that leave the scale free are met by them.
    private const double MinVolume = 1e-4;

    // No rotation, and half turns: each rotation is within a right angle of one of them.
    private static readonly ImmutableArray<double[]> Wishes =
        [WishOf(new(1, 1, 1)), WishOf(new(-1, -1, 1)), WishOf(new(-1, 1, -1)), WishOf(new(1, -1, -1))];

    // Of conditions whose entries are about 1.
    private const double NullTolerance = 1e-8;

    // Maps may move as they like, if only they turn and stretch little: the unit of translations among the unknowns.
    private const double TranslationUnit = 10_000;

    /// <summary>Returns the map, or null where only singular ones are found; where there is none, one that nearly does.</summary>
    /// <param name="pairs">Maps h, each with its g.</param>
    /// <param name="scale">The uniform scaling that is preferred where all are possible.</param>
    public static AffineMap? Solve((AffineMap From, AffineMap To)[] pairs, double scale)
    {
        // What the entries of s add to s·h − g·s, and what is left where all are zero.
        var constant = Residuals(pairs, default);
        var conditions = new double[constant.Length, Unknowns];
        for (var column = 0; column < Unknowns; column++)
        {
            var residuals = Residuals(pairs, ToMap([.. Enumerable.Range(0, Unknowns).Select(row => row == column ? 1.0 : 0)]));
            for (var row = 0; row < constant.Length; row++)
            {
                conditions[row, column] = residuals[row] - constant[row];
            }
        }

        var values = SingularVectors.Find(conditions, out var vectors);
        var fixedDirections = Enumerable.Range(0, Unknowns).Where(index => values[index] > NullTolerance).Select(index => (
            Vector: Enumerable.Range(0, Unknowns).Select(row => vectors[row, index]).ToArray(),
            Share: -constant.Select((entry, row) => entry * conditions[row, index]).Sum() / (values[index] * values[index]))).ToArray();
        var shortest = Combine(fixedDirections);
        foreach (var wish in Wishes)
        {
            var fixedPart = Combine(fixedDirections.Select(direction => (direction.Vector, Dot(direction.Vector, wish))));
            // The multiple of the wish that the solutions come nearest to; any where they come as near as they like.
            var nearest = Dot(fixedPart, fixedPart) > 1e-12 ? Dot(shortest, fixedPart) / Dot(fixedPart, fixedPart) : scale;
            foreach (var multiple in new[] { nearest, scale })
            {
                var map = ToMap(Combine([(shortest, 1), (wish, multiple), (fixedPart, -multiple)]));
                if (Math.Abs(map.Linear.Determinant()) > MinVolume * scale * scale * scale)
                {
                    return map;
                }
            }
        }

        return null;
    }

    private static double[] WishOf(Vector scale) => [scale.X, 0, 0, 0, scale.Y, 0, 0, 0, scale.Z, 0, 0, 0];

    private static AffineMap ToMap(double[] entries) => new(
        new(VectorAt(entries, 0), VectorAt(entries, 3), VectorAt(entries, 6)), TranslationUnit * VectorAt(entries, 9));

    /// <summary>The entries of s·h − g·s for all pairs.</summary>
    private static double[] Residuals((AffineMap From, AffineMap To)[] pairs, AffineMap map) => [.. pairs.SelectMany(pair =>
    {
        var (left, right) = (map * pair.From, pair.To * map);
        var linear = left.Linear - right.Linear;
        return new[] { linear.V1, linear.V2, linear.V3, left.Translation - right.Translation };
    }).SelectMany(column => new[] { column.X, column.Y, column.Z })];

    private static double[] Combine(IEnumerable<(double[] Vector, double Share)> terms)
    {
        var sum = new double[Unknowns];
        foreach (var (vector, share) in terms)
        {
            for (var row = 0; row < Unknowns; row++)
            {
                sum[row] += share * vector[row];
            }
        }

        return sum;
    }

    private static double Dot(double[] vector1, double[] vector2) => vector1.Zip(vector2, (entry1, entry2) => entry1 * entry2).Sum();

    private static Vector VectorAt(double[] values, int start) => new(values[start], values[start + 1], values[start + 2]);
}
