using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Statics;

/// <summary>
/// Where an object is that moves by itself, and how fast its points are: a cube of side 1 about (1, 0, 0).
/// </summary>
public sealed class KinematicObjectTests
{
    // A few roundings of numbers about 10.
    private const double Rounding = 1e-14;

    private static readonly Vector QuarterTurn = 0.5 * Math.PI * Vector.K;

    [Fact]
    public void PlanPart_OfAStraightMotion_LeadsThereWithinTheStep()
    {
        var (set, moved) = Create();
        moved.SetMotion(new(2, 4, 0), Vector.Zero, time: 3);
        moved.BeginStep();
        moved.PlanPart(3, 0.5);
        set.Time = 0.25;
        Assert.Equal(new(6.5, 8, 7), moved.ToWorld(new(6, 7, 7)));
        Assert.Equal(new(6, 7, 7), moved.ToReference(new(6.5, 8, 7)));
        Assert.Equal((new(2, 4, 0), Math.Sqrt(20)), (moved.Velocity, moved.MaxSpeed));
        Assert.Equal(new(new(0.5, -0.5, -0.5), new(2.5, 2.5, 0.5)), moved.SweptBounds);
        Assert.Equal(Vector.I, moved.Pose.Position);
        moved.EndPart();
        set.Time = 0;
        Assert.Equal((new(2, 2, 0), Vector.I), (moved.Pose.Position, moved.PreviousPose.Position));
        Assert.Equal(new(7, 9, 7), moved.ToWorld(new(6, 7, 7)));
        // Exactly where the motion leads after any time.
        moved.PlanPart(7, 1);
        moved.EndPart();
        Assert.Equal(new(1 + (5 * 2), 5 * 4, 0), moved.Pose.Position);
    }

    [Fact]
    public void PlanPart_OfATurn_TurnsAboutTheOrigin()
    {
        var (set, moved) = Create();
        moved.SetMotion(new(0, 0, 4), QuarterTurn, time: 0);
        moved.PlanPart(0, 2);
        set.Time = 1;
        Near.Equal(new(1, 2, 7), moved.ToWorld(new(3, 0, 3)), Rounding);
        Near.Equal(new(3, 0, 3), moved.ToReference(new(1, 2, 7)), Rounding);
        Near.Equal(Vector.J, moved.Rotate(Vector.I), Rounding);
        Near.Equal(Vector.I, moved.RotateBack(Vector.J), Rounding);
        // Its corners are half a diagonal away.
        var radius = Math.Sqrt(0.75);
        Near.Equal(4 + (0.5 * Math.PI * radius), moved.MaxSpeed, Rounding);
        Near.Equal(new(1 - radius, -radius, -radius), moved.SweptBounds.Minimum, Rounding);
        Near.Equal(new(1 + radius, radius, 8 + radius), moved.SweptBounds.Maximum, Rounding);
        moved.EndPart();
        // Half a turn.
        set.Time = 0;
        Near.Equal(new(-1, 0, 11), moved.ToWorld(new(3, 0, 3)), Rounding);
        moved.SetMotion(Vector.Zero, Vector.Zero, 2);
        moved.PlanPart(2, 1);
        Near.Equal(new(1 - radius, -radius, 8 - radius), moved.SweptBounds.Minimum, Rounding);
        Assert.False(moved.IsMoving);
    }

    [Fact]
    public void VelocityAt_APoint_IsThatOfARigidBody()
    {
        var (set, moved) = Create();
        moved.SetMotion(new(0, 0, 4), 2 * Vector.K, 0);
        moved.PlanPart(0, 1);
        set.Time = 0.5;
        // The origin is at (1, 0, 2) then.
        Near.Equal(new(-6, 4, 4), moved.VelocityAt(new(3, 3, 9)), Rounding);
        // Coriolis, 2·ω × (v − along), and ω × (along − velocity).
        var along = new Vector(-6, 4, 4);
        var velocity = new Vector(1, 2, 3);
        var expected = Vector.Cross(2 * Vector.K, (2 * (velocity - along)) + new Vector(-6, 4, 0));
        foreach (var normal in new[] { Vector.I, Vector.J, Vector.K })
        {
            Near.Equal(Vector.Dot(expected, normal), moved.NormalAccelerationAt(new(3, 3, 9), normal, velocity), 1e-13);
        }

        moved.SetMotion(new(5, 6, 7), Vector.Zero, 0);
        Assert.Equal(new(5, 6, 7), moved.VelocityAt(new(100, 200, 300)));
    }

    /// <summary>A belt turns with its object, and moves along each face.</summary>
    [Fact]
    public void SurfaceVelocityAt_OfABelt_IsAlongTheFace()
    {
        var (set, moved) = Create();
        Assert.False(moved.IsCarrying);
        moved.Belt = new(3, 0, 4);
        Assert.Equal((false, true), (moved.IsMoving, moved.IsCarrying));
        Assert.Equal(new(3, 0, 0), moved.SurfaceVelocityAt(Vector.Zero, Vector.K));
        Assert.Equal(new(0, 0, 4), moved.SurfaceVelocityAt(Vector.Zero, Vector.I));
        moved.SetMotion(new(0, 8, 0), QuarterTurn, 0);
        moved.PlanPart(0, 1);
        set.Time = 1;
        Near.Equal(new(0, 11, 4), moved.SurfaceVelocityAt(new(1, 8, 0), Vector.I), Rounding);
        Near.Equal(new(0, 8, 4), moved.SurfaceVelocityAt(new(1, 8, 0), Vector.J), Rounding);
        Assert.Equal((true, true), (moved.IsMoving, moved.IsCarrying));
        moved.Belt = Vector.Zero;
        Near.Equal(new(0, 8, 0), moved.SurfaceVelocityAt(new(1, 8, 0), Vector.I), Rounding);
    }

