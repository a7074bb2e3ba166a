using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Static objects that are added by code, before and while bodies move.</summary>
public sealed class AddStaticTests
{
    private static readonly Mesh Floor = Shapes.Box(new(new(-10, -1, -10), new(10, 0, 10)));

    [Fact]
    public void AddStatic_ByCode_GivesTheSameBitsAsAScene()
    {
        var sponge = PhysicsMeshes.CreateSponge(2);
        var tilt = Transformation.Identity with { Rotation = new(10, 20, 30), Position = new(0.1, 0.2, 0) };
        var world = new PhysicsWorld();
        world.AddStatic(sponge, tilt);
        world.AddStatic(Floor, Samples.Move(0, -2, 0));
        var sceneWorld = TestWorlds.Create(
            Scene.DefaultGravity, new PhysicsSettings(), TestWorlds.Place(sponge, tilt), TestWorlds.Place(Floor, Samples.Move(0, -2, 0)));
        foreach (var target in new[] { world, sceneWorld })
        {
            target.AddSphere(new(0.1, 1.5, 0.1), 0.1, 0.7);
            target.AddSphere(new(-0.2, 1.7, 0.2), 0.15, 0.3, friction: 0.2);
            target.Run(200);
        }

        Assert.Equal(sceneWorld.StateHash, world.StateHash);
    }

    [Fact]
    public void AddStatic_OfAnInfiniteFractal_HoldsASphere()
    {
        var world = new PhysicsWorld();
        var sponge = world.AddStatic(PhysicsMeshes.CreateSponge(null));
        var body = world.AddSphere(new(0.42, 0.8, 0.42), 0.05);
        world.Run(120);
        // The infinite sponge reaches from −½ to ½, and its edges are solid.
        Near.Equal(0.5 + 0.05, body.Position.Y, 1e-6);
        Assert.Equal((0, Transformation.Identity), (sponge.Index, sponge.Placement));
        Assert.Null(sponge.ObjectIndex);
    }

    [Fact]
    public void AddStatic_BelowAFallingSphere_CatchesIt()
    {
        var world = new PhysicsWorld();
        var body = world.AddSphere(new(0.1, 3, 0.2), 0.5);
        world.Run(30);
        Assert.True(body.Position.Y is > 1 and < 2);
        world.AddStatic(Floor);
        world.Run(120);
        Near.Equal(0.5, body.Position.Y, 1e-6);
        Assert.True(body.IsAsleep);
    }

    [Fact]
    public void AddStatic_IntoASleepingSphere_WakesItAndPushesItOut()
    {
        var world = new PhysicsWorld();
        world.AddStatic(Floor);
        var body = world.AddSphere(new(0, 0.5, 0), 0.5);
        world.Run(120);
        Assert.True(body.IsAsleep);
        var cube = Samples.Move(0.6, 0.5, 0);
        world.AddStatic(Shapes.Cube(), cube);
        world.Run(2);
        // The side of the cube is at x = 0.1.
        Assert.False(body.IsStuck);
        Assert.True(body.Position.X <= 0.1 - (0.5 * (1 - 1e-6)), $"at {body.Position}");
    }

    [Fact]
    public void AddStatic_OfEqualModels_SharesOneCollider()
    {
        var world = new PhysicsWorld();
        var sponge = PhysicsMeshes.CreateSponge(3);
        var first = world.AddStatic(sponge);
        world.BuildColliders();
        Assert.Equal((1, 1), world.ColliderCounts);
        var second = world.AddStatic(sponge, Samples.Move(3, 0, 0));
        var third = world.AddStatic(PhysicsMeshes.CreateSponge(3), Samples.Move(6, 0, 0));
        var fourth = world.AddStatic(first.Model, Samples.Move(9, 0, 0));
        Assert.All(new[] { second, third, fourth }, other => Assert.Same(first.Model, other.Model));
        Assert.Equal((1, 1), world.ColliderCounts);
        // Above a solid edge of the last one.
        Assert.True(world.TryFindClosest(new(9.495, 2, 0.495), ColliderKind.Exact, out var closest));
        Near.Equal(1.5, closest.Distance, 1e-12);
    }

    [Fact]
    public void AddStatic_AfterColliders_BuildsOnlyTheNewOneLazily()
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.CreateSponge(3));
        world.BuildColliders();
        world.AddStatic(Floor, Samples.Move(0, -5, 0));
        Assert.Equal((1, 2), world.ColliderCounts);
        Assert.True(world.TryFindClosest(new(0, 1, 0), ColliderKind.Exact, out _));
        // The floor is farther away than the sponge, so nothing has asked it.
        Assert.Equal((1, 2), world.ColliderCounts);
        Assert.True(world.TryFindClosest(new(0, -4, 0), ColliderKind.Exact, out var closest));
        Assert.Equal((2, 2), world.ColliderCounts);
        Near.Equal(1, closest.Distance, 1e-12);
    }

    [Fact]
    public void AddStatic_AtAPlacementThatIsNone_IsRefusedAndAddsNothing()
    {
        var world = new PhysicsWorld();
        Transformation[] wrong =
        [
            Samples.Move(double.NaN, 0, 0), Samples.Move(0, double.PositiveInfinity, 0),
            Transformation.Identity with { Rotation = new(0, double.NaN, 0) },
            Transformation.Identity with { Scale = new(1, 0, 1) }, Transformation.Identity with { Scale = new(1, 1, double.NaN) },
        ];
        Assert.All(wrong, placement => Assert.Throws<ArgumentException>(() => world.AddStatic(Floor, placement)));
        Assert.Empty(world.StaticObjects);
    }
}
