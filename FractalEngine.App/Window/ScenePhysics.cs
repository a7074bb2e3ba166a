using System.Diagnostics;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Scenes;
using FractalEngine.Render;

namespace FractalEngine.App.Window;

/// <summary>The bodies of a scene in a window: lets time pass, drops balls, lets a player walk, and moves what is drawn.</summary>
internal sealed class ScenePhysics
{
    // Of the scene's size.
    private const double BallSize = 0.015;
    private const double PlayerHeight = 0.05;

    // Of the player's height.
    private const double PlayerRadius = 0.2;

    // Parts of the free distance at the camera: what is dropped or walks fits in.
    private const double FreePart = 0.3;

    private const double BallRestitution = 0.6;
    private const double BallFriction = 0.3;

    private const int MostLines = 100;

    private static readonly Colour TowardsSurface = new(1, 0.75, 0.2);
    private static readonly Colour AlongNormal = new(0.3, 0.9, 1);

    private readonly LoadedScene _scene;
    private readonly Task<PhysicsWorld> _building;
    private readonly double _size;
    private readonly int _colliders;
    private TimeSpan _stepTime;
    private string? _problem;
    private bool _isProblemTold;
    private bool _isBroken;

    /// <summary>Begins to build the colliders in the background, where there are bodies that need them.</summary>
    /// <param name="scene">Loaded.</param>
    /// <param name="built">Called on another thread when the colliders are there.</param>
    /// <param name="buildsAll">Builds them even where there are no bodies, for comparison.</param>
    public ScenePhysics(LoadedScene scene, Action built, bool buildsAll = false)
    {
        (_scene, _size) = (scene, scene.Bounds.IsEmpty ? 1 : scene.Bounds.Diagonal);
        _colliders = scene.Objects.Where(static placed => placed.Declaration is not PhysicsObject).Select(static placed => placed.Model).Distinct().Count();
        _building = Task.Run(() =>
        {
            var world = new PhysicsWorld(scene);
            if (world.Bodies.Count > 0 || buildsAll)
            {
                world.BuildColliders();
            }

            return world;
        });
        _building.ContinueWith(_ => built(), TaskScheduler.Default);
    }

    /// <summary>Why nothing moves, or moves no longer, once; null where nothing is wrong.</summary>
    public string? TakeProblem()
    {
        if (_building.IsFaulted && !_isProblemTold)
        {
            (_problem, _isProblemTold) = ($"error: no physics: {_building.Exception.InnerException!.Message}", true);
        }

        (var problem, _problem) = (_problem, null);
        return problem;
    }

    /// <summary>True while there is something to move: time must be told by <see cref="Advance"/>.</summary>
    public bool IsRunning => !IsPaused && IsReady && (World.IsMoving || IsWalking);

    /// <summary>Whether time stands still.</summary>
    public bool IsPaused { get; private set; }

    /// <summary>Whether the player walks, and the camera is where the player's eyes are.</summary>
    public bool IsWalking => IsReady && World.Walker is { IsActive: true };

    /// <summary>Who walks; null for nobody.</summary>
    public Walker? Walker => IsReady ? World.Walker : null;

    /// <summary>Whether closest points and normals are shown as lines.</summary>
    public bool ShowsClosestPoints { get; set; }

    /// <summary>How far between two steps what is drawn is, see <see cref="Body.MapAt"/>.</summary>
    public double Part => IsPaused || !IsReady ? 1 : World.Fraction;

    /// <summary>What is written of the bodies: how many there are, how they find what they touch, and what that costs.</summary>
    public string Description
    {
        get
        {
            if (!IsReady)
            {
                return NotReady;
            }

            var awake = World.Bodies.Count(static body => !body.IsAsleep);
            var collider = World.Collider is { } kind ? SceneParser.NameOf(kind) : "each body's own";
            return FormattableString.Invariant(
                $"{World.Bodies.Count:N0} bodies, {awake:N0} awake · collider: {collider} · a step: {World.Cost.FaceTests:N0} faces, {World.Cost.BoundTests:N0} bounds, {_stepTime.TotalMilliseconds:F2} ms{(IsPaused ? " · paused" : "")}");
        }
    }

