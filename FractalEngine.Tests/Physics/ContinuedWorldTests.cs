using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Worlds that go on with the bodies of another world after its scene was changed.</summary>
public sealed class ContinuedWorldTests
{
    private static readonly Model Cube = new MeshModel(Shapes.Cube());
    private static readonly Model Floor = new MeshModel(Shapes.Box(new(new(-10, -1, -10), new(10, 0, 10))));

    [Fact]
    public void Continue_AfterAChange_KeepsUnchangedBodiesAndStartsOthersAnew()
    {
        var kept = new PhysicsObject(Cube) { Placement = Samples.Move(0, 5, 0), Name = "kept" };
        var twin = kept with { };
        var changed = new PhysicsObject(Cube) { Placement = Samples.Move(4, 5, 0), Name = "changed" };
        var first = new PhysicsWorld(new Scene { Objects = [new SceneObject(Floor), kept, changed, twin] });
        first.AddSphere(new(-4, 9, 0), 0.5);
        first.Run(20);

        var moved = changed with { Placement = Samples.Move(4, 8, 0) };
        var second = new PhysicsWorld(new Scene { Objects = [moved, twin, new SceneObject(Floor), kept] });
        second.Continue(first);
        Assert.Equal(4, second.Bodies.Count);
        Assert.Equal((new Vector(4, 8, 0), Vector.Zero), (second.Bodies[0].Position, second.Bodies[0].Velocity));
        Assert.Equal(
            [State(first.Bodies[0]), State(first.Bodies[2]), State(first.Bodies[3])], second.Bodies.Skip(1).Select(State));
        Assert.Equal(first.Time, second.Time);
        Assert.NotEqual(5, second.Bodies[1].Position.Y);
        second.Run(10);
        second.Reset();
        Assert.Equal(3, second.Bodies.Count);
        Assert.Equal(new Vector(0, 5, 0), second.Bodies[1].Position);
    }

    [Fact]
    public void Continue_WithoutAChange_GoesOnAsIfNothingHadHappened()
    {
        var scene = new Scene { Objects = [new SceneObject(Floor), new PhysicsObject(Cube, 0.5) { Placement = Samples.Move(0, 5, 0) }] };
        var expected = new PhysicsWorld(scene);
        var first = new PhysicsWorld(scene);
        expected.Run(40);
        first.Run(40);
        var second = new PhysicsWorld(scene);
        second.Continue(first);
        expected.Run(100);
        second.Run(100);
        Assert.Equal(expected.StateHash, second.StateHash);
    }

    [Fact]
    public void Continue_OfAWalkingCharacter_GoesOnWalking()
    {
        var scene = new Scene { Objects = [new SceneObject(Floor)] };
        var first = new PhysicsWorld(scene);
        first.AddCharacter(new(new(1, 2, 3), 0.3, 1.6)).IsActive = true;
        first.Run(30);
        var second = new PhysicsWorld(scene with { Objects = [new SceneObject(Floor), new SceneObject(Cube)] });
        second.Continue(first);
        Assert.Equal(
            (first.Character!.Position, first.Character.Velocity, true),
            (second.Character!.Position, second.Character.Velocity, second.Character.IsActive));
    }

    [Fact]
    public void ColliderCache_OfTwoWorlds_BuildsEachColliderOnce()
    {
        var cache = new ColliderCache();
        var scene = LoadedScene.Of(new Scene { Objects = [new SceneObject(Floor), new SceneObject(Cube)] });
        var first = new PhysicsWorld(scene, null, cache);
        first.BuildColliders();
        var changed = LoadedScene.Of(new Scene { Objects = [new SceneObject(new MeshModel(Shapes.Cube())), new SceneObject(Floor)] });
        cache.Retain(changed);
        var second = new PhysicsWorld(changed, null, cache);
        Assert.True(second.TryFindClosest(new(0, 50, 0), ColliderKind.Exact, out _));
        Assert.Equal(2, second.ColliderCounts.All);
        Assert.True(first.TryFindClosest(new(0, 50, 0), ColliderKind.Exact, out _));
        using var cancellation = new CancellationTokenSource();
        cancellation.Cancel();
        Assert.Throws<OperationCanceledException>(() => new PhysicsWorld(changed).BuildColliders(cancellation.Token));
        // The floor is built, before anything is asked of the new world.
        var third = new PhysicsWorld(scene, null, cache);
        third.TryFindClosest(new(0, 50, 0), ColliderKind.Exact, out _);
        Assert.True(third.ColliderCounts.Built >= 1);
    }

    private static (Vector, Vector, double) State(Body body) => (body.Position, body.Velocity, body.Scale);
}
