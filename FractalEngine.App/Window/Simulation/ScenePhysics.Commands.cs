using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.App.Window.Simulation;

/// <content>What the user does with bodies and with the player.</content>
internal sealed partial class ScenePhysics
{
    // Of the first size, where the scene says nothing of shrinking.
    private const double ShrinkagePerSecond = 0.1;

    /// <summary>Pauses the simulation, or resumes it.</summary>
    public string TogglePause()
    {
        IsPaused = _isBroken || !IsPaused;
        if (_isBroken)
        {
            return OutOfRangeMessage;
        }

        return IsPaused ? "paused: N makes one step" : "running";
    }

    /// <summary>Pauses the simulation, and makes one step.</summary>
    public string StepOnce()
    {
        IsPaused = true;
        if (_isBroken)
        {
            return OutOfRangeMessage;
        }

        return WhenReady(world =>
        {
            MakeSteps(world, () =>
            {
                world.Step();
                return 1;
            });
            return FormattableString.Invariant($"step {world.StepCount:N0}, {world.Time:F3} s");
        });
    }

    /// <summary>Returns all bodies and moving objects to their initial states, and removes those that were dropped.</summary>
    public string Reset() => WhenReady(world =>
    {
        world.Reset();
        _isBroken = false;
        return "bodies reset";
    });

    /// <summary>Drops a sphere where the camera looks.</summary>
    public string DropSphere(Camera camera) => WhenReady(world => BodySpawner.DropSphere(world, _sceneSize, camera));

    /// <summary>Throws a sphere from the camera straight ahead.</summary>
    public string ThrowSphere(Camera camera) => WhenReady(world => BodySpawner.ThrowSphere(world, _sceneSize, camera));

    /// <summary>Lets the player walk, or the camera fly.</summary>
    /// <param name="camera">The place of a new player where the scene has none.</param>
    public string ToggleWalking(Camera camera) => WhenReady(world =>
    {
        if (world.Character is { IsActive: true } controller)
        {
            controller.IsActive = false;
            return "flying";
        }

        if (!BodySpawner.TryActivatePlayer(world, _scene.Scene, _sceneSize, camera, out var problem))
        {
            return problem;
        }

        IsPaused = _isBroken;
        return BodySpawner.HasGround(world)
            ? "walking: W A S D move, Space jumps, P flies"
            : "walking, but there is no ground below: P flies";
    });

    /// <summary>Switches all bodies to the next collider that fits the scene.</summary>
    public string SwitchCollider() => WhenReady(world => ColliderSwitch.SwitchToNext(world, _scene));

    /// <summary>Lets bodies shrink (paper §5.5), those that the scene lets, or all where it lets none; or lets none shrink.</summary>
    public string ToggleShrinking() => WhenReady(world =>
    {
        var areDeclared = world.Bodies.Any(static body => body.Description.Shrinkage > 0);
        world.ShrinkageOverride = IsShrinking ? 0 : areDeclared ? null : ShrinkagePerSecond;
        return !IsShrinking ? "nothing shrinks" : areDeclared ? "shrinking, as the scene has it" : "all bodies shrink";
    });

    /// <summary>Shows or hides the lines to closest points.</summary>
    public string ToggleClosestPoints()
    {
        ShowsClosestPoints = !ShowsClosestPoints;
        return ShowsClosestPoints ? "closest points and normals: shown" : "closest points and normals: hidden";
    }

    private string WhenReady(Func<PhysicsWorld, string> command) => World is { } world ? command(world) : NotReadyMessage;
}
