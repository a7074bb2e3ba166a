using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;
using FsCheck.Fluent;

namespace FractalEngine.Tests.Maths;

public class VectorTests
{
    [Fact]
    public void Constants_AreThePapersOnes() => Assert.Equal(
        [new(0, 0, 0), new(1, 1, 1), new(1, 0, 0), new(0, 1, 0), new(0, 0, 1)],
        new[] { Vector.Zero, Vector.One, Vector.I, Vector.J, Vector.K });

    [Fact]
    public void Addition_AnyVectors_IsCommutativeAndUndoneBySubtraction() =>
        Laws.CheckForAll(Laws.Vectors.Two(), pair =>
            pair.Item1 + pair.Item2 == pair.Item2 + pair.Item1 && pair.Item1 + pair.Item2 - pair.Item2 == pair.Item1);

    [Fact]
    public void Negation_AnyVector_IsTheDifferenceFromZero() => Laws.CheckForAll(Laws.Vectors, v => -v == Vector.Zero - v);

    [Fact]
    public void Scaling_FromBothSides_IsTheSameAndDistributes() => Laws.CheckForAll(
        Laws.Vectors.Two(), pair => 3 * (pair.Item1 + pair.Item2) == (pair.Item1 * 3) + (pair.Item2 * 3));

    [Fact]
    public void Division_ByANumber_UndoesScaling() => Laws.CheckForAll(Laws.Vectors, v => 7 * v / 7 == v);

    [Fact]
    public void Dot_IsTheSumOfProducts() => Assert.Equal(32, Vector.Dot(new(1, 2, 3), new(4, 5, 6)));

    [Fact]
    public void Cross_OfTheAxes_IsTheThird() => Assert.Equal(
        [Vector.K, Vector.I, Vector.J],
        new[] { Vector.Cross(Vector.I, Vector.J), Vector.Cross(Vector.J, Vector.K), Vector.Cross(Vector.K, Vector.I) });

    [Fact]
    public void Cross_AnyVectors_IsPerpendicularToBothAndAntisymmetric() => Laws.CheckForAll(Laws.Vectors.Two(), pair =>
        Vector.Cross(pair.Item1, pair.Item2) == -Vector.Cross(pair.Item2, pair.Item1)
        && Vector.Dot(pair.Item1, Vector.Cross(pair.Item1, pair.Item2)) == 0);

    [Fact]
    public void Cross_AnyVectors_SatisfiesLagrangesIdentity() => Laws.CheckForAll(Laws.Vectors.Two(), pair =>
        Vector.Cross(pair.Item1, pair.Item2).LengthSquared()
            == (pair.Item1.LengthSquared() * pair.Item2.LengthSquared()) - Math.Pow(Vector.Dot(pair.Item1, pair.Item2), 2));

    [Fact]
    public void Stretch_AnyVectors_MultipliesComponentwise() => Assert.Equal(new(10, 40, 90), new Vector(1, 2, 3).Stretch(new(10, 20, 30)));

    [Fact]
    public void Length_OfAPythagoreanTriple_IsExact() => Assert.Equal(7, new Vector(2, -3, 6).Length());

    [Theory]
    [InlineData(1)]
    [InlineData(1e-150)]
    [InlineData(1e150)]
    [InlineData(1e-300)]
    [InlineData(1e300)]
    public void UnitVector_OfAnySize_HasLengthOneAndTheSameDirection(double size) => Seeded.Run(100, random =>
    {
        var direction = random.Direction();
        // The rounding of a handful of numbers up to 1.
        Near.Equal(direction, (size * direction).UnitVector(), 1e-15);
        Near.Equal(1, (size * direction).UnitVector().Length(), 1e-15);
    });

    [Fact]
    public void UnitVector_OfSubnormals_HasADirection() => Assert.Equal(Vector.J, new Vector(0, double.Epsilon, 0).UnitVector());

    [Theory]
    [InlineData(0)]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    public void UnitVector_WithoutDirection_IsRefused(double size) =>
        Assert.Throws<InvalidOperationException>(() => new Vector(size, 0, 0).UnitVector());

    [Fact]
    public void MinAndMax_AreComponentwise() => Assert.Equal(
        (new Vector(1, -5, 3), new Vector(4, 2, 3)), (Vector.Min(new(1, 2, 3), new(4, -5, 3)), Vector.Max(new(1, 2, 3), new(4, -5, 3))));

    [Theory]
    [InlineData(1, 2, 3, true)]
    [InlineData(double.NaN, 0, 0, false)]
    [InlineData(0, double.NegativeInfinity, 0, false)]
    public void IsFinite_ChecksEveryComponent(double x, double y, double z, bool expected) =>
        Assert.Equal(expected, new Vector(x, y, z).IsFinite());

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void ToString_InAnyCulture_WritesPoints(string culture) =>
        Assert.Equal("(0.5, -1.25, 1E-07)", InCulture.Run(culture, () => new Vector(0.5, -1.25, 1e-7).ToString()));
}