    /// <summary>How many colliders have been built, of how many.</summary>
    public (int Built, int All) ColliderCounts => IsReady ? World.ColliderCounts : (0, _colliders);

    private bool IsReady => _building.IsCompletedSuccessfully;

    /// <summary>Once it is ready.</summary>
    private PhysicsWorld World => _building.Result;

    private static string Broken => "a body has left the range of numbers: R puts everything back";

    private string NotReady => _building.IsFaulted ? "there is no physics in this scene" : "the colliders are being built";

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
        return _isBroken ? Broken : IsPaused ? "paused: N makes one step" : "time goes on";
    }

    /// <summary>Makes one step, and stops time.</summary>
    public string StepOnce()
    {
        IsPaused = true;
        if (!IsReady)
        {
            return NotReady;
        }

        if (_isBroken)
        {
            return Broken;
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
    public string DropBall(Camera camera)
    {
        if (!IsReady)
        {
            return NotReady;
        }

        if (!TryFindFreeDistance(camera.Position, out var free, out var problem))
        {
            return problem;
        }

        var radius = Math.Min(BallSize * _size, FreePart * free);
        if (!(radius > 0))
        {
            return "there is no room for a ball";
        }

        World.Add(new(camera.Position + (2 * radius * camera.LocalAxes.V3), radius) { Restitution = BallRestitution, Friction = BallFriction });
        return "dropped a ball";
    }

    /// <summary>Lets a player walk, or no longer.</summary>
    /// <param name="camera">Where a player begins that the scene does not have.</param>
    public string ToggleWalking(Camera camera)
    {
        if (!IsReady)
        {
            return NotReady;
        }

        if (World.Walker is { IsActive: true } walking)
        {
            walking.IsActive = false;
            return "the camera flies";
        }

        if (!TryFindFreeDistance(camera.Position, out var free, out var problem))
        {
            return problem;
        }

        IsPaused = _isBroken;
        if (_scene.Scene.Player is null)
        {
            var height = Math.Min(PlayerHeight * _size, FreePart * free);
            if (!(height > 0))
            {
                return "there is no room for a player";
            }

            World.AddWalker(new(camera.Position, PlayerRadius * height, height));
        }

        World.Walker!.IsActive = true;
        return "walking: W A S D, Space jumps, P flies again";
    }

    /// <summary>Takes the next collider for all bodies, as far as it fits the scene.</summary>
    public string CycleCollider()
    {
        if (!IsReady)
        {
            return NotReady;
        }

        return ColliderCycle.Next(World, _scene);
    }

    /// <summary>Moves what is drawn to where the bodies are.</summary>
    public void Place(SceneRenderer renderer)
    {
        if (!IsReady)
        {
            return;
        }

        var part = Part;
        var balls = new List<LooseBall>();
        foreach (var body in World.Bodies)
        {
            var map = body.MapAt(part);
            if (body.Description.ObjectIndex is >= 0 and var index)
            {
                renderer.Move(index, map);
            }
            else
            {
                balls.Add(new(map.Translation, body.Radius));
            }
        }

        renderer.Balls = balls;
        renderer.Lines = ShowsClosestPoints && !_isBroken ? ClosestPoints(part) : [];
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

    private List<LineSegment> ClosestPoints(double part)
    {
        var lines = new List<LineSegment>();
        foreach (var body in World.Bodies.OrderBy(static body => body.IsAsleep).Take(MostLines))
        {
            var centre = body.MapAt(part).Translation;
            if (World.TryFindClosest(centre, World.Collider ?? body.Description.Collider, out var closest))
            {
                lines.Add(new(centre, closest.Point, TowardsSurface));
                lines.Add(new(closest.Point, closest.Point + (2 * body.Radius * closest.Normal), AlongNormal));
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
            distance = World.TryFindClosest(position, World.Collider ?? ColliderKind.Exact, out var closest) ? closest.Distance : distance;
            return true;
        }
        catch (Exception exception) when (exception is ColliderMismatchException or FractalLimitException)
        {
            problem = $"error: {exception.Message}";
            return false;
        }
    }
}
