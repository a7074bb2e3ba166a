using System.Diagnostics;
using FractalEngine.Core;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Character;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Scenes;
using FractalEngine.Render;

namespace FractalEngine.App.Window;

/// <summary>The bodies of a scene in a window: lets time pass, drops balls, lets a player walk, and moves what is drawn.</summary>
internal sealed class ScenePhysics
{
    // Of the scene's size.
    private const double SphereRadiusFraction = 0.015;
    private const double PlayerHeightFraction = 0.05;

    // Of the player's height.
    private const double PlayerRadiusFraction = 0.2;

    // Parts of the free distance at the camera: what is dropped or walks fits in.
    private const double FreeDistanceFraction = 0.3;

    private const double SphereRestitution = 0.6;
    private const double SphereFriction = 0.3;

    private const int MaxClosestPointBodies = 100;

    private static readonly Colour ClosestPointColour = new(1, 0.75, 0.2);
    private static readonly Colour NormalColour = new(0.3, 0.9, 1);

    private readonly LoadedScene _scene;
    private readonly Task<PhysicsWorld> _worldTask;
    private readonly double _sceneSize;
    private readonly int _colliderCount;
    private TimeSpan _stepTime;
    private string? _problem;
    private bool _isProblemReported;
    private bool _isBroken;

    /// <summary>Begins to build the colliders in the background, where there are bodies that need them.</summary>
    /// <param name="scene">Loaded.</param>
    /// <param name="completed">Called on another thread when the colliders are there.</param>
    /// <param name="alwaysBuild">Builds them even where there are no bodies, for comparison.</param>
    public ScenePhysics(LoadedScene scene, Action completed, bool alwaysBuild = false)
    {
        (_scene, _sceneSize) = (scene, scene.Bounds.IsEmpty ? 1 : scene.Bounds.Diagonal);
        _colliderCount = scene.Objects.Where(static placed => placed.Declaration is not PhysicsObject).Select(static placed => placed.Model)
            .Distinct().Count();
        _worldTask = Task.Run(() =>
        {
            var world = new PhysicsWorld(scene);
            if (world.Bodies.Count > 0 || alwaysBuild)
            {
                world.BuildColliders();
            }

            return world;
        });
        _worldTask.ContinueWith(_ => completed(), TaskScheduler.Default);
    }

    /// <summary>Why nothing moves, or moves no longer, once; null where nothing is wrong.</summary>
    public string? TakeProblem()
    {
        if (_worldTask.IsFaulted && !_isProblemReported)
        {
            (_problem, _isProblemReported) = ($"error: no physics: {_worldTask.Exception.InnerException!.Message}", true);
        }

        (var problem, _problem) = (_problem, null);
        return problem;
    }

    /// <summary>True while there is something to move: time must be told by <see cref="Advance"/>.</summary>
    public bool IsRunning => !IsPaused && IsReady && (World.IsMoving || IsWalking);

    /// <summary>Whether time stands still.</summary>
    public bool IsPaused { get; private set; }

    /// <summary>Whether the player walks, and the camera is where the player's eyes are.</summary>
    public bool IsWalking => IsReady && World.Character is { IsActive: true };

    /// <summary>Who walks; null for nobody.</summary>
    public CharacterController? Character => IsReady ? World.Character : null;

    /// <summary>Whether closest points and normals are shown as lines.</summary>
    public bool ShowsClosestPoints { get; set; }

    /// <summary>How far between two steps what is drawn is, see <see cref="Body.InterpolatedMap"/>.</summary>
    public double InterpolationAlpha => IsPaused || !IsReady ? 1 : World.InterpolationAlpha;

    /// <summary>What is written of the bodies: how many there are, how they find what they touch, and what that costs.</summary>
    public string StatusText
    {
        get
        {
            if (!IsReady)
            {
                return NotReadyMessage;
            }

            var awake = World.Bodies.Count(static body => !body.IsAsleep);
            var collider = World.ColliderOverride is { } kind ? SceneParser.GetColliderName(kind) : "each body's own";
            return FormattableString.Invariant(
                $"{World.Bodies.Count:N0} bodies, {awake:N0} awake · collider: {collider} · a step: {World.LastStepCost.FaceTests:N0} faces, {World.LastStepCost.BoundTests:N0} bounds, {_stepTime.TotalMilliseconds:F2} ms{(IsPaused ? " · paused" : "")}");
        }
    }

    /// <summary>How many colliders have been built, of how many.</summary>
    public (int Built, int All) ColliderCounts => IsReady ? World.ColliderCounts : (0, _colliderCount);

    private bool IsReady => _worldTask.IsCompletedSuccessfully;

    /// <summary>Once it is ready.</summary>
    private PhysicsWorld World => _worldTask.Result;

    private static string OutOfRangeMessage => "a body has left the range of numbers: R puts everything back";

    private string NotReadyMessage => _worldTask.IsFaulted ? "there is no physics in this scene" : "the colliders are being built";

    /// <summary>Lets time pass.</summary>
    /// <returns>True when something may have moved.</returns>
    public bool Advance(TimeSpan time)
    {
        if (!IsRunning)
        {
            return false;
        }

        var (start, steps) = (Stopwatch.GetTimestamp(), 0);
        TryStep(() => steps = World.Advance(time.TotalSeconds));
        _stepTime = steps > 0 ? Stopwatch.GetElapsedTime(start) / steps : _stepTime;
        return true;
    }

