using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Objects that move by themselves: what they push, what they carry, and that they pass nothing.</summary>
public class MovingObjectTests
{
    // Relative to a radius: the moment of an impact is found to 1e-10 of it, and some more is rounding at speed.
    private const double Overlap = 1e-9;

    /// <summary>
    /// A step has as many parts as a plate needs that goes a quarter of the smallest radius near it in each, 64 at most. In each part the
    /// island of two balls is solved once. Beyond that there are no islands: balls are stepped as bodies of any shape.
    /// </summary>
    [Theory]
    [InlineData(7.4, 0.5, 1)]
    [InlineData(7.6, 0.5, 2)]
    [InlineData(14.9, 0.5, 2)]
    [InlineData(22.6, 0.5, 4)]
    [InlineData(7.4, 0.25, 2)]
    [InlineData(7.6, 0.25, 3)]
    [InlineData(479, 0.5, 64)]
    [InlineData(481, 0.5, 0)]
    public void Plate_UnderBalls_GoesInAsManyPartsAsItsWayNeeds(double speed, double radius, int parts)
    {
        var world = new PhysicsWorld();
        var plate = world.AddStatic(PhysicsMeshes.Cube, new(new(0, -0.5, 0), Vector.Zero, new(1e6, 1, 9)));
        world.AddRange([new(new(0, 0.5, 0), 0.5), new(new(0.5 + radius, radius, 0), radius)]);
        plate.SetMotion(new(speed, 0, 0));
        world.Step();
        Assert.Equal(parts, world.IslandStatistics.Solves);
    }

