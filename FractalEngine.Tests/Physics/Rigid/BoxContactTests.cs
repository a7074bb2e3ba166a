using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>Boxes that hit, slide and stand, against closed forms.</summary>
public class BoxContactTests
{
    private const double Fall = 9.8;

    private static readonly Mesh Crate = RigidMeshes.Box(1, 1, 1);

    [Theory]
    [InlineData(0, 1, 1)]
    [InlineData(0.5, 2, 5)]
    [InlineData(1, 1, 1)]
    [InlineData(1, 100, 1)]
    [InlineData(0.8, 1, 1000)]
    public void Boxes_FaceOn_LeaveAsNewtonSays(double restitution, double mass1, double mass2)
    {
        foreach (var friction in new[] { 0, 0.5 })
        {
            const double Speed1 = 3;
            const double Speed2 = -1;
            var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
            var body1 = world.Add(RigidMeshes.Describe(Crate, new(-2, 0, 0)) with
            {
                Mass = mass1,
                Velocity = Speed1 * Vector.I,
                // The smaller one counts.
                Restitution = Math.Min(1, restitution + 0.2),
                Friction = friction,
            });
            var body2 = world.Add(RigidMeshes.Describe(Crate, new(2, 0, 0)) with
            {
                Mass = mass2,
                Velocity = Speed2 * Vector.I,
                Restitution = restitution,
                Friction = friction,
            });
            var momentum = world.Momentum();
            world.Run(90, () => Near.Equal(momentum, world.Momentum(), 1e-9 * ((3 * mass1) + mass2)));
            var mean = ((mass1 * Speed1) + (mass2 * Speed2)) / (mass1 + mass2);
            var approach = Speed1 - Speed2;
            var expected1 = mean - (restitution * approach * mass2 / (mass1 + mass2));
            var expected2 = mean + (restitution * approach * mass1 / (mass1 + mass2));
            Near.Equal(expected1 * Vector.I, body1.Velocity, 0.01 * approach);
            Near.Equal(expected2 * Vector.I, body2.Velocity, 0.01 * approach);
            Near.Equal(Vector.Zero, body1.AngularVelocity, 0.01 * approach);
            Near.Equal(Vector.Zero, body2.AngularVelocity, 0.01 * approach);
        }
    }

    [Theory]
    [InlineData(0.4, 4)]
    [InlineData(0.2, 2)]
    [InlineData(0.9, 5)]
    public void Box_ThatSlides_StopsWhereFrictionSays(double friction, double speed)
    {
        var world = CreateOnFloor();
        var body = world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 0.4, 1), new(0, 0.2, 0)) with
        {
            Friction = friction,
            Velocity = speed * Vector.I,
        });
        world.Run(240);
        var distance = speed * speed / (2 * friction * Fall);
        Near.Equal(distance, body.Position.X, 0.02 * distance);
        Near.Equal(0, body.Position.Z, 1e-3);
        Near.Equal(0.2, body.Position.Y, 2e-4);
        Assert.True(body.IsAsleep);
    }

    [Theory]
    [InlineData(0.3)]
    [InlineData(0.5)]
    [InlineData(0.8)]
    public void Box_OnASlope_HoldsBelowTheAngleOfFriction_AndSlidesAbove(double friction)
    {
        var held = RunOnSlope(0.9 * Math.Atan(friction), friction, 300);
        Near.Equal(0, held.Travel.Length(), 1e-3);
        Assert.True(held.Body.IsAsleep);
        var angle = 1.1 * Math.Atan(friction);
        var slid = RunOnSlope(angle, friction, 60, 1e-6);
        var acceleration = Fall * (Math.Sin(angle) - (friction * Math.Cos(angle)));
        Near.Equal(acceleration, slid.Body.Velocity.Length(), 0.01 * acceleration);
        Near.Equal(0.5 * acceleration, slid.Travel.Length(), 0.01 * 0.5 * acceleration);
    }

    [Fact]
    public void Box_OnASlopeWithoutFriction_SlidesAsGalileoSays()
    {
        var (body, travel) = RunOnSlope(0.5, 0, 60, 1e-6);
        Near.Equal(Fall * Math.Sin(0.5), body.Velocity.Length(), 1e-3);
        // A first part of a step without contact is an eighth of it at most.
        Near.Equal(0.5 * Fall * Math.Sin(0.5), travel.Length(), 0.01);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(0.01)]
    public void Stack_OfTenCrates_StandsForAMinute(double disorder)
    {
        var random = new Random(1);
        var world = CreateOnFloor();
        List<Vector> places = [];
        for (var i = 0; i < 10; i++)
        {
            places.Add(new(random.Between(-disorder, disorder), 0.5 + i, random.Between(-disorder, disorder)));
            world.Add(RigidMeshes.Describe(Crate, places[i]) with { Friction = 0.5 });
        }

        world.Run(3600, () =>
        {
            foreach (var body in world.IsMoving ? world.Bodies : [])
            {
                Near.Equal(places[body.Index], body.Position, 0.02);
            }
        });
        Assert.All(world.Bodies, body => Near.Equal(places[body.Index], body.Position, 0.02));
        Assert.All(world.Bodies, body => Assert.True(body.IsAsleep, $"crate {body.Index} is awake"));
    }

    [Theory]
    [InlineData(0, 0, 0, 0)]
    [InlineData(0, 0, 0, 0.4)]
    [InlineData(0.2, 0.5, 0.1, 0.2)]
    public void Crate_Dropped_RestsAtHalfItsHeight(double x, double y, double z, double restitution)
    {
        var world = CreateOnFloor();
        var turn = new Vector(x, y, z);
        var body = world.Add(RigidMeshes.Describe(Crate, new(0, 2, 0), turn == Vector.Zero ? null : Rotation(turn)) with
        {
            Friction = 0.5,
            Restitution = restitution,
        });
        world.Run(600, () => Assert.True(RigidMeshes.LowestPoint(body) >= -1e-9, $"{RigidMeshes.LowestPoint(body):R}"));
        Assert.True(body.IsAsleep);
        Assert.InRange(body.Position.Y, 0.5 - 1e-9, 0.5 + 2e-4);
    }

    private static Matrix Rotation(Vector turn) => Matrix.Rotation(turn.UnitVector(), turn.Length());

    internal static PhysicsWorld CreateOnFloor() =>
        TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));

    internal static (Body Body, Vector Travel) RunOnSlope(double angle, double friction, int steps, double gap = 0)
    {
        var downhill = new Vector(Math.Cos(angle), -Math.Sin(angle), 0);
        var normal = new Vector(Math.Sin(angle), Math.Cos(angle), 0);
        var slope = PhysicsMeshes.FromTriangles(PhysicsMeshes.PlaneTriangle(Vector.Zero, normal));
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(slope));
        var start = (0.2 + gap) * normal;
        var body = world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 0.4, 1), start, new(downhill, normal, Vector.K)) with
        {
            Friction = friction,
        });
        world.Run(steps);
        return (body, body.Position - start);
    }
}
