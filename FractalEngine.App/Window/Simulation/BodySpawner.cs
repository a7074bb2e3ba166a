using System.Diagnostics.CodeAnalysis;
using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.App.Window.Simulation;

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

    // Radii of a dropped sphere that are free around it.
    private const double FreeRadii = 1.5;

    private const double SphereRestitution = 0.6;
    private const double SphereFriction = 0.3;

    /// <summary>
    /// Drops a sphere where the camera looks: before the surface in the middle of the view, or in the air beside the scene.
    /// </summary>
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

        var wantedRadius = SphereRadiusFraction * sceneSize;
        var distance = FindVisibleDistance(world, camera, FreeRadii * wantedRadius, sceneSize);
        var radius = wantedRadius;
        if (distance < 2 * wantedRadius)
        {
            // The camera is too close to a surface for a ball of this size.
            radius = Math.Min(wantedRadius, FreeDistanceFraction * freeDistance);
            distance = 2 * radius;
        }

        return AddBall(world, camera.Position + (distance * camera.LocalAxes.V3), radius, Vector.Zero) ?? "dropped a ball";
    }

    /// <summary>Throws a sphere from the camera straight ahead, fast enough to cross half of the scene in a second.</summary>
    /// <inheritdoc cref="DropSphere"/>
    public static string ThrowSphere(PhysicsWorld world, double sceneSize, Camera camera)
    {
        if (!TryFindFreeDistance(world, camera.Position, out var freeDistance, out var problem))
        {
            return problem;
        }

        var radius = Math.Min(SphereRadiusFraction * sceneSize, FreeDistanceFraction * freeDistance);
        var velocity = 0.5 * sceneSize * camera.LocalAxes.V3;
        return AddBall(world, camera.Position + (2 * radius * camera.LocalAxes.V3), radius, velocity) ?? "threw a ball";
    }

    /// <summary>Adds a ball, if it has a size.</summary>
    /// <returns>The reason why there is none; null on success.</returns>
    private static string? AddBall(PhysicsWorld world, Vector position, double radius, Vector velocity)
    {
        if (!(radius > 0))
        {
            return "there is no room for a ball";
        }

        world.Add(new(position, radius) { Velocity = velocity, Restitution = SphereRestitution, Friction = SphereFriction });
        return null;
    }

    /// <summary>Tells whether a falling player meets something.</summary>
    public static bool HasGround(PhysicsWorld world)
    {
        var player = world.Character!;
        return world.TryCastSphere(player.Position, player.Description.Radius, WayThrough(world, player.Position, -player.Up), out _);
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

    /// <summary>
    /// Finds how far the line of sight has some room around it, before it meets something, or else to where it passes the middle of all
    /// objects.
    /// </summary>
    /// <returns>A distance from the camera in scene units; 0 where there is no room.</returns>
    private static double FindVisibleDistance(PhysicsWorld world, Camera camera, double room, double sceneSize)
    {
        var direction = camera.LocalAxes.V3;
        var bounds = BoundsOf(world);
        return bounds.IsEmpty || !(room > 0) ? sceneSize
            : world.TryCastSphere(camera.Position, room, WayThrough(world, camera.Position, direction), out var hit) ? hit.Distance
            : Math.Max(0, Vector.Dot(bounds.Centre - camera.Position, direction));
    }

    /// <summary>Returns a way that ends beyond all objects.</summary>
    private static Vector WayThrough(PhysicsWorld world, Vector position, Vector direction)
    {
        var bounds = BoundsOf(world);
        return ((bounds.Centre - position).Length() + bounds.Diagonal) * direction;
    }

    private static BoundingBox BoundsOf(PhysicsWorld world) =>
        world.StaticObjects.Aggregate(BoundingBox.Empty, static (box, placed) => BoundingBox.Union(box, placed.Bounds));

    /// <summary>Computes the distance from a position to the closest surface. The first call builds the colliders.</summary>
    private static bool TryFindFreeDistance(
        PhysicsWorld world, Vector position, out double distance, [NotNullWhen(false)] out string? problem)
    {
        distance = double.PositiveInfinity;
        problem = null;
        try
        {
            if (world.TryFindClosest(position, ColliderKind.Exact, out var closest))
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
