using FractalEngine.App.Window;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>The physics of a window whose scene, or whose bodies, go beyond the limits.</summary>
public sealed class ScenePhysicsTests
{
    private static readonly SceneObject Mill =
        new(Shapes.Cube()) { Placement = Samples.Move(-2, 0.5, 0), Motion = new() { Spin = new(0, 20, 0) } };

    [Fact]
    public void Advance_OfASceneBeyondTheLimits_SaysSoAndMovesNothing()
    {
        using var allowed = Create(SceneWith(4));
        Assert.True(allowed.IsRunning);
        Assert.Null(allowed.TakeProblem());

        // As an edit of the scene does.
        using var edited = Create(SceneWith(1e308), allowed);
        _ = edited.ToggleClosestPoints();
        Assert.False(edited.IsRunning);
        Assert.False(edited.Advance(TimeSpan.FromSeconds(1)));
        Assert.EndsWith("is beyond the limit of 1e150 of physics", edited.TakeProblem(), StringComparison.Ordinal);
        Assert.Null(edited.TakeProblem());

        using var undone = Create(SceneWith(4), edited);
        Assert.True(undone.IsRunning);
        Assert.Null(undone.TakeProblem());
    }

    [Fact]
    public void Advance_OfABodyThatFliesBeyondTheLimits_StopsWithAMessage()
    {
        using var physics = Create(SceneWith(1, new(1e150, 1e150, 0)));
        Assert.True(physics.Advance(TimeSpan.FromSeconds(1)));
        for (var frame = 0; frame < 200 && physics.IsRunning; frame++)
        {
            _ = physics.Advance(TimeSpan.FromSeconds(0.02));
        }

        Assert.False(physics.IsRunning);
        Assert.Contains("beyond the limit of 1e150 of physics", physics.TakeProblem(), StringComparison.Ordinal);
    }

    [Fact]
    public void ClosestPointLines_OfBodiesWithoutADistance_AreNone()
    {
        var distant = new SceneObject(Shapes.Cube()) { Placement = Samples.Move(1e308, 0, 0) };
        var world = new PhysicsWorld(new Scene { Objects = [Mill, distant] });
        _ = world.Add(new(new(0, 0, 1e308), 0.7));
        Assert.Empty(ClosestPointLines.Create(world, 1));
        _ = world.Add(new(new(0, 0, 3), 0.7));
        Assert.Equal(2, ClosestPointLines.Create(world, 1).Count);
    }

    private static Scene SceneWith(double z, Vector velocity = default) => new()
    {
        Objects = [new PhysicsObject(new MeshModel(Shapes.Cube()), 0.7) { Placement = Samples.Move(0, 0, z), Velocity = velocity }, Mill],
    };

    private static ScenePhysics Create(Scene scene, ScenePhysics? previous = null)
    {
        using var completed = new ManualResetEventSlim();
        var physics = new ScenePhysics(LoadedScene.Of(scene), completed.Set, previous);
        Assert.True(completed.Wait(Polling.Deadline));
        return physics;
    }
}
