using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars;

/// <summary>Solves the linear conditions of a conjugation: of all maps that meet them, the one nearest to a uniform scaling.</summary>
internal static class ConjugationSolver
{
    private const int Unknowns = 13;
    // Maps that flatten are none, though conditions that leave the scale free are met by them.
    private const double MinVolume = 1e-4;

    // No rotation, and half turns: each rotation is within a right angle of one of them.
    private static readonly ImmutableArray<double[]> Wishes =
        [WishOf(new(1, 1, 1)), WishOf(new(-1, -1, 1)), WishOf(new(-1, 1, -1)), WishOf(new(1, -1, -1))];

    // Of conditions whose entries are about 1.
    private const double NullTolerance = 1e-8;

    // Maps may move as they like, if only they turn and stretch little: translations count by that much.
    private const double TranslationWeight = 1e-4;

    /// <summary>Returns the map that all conditions vanish for, or null where only singular ones or none do.</summary>
    /// <param name="conditions">
    /// Linear conditions on the map's entries by columns, its translation, and 1, [conditions, 13]; changed by the call.
    /// </param>
    /// <param name="scale">The uniform scaling that is preferred where all are possible.</param>
    public static AffineMap? Solve(double[,] conditions, double scale)
    {
        var values = SingularVectors.Find(conditions, out var vectors);
        var basis = Enumerable.Range(0, Unknowns).Where(index => values[index] <= NullTolerance)
            .Select(index => Enumerable.Range(0, Unknowns).Select(row => vectors[row, index]).ToArray()).ToArray();
        var last = basis.Sum(vector => vector[12] * vector[12]);
        if (last < 1e-9)
        {
            return null;
        }

        // One solution, and the directions in which it may be changed, with translations in units that make them count less.
        var shortest = Combine(basis, vector => vector[12] / last);
        var solution = Weigh(shortest, TranslationWeight);
        var directions = Orthonormalize([.. basis.Select(
            vector => Weigh([.. vector.Zip(shortest, (entry, part) => entry - (vector[12] * part))], TranslationWeight))]);
        var fixedPart = Remove(directions, solution);
        foreach (var wish in Wishes)
        {
            var rest = Remove(directions, wish);
            // The multiple of the wish that the solutions come nearest to; any where they come as near as they like.
            var nearest = Dot(rest, rest) > 1e-12 ? Dot(rest, fixedPart) / Dot(rest, rest) : scale;
            foreach (var multiple in new[] { nearest, scale })
            {
                var free = wish.Zip(rest, (whole, part) => multiple * (whole - part));
                var map = ToMap([.. fixedPart.Zip(free, (entry, change) => entry + change)]);
                if (Math.Abs(map.Linear.Determinant()) > MinVolume * scale * scale * scale)
                {
                    return map;
                }
            }
        }

        return null;
    }

    private static double[] WishOf(Vector scale) => [scale.X, 0, 0, 0, scale.Y, 0, 0, 0, scale.Z, 0, 0, 0, 0];

    private static AffineMap ToMap(double[] weighed)
    {
        var entries = Weigh(weighed, 1 / TranslationWeight);
        return new(new(VectorAt(entries, 0), VectorAt(entries, 3), VectorAt(entries, 6)), VectorAt(entries, 9));
    }

    private static double[] Weigh(double[] vector, double weight) =>
        [.. vector.Select((entry, row) => row is >= 9 and < 12 ? weight * entry : entry)];

    /// <summary>Returns orthogonal unit vectors with the same span.</summary>
    private static double[][] Orthonormalize(double[][] vectors)
    {
        var matrix = new double[Unknowns, vectors.Length];
        for (var column = 0; column < vectors.Length; column++)
        {
            for (var row = 0; row < Unknowns; row++)
            {
                matrix[row, column] = vectors[column][row];
            }
        }

        var lengths = SingularVectors.Find(matrix, out _);
        return [.. Enumerable.Range(0, vectors.Length).Where(column => lengths[column] > 1e-10)
            .Select(column => Enumerable.Range(0, Unknowns).Select(row => matrix[row, column] / lengths[column]).ToArray())];
    }

    /// <summary>What is left of a vector without its part in the span of orthogonal unit vectors.</summary>
    private static double[] Remove(double[][] directions, double[] vector)
    {
        var rest = (double[])vector.Clone();
        foreach (var direction in directions)
        {
            var share = Dot(direction, vector);
            for (var row = 0; row < Unknowns; row++)
            {
                rest[row] -= share * direction[row];
            }
        }

        return rest;
    }

    private static double[] Combine(double[][] basis, Func<double[], double> shareOf)
    {
        var sum = new double[Unknowns];
        foreach (var vector in basis)
        {
            var share = shareOf(vector);
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
