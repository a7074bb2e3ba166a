using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>
/// Two balls of any sizes, masses, spins and materials, against the laws of impulses and torques: of both coefficients the smaller one
/// counts, whichever ball is the first.
/// </summary>
public class PairLawTests
{
    // Relative to velocities and spins of some tens: the moment of an impact is found to 1e-10 of a radius.
    private const double Tolerance = 1e-7;

    [Fact]
    public void Impact_OfABallWithOneAtRest_FollowsTheLaws() => Seeded.Run(300, random =>
    {
        var (flying, resting) = (Ball.Of(random).WithoutTorques(), Ball.Of(random).WithoutTorques());
        var normal = random.Direction();
        // From where it touches, back along its way.
        var touching = (flying.Radius + resting.Radius) * normal;
        var velocity = random.Between(1, 5) * (random.Vector(0.7) - normal);
        if (Vector.Dot(velocity, normal) > -0.3)
        {
            velocity -= (0.3 + Vector.Dot(velocity, normal)) * normal;
        }

        flying = flying with { Position = touching - (random.Between(0.1, 0.4) * velocity), Velocity = velocity };
        Check(random, flying, resting, normal, seconds: 0.5);
    });

    [Fact]
    public void Impact_OfBallsThatTouchAtTheStart_FollowsTheLaws() => Seeded.Run(300, random =>
    {
        var (ball, other) = (Ball.Of(random).WithoutTorques(), Ball.Of(random).WithoutTorques());
        var normal = random.Direction();
        other = other with { Velocity = random.Vector(3) };
        var velocity = other.Velocity + random.Vector(2);
        velocity -= (Vector.Dot(velocity - other.Velocity, normal) + random.Between(0.2, 2)) * normal;
        ball = ball with { Position = (ball.Radius + other.Radius) * normal, Velocity = velocity };
        Check(random, ball, other, normal, seconds: 0.02);
    });