    [Theory]
    [InlineData(1.5, 2, 0, 1.5, true)]
    [InlineData(1.5, 2, 0, 1.4999, false)]
    [InlineData(3.5, 0, 0, 2, true)]
    [InlineData(9e9, 0, 0, double.PositiveInfinity, true)]
    public void IsNear_APoint_GoesByItsBox(double x, double y, double z, double distance, bool isNear) =>
        Assert.Equal(isNear, Create().Moved.IsNear(new(x, y, z), distance));

    /// <summary>To and fro between both ends: the velocity of a part is that of the way between its ends.</summary>
    [Fact]
    public void PlanPart_OnAPath_GoesToAndFro()
    {
        var world = new PhysicsWorld(new Scene
        {
            Objects =
            [
                new SceneObject(PhysicsMeshes.Cube)
                {
                    Motion = new() { Velocity = 2 * Vector.I, From = Vector.Zero, To = 3 * Vector.I, Spin = new(0, 90, 0) },
                    Belt = Vector.K,
                },
            ],
        });
        var moved = world.StaticObjects[0].Kinematic!;
        Near.Equal(-0.5 * Math.PI * Vector.J, moved.AngularVelocity, 1e-15);
        moved.PlanPart(0, 1);
        Assert.Equal(new(2, 0, 0), moved.Velocity);
        moved.EndPart();
        moved.PlanPart(1, 1);
        moved.EndPart();
        // At 4 of 3 and back.
        Assert.Equal((Vector.Zero, new(2, 0, 0)), (moved.Velocity, moved.Pose.Position));
        moved.PlanPart(2, 0.5);
        Assert.Equal(new(-2, 0, 0), moved.Velocity);
        moved.Reset(1.25);
        Assert.Equal((new(2.5, 0, 0), Vector.K), (moved.Pose.Position, moved.Belt));
        Assert.Equal(moved.Pose, moved.PreviousPose);
        // Anything else ends the path.
        moved.SetMotion(Vector.J, Vector.Zero, 1.25);
        moved.PlanPart(1.25, 1);
        moved.EndPart();
        Assert.Equal(new(2.5, 1, 0), moved.Pose.Position);
        moved.Belt = Vector.Zero;
        moved.Reset(0);
        Assert.Equal((Vector.Zero, Vector.K, 2 * Vector.I), (moved.Pose.Position, moved.Belt, moved.Velocity));
    }

    [Fact]
    public void Time_OfAFrozenSet_StaysAsItIs()
    {
        var set = new KinematicSet { Time = 1 };
        set.IsFrozen = true;
        set.Time = 2;
        Assert.Equal(1, set.Time);
        set.IsFrozen = false;
        set.Time = 3;
        Assert.Equal(3, set.Time);
        set.BeginPart(5, 1);
        Assert.Equal(0, set.Time);
        set.Time = 4;
        set.EndPart();
        Assert.Equal(0, set.Time);
    }

    [Fact]
    public void MaxSpeedNear_AWay_IsThatOfTheFastestWhoseBoxItReaches()
    {
        var (set, moved) = Create();
        var other = new KinematicObject(set, new PhysicsWorld().AddStatic(PhysicsMeshes.Cube, Transformation.At(new(1, 5, 0))));
        Assert.Equal(0, set.MaxSpeedNear(new(Vector.Zero, Vector.Zero, Vector.Zero), 1, 99));
        set.Objects.AddRange([moved, other]);
        Assert.False(set.IsMoving);
        moved.SetMotion(3 * Vector.K, Vector.Zero, 0);
        Assert.True(set.IsMoving);
        other.SetMotion(2 * Vector.I, Vector.Zero, 0);
        set.BeginStep(0, 1);
        // Boxes from (0.5, −0.5, −0.5) to (1.5, 0.5, 3.5), and from (0.5, 4.5, −0.5) to (3.5, 5.5, 0.5).
        Assert.Equal(3, Speed(new(-3, 0, 0), new(2, 0, 0), 1.5));
        Assert.Equal(0, Speed(new(-3, 0, 0), new(2, 0, 0), 1.4999));
        Assert.Equal(2, Speed(new(1, 7, 0), new(0, -1, 0), 0.5));
        Assert.Equal(0, Speed(new(1, 7, 0), new(0, -1, 0), 0.4999));
        Assert.Equal(3, Speed(new(1, 7, 0), new(0, -6.5, 0), 0));
        Assert.Equal(0, Speed(new(1, 0, 5), Vector.Zero, 1.4999));
        Assert.Equal(3, Speed(new(1, 0, 5), Vector.Zero, 1.5));
        set.IsFrozen = true;
        Assert.Equal(0, Speed(new(1, 0, 0), Vector.Zero, 1));
        set.IsFrozen = false;
        moved.SetMotion(Vector.Zero, Vector.Zero, 0);
        Assert.True(set.IsMoving);
        other.SetMotion(Vector.Zero, Vector.Zero, 0);
        Assert.False(set.IsMoving);

        double Speed(Vector start, Vector velocity, double reach) => set.MaxSpeedNear(new(start, velocity, Vector.Zero), 1, reach);
    }

    private static (KinematicSet Set, KinematicObject Moved) Create()
    {
        var set = new KinematicSet();
        return (set, new(set, new PhysicsWorld().AddStatic(PhysicsMeshes.Cube, Transformation.At(Vector.I))));
    }
}
