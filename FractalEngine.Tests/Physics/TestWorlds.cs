using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Tests.Physics;

/// <summary>Makes worlds of static objects for bodies to move in, and measures what these conserve.</summary>
internal static class TestWorlds
{
    public static readonly Vector Gravity = Scene.DefaultGravity;

    public static PhysicsWorld Create(Vector gravity, PhysicsSettings settings, params PlacedModel[] objects) =>
        new(new LoadedScene(new() { Gravity = gravity }, [.. objects]), settings);

    public static PhysicsWorld Create(Vector gravity, double step, params PlacedModel[] objects) =>
        Create(gravity, new PhysicsSettings { TimeStep = step }, objects);

    public static PlacedModel Place(Mesh mesh, Transformation? placement = null) =>
        new(new SceneObject(mesh) { Placement = placement ?? Transformation.Identity });

    public static PlacedModel Place(Fractal fractal, Transformation? placement = null) =>
        new(new SceneObject(fractal) { Placement = placement ?? Transformation.Identity });

    public static void Run(this PhysicsWorld world, int steps, Action? afterEach = null)
    {
        for (var step = 0; step < steps; step++)
        {
            world.Step();
            afterEach?.Invoke();
        }
    }

    /// <summary>Kinetic and potential energy of all bodies, joules.</summary>
    public static double Energy(this PhysicsWorld world) =>
        world.Bodies.Sum(body => body.SpinEnergy + (body.Description.Mass
            * ((0.5 * body.Velocity.LengthSquared()) - Vector.Dot(world.Gravity, body.Position))));

    public static Vector Momentum(this PhysicsWorld world) =>
        world.Bodies.Aggregate(Vector.Zero, (sum, body) => sum + (body.Description.Mass * body.Velocity));
}