    /// <summary>A character near the plate counts as a body of its radius; the balls are far from it.</summary>
    [Theory]
    [InlineData(4.4, 1, true)]
    [InlineData(4.6, 2, true)]
    [InlineData(4.6, 1, false)]
    public void Plate_BesideACharacter_GoesInAsManyPartsAsItsWayNeeds(double speed, int parts, bool isActive)
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.FloorMesh());
        var plate = world.AddStatic(PhysicsMeshes.Cube, new(new(-2.5, 1.2, 0), Vector.Zero, new(1, 2, 1)));
        world.AddRange([new(new(20, 0.5, 0), 0.5), new(new(21, 0.5, 0), 0.5)]);
        world.AddCharacter(new(new(0, 0.9, 0), 0.3, 1.8)).IsActive = isActive;
        plate.SetMotion(new(0, speed, 0));
        world.Step();
        Assert.Equal(1, world.IslandStatistics.Solves);
        // From 2 units away to a height away from the box of the way.
        plate.MoveTo(new(new(-2.2, 1.2, 0), Vector.Zero, new(1, 2, 1)));
        plate.SetMotion(new(0, speed, 0));
        world.Step();
        Assert.Equal(1 + parts, world.IslandStatistics.Solves);
    }

    [Theory]
    [InlineData(1, 0)]
    [InlineData(1, 1)]
    [InlineData(10, 0.5)]
    [InlineData(50, 1)]
    [InlineData(200, 0)]
    [InlineData(200, 0.5)]
    [InlineData(200, 1)]
    [InlineData(10_000, 0)]
    [InlineData(10_000, 0.5)]
    public void Plate_ThatHitsABall_ThrowsItAndPassesNothing(double speed, double restitution)
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var plate = world.AddStatic(PhysicsMeshes.Cube, Box(new(-3.3, 0.1, 0.2), new(0.05, 4, 4)));
        var body = world.AddSphere(Vector.Zero, 0.5, restitution, friction: 0.3);
        plate.SetMotion(new(speed, 0, 0));
        world.Run(240, () => Assert.True(Lead(body, plate, 0.025) > -Overlap, $"overlaps by {-Lead(body, plate, 0.025):R}"));
        Near.Equal(new((1 + restitution) * speed, 0, 0), body.Velocity, 1e-9 * speed);
    }

    [Theory]
    [InlineData(5)]
    [InlineData(20)]
    [InlineData(200)]
    public void Plate_ThatPushesManyBalls_PassesNone(double speed)
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.Cube, Box(new(0, -0.5, 0), new(4000, 1, 40)));
        var plate = world.AddStatic(PhysicsMeshes.Cube, Box(new(-3.3, 2.05, 0), new(0.1, 4, 8)));
        world.AddRange(from i in Enumerable.Range(0, 5)
                       from j in Enumerable.Range(0, 5)
                       select new BodyDescription(new(1.02 * i, 0.5, (1.02 * j) - 2.04), 0.5) { Friction = 0.3, Restitution = 0.2 });
        plate.SetMotion(new(speed, 0, 0));
        world.Run(60, () => Assert.All(world.Bodies, body => Assert.True(Lead(body, plate, 0.05) > -2e-6, $"{body.Name} is overrun")));
        Assert.All(world.Bodies, static body => Assert.False(body.IsStuck));
    }

    /// <summary>Balls that do not bounce go on with the plate, in steps that are no longer made in parts.</summary>
    [Fact]
    public void Plate_ThatCarriesBallsAlong_GivesThemItsSpeed()
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.Cube, Box(new(0, -0.5, 0), new(4000, 1, 40)));
        var plate = world.AddStatic(PhysicsMeshes.Cube, Box(new(-3.3, 2.05, 0), new(0.1, 4, 8)));
        world.AddRange(from i in Enumerable.Range(0, 5) select new BodyDescription(new(1.02 * i, 0.5, 0), 0.5) { Friction = 0.3 });
        plate.SetMotion(new(200, 0, 0));
        world.Run(10);
        var solves = world.IslandStatistics.Solves;
        world.Run(20);
        Assert.Equal(20, world.IslandStatistics.Solves - solves);
        Assert.All(world.Bodies, static body => Assert.Equal(200, body.Velocity.X, 1e-3));
    }

    [Theory]
    [InlineData(20, 0.3)]
    public void Blade_ThatTurns_CutsThroughNothing(double angularSpeed, double friction) =>
        CheckBlade(angularSpeed, friction, worlds: 1, steps: 20);

    [Theory]
    [InlineData(2, 0.3)]
    [InlineData(20, 0)]
    [InlineData(60, 0.5)]
    [Trait("Category", "Soak")]
    public void Blade_ThatTurnsInManyWorlds_CutsThroughNothing(double angularSpeed, double friction) =>
        CheckBlade(angularSpeed, friction, worlds: 10, steps: 240);

    /// <summary>
    /// Without gravity a blade throws a ball off its end, 4 from its axis. Friction slows down its way outwards, and costs little: the ball
    /// follows the face.
    /// </summary>
    [Theory]
    [InlineData(20, 0.3)]
    [InlineData(-20, 0.5)]
    public void Blade_WithFriction_ThrowsABallNoFasterThanWithout(double angularSpeed, double friction)
    {
        var (speed, cost) = ThrowByBlade(angularSpeed, friction);
        var (smoothSpeed, smoothCost) = ThrowByBlade(angularSpeed, 0);
        Assert.InRange(speed, 4 * Math.Abs(angularSpeed), 0.99 * smoothSpeed);
        Assert.InRange(cost, 1, 2 * smoothCost);
    }

    private static (double Speed, long Cost) ThrowByBlade(double angularSpeed, double friction)
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var blade = world.AddStatic(PhysicsMeshes.Cube, Box(new(0, 1, 0), new(8, 2, 0.1)));
        var body = world.Add(new(new(2, 1, 0.5), 0.3) { Friction = friction });
        blade.SetMotion(Vector.Zero, new(0, angularSpeed, 0));
        var cost = 0L;
        world.Run(30, () => cost += world.LastStepCost.FaceTests + world.LastStepCost.BoundTests);
        return (body.Velocity.Length(), cost);
    }

    [Theory]
    [InlineData(-1, 0)]
    [InlineData(-1, 0.5)]
    [InlineData(-0.03, 0.5)]
    [InlineData(2, 0.5)]
    public void Lift_WithABallOnIt_KeepsItWithoutAGap(double speed, double friction)
    {
        var world = new PhysicsWorld();
        var lift = world.AddStatic(PhysicsMeshes.Cube, Box(new(0, -0.5, 0), new(4, 1, 4)));
        var body = world.AddSphere(new(0.1, 0.5, 0), 0.5, 0.3, friction: friction);
        world.Run(60);
        lift.SetMotion(new(0, speed, 0));
        // The lift starts at once, and the ball has to fall after it first.
        world.Run(120);
        world.Run(240, () => Assert.InRange(body.Position.Y - 0.5 - lift.Placement.Position.Y - 0.5, -1e-9, 1e-6));
        Near.Equal(new(0, speed, 0), body.Velocity, 1e-9);
        Assert.False(body.IsAsleep);
    }

    [Theory]
    [InlineData(3, 0.5)]
    public void Bucket_ThatIsLifted_LosesNoBall(double speed, double friction) => CheckBucket(speed, friction);

    [Theory]
    [InlineData(1, 0)]
    [InlineData(-1, 0.5)]
    [Trait("Category", "Soak")]
    public void Bucket_ThatIsLiftedAndLowered_LosesNoBall(double speed, double friction) => CheckBucket(speed, friction);

    private static void CheckBucket(double speed, double friction)
    {
        var world = new PhysicsWorld();
        StaticObject[] bucket =
        [
            world.AddStatic(PhysicsMeshes.Cube, Box(new(0, -0.5, 0), new(4, 1, 4))),
            world.AddStatic(PhysicsMeshes.Cube, Box(new(2.05, 4, 0), new(0.1, 10, 4.2))),
            world.AddStatic(PhysicsMeshes.Cube, Box(new(-2.05, 4, 0), new(0.1, 10, 4.2))),
            world.AddStatic(PhysicsMeshes.Cube, Box(new(0, 4, 2.05), new(4.2, 10, 0.1))),
            world.AddStatic(PhysicsMeshes.Cube, Box(new(0, 4, -2.05), new(4.2, 10, 0.1))),
        ];
        var random = new Random(1);
        world.AddRange(Enumerable.Range(0, 40).Select(i => new BodyDescription(
            new(random.Between(-1, 1), 1 + (0.5 * i), random.Between(-1, 1)), 0.3)
        {
            Friction = friction, RollingFriction = 0.05, Restitution = 0.2,
        }));
        world.Run(240);
        Array.ForEach(bucket, part => part.SetMotion(new(0, speed, 0)));
        world.Run(180, () => Assert.All(world.Bodies, body =>
        {
            Assert.True(body.Position.Y - 0.3 - bucket[0].Placement.Position.Y - 0.5 > -2e-6, $"{body.Name} has fallen through");
            Assert.True(Math.Max(Math.Abs(body.Position.X), Math.Abs(body.Position.Z)) < 1.7 + 2e-6, $"{body.Name} has left");
        }));
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Belt_WithABodyOnIt_GivesItItsSpeed(bool isLocked)
    {
        var world = new PhysicsWorld();
        var belt = world.AddStatic(PhysicsMeshes.Cube, Box(new(0, -0.5, 0), new(400, 1, 400)));
        // What leads out of the surface moves nothing.
        belt.SetBelt(new(2, 0.5, 0));
        var body = world.Add(new(new(0.1, 0.5, 0), 0.5) { Friction = 0.5, RollingFriction = 0.1, IsRotationLocked = isLocked });
        world.Run(600);
        Near.Equal(new(2, 0, 0), body.Velocity, 1e-6);
        Near.Equal(0.5, body.Position.Y, 1e-9);
        Near.Equal(Vector.Zero, body.AngularVelocity, 1e-6);
    }

    [Fact]
    public void Belt_WithoutRollingFriction_LetsABallSlideThenRoll()
    {
        // At first the ball slides, with the acceleration μ·g; it rolls once its speed is 2/7 of the belt's.
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.Cube, Box(new(0, -0.5, 0), new(400, 1, 400))).SetBelt(new(2, 0, 0));
        var body = world.Add(new(new(0, 0.5, 0), 0.5) { Friction = 0.05 });
        world.Run(30);
        Near.Equal(0.05 * 9.8 * 0.5, body.Velocity.X, 1e-5);
        world.Run(300);
        Near.Equal(2 * 2 / 7.0, body.Velocity.X, 1e-6);
        Near.Equal((body.Velocity.X - 2) / -0.5, body.AngularVelocity.Z, 1e-6);
    }

    [Theory]
    [InlineData(0.5)]
    [InlineData(2)]
    public void Turntable_WithABodyThatDoesNotTurn_CarriesItRound(double angularSpeed)
    {
        var body = CreateOnTurntable(angularSpeed, new(Vector.Zero, 1) { Friction = 0.8, IsRotationLocked = true }, out var world);
        world.Run(600);
        // Each step leads along a chord with a curve: the way out is (ωΔt)⁴/8 of the radius.
        Near.Equal(1, (body.Position with { Y = 0 }).Length(), 1e-5);
        var angle = angularSpeed * 10;
        Near.Equal(new(Math.Cos(angle), 0.5, -Math.Sin(angle)), body.Position, 1e-3 * angle);
    }

    [Fact]
    public void Turntable_WithABallThatRolls_LetsItCircleAtTwoSeventhsOfItsRate()
    {
        // A ball that rolls on a turntable goes round at 2/7 of its rate, wherever its centre is.
        const double AngularSpeed = 1;
        var body = CreateOnTurntable(AngularSpeed, new(Vector.Zero, 1) { Friction = 5 }, out var world);
        world.Run(60);
        var start = body.Velocity;
        world.Run(120);
        var angle = Math.Acos(Vector.Dot(start.UnitVector(), body.Velocity.UnitVector()));
        Near.Equal(2 / 7.0 * AngularSpeed * 2, angle, 1e-3);
        Near.Equal(start.Length(), body.Velocity.Length(), 1e-3 * start.Length());
    }

    [Fact]
    public void Wall_BeforeAMover_LeavesTheBallStuckUntilItHasGone()
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.FloorMesh());
        world.AddStatic(PhysicsMeshes.Cube, Box(new(3, 2, 0), new(1, 4, 8)));
        var plate = world.AddStatic(PhysicsMeshes.Cube, Box(new(-1, 2.05, 0), new(0.1, 4, 8)));
        var body = world.AddSphere(new(0, 0.5, 0), 0.5);
        plate.SetMotion(new(1, 0, 0));
        world.Run(170);
        Assert.True(body.IsStuck);
        Near.Equal(new(2, 0.5, 0), body.Position, 1e-3);
        Assert.Equal(Vector.Zero, body.Velocity);
        plate.SetMotion(new(-1, 0, 0));
        world.Run(100);
        Assert.False(body.IsStuck);
    }

    [Fact]
    public void Sleeper_ThatAMoverReaches_Wakes()
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.FloorMesh());
        var plate = world.AddStatic(PhysicsMeshes.Cube, Box(new(-3, 2.05, 0), new(0.1, 4, 8)));
        var body = world.AddSphere(new(0, 0.5, 0), 0.5, friction: 0.5);
        world.Run(120);
        plate.SetMotion(new(1, 0, 0));
        world.Run(60);
        Assert.True(body.IsAsleep);
        world.Run(120);
        Assert.Equal(1, body.Velocity.X, 1e-9);
    }

    [Fact]
    public void Capsule_OnLiftBeltAndBeforeAPlate_IsCarriedAndPushed()
    {
        var world = new PhysicsWorld();
        var lift = world.AddStatic(PhysicsMeshes.Cube, Box(new(0, -0.5, 0), new(4, 1, 4)));
        var belt = world.AddStatic(PhysicsMeshes.Cube, Box(new(100, -0.5, 0), new(100, 1, 8)));
        world.AddStatic(PhysicsMeshes.Cube, Box(new(500, -0.5, 100), new(1000, 1, 20)));
        var plate = world.AddStatic(PhysicsMeshes.Cube, Box(new(-4, 2.05, 100), new(0.1, 4, 8)));
        var capsule = CompoundShape.Capsule(new(-0.5, 0, 0), new(0.5, 0, 0), 0.3);
        var bodies = ((Vector[])[new(0, 0.3, 0), new(80, 0.3, 0), new(5, 0.3, 100)])
            .Select(position => world.Add(new(position, capsule) { Friction = 0.5, RollingFriction = 0.1 })).ToArray();
        lift.SetMotion(new(0, -1, 0));
        belt.SetBelt(new(2, 0, 0));
        plate.SetMotion(new(20, 0, 0));
        world.Run(60);
        world.Run(120, () =>
        {
            Near.Equal(lift.Placement.Position.Y + 0.5 + 0.3, bodies[0].Position.Y, 1e-6);
            // It may stand across the plate: then only its radius is before it.
            Assert.True(bodies[2].Position.X - 0.3 > plate.Placement.Position.X + 0.05 - 1e-6, "passed");
        });
        Near.Equal(new(2, 0, 0), bodies[1].Velocity, 1e-3);
        Assert.True(bodies[2].Velocity.X > 15, $"{bodies[2].Velocity}");
    }

    [Fact]
    public void Path_LeadsToAndFro_AndEndsWhereItShould()
    {
        var motion = new ObjectMotion { Velocity = new(0, 2, 0), From = new(1, 0, 0), To = new(1, 3, 0) };
        var start = new Vector(1, 1, 0);
        foreach (var (time, height) in ((double, double)[])[(0, 1), (0.5, 2), (1, 3), (1.5, 2), (2.5, 0), (3, 1), (30, 1)])
        {
            Near.Equal(new(1, height, 0), motion.PositionAt(start, time), 1e-12);
        }

        // At first towards where the path begins.
        foreach (var (time, height) in ((double, double)[])[(0.25, 0.5), (0.5, 0), (1, 1), (2, 3), (3, 1), (30, 1)])
        {
            Near.Equal(new(1, height, 0), (motion with { Velocity = new(0, -2, 0) }).PositionAt(start, time), 1e-12);
        }

        Assert.Null(motion.FindFault(start));
        Assert.Equal("the object's position must lie on the path, between its ends", motion.FindFault(new(0, 1, 0)));
        Assert.Equal("the velocity must lead along the path", (motion with { Velocity = new(1, 1, 0) }).FindFault(start));
        Assert.Equal("the ends of the path must differ", (motion with { To = motion.From }).FindFault(start));
        Assert.Null(motion.MovedBy(new(5, 5, 5)).FindFault(start + new Vector(5, 5, 5)));
    }

    [Fact]
    public void Scene_WithMotions_MovesItsObjectsAndResets()
    {
        var lift = new SceneObject(PhysicsMeshes.Cube)
        {
            Motion = new() { Velocity = new(0, 2, 0), From = Vector.Zero, To = new(0, 3, 0) },
        };
        var turntable = new SceneObject(PhysicsMeshes.Cube)
        {
            Placement = Transformation.At(new(9, 0, 0)) with { Rotation = new(0, 10, 0) }, Motion = new() { Spin = new(0, 30, 0) },
        };
        var world = new PhysicsWorld(new Scene { Objects = [lift, turntable] });
        Assert.True(world.IsMoving);
        world.Run(30);
        var placements = world.GetCurrentScene().Objects.Select(static placed => placed.Declaration.Placement).ToArray();
        Near.Equal(new(0, 1, 0), placements[0].Position, 1e-12);
        Near.Equal(new(0, 25, 0), placements[1].Rotation, 1e-9);
        Near.Equal(new(0, 29 / 30.0, 0), world.StaticObjects[0].InterpolatedMap(0).Translation, 1e-12);
        Assert.Equal(new(0, 2, 0), world.StaticObjects[0].Velocity, static (v1, v2) => (v1 - v2).Length() < 1e-9);
        world.Run(150);
        Near.Equal(Vector.Zero, world.StaticObjects[0].Placement.Position, 1e-12);
        world.StaticObjects[0].SetMotion(new(5, 0, 0));
        world.Run(60);
        world.Reset();
        Assert.Equal((lift.Placement, turntable.Placement), (world.StaticObjects[0].Placement, world.StaticObjects[1].Placement));
        world.Run(30);
        Near.Equal(new(0, 1, 0), world.StaticObjects[0].Placement.Position, 1e-12);
    }

    [Fact]
    public void Scene_WithAnImpossiblePath_IsRefused()
    {
        var motion = new ObjectMotion { Velocity = new(1, 0, 0), From = Vector.Zero, To = new(0, 3, 0) };
        var lift = new SceneObject(PhysicsMeshes.Cube) { Motion = motion };
        var exception = Assert.Throws<SceneObjectException>(() => new PhysicsWorld(new Scene { Objects = [lift] }));
        Assert.EndsWith("the velocity must lead along the path", exception.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Run_WithMovers_RepeatsBitForBit() => CheckRepeats(steps: 50);

    [Fact]
    [Trait("Category", "Soak")]
    public void LongRun_WithMovers_RepeatsBitForBit() => CheckRepeats(steps: 300);

    [Fact]
    public void TryFindClosest_OnAMover_FindsItWhereItIs()
    {
        var world = new PhysicsWorld();
        var block = world.AddStatic(PhysicsMeshes.Cube);
        block.SetMotion(new(6, 0, 0), new(0, 0, Math.PI));
        world.Run(30);
        Assert.True(world.TryFindClosest(new(3, 2, 0), ColliderKind.Exact, out var closest));
        Near.Equal(new(3, 0.5, 0), closest.Point, 1e-9);
        block.MoveTo(Transformation.At(new(0, 5, 0)));
        Assert.Equal((Vector.Zero, Vector.Zero), (block.Velocity, block.AngularVelocity));
        world.Run(10);
        Assert.True(world.TryFindClosest(new(0, 9, 0), ColliderKind.Exact, out closest));
        Near.Equal(new(0, 5.5, 0), closest.Point, 1e-12);
    }

    [Theory]
    [InlineData(2)]
    [InlineData(5)]
    public void Belt_UnderManyBallsThatTouch_GivesThemItsSpeed(int side)
    {
        var world = CreateLayer(side);
        world.StaticObjects[0].SetBelt(2 * Vector.I);
        // Friction of 0.5 needs less than half a second for it.
        world.Run(60);
        Assert.All(world.Bodies, body => Assert.InRange((body.Velocity - (2 * Vector.I)).MaxAbsComponent(), 0, 1e-9));
    }

    [Theory]
    [InlineData(2)]
    [InlineData(5)]
    public void Lift_UnderManyBallsThatTouch_RaisesThemAtItsSpeed(int side)
    {
        var world = CreateLayer(side);
        world.StaticObjects[0].SetMotion(Vector.J);
        world.Run(60);
        var top = world.StaticObjects[0].Placement.Position.Y + 0.5;
        Assert.All(world.Bodies, body => Assert.InRange((body.Velocity - Vector.J).MaxAbsComponent(), 0, 1e-9));
        Assert.All(world.Bodies, body => Assert.InRange(body.Position.Y - 0.5 - top, -1e-6, 1e-6));
    }

    [Fact]
    public void SetMotion_ThatIsNotFinite_IsRefused()
    {
        var block = new PhysicsWorld().AddStatic(PhysicsMeshes.Cube);
        Assert.Throws<ArgumentException>(() => block.SetMotion(new(double.NaN, 0, 0)));
        Assert.Throws<ArgumentException>(() => block.SetMotion(Vector.Zero, new(0, double.PositiveInfinity, 0)));
        Assert.Throws<ArgumentException>(() => block.SetBelt(new(0, double.NaN, 0)));
    }

    private static Transformation Box(Vector centre, Vector size) => new(centre, Vector.Zero, size);

    private static double Lead(Body body, StaticObject plate, double halfThickness) =>
        body.Position.X - plate.Placement.Position.X - halfThickness - body.Radius;

    private static Body CreateOnTurntable(double angularSpeed, BodyDescription description, out PhysicsWorld world)
    {
        world = new();
        var turntable = world.AddStatic(PhysicsMeshes.Cube, Box(new(0, -0.5, 0), new(40, 1, 40)));
        turntable.SetMotion(Vector.Zero, new(0, angularSpeed, 0));
        return world.Add(description with
        {
            Position = new(1, 0.5, 0),
            Radius = 0.5,
            Velocity = Vector.Cross(new(0, angularSpeed, 0), Vector.I),
        });
    }

    /// <summary>Rows of balls that do not turn and touch each other, on a plate.</summary>
    private static PhysicsWorld CreateLayer(int side)
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.Cube, Box(new(0, -0.5, 0), new(100, 1, 100)));
        world.AddRange(Enumerable.Range(0, side * side).Select(i => new BodyDescription(new(i % side, 0.5, i / side), 0.5)
        {
            Friction = 0.5, IsRotationLocked = true,
        }));
        return world;
    }

    private static void CheckBlade(double angularSpeed, double friction, int worlds, int steps) => Seeded.Run(worlds, random =>
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.FloorMesh());
        var blade = world.AddStatic(PhysicsMeshes.Cube, Box(new(0, 1.01, 0), new(8, 2, 0.1)));
        world.AddRange(Enumerable.Range(0, 20).Select(_ => new BodyDescription(
            new(random.Between(-3, 3), random.Between(0.4, 3), (random.NextDouble() < 0.5 ? -1 : 1) * random.Between(0.5, 3)), 0.3)
        {
            Friction = friction, Restitution = 0.3,
        }));
        blade.SetMotion(Vector.Zero, new(0, angularSpeed, 0));
        world.Run(steps, () => Assert.All(world.Bodies, body =>
        {
            Assert.True(world.TryFindClosest(body.Position, ColliderKind.Exact, out var closest));
            var overlap = body.Radius - closest.Distance;
            Assert.True(body.IsStuck || overlap < 2e-6, $"{body.Name} overlaps by {overlap:R}");
        }));
    });

    private static void CheckRepeats(int steps)
    {
        Assert.Equal(Run(2, steps), Run(2, steps));
        // Velocities belong to the state, even where nothing is touched.
        Assert.NotEqual(Run(2, 1), Run(2.5, 1));

        static string Run(double speed, int steps)
        {
            var world = CreateMill(speed);
            world.Run(steps);
            return world.StateHash;
        }
    }

    private static PhysicsWorld CreateMill(double speed)
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.FloorMesh());
        world.AddStatic(PhysicsMeshes.Cube, Box(new(0, 1, 0), new(6, 2, 0.2))).SetMotion(Vector.Zero, new(0, speed, 0));
        world.AddStatic(PhysicsMeshes.Cube, Box(new(0, -0.4, 5), new(9, 1, 3))).SetBelt(new(0, 0, -speed));
        world.AddRange(Enumerable.Range(0, 12).Select(static i => new BodyDescription(
            new((0.8 * i) - 4.4, 2 + (0.1 * i), i % 2 == 0 ? 1.5 : -1.5), 0.3)
        {
            Friction = 0.4, Restitution = 0.3, RollingFriction = 0.02,
        }));
        return world;
    }
}
