using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Statics;

/// <summary>Paths of constant acceleration, and the clock that steps tick.</summary>
public class SphereMotionTests
{
    // The rounding of numbers of some units.
    private const double Tolerance = 1e-14;

    [Fact]
    public void Motion_UnderAnAcceleration_IsAParabola() => Seeded.Run(100, random =>
    {
        var motion = new SphereMotion(random.Vector(), random.Vector(2), random.Next(4) * random.Vector(2));
        var time = random.Between(0.1, 2);
        Near.Equal(motion.Start + (time * motion.Velocity) + (0.5 * time * time * motion.Acceleration), motion.PositionAt(time), Tolerance);
        Near.Equal(motion.Velocity + (time * motion.Acceleration), motion.VelocityAt(time), Tolerance);
        var distance = (time * motion.Velocity.Length()) + (0.5 * time * time * motion.Acceleration.Length());
        Near.Equal(distance, motion.MaxTravelDistance(time), Tolerance);
        Near.Equal(time, motion.MinTimeToTravel(distance), 1e-13);
        // Something comes towards it as well.
        Near.Equal(time, motion.MinTimeToTravel(distance + (3 * time), 3), 1e-13);
        Assert.Equal(double.PositiveInfinity, new SphereMotion(motion.Start, Vector.Zero, Vector.Zero).MinTimeToTravel(1));
        var box = motion.SweptBox(time);
        for (var i = 0; i <= 20; i++)
        {
            var position = motion.PositionAt(0.05 * i * time);
            Near.Equal(position, Vector.Max(box.Minimum, Vector.Min(box.Maximum, position)), Tolerance);
        }

        // No larger than the three points that control the curve.
        var control = motion.Start + (0.5 * time * motion.Velocity);
        var end = motion.PositionAt(time);
        Assert.Equal(Vector.Min(motion.Start, Vector.Min(control, end)), box.Minimum);
        Assert.Equal(Vector.Max(motion.Start, Vector.Max(control, end)), box.Maximum);
    });

    /// <summary>A run of equal steps is a product: its time has no sum of roundings.</summary>
    [Fact]
    public void Clock_OfEqualSteps_MultipliesAndAddsUpRuns()
    {
        var (clock, copy) = (new StepClock(), new StepClock());
        for (var i = 1; i <= 1000; i++)
        {
            clock.Tick(0.1);
            Assert.Equal(0.1 * i, clock.Time);
            Assert.Equal(i, clock.StepCount);
        }

        clock.Tick(0.5);
        clock.Tick(0.5);
        Assert.Equal((101.0, 1002L), (clock.Time, clock.StepCount));
        copy = clock;
        clock.Tick(0.25);
        Assert.Equal((101.25, 1003L), (clock.Time, clock.StepCount));
        Assert.Equal((101.0, 1002L), (copy.Time, copy.StepCount));
        copy.Tick(0.5);
        Assert.Equal((101.5, 1003L), (copy.Time, copy.StepCount));
        copy = default;
        Assert.Equal((0.0, 0L), (copy.Time, copy.StepCount));
        copy.Tick(0.5);
        Assert.Equal((0.5, 1L), (copy.Time, copy.StepCount));
    }
}
