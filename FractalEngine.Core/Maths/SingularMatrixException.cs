namespace FractalEngine.Core.Maths;

/// <summary>A matrix without an inverse was to be inverted; its determinant is zero or out of the range of a double.</summary>
public sealed class SingularMatrixException : FractalEngineException
{
    /// <summary>Makes the error of a given matrix.</summary>
    public SingularMatrixException(Matrix matrix)
        : base($"the matrix {matrix} has no inverse: its determinant is {FormatDeterminant(matrix)}") => Matrix = matrix;

    /// <summary>Makes the error of a matrix whose inverse is not one of doubles.</summary>
    internal SingularMatrixException(Matrix matrix, string fault)
        : base($"the inverse of the matrix {matrix} {fault}") => Matrix = matrix;

    /// <summary>The matrix that has no inverse.</summary>
    public Matrix Matrix { get; }

    private static string FormatDeterminant(Matrix matrix) =>
        matrix.Determinant().ToString("R", System.Globalization.CultureInfo.InvariantCulture);
}
