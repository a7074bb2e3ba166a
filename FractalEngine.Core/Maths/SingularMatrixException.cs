namespace FractalEngine.Core.Maths;

/// <summary>
/// The exception for the inversion of a matrix that has no inverse: its determinant is zero or out of the range of a double.
/// </summary>
public sealed class SingularMatrixException : ArithmeticException
{
    /// <summary>Creates an exception whose message names the matrix and its determinant.</summary>
    public SingularMatrixException(Matrix matrix)
        : base($"the matrix {matrix} has no inverse: its determinant is {FormatDeterminant(matrix)}") => Matrix = matrix;

    /// <summary>Creates an exception with a message.</summary>
    public SingularMatrixException(string message)
        : base(message)
    {
    }

    /// <summary>Creates an exception with a message and a cause.</summary>
    public SingularMatrixException(string message, Exception innerException)
        : base(message, innerException)
    {
    }

    /// <summary>Creates an exception with the default message.</summary>
    public SingularMatrixException()
    {
    }

    /// <summary>The matrix that has no inverse.</summary>
    public Matrix Matrix { get; }

    private static string FormatDeterminant(Matrix matrix) =>
        matrix.Determinant().ToString("R", System.Globalization.CultureInfo.InvariantCulture);
}
