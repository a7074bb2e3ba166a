using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Rows;

/// <summary>Whether two bodies touch, hit or overlap each other, with any of their balls.</summary>
public sealed class BallPairsTests
{
    private static readonly CompoundShape Dumbbell = CompoundShape.OfBalls([new(-2 * Vector.I, 0.5), new(2 * Vector.I, 0.5)]);

    [Fact]
    public void Gap_OfTwoBalls_IsTheirDistanceLessBothRadii()
    {
        var compound = new Body(new(Vector.Zero, Dumbbell), 0);
        var ball = new Body(new(new(2, 3, 0), 0.25), 1);
        Near.Equal(2.25, BallPairs.Gap(compound, 1, ball, 0), 1e-15);
        Near.Equal(2.25, BallPairs.Gap(ball, 0, compound, 1), 1e-15);
        Near.Equal(5 - 0.75, BallPairs.Gap(compound, 0, ball, 0), 1e-15);
    }

    /// <summary>A millionth of the smaller radius counts as touching; of those in a heap, a thousandth more.</summary>
    [Theory]
    [InlineData(-0.1, false, false, true)]
    [InlineData(2.4e-7, false, false, true)]
    [InlineData(2.6e-7, false, false, false)]
    [InlineData(2.4e-4, true, false, false)]
    [InlineData(2.4e-4, false, true, false)]
    [InlineData(2.5e-4, true, true, true)]
    [InlineData(2.51e-4, true, true, false)]
    public void AreTouching_AcrossAGap_GoesByTheSmallerRadius(double gap, bool isInHeap, bool isOtherInHeap, bool areTouching)
    {
        var first = new Body(new(Vector.Zero, 0.5), 0) { HasHeapMargin = isInHeap };
        var second = new Body(new(new(0.75 + gap, 0, 0), 0.25), 1) { HasHeapMargin = isOtherInHeap };
        Assert.Equal(areTouching, BallPairs.AreTouching(first, second));
        Assert.Equal(areTouching, BallPairs.AreTouching(second, first));
    }

    [Theory]
    [InlineData(1, 0, 0.9, true)]
    [InlineData(1, 0, 1, false)]
    [InlineData(1, 0.5, 0.4, true)]
    [InlineData(1, 0.5, 0.6, false)]
    [InlineData(0, -1, 0.9, true)]
    [InlineData(-1, -1, 0, false)]
    public void AreHitting_AtASpeed_GoesByTheThresholdOfTheFirst(double speed, double otherSpeed, double threshold, bool areHitting)
    {
        var first = new Body(new(Vector.Zero, 0.5) { Velocity = new(speed, 7, 0) }, 0) { RestitutionThreshold = threshold };
        var second = new Body(new(new(1, 0, 0), 0.5) { Velocity = new(otherSpeed, -7, 0) }, 1) { RestitutionThreshold = 99 };
        Assert.Equal(areHitting, BallPairs.AreHitting(first, second));
    }

    [Fact]
    public void AreHitting_OfACompoundThatTurns_GoesByTheBallThatTouches()
    {
        var compound = new Body(new(Vector.Zero, Dumbbell) { AngularVelocity = 0.5 * Vector.K }, 0);
        var above = new Body(new(new(2, 1, 0), 0.5), 1);
        var below = new Body(new(new(2, -1, 0), 0.5), 2);
        Assert.True(BallPairs.AreHitting(compound, above));
        Assert.False(BallPairs.AreHitting(compound, below));
        compound.RestitutionThreshold = 0.99;
        Assert.True(BallPairs.AreHitting(compound, above));
        compound.RestitutionThreshold = 1.01;
        Assert.False(BallPairs.AreHitting(compound, above));
        Assert.True(BallPairs.AreTouching(below, compound));
        Assert.False(BallPairs.AreTouching(new Body(new(new(0, 1, 0), 0.5), 3), compound));
    }

    [Theory]
    [InlineData(0.75, 0, false)]
    [InlineData(0.7499, 0, true)]
    [InlineData(0.7251, 0.1, false)]
    [InlineData(0.7249, 0.1, true)]
    public void AreOverlapping_ByMoreThanAShare_GoesByTheSmallerRadius(double distance, double share, bool areOverlapping)
    {
        var first = new Body(new(Vector.Zero, 0.5), 0);
        var second = new Body(new(new(0, 0, distance), 0.25), 1);
        Assert.Equal(areOverlapping, BallPairs.AreOverlapping(first, second, share));
        Assert.Equal(areOverlapping, BallPairs.AreOverlapping(second, first, share));
    }

    [Fact]
    public void AreOverlapping_OfCompounds_TriesAllTheirBalls()
    {
        var first = new Body(new(Vector.Zero, Dumbbell), 0);
        var second = new Body(new(new(4, 0.9, 0), Dumbbell), 1);
        Assert.True(BallPairs.AreOverlapping(first, second, 0));
        Assert.True(BallPairs.AreOverlapping(second, first, 0));
        Assert.False(BallPairs.AreOverlapping(first, new Body(new(new(2, 0, 0), Dumbbell), 2), 0));
    }
}
