using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Tests.Physics;

/// <summary>Worlds to let bodies loose in, and what is conserved there.</summary>
internal static class TestWorlds
{
    public static readonly Vector Gravity = new(0, -9.8, 0);

    public static PhysicsWorld Create(Vector gravity, PhysicsSettings settings, params PlacedModel[] objects) =>
        new(new(new Scene { Gravity = gravity }, [.. objects]), settings);

    public static PhysicsWorld Create(Vector gravity, double step, params PlacedModel[] objects) =>
        Create(gravity, new PhysicsSettings { TimeStep = step }, objects);

    public static PlacedModel Place(Mesh mesh, Transformation? placement = null) =>
        new(new("mesh.obj", placement ?? Transformation.Identity), new MeshModel(mesh) { SourcePath = "/mesh.obj" });

    public static PlacedModel Place(Fractal fractal, Transformation? placement = null) =>
        new(new("fractal.fdo", placement ?? Transformation.Identity), new FractalModel(fractal) { SourcePath = "/fractal.fdo" });

    public static void Run(this PhysicsWorld world, int steps, Action? afterEach = null)
    {
        for (var step = 0; step < steps; step++)
        {
            world.Step();
            afterEach?.Invoke();
        }
    }

    /// <summary>Of motion and height, joules.</summary>
    public static double Energy(this PhysicsWorld world) =>
        world.Bodies.Sum(body => body.Description.Mass
            * ((0.5 * body.Velocity.LengthSquared()) - Vector.Dot(world.Gravity, body.Position)));

    public static Vector Momentum(this PhysicsWorld world) =>
        world.Bodies.Aggregate(Vector.Zero, (sum, body) => sum + (body.Description.Mass * body.Velocity));
}
