using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Physics.Separation;

namespace FractalEngine.Tests.Physics.Separation;

/// <summary>What a gap takes from its contact.</summary>
public sealed class SeparationGapTests
{
    [Theory]
    [InlineData(false, false, false, 1.3, false, false)]
    [InlineData(true, false, false, 1, false, false)]
    [InlineData(false, true, false, 1.3, true, false)]
    [InlineData(true, true, true, 1, true, true)]
    public void Gap_OfBalls_HasWhatTheirContactSays(
        bool isAhead, bool hasFixedNormal, bool isBouncing, double relaxation, bool isPlane, bool isOneSided)
    {
        var gap = new SeparationGap(new ContactRow
        {
            First = 5, Second = 0, Offset = new(1, 2, 3), Normal = Vector.K, MinDistance = 0.75, FirstRadius = 0.5, SecondRadius = 0.25,
            IsBall = true, IsAhead = isAhead, HasFixedNormal = hasFixedNormal, IsBouncingAhead = isBouncing,
        });
        Assert.Equal((5, 0, new(1, 2, 3), Vector.K, 0.75), (gap.First, gap.Second, gap.Offset, gap.Normal, gap.MinDistance));
        Assert.Equal((relaxation, isPlane, isOneSided), (gap.Relaxation, gap.IsPlane, gap.IsOneSided));
        Assert.Equal(2.5e-8, gap.Aimed, 1e-20);
        Assert.Equal(7.5e-8, gap.Negligible, 1e-20);
    }

    [Fact]
    public void Gap_OfASurface_AllowsNoOverlap()
    {
        var row = new ContactRow { First = 1, Second = ContactRow.Immovable, Offset = new(1, 2, 3), MinDistance = 0.75 };
        row.SetSurface(Vector.I, Vector.J, new(0.5, 0.25, 4));
        var gap = new SeparationGap(in row);
        Assert.Equal((new Vector(0.5, 1.75, -1), true), (gap.Offset, gap.IsPlane));
        Assert.Equal((0.0, 0.0, 1.0), (gap.Aimed, gap.Negligible, gap.Relaxation));
        row.SetArms(Vector.I, Vector.J);
        row.TurnShift = new(0, 8, 16);
        Assert.Equal(new(0.5, 9.75, 15), new SeparationGap(in row).Offset);
    }
}
