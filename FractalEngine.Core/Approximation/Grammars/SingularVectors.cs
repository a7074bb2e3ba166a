namespace FractalEngine.Core.Approximation.Grammars;

/// <summary>Singular values and vectors of small matrices, by one-sided Jacobi rotations (Golub and Van Loan, §8.6).</summary>
internal static class SingularVectors
{
    private const int MaxSweeps = 40;

    /// <summary>Returns the singular values, unordered.</summary>
    /// <param name="matrix">[m, n]; its columns are made orthogonal.</param>
    /// <param name="vectors">The right singular vectors as columns, [n, n].</param>
    /// <remarks>Small values are exact to rounding of the largest one. Cost O(m·n²) a sweep, of which some eight are needed.</remarks>
    public static double[] Find(double[,] matrix, out double[,] vectors)
    {
        var size = matrix.GetLength(1);
        vectors = new double[size, size];
        for (var i = 0; i < size; i++)
        {
            vectors[i, i] = 1;
        }

        var isRotated = true;
        for (var sweep = 0; sweep < MaxSweeps && isRotated; sweep++)
        {
            isRotated = false;
            for (var p = 0; p < size; p++)
            {
                for (var q = p + 1; q < size; q++)
                {
                    isRotated |= Orthogonalize(matrix, vectors, p, q);
                }
            }
        }

        return [.. Enumerable.Range(0, size).Select(column => Math.Sqrt(Product(matrix, column, column)))];
    }

    private static bool Orthogonalize(double[,] matrix, double[,] vectors, int p, int q)
    {
        var (pp, qq, pq) = (Product(matrix, p, p), Product(matrix, q, q), Product(matrix, p, q));
        if (Math.Abs(pq) <= 1e-16 * Math.Sqrt(pp * qq) || pp * qq == 0)
        {
            return false;
        }

        var theta = (qq - pp) / (2 * pq);
        var tangent = Math.CopySign(1, theta) / (Math.Abs(theta) + Math.Sqrt((theta * theta) + 1));
        var cosine = 1 / Math.Sqrt((tangent * tangent) + 1);
        RotateColumns(matrix, p, q, cosine, tangent * cosine);
        RotateColumns(vectors, p, q, cosine, tangent * cosine);
        return true;
    }

    private static double Product(double[,] matrix, int column1, int column2)
    {
        var sum = 0.0;
        for (var row = 0; row < matrix.GetLength(0); row++)
        {
            sum += matrix[row, column1] * matrix[row, column2];
        }

        return sum;
    }

    private static void RotateColumns(double[,] matrix, int p, int q, double cosine, double sine)
    {
        for (var row = 0; row < matrix.GetLength(0); row++)
        {
            var entry = matrix[row, p];
            matrix[row, p] = (cosine * entry) - (sine * matrix[row, q]);
            matrix[row, q] = (sine * entry) + (cosine * matrix[row, q]);
        }
    }
}
