using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>Holes, rings and hooks: what bodies that were only hulls or balls could not do.</summary>
public class ThroughHoleTests
{
    private const double SpongeSize = 3;

    private static readonly (double Radius, double Y)[] Bowl = [(0, 0), (1, 0), (2, 1.5), (1.8, 1.5), (0.9, 0.2), (0, 0.2)];

    private static readonly Matrix SpongeScale = SpongeSize * Matrix.Identity;

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void Box_FallsThroughTheHoleOfASponge(int depth)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0);
        world.AddStatic(PhysicsMeshes.CreateSponge(depth), Transformation.Identity with { Scale = SpongeSize * Vector.One });
        var body = world.Add(RigidMeshes.Describe(RigidMeshes.Box(0.6, 0.6, 0.6), new(0.05, 3, -0.03), Matrix.Rotation(Vector.J, 0.2)) with
        {
            Restitution = 0.3,
            Friction = 0.1,
            AngularVelocity = new(0.3, 0.2, 0.1),
        });
        var passed = false;
        world.Run(240, () =>
        {
            var position = body.Position;
            passed |= position.Y < 0;
            Assert.True(
                Math.Abs(position.Y) > 1.5 || Math.Max(Math.Abs(position.X), Math.Abs(position.Z)) < 0.2, $"left the hole at {position}");
        });
        Assert.True(passed);
        Assert.InRange(body.Position.Y, -100, -2);
    }

    [Fact]
    public void Box_ThatIsTooLarge_DoesNot()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0);
        world.AddStatic(PhysicsMeshes.CreateSponge(1), Transformation.Identity with { Scale = SpongeSize * Vector.One });
        var body = world.Add(RigidMeshes.Describe(RigidMeshes.Box(1.01, 0.6, 1.01), new(0.001, 3, 0)) with { Friction = 0.5 });
        world.Run(240);
        Near.Equal(1.8, body.Position.Y, 1e-3);
        Assert.True(body.IsAsleep);
    }

    [Fact]
    public void Box_FallsIntoTheHoleOfASpongeThatSleeps()
    {
        var world = CreateOnFloor();
        var fractal = PhysicsMeshes.CreateSponge(1);
        var shape = new MeshShape(Model.Of(fractal), SpongeScale);
        var sponge = world.Add(new BodyDescription(new(0, 1.5, 0), shape) { Mass = 1e4, Friction = 0.5 });
        world.Run(120);
        Assert.True(sponge.IsAsleep);
        Near.Equal(new(0, 1.5, 0), sponge.Position, 1e-3);
        var body = world.Add(RigidMeshes.Describe(RigidMeshes.Box(0.6, 0.6, 0.6), new(0.05, 4, -0.03), Matrix.Rotation(Vector.J, 0.2)) with
        {
            Mass = 1,
            Friction = 0.1,
        });
        world.Run(300);
        Near.Equal(0.3, body.Position.Y, 1e-3);
        Near.Equal(new(0, 1.5, 0), sponge.Position, 2e-3);
        Assert.All(world.Bodies, each => Assert.True(each.IsAsleep, $"body {each.Index} is awake"));
    }

    [Fact]
    public void Sponge_FallsOverABarThroughItsHole()
    {
        // The bar stands in the hole, and the sponge slides down along it.
        var world = CreateOnFloor();
        world.AddStatic(RigidMeshes.Box(new(-0.3, 0, -0.3), new(0.3, 5, 0.3)));
        var shape = new MeshShape(Model.Of(PhysicsMeshes.CreateSponge(2)), SpongeScale);
        var sponge = world.Add(new BodyDescription(new(0.05, 6.7, 0), shape) { Mass = 10, Friction = 0.1 });
        world.Run(300);
        Near.Equal(1.5, sponge.Position.Y, 1e-3);
        Assert.InRange(Math.Max(Math.Abs(sponge.Position.X), Math.Abs(sponge.Position.Z)), 0, 0.21);
    }

    [Fact]
    public void Ring_OnAPeg_StaysOnIt()
    {
        var world = CreateOnFloor();
        world.AddStatic(RigidMeshes.Box(new(-0.2, 0, -0.2), new(0.2, 2, 0.2)));
        var ring = world.Add(RigidMeshes.Describe(RigidMeshes.Join(RigidMeshes.BoxesOfFrame(2, 1, 0.3)), new(0.1, 2.6, 0.05)) with
        {
            Mass = 1,
            Friction = 0.3,
            Restitution = 0.2,
            AngularVelocity = new(0.1, 0.5, 0),
        });
        world.Run(300);
        Near.Equal(0.15, ring.Position.Y, 1e-3);
        world.SetVelocity(ring, new(3, 0, 2));
        world.Run(300, () => Assert.InRange(Math.Max(Math.Abs(ring.Position.X), Math.Abs(ring.Position.Z)), 0, 0.6));
        Near.Equal(0.15, ring.Position.Y, 1e-3);
        Assert.True(ring.IsAsleep);
    }

    [Fact]
    public void Hook_OnAHook_Hangs()
    {
        var world = CreateOnFloor();
        // A rod along x with a tip that points up at its end, and a clamp with legs of different lengths over it.
        world.AddStatic(
            RigidMeshes.Join(RigidMeshes.Box(new(-2, 3, -0.1), new(1, 3.2, 0.1)), RigidMeshes.Box(new(0.8, 3.2, -0.1), new(1, 3.7, 0.1))));
        var clamp = RigidMeshes.Join(
            RigidMeshes.Box(new(-0.1, 0, -0.4), new(0.1, 0.2, 0.4)),
            RigidMeshes.Box(new(-0.1, -1, -0.4), new(0.1, 0, -0.2)),
            RigidMeshes.Box(new(-0.1, -0.7, 0.2), new(0.1, 0, 0.4)));
        var start = new Vector(0, 3.25, 0) + SolidMoments.Of(clamp, AffineMap.Identity).Centre;
        var hook = world.Add(RigidMeshes.Describe(clamp, start) with { Mass = 1, Friction = 0.5 });
        world.Run(300);
        Assert.True(hook.IsAsleep, $"it moves at {hook.Velocity}");
        Assert.InRange(RigidMeshes.LowestPoint(hook), 1.5, 3);
        // The tip keeps it from being thrown off along the rod.
        world.SetVelocity(hook, new(2, 0, 0));
        world.Run(300);
        Assert.InRange(hook.Position.X, 0, 0.8);
        Assert.InRange(RigidMeshes.LowestPoint(hook), 1.5, 3);
    }

    [Fact]
    public void Ball_InABowl_StaysInIt()
    {
        var bowl = RigidMeshes.Revolve(Bowl, 12);
        var world = CreateOnFloor();
        world.AddStatic(bowl);
        var ball = world.AddSphere(new(1.2, 2, 0), 0.3, 0.3, new(0, 0, 2), friction: 0.3, damping: 0.7);
        world.Run(600, () => CheckInside(ball.Position));
        Near.Equal(0.5, ball.Position.Y, 1e-6);
    }

    [Fact]
    public void Ball_InABowlThatIsABody_StaysInIt()
    {
        var world = CreateOnFloor();
        var mesh = RigidMeshes.Revolve(Bowl, 12);
        var centre = SolidMoments.Of(mesh, AffineMap.Identity).Centre;
        var bowl = world.Add(RigidMeshes.Describe(mesh, centre) with { Mass = 50, Friction = 0.6 });
        var ball = world.AddSphere(new(1.2, 2, 0), 0.3, 0.3, new(0, 0, 2), friction: 0.3, damping: 0.7);
        world.Run(600, () => CheckInside(ball.Position - RigidMeshes.PointOf(bowl, Vector.Zero)));
        Assert.InRange(bowl.Orientation.Rotate(Vector.J).Y, 0.999, 1.001);
    }

    private static void CheckInside(Vector position) =>
        Assert.True(position.Y >= 0.5 - 1e-3 && new Vector(position.X, 0, position.Z).Length() < 2, $"the ball is at {position}");

    private static PhysicsWorld CreateOnFloor() =>
        TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
}
