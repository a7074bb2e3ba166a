using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Tests.Physics.Statics;

/// <summary>The time of a world, which is exact over equal steps.</summary>
public sealed class StepClockTests
{
    [Fact]
    public void Tick_OfStepsOfSeveralLengths_AddsThemUp()
    {
        var clock = new StepClock();
        Assert.Equal((0.0, 0L), (clock.Time, clock.StepCount));
        clock.Tick(0.25);
        clock.Tick(0.25);
        Assert.Equal((0.5, 2L), (clock.Time, clock.StepCount));
        clock.Tick(2);
        Assert.Equal((2.5, 3L), (clock.Time, clock.StepCount));
        clock.Tick(0.25);
        clock.Tick(0.25);
        clock.Tick(0.25);
        Assert.Equal((3.25, 6L), (clock.Time, clock.StepCount));
    }

    [Fact]
    public void Copy_OfAClock_GoesOnAsItDoes()
    {
        var first = new StepClock();
        first.Tick(1);
        first.Tick(0.1);
        first.Tick(0.1);
        var second = new StepClock();
        second.Tick(7);
        second = first;
        Assert.Equal((first.Time, 3L), (second.Time, second.StepCount));
        first.Tick(0.1);
        second.Tick(0.1);
        // Three tenths at once, and not one after the other.
        Assert.Equal((1 + (3 * 0.1), 4L), (second.Time, second.StepCount));
        Assert.Equal(first.Time, second.Time);
    }

    [Theory]
    [InlineData(0.5)]
    [InlineData(1)]
    [InlineData(3)]
    public void Default_AfterSteps_IsANewClock(double step)
    {
        var clock = new StepClock();
        clock.Tick(3);
        clock.Tick(0.5);
        clock = default;
        Assert.Equal((0.0, 0L), (clock.Time, clock.StepCount));
        clock.Tick(step);
        Assert.Equal((step, 1L), (clock.Time, clock.StepCount));
    }
}
