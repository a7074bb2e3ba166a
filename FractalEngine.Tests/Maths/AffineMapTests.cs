using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;
using FsCheck.Fluent;

namespace FractalEngine.Tests.Maths;

public class AffineMapTests
{
    // The rounding of chains of two maps with entries up to some tens.
    private const double Tolerance = 1e-13;

    [Fact]
    public void Product_WithAPoint_IsLinearPartPlusTranslation() => Laws.CheckForAll(
        Laws.Maps.Zip(Laws.Vectors), pair => pair.Item1 * pair.Item2 == (pair.Item1.Linear * pair.Item2) + pair.Item1.Translation);

    [Fact]
    public void Composition_AppliedToAPoint_IsOneMapAfterTheOther() => Laws.CheckForAll(
        Laws.Maps.Two().Zip(Laws.Vectors), t => t.Item1.Item1 * t.Item1.Item2 * t.Item2 == t.Item1.Item1 * (t.Item1.Item2 * t.Item2));

    [Fact]
    public void Composition_OfThree_IsAssociative() =>
        Laws.CheckForAll(Laws.Maps.Three(), t => t.Item1 * t.Item2 * t.Item3 == t.Item1 * (t.Item2 * t.Item3));

    [Fact]
    public void Identity_OnEitherSide_ChangesNothing() =>
        Laws.CheckForAll(Laws.Maps, map => map * AffineMap.Identity == map && AffineMap.Identity * map == map);

    [Fact]
    public void Inverse_OfATransformation_UndoesIt() => Seeded.Run(200, random =>
    {
        var map = random.Transformation().ToAffineMap();
        var point = random.Vector(5);
        Near.Equal(point, map.Inverse() * (map * point), Tolerance);
        Near.Equal(AffineMap.Identity, map * map.Inverse(), Tolerance);
    });

    [Fact]
    public void Translate_MovesEveryPoint() => Assert.Equal(new(11, 22, 33), AffineMap.Translate(new(10, 20, 30)) * new Vector(1, 2, 3));

    [Fact]
    public void Rotate_AboutAPivot_IsThePapersFormula() => Seeded.Run(100, random =>
    {
        var rotation = random.Degrees();
        var pivot = random.Vector(5);
        var point = random.Vector(5);
        Near.Equal(pivot + (rotation.LocalAxesFromDegrees() * (point - pivot)), AffineMap.Rotate(rotation, pivot) * point, Tolerance);
    });

    [Fact]
    public void Scale_AboutAPivot_IsThePapersFormula() => Seeded.Run(100, random =>
    {
        var scale = random.Vector(3);
        var pivot = random.Vector(5);
        var point = random.Vector(5);
        Near.Equal(pivot + (point - pivot).Stretch(scale), AffineMap.Scale(scale, pivot) * point, Tolerance);
    });

    [Fact]
    public void RotateAndScale_AboutAPivot_KeepThePivot()
    {
        var pivot = new Vector(1, 2, 3);
        Assert.Equal(pivot, AffineMap.Rotate(new(90, 180, 270), pivot) * pivot);
        Assert.Equal(pivot, AffineMap.Scale(new(2, -4, 8), pivot) * pivot);
    }

    [Fact]
    public void Rotate_ByAQuarterAboutAPivot_IsExact() =>
        // Pitch has the rows [1 0 0; 0 c s; 0 −s c], so that it maps (0, 1, 0) to (0, 0, −1).
        Assert.Equal(new(1, 1, 0), AffineMap.Rotate(new(90, 0, 0), new(1, 1, 1)) * new Vector(1, 2, 1));

    [Fact]
    public void ChainOfScaleAndRotation_Shears()
    {
        var rotation = AffineMap.Rotate(new(0, 0, 45), Vector.Zero);
        var map = rotation * AffineMap.Scale(new(4, 1, 1), Vector.Zero) * rotation;
        Assert.True(Math.Abs(Vector.Dot(map * Vector.I, map * Vector.J)) > 1, "the axes stay perpendicular");
    }

    [Fact]
    public void IsFinite_ChecksAllTwelveEntries()
    {
        Assert.True(AffineMap.Identity.IsFinite());
        Assert.False(AffineMap.Translate(new(0, double.NaN, 0)).IsFinite());
        Assert.False(AffineMap.Scale(new(1, 1, double.PositiveInfinity), Vector.Zero).IsFinite());
    }

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void ToString_InAnyCulture_WritesPoints(string culture) => Assert.Equal(
        "[(1, 0, 0) (0, 1, 0) (0, 0, 1)] + (0.5, 0, 0)", InCulture.Run(culture, () => AffineMap.Translate(new(0.5, 0, 0)).ToString()));
}
