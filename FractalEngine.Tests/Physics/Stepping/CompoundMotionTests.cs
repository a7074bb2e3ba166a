using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Physics.Stepping;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Stepping;

/// <summary>
/// How compounds turn freely, and when a dumbbell of two balls meets a floor or a ball, in closed form.
/// </summary>
public sealed class CompoundMotionTests
{
    // Impacts are found to 1e-10 of the radius, and the touch tolerance is 1e-9 of it.
    private const double Tolerance = 2e-9;

    private static readonly CompoundShape Dumbbell = CompoundShape.OfBalls([new(-Vector.I, 0.5), new(Vector.I, 0.5)]);

    [Fact]
    public void Plan_OfABodyThatTurnsAboutItsAxis_GoesOn()
    {
        var body = new Body(new(Vector.Zero, Dumbbell) { AngularVelocity = 3 * Vector.J }, 0);
        FreeTurn.Plan(body, 0.25);
        Near.Equal(3 * Vector.J, body.FreeSpin, 1e-12);
        Near.Equal(3 * Vector.J, body.SpinBase, 1e-12);
        body.AngularVelocity = Vector.Zero;
        FreeTurn.Plan(body, 0.25);
        Assert.Equal((Vector.Zero, Vector.Zero), (body.FreeSpin, body.SpinBase));
        // Several turns at once.
        body.AngularVelocity = 40 * Vector.K;
        FreeTurn.Plan(body, 0.25);
        Near.Equal(40 * Vector.K, body.FreeSpin, 1e-9);
        Near.Equal(40 * Vector.K, body.SpinBase, 1e-9);
    }

    /// <summary>
    /// The axis of a symmetric body goes round its angular momentum, as fast as that over the inertia across
    /// the axis.
    /// </summary>
    [Fact]
    public void Plan_OfASymmetricTop_PrecessesAboutItsMomentum() => Seeded.Run(20, random =>
    {
        var spin = random.Vector(4);
        var capsule = CompoundShape.Capsule(-Vector.I, Vector.I, 0.5);
        var body = new Body(new(Vector.Zero, capsule) { AngularVelocity = spin, Mass = 3 }, 0);
        const double Duration = 0.125;
        FreeTurn.Plan(body, Duration);
        var momentum = body.InertiaTensor * spin;
        var turned = Orientation.Identity.TurnedBy(0.5 * Duration * (body.SpinBase + body.FreeSpin));
        var expected = Orientation.Identity.TurnedBy(Duration / body.InertiaTensor.V2.Y * momentum);
        Near.Equal(expected.Rotate(Vector.I), turned.Rotate(Vector.I), 1e-8);
        // Momentum and energy stay.
        var energy = Vector.Dot(spin, momentum);
        body.SetOrientation(turned);
        Near.Equal(momentum, body.InertiaTensor * body.FreeSpin, 1e-11);
        Near.Equal(energy, Vector.Dot(body.FreeSpin, momentum), 1e-6);
    });

    /// <summary>
    /// Bodies of three different moments have no closed form, but keep momentum and energy all the same.
    /// </summary>
    [Fact]
    public void Plan_OfAnyBody_KeepsMomentumAndEnergy() => Seeded.Run(20, random =>
    {
        var shape = CompoundShape.OfBalls(Enumerable.Range(0, 4).Select(_ => new CompoundBall(random.Vector(), random.Between(0.2, 0.6))));
        var body = new Body(new(Vector.Zero, shape) { AngularVelocity = random.Vector(5) }, 0);
        var momentum = body.InertiaTensor * body.AngularVelocity;
        var energy = Vector.Dot(momentum, body.AngularVelocity);
        FreeTurn.Plan(body, 0.1);
        body.SetOrientation(Orientation.Identity.TurnedBy(0.05 * (body.SpinBase + body.FreeSpin)));
        Near.Equal(momentum, body.InertiaTensor * body.FreeSpin, 1e-11);
        Near.Equal(energy, Vector.Dot(momentum, body.FreeSpin), 1e-6);
    });

    /// <summary>A fall is met exactly, and of a turn the moment at which a way ends where the lower ball touches the floor.</summary>
    [Theory]
    [InlineData(2, 4, 0, 0.375)]
    [InlineData(1.2, 0, 2, 0.3876987483053765)]
    [InlineData(1.2, 0, -2, 0.3876987483053765)]
    public void TryFindImpact_WithAFloor_IsWhenTheLowerBallTouchesIt(double height, double speed, double spin, double expected)
    {
        var (sweep, body, obstacles) = Create(new(0.25, height, 0));
        var motion = new SphereMotion(body.Position, new(0, -speed, 0), Vector.Zero);
        // Level, or where sin(2·t) is 0.7.
        var duration = spin == 0 ? 1 : expected + 1e-6;
        sweep.ResetStepBudget();
        Assert.True(sweep.TryFindImpact(body, in motion, duration * spin * Vector.K, duration, out var hit, out var ball, out var elapsed));
        Near.Equal(expected, elapsed, spin == 0 ? Tolerance : 1e-6);
        Assert.Equal((spin > 0 ? 0 : spin < 0 ? 1 : ball, false), (ball, hit.IsBody));
        Near.Equal(0, hit.Point.Y, 1e-12);
        Near.Equal(0.25 + ((ball == 0 ? -1 : 1) * Math.Cos(spin * elapsed)), hit.Point.X, 1e-5);
        Assert.Equal(0, obstacles.Time);
        duration = expected - 1e-6;
        Assert.False(sweep.TryFindImpact(body, in motion, duration * spin * Vector.K, duration, out _, out _, out elapsed));
        Assert.Equal(duration, elapsed);
    }

