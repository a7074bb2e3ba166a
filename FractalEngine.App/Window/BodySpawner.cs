using System.Diagnostics.CodeAnalysis;
using FractalEngine.Core;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;

namespace FractalEngine.App.Window;

/// <summary>Adds spheres and players to a world at the camera, small enough for the free space there.</summary>
internal static class BodySpawner
{
    // Fractions of the scene's size.
    private const double SphereRadiusFraction = 0.015;
    private const double PlayerHeightFraction = 0.05;

    // Fraction of the player's height.
    private const double PlayerRadiusFraction = 0.2;

    // Fraction of the distance from the camera to the closest surface, so that a new body overlaps nothing.
    private const double FreeDistanceFraction = 0.3;

    private const double SphereRestitution = 0.6;
    private const double SphereFriction = 0.3;

    /// <summary>Drops a sphere in front of the camera.</summary>
    /// <param name="world">The world that the sphere is added to.</param>
    /// <param name="sceneSize">The size of the scene in scene units.</param>
    /// <param name="camera">The present camera.</param>
    /// <returns>A message for the user.</returns>
    public static string DropSphere(PhysicsWorld world, double sceneSize, Camera camera)
    {
        if (!TryFindFreeDistance(world, camera.Position, out var freeDistance, out var problem))
        {
            return problem;
        }

        var radius = Math.Min(SphereRadiusFraction * sceneSize, FreeDistanceFraction * freeDistance);
        if (!(radius > 0))
        {
            return "there is no room for a ball";
        }

        world.Add(new(camera.Position + (2 * radius * camera.LocalAxes.V3), radius)
        {
            Restitution = SphereRestitution,
            Friction = SphereFriction,
        });
        return "dropped a ball";
    }

    /// <summary>Activates the player: that of the scene, or else a new one at the camera.</summary>
    /// <param name="world">The world of the scene.</param>
    /// <param name="scene">The scene that may declare a player.</param>
    /// <param name="sceneSize">The size of the scene in scene units.</param>
    /// <param name="camera">The present camera.</param>
    /// <param name="problem">The reason why no player can walk; null on success.</param>
    /// <returns>True on success.</returns>
    public static bool TryActivatePlayer(
        PhysicsWorld world, Scene scene, double sceneSize, Camera camera, [NotNullWhen(false)] out string? problem)
    {
        if (!TryFindFreeDistance(world, camera.Position, out var freeDistance, out problem))
        {
            return false;
        }

        if (scene.Player is null)
        {
            var height = Math.Min(PlayerHeightFraction * sceneSize, FreeDistanceFraction * freeDistance);
            if (!(height > 0))
            {
                problem = "there is no room for a player";
                return false;
            }

            world.AddCharacter(new(camera.Position, PlayerRadiusFraction * height, height));
        }

        world.Character!.IsActive = true;
        return true;
    }

    /// <summary>Computes the distance from a position to the closest surface. The first call builds the colliders.</summary>
    private static bool TryFindFreeDistance(
        PhysicsWorld world, Vector position, out double distance, [NotNullWhen(false)] out string? problem)
    {
        distance = double.PositiveInfinity;
        problem = null;
        try
        {
            if (world.TryFindClosest(position, world.ColliderOverride ?? ColliderKind.Exact, out var closest))
            {
                distance = closest.Distance;
            }

            return true;
        }
        catch (FractalEngineException exception)
        {
            problem = $"error: {exception.Message}";
            return false;
        }
    }
}