    [Fact]
    public void Friction_OfABallOnOneThatSleeps_IsTheSmallerOne() => Seeded.Run(20, random =>
    {
        // So large a ball that the other one slides on a plane.
        const double Large = 1e5;
        var (friction, other) = (random.Between(0.05, 0.5), random.Between(0.05, 0.5));
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh(1e6)));
        var ground = world.Add(new(new(0, Large, 0), Large) { Friction = other, IsRotationLocked = true, Mass = 1e9 });
        world.Run(120);
        Assert.True(ground.IsAsleep);
        var speed = random.Between(3, 5);
        var body = world.Add(new(new(0, (2 * Large) + 0.5, 0), 0.5) { Friction = friction, Velocity = new(speed, 0, 0) });
        // In the first step it sleeps, and in others it has been woken by what moves on it.
        world.Run(6, () => Near.Equal(speed - (Math.Min(friction, other) * 9.8 * (world.Time - 2)), body.Velocity.X, 1e-4));
        Near.Equal(Vector.Zero, ground.Velocity, 1e-6);
    });

    /// <summary>
    /// A force along the line of centres pushes a ball against another one, along which it slides. What it has met does not give way any
    /// more in that step, and holds the force. Friction by that would slow the ball down, and drive the other one not at all.
    /// </summary>
    [Fact]
    public void Momentum_AcrossAForceThatPushesABallAgainstAFreeOne_IsKept() => Seeded.Run(100, random =>
    {
        var (pushed, free) = (Ball.Of(random).WithoutTorques(), Ball.Of(random).WithoutTorques());
        var world = TestWorlds.Create(Vector.Zero, new PhysicsSettings { SleepSpeed = 0 });
        var (acceleration, time) = (random.Between(20, 50), random.Between(0, 0.1));
        var velocity = random.Vector(2) with { Y = random.Between(-3, -0.1) };
        var rise = (0.5 * acceleration * time * time) - (velocity.Y * time);
        var start = ((pushed.Radius + free.Radius + rise) * Vector.J) - (time * (velocity with { Y = 0 }));
        var other = random.Next(2) == 0 ? world.Add(free.Describe()) : null;
        var body = world.Add((pushed with { Position = start, Velocity = velocity }).Describe());
        other ??= world.Add(free.Describe());
        world.SetForce(body, -acceleration * pushed.Mass * Vector.J);
        var momentum = world.Momentum();
        world.Run((int)(60 * time) + 1);
        Assert.NotEqual(Vector.Zero, other.Velocity);
        // The line of centres turns a little as the ball slides.
        var change = world.Momentum() - momentum;
        Near.Equal(Vector.Zero, change with { Y = 0 }, 0.04 * acceleration * pushed.Mass / 60);
    });

    /// <summary>Balls are pressed against one in the middle, and spin. Each is slowed down by the smaller of both coefficients.</summary>
    /// <param name="count">One contact is solved on its own, and a dozen at once, four lanes wide.</param>
    /// <param name="isMiddleTurning">Whether the one in the middle gets what they lose.</param>
    [Theory]
    [InlineData(1, true)]
    [InlineData(1, false)]
    [InlineData(12, false)]
    public void Torques_OfBallsThatArePressedTogether_AreTheSmallerOnes(int count, bool isMiddleTurning) => Seeded.Run(20, random =>
    {
        const int Steps = 20;
        var middle = Ball.Of(random) with { Friction = 0, IsLocked = !isMiddleTurning, Radius = 1 };
        middle = middle with { Spin = isMiddleTurning ? random.Vector(9) : Vector.Zero };
        var world = TestWorlds.Create(Vector.Zero, new PhysicsSettings { TimeStep = 0.01, SleepSpeed = 0 });
        var isMiddleFirst = random.Next(2) == 0;
        var turnsAtStart = Vector.Zero;
        Body? centre = isMiddleFirst ? world.Add(middle.Describe()) : null;
        var pressed = Directions(count).Select(direction =>
        {
            var ball = Ball.Of(random) with { Friction = 0, IsLocked = false, Radius = random.Between(0.1, 0.3), Spin = random.Vector(9) };
            ball = ball with { Position = (1 + ball.Radius) * direction };
            return (Ball: ball, Direction: direction, Body: world.Add(ball.Describe()));
        }).ToArray();
        centre ??= world.Add(middle.Describe());
        var force = random.Between(1, 20);
        Array.ForEach(pressed, item => world.SetForce(item.Body, -force * item.Direction));
        world.SetForce(centre, pressed.Aggregate(Vector.Zero, (sum, item) => sum + (force * item.Direction)));
        turnsAtStart = TotalSpin();
        world.Run(Steps);
        Near.Equal(turnsAtStart, TotalSpin(), Tolerance);
        foreach (var (ball, direction, body) in pressed)
        {
            var inverse = ball.InverseInertia + middle.InverseInertia;
            var before = ball.Spin - middle.Spin;
            var (about, rolling) = (Vector.Dot(before, direction), before - (Vector.Dot(before, direction) * direction));
            var change = force * Steps * 0.01 * inverse * Math.Min(ball.Radius, middle.Radius);
            var spinning = change * Math.Min(ball.Spinning, middle.Spinning);
            var rolled = change * Math.Min(ball.Rolling, middle.Rolling);
            about -= Math.Clamp(about, -spinning, spinning);
            rolling *= Math.Max(0, 1 - (rolled / rolling.Length()));
            Near.Equal((about * direction) + rolling, body.AngularVelocity - centre.AngularVelocity, Tolerance);
            Near.Equal(ball.Position, body.Position, Tolerance);
        }

        Vector TotalSpin() => !isMiddleTurning ? Vector.Zero : pressed.Aggregate(
            (1 / middle.InverseInertia) * centre.AngularVelocity,
            static (sum, item) => sum + ((1 / item.Ball.InverseInertia) * item.Body.AngularVelocity));
    });

    /// <summary>Far enough from each other: one, or those of an icosahedron.</summary>
    private static Vector[] Directions(int count)
    {
        var golden = 0.5 * (1 + Math.Sqrt(5));
        Vector[] all = [.. from s in new[] { -1, 1 } from t in new[] { -1, 1 }
            from v in new Vector[] { new(0, s, t * golden), new(s, t * golden, 0), new(t * golden, 0, s) } select v.UnitVector()];
        return all[..count];
    }

    private static void Check(Random random, Ball ball, Ball other, Vector normal, double seconds)
    {
        var world = TestWorlds.Create(Vector.Zero, new PhysicsSettings { TimeStep = random.Between(0.003, 0.02), SleepSpeed = 0 });
        // Whichever is first.
        var isFirst = random.Next(2) == 0;
        var body = isFirst ? world.Add(ball.Describe()) : null;
        var otherBody = world.Add(other.Describe());
        body ??= world.Add(ball.Describe());
        world.Run((int)Math.Ceiling(seconds / world.Settings.TimeStep));
        var (velocity, spin, velocityOfOther, spinOfOther) = ball.Meet(other, normal);
        Near.Equal(velocity, body.Velocity, Tolerance);
        Near.Equal(velocityOfOther, otherBody.Velocity, Tolerance);
        Near.Equal(spin, body.AngularVelocity, Tolerance);
        Near.Equal(spinOfOther, otherBody.AngularVelocity, Tolerance);
    }

    private sealed record Ball(
        double Radius, double Mass, double Inertia, double Restitution, double Friction, double Rolling, double Spinning, bool IsLocked)
    {
        public Vector Position { get; init; }

        public Vector Velocity { get; init; }

        public Vector Spin { get; init; }

        public double InverseInertia => IsLocked ? 0 : 1 / (Inertia * Mass * Radius * Radius);

        public static Ball Of(Random random)
        {
            var isLocked = random.Next(5) == 0;
            return new(
                random.Between(0.1, 1), Math.Pow(10, random.Between(-1, 1)), random.Between(0.1, 2 / 3.0),
                random.Next(4) * random.NextDouble() / 3, random.Next(4) * random.NextDouble(), random.Between(0, 0.5),
                random.Between(0, 0.5), isLocked)
            {
                Spin = isLocked ? Vector.Zero : random.Vector(6),
            };
        }

        /// <summary>The same without friction against rolling and spinning, of which bounces know nothing.</summary>
        public Ball WithoutTorques() => this with { Rolling = 0, Spinning = 0 };

        public BodyDescription Describe() => new(Position, Radius)
        {
            Velocity = Velocity, AngularVelocity = Spin, Mass = Mass, InertiaFactor = Inertia, Restitution = Restitution,
            Friction = Friction, RollingFriction = Rolling, SpinningFriction = Spinning, IsRotationLocked = IsLocked,
        };

        /// <summary>The laws of Newton and Coulomb for two balls that touch: first along the normal, then across it.</summary>
        public (Vector Velocity, Vector Spin, Vector VelocityOfOther, Vector SpinOfOther) Meet(Ball other, Vector normal)
        {
            var relative = Velocity - other.Velocity;
            var approach = -Vector.Dot(relative, normal);
            var along = (1 + Math.Min(Restitution, other.Restitution)) * approach / ((1 / Mass) + (1 / other.Mass));
            // The velocities of the touching points, each of which is a radius from its centre.
            var slip = relative + (approach * normal)
                + Vector.Cross(Spin, -Radius * normal) - Vector.Cross(other.Spin, other.Radius * normal);
            var across = -1 / ((1 / Mass) + (1 / other.Mass)
                + (InverseInertia * Radius * Radius) + (other.InverseInertia * other.Radius * other.Radius)) * slip;
            var limit = Math.Min(Friction, other.Friction) * along;
            across *= across.Length() > limit ? limit / across.Length() : 1;
            var impulse = (along * normal) + across;
            return (
                Velocity + (impulse / Mass), Spin + (InverseInertia * Vector.Cross(-Radius * normal, impulse)),
                other.Velocity - (impulse / other.Mass),
                other.Spin - (other.InverseInertia * Vector.Cross(other.Radius * normal, impulse)));
        }
    }
}
