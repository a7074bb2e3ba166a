using System.Diagnostics;
using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Threading;
using FractalEngine.Render;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Lines;
using FractalEngine.Render.Preparation;
using static System.FormattableString;

namespace FractalEngine.App.Window.Simulation;

/// <summary>
/// The physics of a scene in a window. Colliders are built in the background; until then the commands answer that they are not ready.
/// </summary>
/// <remarks><see cref="PhysicsCommands"/> are what the user does with it.</remarks>
internal sealed class ScenePhysics : IDisposable
{
    private readonly MovedScene _movedScene;
    private readonly Action _completed;
    private readonly ColliderCache _colliders;

    // The bodies where an earlier scene left them, drawn until the colliders are built; null for none.
    private readonly PhysicsWorld? _continued;
    private readonly int _colliderCount;
    // Null until something needs the world: a scene that stands still may do without.
    private BackgroundJob<PhysicsWorld>? _job;
    private TimeSpan _stepTime;
    private string? _problem;
    private bool _isBuildProblemReported;

    /// <summary>Starts to build the world and its colliders in the background, if something in the scene moves.</summary>
    /// <param name="scene">The loaded scene.</param>
    /// <param name="completed">Called on another thread when they are built.</param>
    /// <param name="previous">The physics of the scene before it was changed, which ends here; null for none.</param>
    /// <param name="alwaysBuild">Builds the colliders even without bodies, for comparison.</param>
    public ScenePhysics(LoadedScene scene, Action completed, ScenePhysics? previous = null, bool alwaysBuild = false)
    {
        Scene = scene;
        _movedScene = new(scene);
        SceneExtent = scene.Bounds.IsEmpty ? 1 : scene.Bounds.Diagonal;
        _completed = completed;
        _colliderCount = scene.StaticModels.Count();
        _colliders = previous?._colliders ?? new();
        _continued = previous is null ? null : Continue(previous);
        if (alwaysBuild || _continued is not null
            || scene.Scene.Objects.Any(static item => item is PhysicsObject || item.Motion is not null || item.Belt != Vector.Zero))
        {
            _job = CreateJob(alwaysBuild);
        }
    }

    /// <summary>True while bodies, objects or the player move, so that <see cref="Advance"/> must be called.</summary>
    public bool IsRunning => !IsPaused && Speed > 0 && World is { } world && (world.IsMoving || IsWalking);

    public LoadedScene Scene { get; }

    /// <summary>The diagonal of the scene in scene units.</summary>
    public double SceneExtent { get; }

    public bool IsPaused { get; set; }

    /// <summary>True while a body is out of range: no step can be made until the next reset.</summary>
    public bool IsBroken { get; set; }

    /// <summary>Whether the player walks, so that the camera is at the player's eyes.</summary>
    public bool IsWalking => Character is { IsActive: true };

    /// <summary>
    /// Whether anything can move: a body, an object that the scene moves, or the player who walks. While colliders are built, whether they
    /// have to be.
    /// </summary>
    public bool HasMovers => (World ?? _continued) is { } world ? world.Bodies.Count > 0 || world.MovingObjects.Any() || IsWalking
        : _job is { Result.IsCompleted: false };

    /// <summary>The player; null where there is none.</summary>
    public CharacterController? Character => (World ?? _continued)?.Character;

    /// <summary>Whether closest points and normals are shown as lines.</summary>
    public bool ShowsClosestPoints { get; set; }

    /// <summary>Whether bodies shrink: some as the scene has it, or all.</summary>
    public bool IsShrinking => (World ?? _continued) is { } world
        && (world.ShrinkageOverride ?? world.Bodies.Max(static body => (double?)body.Shrinkage)) > 0;

    /// <summary>The fraction of a step by which frames follow the last step, from 0 to 1; see <see cref="Body.InterpolatedMap"/>.</summary>
    public double InterpolationAlpha => IsPaused || (World ?? _continued) is not { } world ? 1 : world.InterpolationAlpha;

    /// <summary>Seconds of the simulation in a second, not negative.</summary>
    public double Speed { get; set; } = 1;

    /// <summary>Face tests a second in the last step; null where none was made.</summary>
    public double? QueriesPerSecond =>
        World is { } world && _stepTime > TimeSpan.Zero ? world.LastStepCost.FaceTests / _stepTime.TotalSeconds : null;

    /// <summary>Two lines about the bodies, their collider and the cost of the last step.</summary>
    public string StatusText => WhenReady(world =>
    {
        var awakeCount = world.Bodies.Count(static body => !body.IsAsleep);
        var collider = world.ColliderOverride is { } kind ? ColliderNames.Of(kind) : "each body's own";
        var (faceTests, boundTests) = world.LastStepCost;
        var paused = IsPaused ? " · paused" : "";
        var bodies = Invariant($"{Count(world.Bodies.Count, "body", "bodies")}, {awakeCount:N0} awake · collider: {collider}{paused}");
        var tests = $"last step: {Count(faceTests, "face test", "face tests")}";
        return Invariant($"{bodies}\n{tests}, {Count(boundTests, "bound test", "bound tests")}, {_stepTime.TotalMilliseconds:F2} ms");
    });

    /// <summary>The scene with its bodies where they are, the same object until one of them moves.</summary>
    public LoadedScene CurrentScene => _movedScene.With(World ?? _continued);

    public (int Built, int All) ColliderCounts => World?.ColliderCounts ?? (0, _colliderCount);

    /// <summary>The world, once its colliders are built; null until then, and where it can't be made or nothing has needed it.</summary>
    public PhysicsWorld? World => _job is { Result: { IsCompletedSuccessfully: true } built } ? built.Result : null;

