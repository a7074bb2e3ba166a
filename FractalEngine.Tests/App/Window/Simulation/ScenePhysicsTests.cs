using FractalEngine.App.Window.Simulation;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Lines;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.Simulation;

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
    public void Advance_OfBodiesThatOverlapByTheHundred_SaysSoAndMovesNothing()
    {
        var bodies = Enumerable.Repeat<SceneObject>(new PhysicsObject(new MeshModel(Shapes.Cube()), 0), 201);
        using var physics = Create(new() { Objects = [.. bodies] });
        Assert.False(physics.Advance(TimeSpan.FromSeconds(1)));
        Assert.EndsWith("more than the limit of 20000 pairs", physics.TakeProblem(), StringComparison.Ordinal);
    }

    [Fact]
    public void Shrinking_OfAScene_IsSwitchedForThoseThatItLetsShrink()
    {
        var scene = SceneWith(4);
        var declared = (PhysicsObject)scene.Objects[0] with { Shrinkage = 0.2 };
        using var physics = Create(scene with { Objects = [declared, scene.Objects[0] with { Placement = Samples.Move(9, 9, 9) }] });
        Assert.True(physics.IsShrinking);
        Assert.Equal("nothing shrinks", physics.ToggleShrinking());
        Assert.False(physics.IsShrinking);
        Assert.Equal("shrinking, as the scene has it", physics.ToggleShrinking());
        Assert.Equal([0.2, 0], physics.World!.Bodies.Select(static body => body.Shrinkage));
    }

    [Fact]
    public void Shrinking_OfASceneThatLetsNoneShrink_IsSwitchedForAllAndOutlivesAnEdit()
    {
        using var physics = Create(SceneWith(4));
        Assert.False(physics.IsShrinking);
        Assert.Equal("all bodies shrink", physics.ToggleShrinking());
        var dropped = physics.World!.AddSphere(new(0, 50, 0), 1);
        Advance(physics, 30);
        Assert.InRange(dropped.Scale, 0.94, 0.96);
        using var edited = Create(SceneWith(5), physics);
        Assert.True(edited.IsShrinking);
        Assert.Equal("nothing shrinks", edited.ToggleShrinking());
        var before = edited.World!.Bodies.Select(static body => body.Scale).ToArray();
        Advance(edited, 30);
        Assert.Equal(before, edited.World.Bodies.Select(static body => body.Scale));

        static void Advance(ScenePhysics physics, int steps)
        {
            for (var step = 0; step < steps; step++)
            {
                _ = physics.StepOnce();
            }
        }
    }

    [Fact]
    public void Speed_OfTheSimulation_OutlivesAnEdit()
    {
        using var physics = Create(SceneWith(4));
        physics.Speed = 0.25;
        using var edited = Create(SceneWith(5), physics);
        Assert.Equal(0.25, edited.Speed);
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
