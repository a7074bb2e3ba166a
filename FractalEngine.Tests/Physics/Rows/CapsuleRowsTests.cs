using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Rows;

/// <summary>Which contacts of a capsule two others hold.</summary>
public class CapsuleRowsTests
{
    private const double Radius = 0.5;

    /// <summary>Balls in a row over a plane, or over steps below it.</summary>
    /// <param name="heights">Heights of the balls above what each touches, in their order.</param>
    /// <param name="kept">The balls whose contacts stay.</param>
    [Theory]
    [InlineData(new[] { 2.5, 2.5, 2.5, 2.5 }, new[] { 0, 3 })]
    [InlineData(new[] { 2.5, 3, 3.5, 4 }, new[] { 0, 3 })]
    [InlineData(new[] { 4.0, 3.5, 3, 2.5 }, new[] { 0, 3 })]
    [InlineData(new[] { 2.5, 2.4, 2.5, 2.5 }, new[] { 0, 1, 3 })]
    [InlineData(new[] { 2.5, 2.6, 2.6, 2.5 }, new[] { 0, 3 })]
    [InlineData(new[] { 2.5, 3 - 0.4e-9, 3.5 - 0.4e-9, 4 }, new[] { 0, 3 })]
    [InlineData(new[] { 2.5, 3 - 0.6e-9, 3.5, 4 }, new[] { 0, 1, 3 })]
    [InlineData(new[] { 2.5, 3, 3.5 - 0.6e-9, 4 }, new[] { 0, 2, 3 })]
    [InlineData(new[] { 2.5, 4 }, new[] { 0, 1 })]
    [InlineData(new[] { 2.5 }, new[] { 0 })]
    public void RemoveInner_OfARow_KeepsWhatLiesLowerThanTheLine(double[] heights, int[] kept) => Seeded.Run(5, random =>
    {
        var normal = random.Direction();
        ContactRow[] rows = [.. heights.Select((height, i) => Row(i, height, normal, random))];
        // In any order, which stays.
        random.Shuffle(rows);
        int[] expected = [.. rows.Select(static row => row.FeatureId).Where(kept.Contains)];
        var count = CapsuleRows.RemoveInner(rows);
        Assert.Equal(expected, rows[..count].Select(static row => row.FeatureId));
    });

    [Theory]
    [InlineData(0, 3e-9, 2)]
    [InlineData(0, 1e-7, 3)]
    [InlineData(1, 3e-9, 2)]
    [InlineData(1, 1e-7, 3)]
    [InlineData(2, 3e-9, 2)]
    [InlineData(2, 1e-7, 3)]
    public void RemoveInner_OfPlanesThatAreNotParallel_KeepsAll(int tilted, double angle, int count)
    {
        var random = new Random(1);
        ContactRow[] rows = [.. Enumerable.Range(0, 3).Select(i => Row(i, 2, Vector.J, random))];
        rows[tilted].Normal = new(angle, 1, 0);
        rows[tilted].Offset = new(0, 2, 0);
        Assert.Equal(count, CapsuleRows.RemoveInner(rows));
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(2)]
    public void RemoveInner_WithABall_KeepsAll(int ball)
    {
        var random = new Random(1);
        ContactRow[] rows = [.. Enumerable.Range(0, 3).Select(i => Row(i, 2, Vector.J, random))];
        rows[ball].IsBall = true;
        Assert.Equal(3, CapsuleRows.RemoveInner(rows));
    }

    /// <summary>Two contacts of one ball are not between each other.</summary>
    [Fact]
    public void RemoveInner_OfOneBallOnTwoFaces_KeepsBoth()
    {
        var random = new Random(1);
        ContactRow[] rows = [Row(1, 2, Vector.J, random), Row(1, 2, Vector.J, random), Row(2, 2, Vector.J, random)];
        Assert.Equal(3, CapsuleRows.RemoveInner(rows));
    }

    private static ContactRow Row(int ball, double height, Vector normal, Random random)
    {
        var side = Vector.Cross(normal, random.Direction());
        return new() { FeatureId = ball, Normal = normal, Offset = (height * normal) + side, FirstRadius = Radius };
    }
}
