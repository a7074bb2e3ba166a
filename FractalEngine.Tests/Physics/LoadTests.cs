using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Bodies that lie on each other, fall together, or lose what they lie on.</summary>
public sealed class LoadTests
{
    [Theory]
    [InlineData(1)]
    [InlineData(100)]
    public void Stack_OfElasticSpheres_DoesNotBounceFromItsLoad(double mass)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings { SleepSpeed = 0 },
            TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var lower = world.Add(new(new(0, 0.5, 0), 0.5) { Restitution = 0.9 });
        var upper = world.Add(new(new(0, 1.5, 0), 0.5) { Restitution = 0.9, Mass = mass });
        world.Run(600);
        // Both fall by what counts as touching, and rest.
        Near.Equal(new(0, 0.5, 0), lower.Position, 1e-5);
        Near.Equal(new(0, 1.5, 0), upper.Position, 1e-5);
    }

    [Fact]
    public void Pair_InContactInTheAir_FallsAsEachAlone()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings());
        var upper = world.Add(new(new(0, 1, 0), 0.5) { Mass = 100, Friction = 0.5 });
        var lower = world.Add(new(new(0, 0, 0), 0.5));
        world.Run(60);
        // One step apart at most: each sees the other where it is at that moment.
        var fallen = 0.5 * 9.8;
        Near.Equal(new(0, 1 - fallen, 0), upper.Position, 9.8 / 60);
        Near.Equal(new(0, -fallen, 0), lower.Position, 9.8 / 60);
    }

    [Fact]
    public void SleepingBody_OnABodyThatShrinks_SinksWithIt()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings(), TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        world.Add(new(new(0, 1, 0), 1) { Shrinkage = 0.01, MinimumScale = 0.5, Friction = 1 });
        var upper = world.Add(new(new(0, 3, 0), 1) { Friction = 1 });
        world.Run(1200);
        Assert.InRange(upper.Position.Y, 0, 2.65);
    }

    [Fact]
    public void Player_AgainstASphereInContact_PushesIt()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings(), TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var walker = world.AddCharacter(new(new(0, 0.9, 0), 0.3, 1.8));
        var body = world.Add(new(new(0.61, 0.3, 0), 0.3));
        walker.IsActive = true;
        world.Run(60);
        walker.MoveInput = Vector.I;
        world.Run(60);
        Assert.True(body.Position.X > 3, $"{body.Position}");
    }

    [Fact]
    public void Sphere_OnAPlayerWhoLeaves_Falls()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings(), TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var walker = world.AddCharacter(new(new(0, 0.9, 0), 0.3, 1.8));
        walker.IsActive = true;
        var body = world.Add(new(new(0, 2.2, 0), 0.3));
        world.Run(300);
        Assert.True(body.IsAsleep);
        Near.Equal(2.1, body.Position.Y, 1e-6);
        walker.IsActive = false;
        world.Run(120);
        Near.Equal(0.3, body.Position.Y, 1e-6);

        // And a player who comes back where it lies stands beside or above it, and can walk.
        walker.IsActive = true;
        walker.MoveInput = Vector.K;
        world.Run(120);
        Assert.True(walker.Position.Z > 3, $"{walker.Position}");
    }

    [Theory]
    [InlineData(1, 0.45)]
    [InlineData(1, 0.5)]
    [InlineData(1, 0.55)]
    [InlineData(-1, 0.45)]
    [InlineData(-1, 0.5)]
    [InlineData(-1, 0.55)]
    public void Start_AtASolidsSurface_EndsOutside(double mirror, double height)
    {
        var world =
            TestWorlds.Create(Vector.Zero, new PhysicsSettings(),
            TestWorlds.Place(PhysicsMeshes.Cube, new(Vector.Zero, Vector.Zero, new(mirror, 1, 1))));
        var body = world.Add(new(new(0.05, height, 0.1), 0.1));
        world.Step();
        Near.Equal(new(0.05, 0.6, 0.1), body.Position, 1e-6);
    }

    [Fact]
    public void Reset_AfterAnObjectWasMoved_PutsItBack()
    {
        var scene = new LoadedScene(new Scene(),
        [
            TestWorlds.Place(PhysicsMeshes.FloorMesh()),
            new(new PhysicsObject("cube.obj", PlacementAt(2), 0.5), new MeshModel(PhysicsMeshes.Cube) { SourcePath = "cube.obj" }),
        ]);
        var world = new PhysicsWorld(scene);
        world.Run(120);
        var hash = world.StateHash;
        world.MoveObject(0, PlacementAt(-5));
        world.Run(60);
        world.Reset();
        world.Run(120);
        Assert.Equal(hash, world.StateHash);
    }

    private static Transformation PlacementAt(double height) => Transformation.Identity with { Position = new(0, height, 0) };
}
