using FractalEngine.App.Window.Simulation;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Preparation;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Preparation;

/// <summary>Tests the scene that is traced while bodies stand still.</summary>
public class MovedSceneTests
{
    [Fact]
    public void With_OfBodies_ChangesOnlyWhenOneMoves()
    {
        var floor = new SceneObject(Shapes.Box(new(new(-10, -1, -10), new(10, 0, 10))));
        var ball = new PhysicsObject(new MeshModel(Shapes.Sphere(2)), 0.5) { Placement = Transformation.At(new(3, 5, 0)) };
        var scene = LoadedScene.Of(new() { Objects = [floor, ball] });
        var moved = new MovedScene(scene);
        Assert.Same(scene, moved.With(null));

        var world = new PhysicsWorld(scene);
        var before = moved.With(world);
        Assert.Same(before, moved.With(world));
        Near.Equal(new(3, 5, 0), before.Objects[1].ObjectToWorld.Translation, 1e-12);

        world.Step();
        var after = moved.With(world);
        Assert.NotSame(before, after);
        Assert.True(after.Objects[1].ObjectToWorld.Translation.Y < 5);

        // A dropped ball is no object of the scene.
        BodySpawner.DropSphere(world, 28, new Camera(new(0, 3, -8), Vector.Zero, 50));
        var dropped = moved.With(world);
        Assert.Equal(3, dropped.Objects.Length);
        var body = world.Bodies[1];
        Near.Equal(body.Position, dropped.Objects[2].Bounds.Centre, 1e-9);
        Assert.Equal(2 * body.Radius, dropped.Objects[2].Bounds.Size.X, 0.01 * body.Radius);
    }
}
