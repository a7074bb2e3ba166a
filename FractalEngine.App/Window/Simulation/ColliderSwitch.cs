using System.Numerics;
using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;

namespace FractalEngine.App.Window.Simulation;

/// <summary>Switches all bodies to the next collider that fits the scene, and after the last one back to their own.</summary>
internal static class ColliderSwitch
{
    // Colliders of more expanded faces take seconds to build, during which the window would not react.
    private const int MaxInteractiveFaces = 2_000_000;

    /// <summary>Switches to the next collider. The reasons why others were skipped are written to stderr.</summary>
    /// <returns>A message for the user.</returns>
    public static string SwitchToNext(PhysicsWorld world, LoadedScene scene)
    {
        var kinds = Enum.GetValues<ColliderKind>();
        var nextIndex = world.ColliderOverride is { } current ? (int)current + 1 : 0;
        foreach (var kind in kinds.Skip(nextIndex))
        {
            var name = ColliderNames.Of(kind);
            if (TrySwitchTo(world, scene, kind, out var reason))
            {
                return $"collider: {name}";
            }

            Console.Error.WriteLine($"collider {name}: {reason}");
        }

        world.ColliderOverride = null;
        return "collider: each body's own";
    }

    private static bool TrySwitchTo(PhysicsWorld world, LoadedScene scene, ColliderKind kind, out string reason)
    {
        var needsExpansion = kind is ColliderKind.Hierarchy or ColliderKind.BoundingBox or ColliderKind.Simple;
        if (needsExpansion && CountFaces(scene) > MaxInteractiveFaces)
        {
            reason = FormattableString.Invariant($"more than {MaxInteractiveFaces:N0} faces are too many to build it in a window");
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
            world.ColliderOverride = previous;
            reason = exception.Message;
            return false;
        }
    }

    /// <summary>Counts the faces of all models that no physics moves; an infinite fractal counts as too many.</summary>
    private static BigInteger CountFaces(LoadedScene scene) =>
        scene.StaticModels.Aggregate(BigInteger.Zero, static (sum, model) => sum + (model.FaceCount ?? MaxInteractiveFaces + 1));
}
