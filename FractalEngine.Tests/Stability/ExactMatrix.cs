using System.Numerics;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Stability;

/// <summary>
/// Computes the determinant and the inverse of a matrix of doubles in exact arithmetic. Entries are integers times a common power of two,
/// and only the last quotient rounds.
/// </summary>
internal sealed class ExactMatrix
{
    private readonly BigInteger[][] _rows;
    private readonly BigInteger _determinant;
    private readonly int _exponent;

    /// <param name="matrix">A finite matrix, whose entries are within 10²⁰⁰ of each other.</param>
    public ExactMatrix(Matrix matrix)
    {
        var (v1, v2, v3) = matrix;
        double[][] rows = [[v1.X, v2.X, v3.X], [v1.Y, v2.Y, v3.Y], [v1.Z, v2.Z, v3.Z]];
        _exponent = ScaledInteger.CommonExponent(rows.SelectMany(row => row));
        _rows = [.. rows.Select(row => row.Select(entry => ScaledInteger.Of(entry, _exponent)).ToArray())];
        _determinant = Enumerable.Range(0, 3).Aggregate(BigInteger.Zero, (sum, column) => sum + (_rows[0][column] * Cofactor(0, column)));
    }

    public bool IsSingular => _determinant.IsZero;

    public double Determinant => ScaledInteger.Quotient(_determinant, 1, 3 * _exponent);

    /// <summary>The inverse, each entry of which is one of the two doubles next to it, or one further.</summary>
    public Matrix Inverse => Matrix.FromRows(Row(0), Row(1), Row(2));

    // Cofactors are transposed here.
    private Vector Row(int i) => new(Entry(0, i), Entry(1, i), Entry(2, i));

    private double Entry(int row, int column) => ScaledInteger.Quotient(Cofactor(row, column), _determinant, -_exponent);

    private BigInteger Cofactor(int row, int column)
    {
        var (r1, r2, c1, c2) = ((row + 1) % 3, (row + 2) % 3, (column + 1) % 3, (column + 2) % 3);
        return (_rows[r1][c1] * _rows[r2][c2]) - (_rows[r1][c2] * _rows[r2][c1]);
    }
}
