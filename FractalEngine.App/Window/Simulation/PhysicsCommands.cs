using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.App.Window.Simulation;

/// <summary>What the user does with bodies and with the player. All commands return a message for the user.</summary>
internal static class PhysicsCommands
{
    private const string OutOfRangeMessage = "a body has left the range of numbers: R resets all bodies";

    // Of the first size, where the scene says nothing of shrinking.
    private const double ShrinkagePerSecond = 0.1;

    /// <summary>Pauses the simulation, or resumes it.</summary>
    public static string TogglePause(this ScenePhysics physics)
    {
        physics.IsPaused = physics.IsBroken || !physics.IsPaused;
        return physics.IsBroken ? OutOfRangeMessage : physics.IsPaused ? "paused: N makes one step" : "running";
    }

    public static string StepOnce(this ScenePhysics physics)
    {
        physics.IsPaused = true;
        return physics.IsBroken ? OutOfRangeMessage : physics.WhenReady(world =>
        {
            physics.MakeSteps(world, () =>
            {
                world.Step();
                return 1;
            });
            return FormattableString.Invariant($"step {world.StepCount:N0}, {world.Time:F3} s");
        });
    }

    /// <summary>Returns all bodies and moving objects to their initial states, and removes those that were dropped.</summary>
    public static string Reset(this ScenePhysics physics) => physics.WhenReady(world =>
    {
        world.Reset();
        physics.IsBroken = false;
        return "bodies reset";
    });

    /// <summary>Lets the player walk, or the camera fly.</summary>
    /// <param name="physics">The physics of the scene.</param>
    /// <param name="camera">The place of a new player where the scene has none.</param>
    public static string ToggleWalking(this ScenePhysics physics, Camera camera) => physics.WhenReady(world =>
    {
        if (world.Character is { IsActive: true } controller)
        {
            controller.IsActive = false;
            return "flying";
        }

        if (!BodySpawner.TryActivatePlayer(world, physics.Scene.Scene, physics.SceneExtent, camera, out var problem))
        {
            return problem;
        }

        physics.IsPaused = physics.IsBroken;
        return BodySpawner.HasGround(world)
            ? "walking: W A S D move, Space jumps, P flies"
            : "walking, but there is no ground below: P flies";
    });

    /// <summary>Switches all bodies to the next collider that fits the scene.</summary>
    public static string SwitchCollider(this ScenePhysics physics) =>
        physics.WhenReady(world => ColliderSwitch.SwitchToNext(world, physics.Scene));

    /// <summary>Lets bodies shrink (paper §5.5), those that the scene lets, or all where it lets none; or lets none shrink.</summary>
    public static string ToggleShrinking(this ScenePhysics physics) => physics.WhenReady(world =>
    {
        var areDeclared = world.Bodies.Any(static body => body.Description.Shrinkage > 0);
        world.ShrinkageOverride = physics.IsShrinking ? 0 : areDeclared ? null : ShrinkagePerSecond;
        return !physics.IsShrinking ? "nothing shrinks" : areDeclared ? "shrinking, as the scene has it" : "all bodies shrink";
    });

    public static string ToggleClosestPoints(this ScenePhysics physics)
    {
        physics.ShowsClosestPoints = !physics.ShowsClosestPoints;
        return physics.ShowsClosestPoints ? "closest points and normals: shown" : "closest points and normals: hidden";
    }
}