    private string? Failure => _job?.Result.Exception is { } failure ? $"no physics: {failure.InnerException!.Message}" : null;

    /// <summary>Ends the building of colliders after the one in progress. Those that are built stay for the next scene.</summary>
    public void Dispose() => _job?.Cancel();

    /// <summary>Returns the reason why the physics has failed, only once for each failure; null otherwise.</summary>
    public string? TakeProblem()
    {
        if (!_isBuildProblemReported && Failure is { } failure)
        {
            _isBuildProblemReported = true;
            return $"error: {failure}";
        }

        var problem = _problem;
        _problem = null;
        return problem;
    }

    /// <summary>
    /// Runs a command of the world, or answers that it is not ready. The first one makes the world of a scene that stands still.
    /// </summary>
    public string WhenReady(Func<PhysicsWorld, string> command)
    {
        if (_job is null)
        {
            _job = CreateJob(alwaysBuild: false);
            // It builds no collider, and is made at once. A failure is told as that of any other world.
            Task.WaitAny(_job.Result);
        }

        return World is { } world ? command(world) : Failure ?? "the colliders are being built";
    }

    /// <summary>Advances the simulation by a time.</summary>
    /// <returns>True when something may have moved.</returns>
    public bool Advance(TimeSpan time)
    {
        if (!IsRunning || World is not { } world)
        {
            return false;
        }

        MakeSteps(world, () => world.Advance(Speed * time.TotalSeconds));
        return true;
    }

    /// <summary>Moves the drawn bodies and moving objects to their interpolated positions.</summary>
    public void ApplyTo(SceneRenderer renderer)
    {
        if ((World ?? _continued) is not { } world)
        {
            renderer.Lines = [];
            return;
        }

        var alpha = InterpolationAlpha;
        var spheres = new List<SphereInstance>();
        foreach (var body in world.Bodies)
        {
            var map = body.InterpolatedMap(alpha);
            if (body.Description.ObjectIndex is >= 0 and var index)
            {
                renderer.Move(index, map);
            }
            else
            {
                for (var ball = 0; ball < body.BallCount; ball++)
                {
                    var offset = body.Description.Shape?.Balls[ball].Offset ?? Vector.Zero;
                    spheres.Add(new(map * offset, body.BallRadius(ball)));
                }
            }
        }

        foreach (var moving in world.MovingObjects)
        {
            if (moving.ObjectIndex is { } index)
            {
                renderer.Move(index, moving.InterpolatedMap(alpha));
            }
        }

        renderer.Spheres = spheres;
        renderer.Lines = ShowsClosestPoints && !IsBroken && World is not null ? ClosestPointLines.Create(world, alpha) : [];
    }

    private static string Count(long number, string one, string many) =>
        Invariant($"{number:N0} {(number == 1 ? one : many)}");

    private BackgroundJob<PhysicsWorld> CreateJob(bool alwaysBuild) => new(
        cancellation =>
        {
            PhysicsLimits.RequireRange(Scene);
            var world = _continued ?? new PhysicsWorld(Scene, null, _colliders);
            PhysicsLimits.Require(world.Bodies);
            PhysicsLimits.RequireRange(world);
            if (world.Bodies.Count > 0 || world.Character is { IsActive: true } || alwaysBuild)
            {
                BuildColliders(world, cancellation);
            }

            return world;
        },
        _completed);

    private static void BuildColliders(PhysicsWorld world, CancellationToken cancellation)
    {
        try
        {
            world.BuildColliders(cancellation);
        }
        catch (FractalEngineException) when (world.ColliderOverride is not null)
        {
            // The collider that the user chose does not fit the changed scene.
            world.ColliderOverride = null;
            world.BuildColliders(cancellation);
        }
    }

    /// <summary>Creates the world of the changed scene, with the bodies where they are.</summary>
    /// <returns>Null where there is nothing to continue, or the scene has no physics.</returns>
    private PhysicsWorld? Continue(ScenePhysics previous)
    {
        previous.Dispose();
        _colliders.Retain(Scene);
        IsPaused = previous.IsPaused;
        Speed = previous.Speed;
        ShowsClosestPoints = previous.ShowsClosestPoints;
        if (previous.IsBroken || (previous.World ?? previous._continued) is not { } earlier)
        {
            return null;
        }

        try
        {
            var world = new PhysicsWorld(Scene, null, _colliders);
            world.Continue(earlier);
            world.ColliderOverride = earlier.ColliderOverride;
            world.ShrinkageOverride = earlier.ShrinkageOverride;
            return world;
        }
        catch (FractalEngineException)
        {
            // The task that creates the world again reports the error.
            return null;
        }
    }

    /// <summary>Makes and times steps. Pauses the simulation when a body goes beyond the limit of physics.</summary>
    /// <param name="world">The world that makes them.</param>
    /// <param name="advance">Makes the steps, and returns their number.</param>
    public void MakeSteps(PhysicsWorld world, Func<int> advance)
    {
        var start = Stopwatch.GetTimestamp();
        try
        {
            var stepCount = advance();
            if (stepCount > 0)
            {
                _stepTime = Stopwatch.GetElapsedTime(start) / stepCount;
                PhysicsLimits.RequireRange(world);
            }
        }
        catch (Exception exception) when (exception is InvalidOperationException or FractalEngineException { Kind: ErrorKind.Limit })
        {
            _problem = $"error: {exception.Message}";
            IsPaused = true;
            IsBroken = true;
        }
    }
}
