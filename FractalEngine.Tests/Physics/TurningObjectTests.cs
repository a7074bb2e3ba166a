using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Objects that turn, against closed forms and against the same object at rest where it has turned to.</summary>
public class TurningObjectTests
{
    /// <summary>
    /// A plane that turns about an axis in it, and moves along, reaches a ball at rest when the centre is a radius away from it. It throws
    /// it as fast as its surface is there, and as much again as it bounces.
    /// </summary>
    [Theory]
    [InlineData(0)]
    [InlineData(3)]
    public void Blade_ThatTurnsIntoABall_ThrowsItAsGeometrySays(double speed) => Seeded.Run(60, random =>
    {
        var frame = random.Orthogonal();
        var (axis, forward, side) = (frame * Vector.K, frame * Vector.I, frame * Vector.J);
        var turn = Math.Sign(Vector.Dot(Vector.Cross(axis, forward), side));
        var origin = random.Vector(3);
        var motion = random.Vector(speed);
        var radius = random.Between(0.1, 0.5);
        var distance = random.Between(1.5 * radius, 4);
        var restitution = random.Between(0.2, 1);
        var spin = random.Between(1, 20);
        // Long enough before for some steps, or for less than one.
        var angle = Math.Asin(radius / distance) + random.Between(0.01, 1.2);
        var blade = PhysicsMeshes.FromTriangles(
            (20 * (forward + axis), 20 * (forward - axis), -20 * (forward + axis)),
            (20 * (forward + axis), -20 * (forward + axis), -20 * (forward - axis)));
        // So short that the blade doesn't reach the ball once more until it is looked at.
        var world = TestWorlds.Create(Vector.Zero, random.Between(0.1, 1) * Math.Min(0.03, 0.1 / spin));
        world.AddStatic(blade, Transformation.At(origin)).SetMotion(motion, turn * spin * axis);
        var centre = origin + (distance * ((Math.Cos(angle) * forward) + (Math.Sin(angle) * side))) + (random.Between(-3, 3) * axis);
        var body = world.Add(new(centre, radius) { Restitution = restitution });
        var arrival = FirstTime(0, time => Vector.Dot(centre - origin - (time * motion), NormalAt(time)) - radius);
        while (world.Time < arrival + world.Settings.TimeStep)
        {
            world.Step();
        }

        var normal = NormalAt(arrival);
        var lever = centre - (radius * normal) - origin - (arrival * motion);
        var thrown = (1 + restitution) * Vector.Dot(motion + Vector.Cross(turn * spin * axis, lever), normal) * normal;
        // The moment is found to 1e-10 of the radius.
        Near.Equal(thrown, body.Velocity, 1e-7 * spin);
        Near.Equal(centre + ((world.Time - arrival) * thrown), body.Position, 1e-8 * spin);

        Vector NormalAt(double time) => (-Math.Sin(spin * time) * forward) + (Math.Cos(spin * time) * side);
    });

