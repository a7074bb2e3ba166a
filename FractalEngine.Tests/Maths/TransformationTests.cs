using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Maths;

public class TransformationTests
{
    [Fact]
    public void Identity_ChangesNothing()
    {
        Assert.Equal(new(Vector.Zero, Vector.Zero, Vector.One), Transformation.Identity);
        Assert.Equal(AffineMap.Identity, Transformation.Identity.ToAffineMap());
        Assert.True(Transformation.Identity.IsIdentity);
    }

    [Fact]
    public void ToAffineMap_ScalesThenRotatesThenMoves() =>
        // (1, 0, 0) is stretched to (2, 0, 0), a yaw of 90° rotates it to (0, 0, 2), and it moves by (10, 0, 0).
        Assert.Equal(new(10, 0, 2), new Transformation(new(10, 0, 0), new(0, 90, 0), new(2, 1, 1)).ToAffineMap() * Vector.I);

    [Fact]
    public void ToAffineMap_OfAnyTransformation_EqualsTheMatricesWrittenByRows() => Seeded.Run(200, random =>
    {
        var transformation = random.Transformation();
        var point = random.Vector(5);
        // The rounding of positions up to 10 in three matrix products.
        Near.Equal(NaiveFractal.Apply(NaiveFractal.MapOf(transformation), point), transformation.ToAffineMap() * point, 1e-14);
    });

    [Fact]
    public void ToAffineMap_WithANegativeFactor_Mirrors() =>
        Assert.Equal(-6, new Transformation(Vector.One, new(0, 90, 0), new(1, -2, 3)).ToAffineMap().Linear.Determinant());

    [Fact]
    public void ComposeComponentwise_AddsPositionsAndRotationsAndMultipliesScales() => Assert.Equal(
        new(new(11, 22, 33), new(90, 0, -45), new(2, -6, 12)),
        Transformation.ComposeComponentwise(
            new(new(1, 2, 3), new(45, 0, 45), new(1, 2, 3)), new(new(10, 20, 30), new(45, 0, -90), new(2, -3, 4))));

    [Fact]
    public void ComposeComponentwise_InEitherOrder_IsTheSame() => Seeded.Run(100, random =>
    {
        var t1 = random.Transformation();
        var t2 = random.Transformation();
        Assert.Equal(Transformation.ComposeComponentwise(t1, t2), Transformation.ComposeComponentwise(t2, t1));
    });

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void ToString_InAnyCulture_WritesAsTheFilesDo(string culture) => Assert.Equal(
        "((0.5, 0, 0), (0, 90, 0), (1, 1, 1))",
        InCulture.Run(culture, () => new Transformation(new(0.5, 0, 0), new(0, 90, 0), Vector.One).ToString()));
}
