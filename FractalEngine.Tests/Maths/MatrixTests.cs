using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;
using FsCheck.Fluent;

namespace FractalEngine.Tests.Maths;

public class MatrixTests
{
    private static readonly Matrix Sample = Matrix.FromRows(new(1, 2, 3), new(4, 5, 6), new(7, 8, 10));

    [Fact]
    public void Product_WithAVector_CombinesTheColumns() => Laws.CheckForAll(Laws.Matrices.Zip(Laws.Vectors), pair =>
        pair.Item1 * pair.Item2 == (pair.Item2.X * pair.Item1.V1) + (pair.Item2.Y * pair.Item1.V2) + (pair.Item2.Z * pair.Item1.V3));

    [Fact]
    public void FromRows_AppliedToTheAxes_GivesTheColumns() => Assert.Equal(
        [new(1, 4, 7), new(2, 5, 8), new(3, 6, 10)], new[] { Sample * Vector.I, Sample * Vector.J, Sample * Vector.K });

    [Fact]
    public void Product_OfMatrices_AppliesTheSecondFirst() => Laws.CheckForAll(
        Laws.Matrices.Two().Zip(Laws.Vectors), t => t.Item1.Item1 * t.Item1.Item2 * t.Item2 == t.Item1.Item1 * (t.Item1.Item2 * t.Item2));

    [Fact]
    public void Product_OfMatrices_IsAssociativeButNotCommutative()
    {
        Laws.CheckForAll(Laws.Matrices.Three(), t => t.Item1 * t.Item2 * t.Item3 == t.Item1 * (t.Item2 * t.Item3));
        Assert.NotEqual(Matrix.Pitch(1) * Matrix.Yaw(1), Matrix.Yaw(1) * Matrix.Pitch(1));
    }

    [Fact]
    public void Identity_OnEitherSide_ChangesNothing() =>
        Laws.CheckForAll(Laws.Matrices, m => m * Matrix.Identity == m && Matrix.Identity * m == m);

    [Fact]
    public void Transpose_OfAProduct_ReversesTheOrder() => Laws.CheckForAll(
        Laws.Matrices.Two(), pair => (pair.Item1 * pair.Item2).Transpose() == pair.Item2.Transpose() * pair.Item1.Transpose());

    [Fact]
    public void Transpose_Twice_ChangesNothing() => Laws.CheckForAll(Laws.Matrices, m => m.Transpose().Transpose() == m);

    [Fact]
    public void Determinant_IsTheTripleProductOfTheColumns() => Assert.Equal(-3, Sample.Determinant());

    [Fact]
    public void Determinant_OfAProduct_IsTheProductOfDeterminants() => Seeded.Run(200, random =>
    {
        var m1 = new Matrix(random.Vector(), random.Vector(), random.Vector());
        var m2 = new Matrix(random.Vector(), random.Vector(), random.Vector());
        // The rounding of some dozens of numbers up to 27.
        Near.Equal(m1.Determinant() * m2.Determinant(), (m1 * m2).Determinant(), 1e-13);
    });

    [Fact]
    public void Cofactors_OfAnyMatrix_MapNormalsToNormals() => Laws.CheckForAll(Laws.Matrices.Zip(Laws.Vectors.Two()), t =>
        t.Item1.Cofactors() * Vector.Cross(t.Item2.Item1, t.Item2.Item2) == Vector.Cross(t.Item1 * t.Item2.Item1, t.Item1 * t.Item2.Item2));

    [Fact]
    public void Outer_MapsVToDotTimesTheFirst() =>
        Assert.Equal(new(32, 64, 96), Matrix.Outer(new(1, 2, 3), new(4, 5, 6)) * new Vector(1, 2, 3));

    [Fact]
    public void SkewSymmetric_MapsVToTheCrossProduct() =>
        Laws.CheckForAll(Laws.Vectors.Two(), pair => Matrix.SkewSymmetric(pair.Item1) * pair.Item2 == Vector.Cross(pair.Item1, pair.Item2));

    [Fact]
    public void Orthonormalized_OfADriftedRotation_IsARotationNearby() => Seeded.Run(100, random =>
    {
        var rotation = random.Degrees().LocalAxesFromDegrees();
        var drifted = rotation + (1e-6 * new Matrix(random.Vector(), random.Vector(), random.Vector()));
        var repaired = drifted.Orthonormalized();
        Near.Equal(Matrix.Identity, repaired.Transpose() * repaired, 1e-15 * 4);
        // It differs from the rotation by no more than a few times the drift.
        Near.Equal(rotation, repaired, 1e-5);
        Near.Equal(drifted.V3.UnitVector(), repaired.V3, 1e-15);
    });

    [Fact]
    public void KeepsBoxesAxisAligned_OfScalesMirrorsAndQuarterTurns_IsTrue()
    {
        Assert.True(Matrix.Diagonal(new(2, -3, 0.5)).KeepsBoxesAxisAligned());
        Assert.True(Matrix.Diagonal(new(1, 1, 0)).KeepsBoxesAxisAligned());
        Assert.True(new Vector(90, 180, 270).LocalAxesFromDegrees().KeepsBoxesAxisAligned());
        Assert.False(new Vector(0, 0, 45).LocalAxesFromDegrees().KeepsBoxesAxisAligned());
        Assert.False(Sample.KeepsBoxesAxisAligned());
    }

    [Fact]
    public void KeepsBoxesAxisAligned_WithTwoColumnsAlongOneAxis_IsTrueAndTheMatrixIsNoPermutation()
    {
        var matrix = new Matrix(Vector.I, 2 * Vector.I, Vector.K);
        Assert.True(matrix.KeepsBoxesAxisAligned());
        Assert.False(matrix.IsScaledAxisPermutation());
    }

    [Fact]
    public void IsScaledAxisPermutation_OfInvertibleOnes_IsTrue()
    {
        Assert.True(Matrix.Diagonal(new(2, -3, 0.5)).IsScaledAxisPermutation());
        Assert.True(new Matrix(-Vector.J, 3 * Vector.K, Vector.I).IsScaledAxisPermutation());
        Assert.False(Matrix.Diagonal(new(1, 1, 0)).IsScaledAxisPermutation());
        Assert.False(new Vector(0, 0, 45).LocalAxesFromDegrees().IsScaledAxisPermutation());
    }

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void ToString_InAnyCulture_WritesPoints(string culture) =>
        Assert.Equal("[(0.5, 0, 0) (0, 1, 0) (0, 0, -1.5)]", InCulture.Run(culture, () => Matrix.Diagonal(new(0.5, 1, -1.5)).ToString()));
}