    /// <summary>
    /// On a plane without friction that turns about a level axis, s″ = ω²·s − g·sin ωt along the plane: s = A·cosh ωt + B·sinh ωt +
    /// g/(2ω²)·sin ωt. Coriolis' acceleration 2ω·s′ keeps the ball on it.
    /// </summary>
    [Theory]
    [InlineData(0.5, 0)]
    [InlineData(-0.5, 0)]
    [InlineData(1.2, 0)]
    [InlineData(1.2, 1.5)]
    public void Plane_ThatTilts_LetsABallSlideAsMechanicsSays(double spin, double height) => Seeded.Run(10, random =>
    {
        const double Radius = 0.3;
        var (start, speed) = (random.Between(-1, 1), random.Between(-1, 1));
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 240.0);
        // The axis lies below the plane.
        var plane = world.AddStatic(PhysicsMeshes.FloorMesh().Transform(vertex => vertex + (height * Vector.J)));
        plane.SetMotion(Vector.Zero, spin * Vector.K);
        // A ball that goes along with the plane goes back by ω for each unit of height above the axis.
        var body = world.Add(new(new(start, height + Radius, 0), Radius)
        {
            Velocity = new(speed - (spin * (height + Radius)), spin * start, 0),
        });
        var swing = 9.8 / (2 * spin * spin);
        var pressure = 1.0;
        for (var step = 0; step < 200 && pressure > 0.5; step++)
        {
            world.Step();
            var angle = spin * world.Time;
            var along = (start * Math.Cosh(angle)) + (((speed / spin) - swing) * Math.Sinh(angle)) + (swing * Math.Sin(angle));
            var (tangent, normal) = (new Vector(Math.Cos(angle), Math.Sin(angle), 0), new Vector(-Math.Sin(angle), Math.Cos(angle), 0));
            // Within a step it follows a parabola; a height of g·Δt²/8 is 2e-5.
            Near.Equal(along, Vector.Dot(body.Position, tangent), 4e-3);
            // It begins without a contact, and may lose a part of the first step.
            Assert.InRange(Vector.Dot(body.Position, normal) - height - Radius, -1e-6, step < 3 ? 1e-3 : 2e-6);
            // Until the plane would have to pull it.
            var rate = spin * ((start * Math.Sinh(angle)) + (((speed / spin) - swing) * Math.Cosh(angle)) + (swing * Math.Cos(angle)));
            pressure = (2 * spin * rate) - (spin * spin * (height + Radius)) + (9.8 * Math.Cos(angle));
        }
    });

    /// <summary>
    /// What does not roll stays where it lies on a disc that turns and moves along, or goes with its belt, which turns with it; on a disc
    /// without friction nothing happens.
    /// </summary>
    [Theory]
    [InlineData(0, 0, 1e-4)]
    [InlineData(0.7, 0, 1e-4)]
    [InlineData(0.3, 0.5, 1e-2)]
    public void Disc_ThatTurnsAndMoves_CarriesWhatDoesNotRoll(double speed, double belt, double tolerance)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 240.0);
        var disc = world.AddStatic(PhysicsMeshes.FloorMesh());
        disc.SetMotion(new(speed, 0, 0), 1.5 * Vector.J);
        disc.SetBelt(belt * Vector.K);
        // It begins with the velocity of the place where it lies: v + ω × r + u.
        var carried = world.Add(new(new(1, 0.5, 0), 0.5) { Friction = 2, IsRotationLocked = true, Velocity = new(speed, 0, belt - 1.5) });
        var sliding = world.Add(new(new(-3, 0.5, 0), 0.5) { Velocity = new(0.1, 0, 0.2) });
        world.Run(480, () =>
        {
            var (sine, cosine) = Math.SinCos(1.5 * world.Time);
            var way = belt * world.Time;
            // Chords of 1.5/240 radians; where it moves on the disc, friction has to follow what turns it.
            Near.Equal(new((speed * world.Time) + cosine + (way * sine), 0.5, (way * cosine) - sine), carried.Position,
                tolerance * (1 + (1.5 * world.Time)));
            Near.Equal(new Vector(-3, 0.5, 0) + (world.Time * new Vector(0.1, 0, 0.2)), sliding.Position, 1e-6);
        });
    }

    /// <summary>
    /// A solid ball that rolls on a disc has the acceleration 2/7·Ω × v, where v is relative to the axis: it goes round in circles,
    /// wherever the axis is.
    /// </summary>
    [Theory]
    [InlineData(0)]
    [InlineData(0.5)]
    public void Disc_ThatTurnsAndMoves_LetsABallRollInCircles(double speed)
    {
        const double Spin = 3, Rate = 2 / 7.0 * Spin, Radius = 0.5;
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0);
        world.AddStatic(PhysicsMeshes.FloorMesh()).SetMotion(new(speed, 0, 0), Spin * Vector.J);
        var (place, velocity) = (new Vector(2, Radius, 0), new Vector(0.6, 0, -0.8));
        // Its lowest point, at −r·j, moves as the disc does there: v + ω × (−r·j) = V + Ω × x.
        var surface = Vector.Cross(Spin * Vector.J, place);
        var slip = velocity - surface;
        var body = world.Add(new(place, Radius)
        {
            Friction = 5, Velocity = velocity + (speed * Vector.I), AngularVelocity = Vector.Cross(Vector.J, slip) / Radius,
        });
        world.Run(120, () =>
        {
            var (sine, cosine) = Math.SinCos(Rate * world.Time);
            var side = Vector.Cross(Vector.J, velocity);
            var expected = place + (speed * world.Time * Vector.I)
                + (1 / Rate * ((sine * velocity) + ((1 - cosine) * side)));
            Near.Equal(expected, body.Position, 2e-3);
        });
    }

    [Fact]
    public void Trigger_ThatTurns_HasWithinWhatIsWithin()
    {
        var world = new PhysicsWorld(new PhysicsSettings { ReportsContacts = true }) { Gravity = Vector.Zero };
        var trigger = world.AddStatic(PhysicsMeshes.Cube, new(Vector.Zero, Vector.Zero, new(2, 2, 2)));
        trigger.IsTrigger = true;
        trigger.SetMotion(Vector.Zero, new(1, 2, -1.5));
        // As far from the middle as a face is, and farther than a corner.
        var inside = world.AddSphere(new(0.5, 0.4, -0.3), 0.05);
        _ = world.AddSphere(new(1.8, 0, 0), 0.05);
        world.Run(200, () => Assert.Equal([inside], world.ContactEvents.Select(static contact => contact.Body)));
    }

    [Fact]
    public void Queries_OfAnObjectThatHasTurned_AreThoseOfItAtRestThere() => Seeded.Run(15, random =>
    {
        var mesh = PhysicsMeshes.Cube;
        var placement = new Transformation(new(random.Between(-1, 1), random.Between(-1, 1), 0), random.Degrees(), new(1, 2, 0.5));
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        var turning = world.AddStatic(mesh, placement);
        turning.SetMotion(random.Vector(2), random.Vector(6));
        world.Run(random.Next(1, 60));
        // Independent of how the object keeps its pose: the vertices of its mesh, turned one by one.
        var pose = turning.Kinematic!.Pose;
        var linear = pose.Orientation.ToMatrix() * placement.ToAffineMap().Linear;
        var there = mesh.Transform(vertex => (linear * vertex) + pose.Position);
        Near.Equal(placement.Position + (world.Time * turning.Velocity), pose.Position, 1e-12);
        Near.Equal(turning.InterpolatedMap(1), new AffineMap(linear, pose.Position), 1e-12);
        var still = new PhysicsWorld { Gravity = Vector.Zero };
        still.AddStatic(there);
        for (var i = 0; i < 40; i++)
        {
            var position = pose.Position + random.Vector(3);
            Assert.True(still.TryFindClosest(position, ColliderKind.Exact, out var expected));
            Assert.True(world.TryFindClosest(position, ColliderKind.Exact, out var closest));
            Near.Equal(expected.Point, closest.Point, 1e-9);
            Near.Equal(expected.Distance, closest.Distance, 1e-9);
            if (expected.Feature == TriangleFeature.Interior)
            {
                Near.Equal(expected.Normal, closest.Normal, 1e-9);
            }

            // Towards it, and sometimes from within.
            var start = i % 4 == 0 ? pose.Position + random.Vector(0.1) : position;
            var way = pose.Position + random.Vector(0.8) - start;
            var isHit = still.TryCastRay(new(start, way), out var expectedHit);
            Assert.Equal(isHit, world.TryCastRay(new(start, way), out var hit));
            CheckHit(turning, isHit, expectedHit, hit);
            Assert.True(!isHit || Vector.Dot(hit.Normal, way) < 0, "the normal looks away");
            isHit = still.TryCastSphere(position, 0.05, 2 * way, out expectedHit);
            Assert.Equal(isHit, world.TryCastSphere(position, 0.05, 2 * way, out hit));
            CheckHit(turning, isHit, expectedHit, hit);
        }
    });

    /// <summary>The first time when a function falls to 0, to the last digits.</summary>
    private static double FirstTime(double time, Func<double, double> function)
    {
        var step = 1e-3;
        for (; step > 1e-14; step *= 0.5)
        {
            while (function(time + step) > 0)
            {
                time += step;
            }
        }

        return time;
    }

    private static void CheckHit(StaticObject target, bool isHit, CastHit expected, CastHit hit)
    {
        if (isHit)
        {
            Near.Equal(expected.Distance, hit.Distance, 1e-8);
            Near.Equal(expected.Point, hit.Point, 1e-8);
            Near.Equal(expected.Normal, hit.Normal, 1e-7);
            Assert.Equal(target, hit.StaticObject);
        }
    }
}
