using System.Numerics;
using FractalEngine.Core;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Scenes;

namespace FractalEngine.App.Window;

/// <summary>Takes one collider after the other for all bodies, as far as they fit the scene; then each body its own again.</summary>
internal static class ColliderSwitch
{
    // Beyond, meshes of whole fractals take seconds to build.
    private const int MaxExpandedFaces = 2_000_000;

    /// <summary>Takes the next. Why others were passed over is written to the terminal.</summary>
    /// <returns>What to say.</returns>
    public static string SwitchToNext(PhysicsWorld world, LoadedScene scene)
    {
        var kinds = Enum.GetValues<ColliderKind>();
        for (var next = world.ColliderOverride is { } before ? (int)before + 1 : 0; next < kinds.Length; next++)
        {
            if (TrySwitchTo(world, scene, kinds[next], out var reason))
            {
                return $"collider: {SceneParser.GetColliderName(kinds[next])}";
            }

            Console.Error.WriteLine($"collider {SceneParser.GetColliderName(kinds[next])}: {reason}");
        }

        world.ColliderOverride = null;
        return "collider: each body's own";
    }

    private static bool TrySwitchTo(PhysicsWorld world, LoadedScene scene, ColliderKind kind, out string reason)
    {
        var models = scene.Objects.Where(static placed => placed.Declaration is not PhysicsObject).Select(static placed => placed.Model)
            .Distinct();
        var faces = models.Aggregate(BigInteger.Zero, (sum, model) => sum + (model.FaceCount ?? MaxExpandedFaces + 1));
        if (kind is ColliderKind.Hierarchy or ColliderKind.BoundingBox or ColliderKind.Simple && faces > MaxExpandedFaces)
        {
            reason = "the scene has more faces than it is made for in a window";
            return false;
        }

        var previous = world.ColliderOverride;
        try
        {
            world.ColliderOverride = kind;
            world.BuildColliders();
            reason = "";
            return true;
        }
        catch (FractalEngineException exception)
        {
            (world.ColliderOverride, reason) = (previous, exception.Message);
            return false;
        }
    }
}
