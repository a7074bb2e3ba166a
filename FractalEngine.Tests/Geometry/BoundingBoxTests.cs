using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry;

public class BoundingBoxTests
{
    private static readonly BoundingBox Unit = new(Vector.Zero, Vector.One);

    [Fact]
    public void Empty_ContainsNothingAndIsNeutral()
    {
        Assert.True(BoundingBox.Empty.IsEmpty);
        Assert.Equal((Vector.Zero, Vector.Zero), (BoundingBox.Empty.Centre, BoundingBox.Empty.Size));
        Assert.Equal(Unit, BoundingBox.Union(Unit, BoundingBox.Empty));
        Assert.Equal(Unit, BoundingBox.Union(BoundingBox.Empty, Unit));
        Assert.True(BoundingBox.Empty.Transform(AffineMap.Translate(Vector.One)).IsEmpty);
    }

    [Fact]
    public void Including_FromEmpty_IsThePoint() => Assert.Equal(new(Vector.J, Vector.J), BoundingBox.Empty.Including(Vector.J));

    [Fact]
    public void Union_ContainsBoth() =>
        Assert.Equal(new(new(-1, 0, 0), new(1, 1, 5)), BoundingBox.Union(Unit, new(new(-1, 0, 2), new(0, 1, 5))));

    [Fact]
    public void Intersection_OfFlatBoxesThatRoundingParts_HoldsBothSidesOfTheGap()
    {
        // Both bound the same, such as a triangle at the height 0.3, and neither is as exact as the other.
        var box = BoundingBox.Intersection(
            new(new(-1, 0.1 + 0.2, 0), new(2, 0.1 + 0.2, 4)), new(new(0, 0.3, -1), new(3, 0.3, 3)));
        Assert.Equal(new(new(0, 0.3, 0), new(2, 0.1 + 0.2, 3)), box);
        Assert.False(box.IsEmpty);
    }

    [Fact]
    public void Intersection_WithTheEmptyBox_IsEmpty()
    {
        var box = new BoundingBox(Vector.Zero, Vector.One);
        Assert.Equal(BoundingBox.Empty, BoundingBox.Intersection(box, BoundingBox.Empty));
        Assert.Equal(BoundingBox.Empty, BoundingBox.Intersection(BoundingBox.Empty, BoundingBox.Empty));
    }

    [Fact]
    public void CentreSizeAndDiagonal_OfAnyBox_FollowFromItsCorners()
    {
        var box = new BoundingBox(new(-1, 0, 2), new(1, 3, 8));
        Assert.Equal((new(0, 1.5, 5), new(2, 3, 6), 7), (box.Centre, box.Size, box.Diagonal));
    }

    [Fact]
    public void Centre_OfAnEnormousBox_IsFinite() =>
        Assert.Equal(Vector.Zero, new BoundingBox(-1.7e308 * Vector.One, 1.7e308 * Vector.One).Centre);

    [Fact]
    public void Transform_ByAnyMap_IsTheSmallestBoxAroundTheImagesOfTheCorners() => Seeded.Run(200, random =>
    {
        var map = random.Transformation().ToAffineMap();
        var corners = Enumerable.Range(0, 8).Select(i => map * new Vector(i & 1, (i >> 1) & 1, i >> 2));
        var expected = NaiveFractal.Box(corners);
        var actual = Unit.Transform(map);
        // The rounding of coordinates up to 4.
        Near.Equal(expected.Minimum, actual.Minimum, 1e-14);
        Near.Equal(expected.Maximum, actual.Maximum, 1e-14);
    });
}
