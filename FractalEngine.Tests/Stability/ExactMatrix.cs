using System.Numerics;
using FractalEngine.Core.Maths;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Stability;

/// <summary>
/// The determinant and the inverse of a matrix of doubles in exact arithmetic: entries are integers times a common power of two, and only
/// the last quotient rounds.
/// </summary>
internal sealed class ExactMatrix
{
    private readonly BigInteger[][] _rows;
    private readonly BigInteger _determinant;
    private readonly int _exponent;

    /// <param name="matrix">Finite, entries within 10²⁰⁰ of each other.</param>
    public ExactMatrix(Matrix matrix)
    {
        var (v1, v2, v3) = matrix;
        double[][] rows = [[v1.X, v2.X, v3.X], [v1.Y, v2.Y, v3.Y], [v1.Z, v2.Z, v3.Z]];
        _exponent = rows.SelectMany(row => row).Where(entry => entry != 0).Select(entry => Math.ILogB(entry) - 52).DefaultIfEmpty(0).Min();
        _rows = [.. rows.Select(row => row.Select(entry => ToInteger(entry, _exponent)).ToArray())];
        _determinant = Enumerable.Range(0, 3).Aggregate(BigInteger.Zero, (sum, column) => sum + (_rows[0][column] * Cofactor(0, column)));
    }

    public bool IsSingular => _determinant.IsZero;

    public double Determinant => Quotient(_determinant, 1, 3 * _exponent);

    /// <summary>Each entry is the double next to it, or but one.</summary>
    public Matrix Inverse => Matrix.FromRows(Row(0), Row(1), Row(2));

    /// <summary>Cofactors are transposed here.</summary>
    private Vector Row(int i) => new(Entry(0, i), Entry(1, i), Entry(2, i));

    private double Entry(int row, int column) => Quotient(Cofactor(row, column), _determinant, -_exponent);

    private BigInteger Cofactor(int row, int column)
    {
        var (r1, r2, c1, c2) = ((row + 1) % 3, (row + 2) % 3, (column + 1) % 3, (column + 2) % 3);
        return (_rows[r1][c1] * _rows[r2][c2]) - (_rows[r1][c2] * _rows[r2][c1]);
    }

    private static BigInteger ToInteger(double x, int exponent)
    {
        if (x == 0)
        {
            return 0;
        }

        var ulpExponent = Math.ILogB(x) - 52;
        return new BigInteger(Math.ScaleB(x, -ulpExponent)) << (ulpExponent - exponent);
    }

    /// <summary>Times a power of two; 120 bits are kept before the quotient is rounded to a double.</summary>
    private static double Quotient(BigInteger numerator, BigInteger denominator, int exponent)
    {
        var shift = 120 - (int)(BigInteger.Abs(numerator).GetBitLength() - BigInteger.Abs(denominator).GetBitLength());
        var quotient = shift >= 0 ? (numerator << shift) / denominator : numerator / (denominator << -shift);
        return Math.ScaleB((double)quotient, exponent - shift);
    }
}
