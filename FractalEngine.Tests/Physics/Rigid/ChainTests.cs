using FractalEngine.Tests.Support;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>Impacts off centre, rows of dominoes, and stacks that are out of line.</summary>
public class ChainTests
{
    private static readonly Mesh Crate = RigidMeshes.Box(1, 1, 1);
    [Fact]
    public void Bodies_ThatHitOffCentre_KeepMomentumAndAngularMomentum() => Seeded.Run(6, random =>
    {
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        Mesh[] meshes = [Crate, RigidMeshes.CreateL(), Crate, RigidMeshes.CreateL()];
        for (var i = 0; i < 4; i++)
        {
            var angle = 0.5 * Math.PI * i;
            var place = 3 * new Vector(Math.Cos(angle), 0, Math.Sin(angle));
            world.Add(RigidMeshes.Describe(meshes[i], place) with
            {
                Mass = 1 + i,
                Velocity = (-1 * place) + random.Vector(0.3),
                AngularVelocity = random.Vector(3),
                Restitution = 0.5,
                Friction = 0.4,
            });
        }

        var (linear, angular) = (world.Momentum(), AngularMomentum(world));
        world.Run(120, () =>
        {
            Near.Equal(linear, world.Momentum(), 1e-9 * 30);
            // What is moved apart by 1e-4 of the radius, again and again, takes its momentum along.
            Near.Equal(angular, AngularMomentum(world), 5e-3 * 30);
        });
    });

    private static Vector AngularMomentum(PhysicsWorld world) => world.Bodies.Aggregate(Vector.Zero, (sum, body) =>
    {
        var rotation = body.Orientation.ToMatrix();
        var spin = rotation * body.Description.Mesh!.Inertia * rotation.Transpose() * body.AngularVelocity;
        return sum + (body.Description.Mass * (spin + Vector.Cross(body.Position, body.Velocity)));
    });

    [Theory]
    [InlineData(1.1)]
    [InlineData(1.5)]
    public void Box_InExactContactWithASlope_SlidesAboveTheAngleOfFriction(double factor)
    {
        const double Friction = 0.5;
        var angle = factor * Math.Atan(Friction);
        var (body, _) = BoxContactTests.RunOnSlope(angle, Friction, 60);
        var acceleration = 9.8 * (Math.Sin(angle) - (Friction * Math.Cos(angle)));
        Near.Equal(acceleration, body.Velocity.Length(), 0.02 * acceleration);
    }

    [Fact]
    public void Dominoes_FallInOrder() => CheckDominoes(6);

    [Fact]
    [Trait("Category", "Soak")]
    public void ManyDominoes_FallInOrder() => CheckDominoes(100);

    private static void CheckDominoes(int count)
    {
        const double Height = 1;
        var world = BoxContactTests.CreateOnFloor();
        var domino = RigidMeshes.Box(0.2, Height, 0.5);
        for (var i = 0; i < count; i++)
        {
            world.Add(RigidMeshes.Describe(domino, new(0.5 * i, 0.5 * Height, 0)) with { Mass = 1, Friction = 0.4 });
        }

        world.Run(60);
        Assert.All(world.Bodies, body => Near.Equal(1, UprightnessOf(body), 1e-6));
        world.ApplyImpulse(world.Bodies[0], 0.8 * Vector.I, new(0, Height, 0));
        var fell = new long[count];
        world.Run(300 + (20 * count), () =>
        {
            foreach (var body in world.Bodies)
            {
                Near.Equal(0, body.Position.Z, 0.05);
                fell[body.Index] = fell[body.Index] == 0 && UprightnessOf(body) < Math.Cos(0.3) ? world.StepCount : fell[body.Index];
            }
        });
        for (var i = 0; i < count; i++)
        {
            Assert.True(fell[i] > (i == 0 ? 0 : fell[i - 1]), $"domino {i} fell in step {fell[i]}");
            Assert.True(world.Bodies[i].Orientation.Rotate(Vector.J).X > 0, $"domino {i} fell backwards");
        }

        Assert.All(world.Bodies, body => Assert.True(body.IsAsleep, $"domino {body.Index} is awake"));
    }

    private static double UprightnessOf(Body body) => body.Orientation.Rotate(Vector.J).Y;

    [Theory]
    [InlineData(0.01)]
    [InlineData(0.05)]
    public void Stack_OfTenTurnedCrates_StandsForAMinute(double disorder)
    {
        var random = new Random(1);
        var world = BoxContactTests.CreateOnFloor();
        List<Vector> places = [];
        for (var i = 0; i < 10; i++)
        {
            places.Add(new(random.Between(-disorder, disorder), 0.5 + i, random.Between(-disorder, disorder)));
            var turn = Matrix.Rotation(Vector.J, 10 * random.Between(-disorder, disorder));
            world.Add(RigidMeshes.Describe(Crate, places[i], turn) with { Friction = 0.5 });
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

    [Fact]
    public void Crate_ThatSleeps_IsPushedByAPlateThatComes()
    {
        var world = BoxContactTests.CreateOnFloor();
        var crate = world.Add(RigidMeshes.Describe(Crate, new(0, 0.5, 0)) with { Friction = 0.3, Mass = 1 });
        world.Run(90);
        Assert.True(crate.IsAsleep);
        var plate = world.AddStatic(RigidMeshes.Box(0.2, 1, 1), Transformation.Identity with { Position = new(-2, 0.6, 0) });
        world.Run(90);
        plate.SetMotion(2 * Vector.I);
        world.Run(90);
        // Its face is at −1.9 + 3, and the crate before it.
        Assert.InRange(crate.Position.X, 1.1 + 0.5, 1.1 + 0.6);
        Near.Equal(0.5, crate.Position.Y, 1e-3);
    }

    [Fact]
    public void Crates_OfDifferentFriction_SlideByTheSmaller()
    {
        var world = BoxContactTests.CreateOnFloor();
        world.Add(RigidMeshes.Describe(RigidMeshes.Box(8, 1, 2), new(0, 0.5, 0)) with { Friction = 2, Mass = 100 });
        var upper = world.Add(RigidMeshes.Describe(Crate, new(-2, 1.501, 0)) with { Friction = 0.2, Mass = 1, Velocity = 2 * Vector.I });
        world.Run(120);
        Near.Equal(-2 + (4 / (2 * 0.2 * 9.8)), upper.Position.X, 0.03);
    }
}
