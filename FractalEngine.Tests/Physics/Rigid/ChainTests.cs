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
        var (body, _) = RunOnSlope(angle, Friction, 60);   // of BoxContactTests, gap 0
        var acceleration = 9.8 * (Math.Sin(angle) - (Friction * Math.Cos(angle)));
        Near.Equal(acceleration, body.Velocity.Length(), 0.02 * acceleration);
    }

    [Fact]
    public void Dominoes_FallInOrder() => CheckDominoes(12);

    [Fact]
    [Trait("Category", "Soak")]
    public void ManyDominoes_FallInOrder() => CheckDominoes(100);

    private static void CheckDominoes(int count)
    {
        const double Height = 1;
        var world = CreateOnFloor();
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
        var world = CreateOnFloor();
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

    private static PhysicsWorld CreateOnFloor() =>
        TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));

    private static (Body Body, Vector Travel) RunOnSlope(double angle, double friction, int steps, double gap = 0)
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