    [Fact]
    public void TryFindImpact_WithABall_IsWhenTheyTouch()
    {
        var (sweep, body, obstacles) = Create(new(0, 5, 0), new BodyDescription(new(1, 8, 0.6), 0.5));
        var motion = new SphereMotion(body.Position, new(0, 4, 0), Vector.Zero);
        obstacles.SelectBall(body.Radius, body.SafeDistance);
        obstacles.CollectNearbyBodies(in motion, 1, body.Index);
        Assert.True(sweep.TryFindImpact(body, in motion, Vector.Zero, 1, out var hit, out var ball, out var elapsed));
        // 0.8 below its centre.
        Near.Equal(2.2 / 4, elapsed, Tolerance);
        Assert.Equal((1, 1), (ball, hit.BodyIndex));
    }

    /// <summary>A solve leaves a little of what it should keep: a ball that touches something may be in it by 1e-7 of its radius.</summary>
    [Theory]
    [InlineData(0.9, false, true)]
    [InlineData(0.9, true, false)]
    [InlineData(1.1, true, true)]
    public void TryFindImpact_OfBallsThatTouch_LeavesThemIn(double depth, bool isTouching, bool isHit)
    {
        var (sweep, body, _) = Create(new(0, 0.5, 0));
        body.Balls[1].IsOnSurface = isTouching;
        body.Balls[0].IsOnSurface = isTouching;
        var motion = new SphereMotion(body.Position, depth * -0.5e-7 * Vector.J, Vector.Zero);
        sweep.ResetStepBudget();
        Assert.Equal(isHit, sweep.TryFindImpact(body, in motion, Vector.Zero, 1, out var hit, out _, out _));
        Near.Equal(isHit ? 0.5 : 0, hit.CombinedRadius, 1e-15);
    }

    /// <summary>A circle is farthest from its chord in the middle: by an eighth of its radius times the squared angle.</summary>
    [Fact]
    public void IsOnWay_OfATurn_IsTrueWhereTheBallsAreOnTheirWays()
    {
        var (_, body, _) = Create(new(0, 5, 0));
        // Both arms are 1, and the height is 1e-7 of the radius.
        var turn = Math.Sqrt(8 * 1e-7 * 0.5);
        Assert.True(BodySweep.IsOnWay(body, 0.999 * turn * Vector.K, 0.5));
        Assert.False(BodySweep.IsOnWay(body, 1.001 * turn * Vector.K, 0.5));
        Assert.True(BodySweep.IsOnWay(body, Vector.K, 0));
        Assert.True(BodySweep.IsOnWay(body, Vector.K, 1));
        Assert.False(BodySweep.IsOnWay(body, Vector.K, 0.999));
        // So much would a centre of mass be beside a straight way.
        Assert.True(BodySweep.IsOnWay(body, Vector.Zero, 0.5, 0.999 * turn * turn));
        Assert.False(BodySweep.IsOnWay(body, Vector.Zero, 0.5, 1.001 * turn * turn));
    }

    [Fact]
    public void TryResolve_OfADumbbellInAFloor_LiftsItAsFarAsItIsIn()
    {
        var (_, body, obstacles) = Create(new(0, 0.25, 0));
        var position = body.Position;
        Assert.True(new OverlapResolver(obstacles).TryResolve(ref position, body));
        Near.Equal(new(0, 0.5, 0), position, 1e-8);
    }

    private static (BodySweep Sweep, Body Body, Obstacles Obstacles) Create(Vector position, params BodyDescription[] others)
    {
        BodyDescription[] all = [new(position, Dumbbell), .. others];
        List<Body> bodies = [.. all.Select(static (one, i) => new Body(one, i))];
        var grid = new BodyGrid();
        grid.Build(bodies);
        var obstacles = new Obstacles(
            bodies, new NearbyBodies(grid, bodies), new QueryContext(), new KinematicSet(),
            new BodySurfaces([], new(static _ => { }, null)));
        var statics = new StaticObjectSet(static _ => { }, null);
        statics.Add(new PhysicsWorld().AddStatic(PhysicsMeshes.FloorMesh()));
        obstacles.SetMover(statics.CollidersOf(ColliderKind.Exact), [Vector.Zero], bodies[0].Radius, bodies[0].SafeDistance, 0);
        return (new(obstacles), bodies[0], obstacles);
    }
}
