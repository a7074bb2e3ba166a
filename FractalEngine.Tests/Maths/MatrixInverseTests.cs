using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Maths;

public class MatrixInverseTests
{
    [Fact]
    public void Inverse_OfAKnownMatrix_IsExact() => Assert.Equal(
        Matrix.FromRows(new(0, 1, 0), new(0, 0, 0.5), new(0.25, 0, 0)),
        Matrix.FromRows(new(0, 0, 4), new(1, 0, 0), new(0, 2, 0)).Inverse());

    [Theory]
    [InlineData(1, 1e-14)]
    [InlineData(1e3, 1e-12)]
    public void Inverse_OfAGivenCondition_UndoesTheMatrix(double condition, double tolerance) => Seeded.Run(200, random =>
    {
        var left = random.Orthogonal();
        var right = random.Orthogonal();
        var matrix = left * Matrix.Diagonal(new(1, 1 / Math.Sqrt(condition), 1 / condition)) * right;
        var expected = right.Transpose() * Matrix.Diagonal(new(1, Math.Sqrt(condition), condition)) * left.Transpose();
        // Rounding the entries of the matrix alone changes its inverse by condition × 1e-16 of itself.
        Near.Equal(expected, matrix.Inverse(), tolerance * condition);
    });

    [Theory]
    [InlineData(1e-150)]
    [InlineData(1e-100)]
    [InlineData(1e100)]
    [InlineData(1e150)]
    public void Inverse_OfHugeAndTinyEntries_NeitherOverflowsNorUnderflows(double size) => Seeded.Run(50, random =>
    {
        var rotation = random.Degrees().LocalAxesFromDegrees();
        Near.Equal(rotation.Transpose(), size * (size * rotation).Inverse(), 1e-14);
    });

    [Theory]
    [InlineData(1e100, 1, 1e-100)]
    [InlineData(1e100, 1e100, 1e-100)]
    [InlineData(1e100, 1e-100, 1e-100)]
    public void Inverse_OfAnyScaleThatFilesMayHave_IsTheReciprocalScale(double x, double y, double z)
    {
        var inverse = Matrix.Diagonal(new(x, y, z)).Inverse();
        Near.Equal(Vector.One, new Vector(x * inverse.V1.X, y * inverse.V2.Y, z * inverse.V3.Z), 1e-15);
    }

    [Fact]
    public void Inverse_OfTheInverse_IsTheMatrix() => Seeded.Run(200, random =>
    {
        var map = random.Transformation().ToAffineMap();
        // Scales from 0.3 to 0.7 have a condition number below 3.
        Near.Equal(map, map.Inverse().Inverse(), 1e-13);
    });

    [Theory]
    [InlineData(0, 0, 0)]
    [InlineData(1, 1, 0)]
    [InlineData(0, 1e150, 1)]
    public void Inverse_OfAFlatScale_Throws(double x, double y, double z)
    {
        var matrix = Matrix.Diagonal(new(x, y, z));
        var error = Assert.Throws<SingularMatrixException>(() => matrix.Inverse());
        Assert.Equal(matrix, error.Matrix);
        Assert.Contains("inverse", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Inverse_BeyondTheRangeOfADouble_NamesTheMatrix()
    {
        var matrix = Matrix.Diagonal(new(1e-310, 1, 1));
        Assert.Equal(matrix, Assert.Throws<SingularMatrixException>(() => matrix.Inverse()).Matrix);
    }

    [Fact]
    public void Inverse_OfParallelColumns_Throws() =>
        Assert.Throws<SingularMatrixException>(() => new Matrix(new(1, 2, 3), new(2, 4, 6), new(0, 0, 1)).Inverse());

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    public void Inverse_OfEntriesThatAreNotFinite_Throws(double entry) =>
        Assert.Throws<SingularMatrixException>(() => Matrix.Diagonal(new(1, entry, 1)).Inverse());

    [Fact]
    public void Inverse_OfASingularMap_Throws() => Assert.Throws<SingularMatrixException>(
        () => new Transformation(Vector.One, Vector.Zero, new(1, 0, 1)).ToAffineMap().Inverse());

    [Fact]
    public void Inverse_OfConditionTenToTheTwelve_IsOffByNoMoreThanThatTimesAnUlp() => Seeded.Run(200, random =>
    {
        var left = random.Orthogonal();
        var right = random.Orthogonal();
        var matrix = left * Matrix.Diagonal(new(1, 1e-6, 1e-12)) * right;
        var expected = right.Transpose() * Matrix.Diagonal(new(1, 1e6, 1e12)) * left.Transpose();
        // Rounding the entries of the matrix alone changes its inverse by 1e12 × 1e-16 of itself; a hundred times that is allowed.
        Near.Equal(expected, matrix.Inverse(), 1e-2 * 1e12);
    });
}