    /// <summary>Stops time, or lets it go on.</summary>
    /// <returns>What to say.</returns>
    public string TogglePause()
    {
        IsPaused = _isBroken || !IsPaused;
        return _isBroken ? OutOfRangeMessage : IsPaused ? "paused: N makes one step" : "time goes on";
    }

    /// <summary>Makes one step, and stops time.</summary>
    public string StepOnce()
    {
        IsPaused = true;
        if (!IsReady)
        {
            return NotReadyMessage;
        }

        if (_isBroken)
        {
            return OutOfRangeMessage;
        }

        var start = Stopwatch.GetTimestamp();
        TryStep(World.Step);
        _stepTime = Stopwatch.GetElapsedTime(start);
        return FormattableString.Invariant($"step {World.StepCount:N0}, {World.Time:F3} s");
    }

    /// <summary>Everything is where the scene's file has it.</summary>
    public string Reset()
    {
        if (IsReady)
        {
            World.Reset();
            _isBroken = false;
        }

        return "as in the file";
    }

    /// <summary>Drops a ball before the camera.</summary>
    public string DropSphere(Camera camera)
    {
        if (!IsReady)
        {
            return NotReadyMessage;
        }

        if (!TryFindFreeDistance(camera.Position, out var freeDistance, out var problem))
        {
            return problem;
        }

        var radius = Math.Min(SphereRadiusFraction * _sceneSize, FreeDistanceFraction * freeDistance);
        if (!(radius > 0))
        {
            return "there is no room for a ball";
        }

        World.Add(new(camera.Position + (2 * radius * camera.LocalAxes.V3), radius) { Restitution = SphereRestitution,
            Friction = SphereFriction });
        return "dropped a ball";
    }

    /// <summary>Lets a player walk, or no longer.</summary>
    /// <param name="camera">Where a player begins that the scene does not have.</param>
    public string ToggleWalking(Camera camera)
    {
        if (!IsReady)
        {
            return NotReadyMessage;
        }

        if (World.Character is { IsActive: true } controller)
        {
            controller.IsActive = false;
            return "the camera flies";
        }

        if (!TryFindFreeDistance(camera.Position, out var freeDistance, out var problem))
        {
            return problem;
        }

        IsPaused = _isBroken;
        if (_scene.Scene.Player is null)
        {
            var height = Math.Min(PlayerHeightFraction * _sceneSize, FreeDistanceFraction * freeDistance);
            if (!(height > 0))
            {
                return "there is no room for a player";
            }

            World.AddCharacter(new(camera.Position, PlayerRadiusFraction * height, height));
        }

        World.Character!.IsActive = true;
        return "walking: W A S D, Space jumps, P flies again";
    }

    /// <summary>Takes the next collider for all bodies, as far as it fits the scene.</summary>
    public string SwitchCollider()
    {
        if (!IsReady)
        {
            return NotReadyMessage;
        }

        return ColliderSwitch.SwitchToNext(World, _scene);
    }

    /// <summary>Moves what is drawn to where the bodies are.</summary>
    public void ApplyTo(SceneRenderer renderer)
    {
        if (!IsReady)
        {
            return;
        }

        var alpha = InterpolationAlpha;
        var spheres = new List<SphereInstance>();
        foreach (var body in World.Bodies)
        {
            var map = body.InterpolatedMap(alpha);
            if (body.Description.ObjectIndex is >= 0 and var index)
            {
                renderer.Move(index, map);
            }
            else
            {
                spheres.Add(new(map.Translation, body.Radius));
            }
        }

        renderer.Spheres = spheres;
        renderer.Lines = ShowsClosestPoints && !_isBroken ? ClosestPointLines(alpha) : [];
    }

    /// <summary>Stops time where a body leaves the range of a double.</summary>
    private void TryStep(Action step)
    {
        try
        {
            step();
        }
        catch (InvalidOperationException exception)
        {
            (_problem, IsPaused, _isBroken) = ($"error: {exception.Message}", true, true);
        }
    }

    private List<LineSegment> ClosestPointLines(double alpha)
    {
        var lines = new List<LineSegment>();
        foreach (var body in World.Bodies.OrderBy(static body => body.IsAsleep).Take(MaxClosestPointBodies))
        {
            var centre = body.InterpolatedMap(alpha).Translation;
            if (World.TryFindClosest(centre, World.ColliderOverride ?? body.Description.Collider, out var closest))
            {
                lines.Add(new(centre, closest.Point, ClosestPointColour));
                lines.Add(new(closest.Point, closest.Point + (2 * body.Radius * closest.Normal), NormalColour));
            }
        }

        return lines;
    }

    /// <summary>How far everything is from a position. The first to ask builds the colliders.</summary>
    private bool TryFindFreeDistance(Vector position, out double distance, out string problem)
    {
        (distance, problem) = (double.PositiveInfinity, "");
        try
        {
            distance = World.TryFindClosest(position, World.ColliderOverride ?? ColliderKind.Exact, out var closest)
                ? closest.Distance
                : distance;
            return true;
        }
        catch (FractalEngineException exception)
        {
            problem = $"error: {exception.Message}";
            return false;
        }
    }
}
