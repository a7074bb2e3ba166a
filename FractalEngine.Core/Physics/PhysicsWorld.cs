using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Separation;
using FractalEngine.Core.Physics.Solving;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Physics.Stepping;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <summary>
/// Balls, compounds and a character that move under gravity among meshes, fractals, moving objects and each other (paper §4.4). Made empty
/// or from a scene; bodies and static objects may be added at any time.
/// </summary>
/// <remarks>
/// Deterministic: the same calls give the same bits. For one thread at a time. A step allocates nothing once all colliders are built, but
/// where it has more contacts than any before and than room is made for when bodies are added: four of each ball.
/// </remarks>
public sealed partial class PhysicsWorld
{
    private readonly LoadedScene _scene;
    private readonly StaticObject?[] _staticOfObject;
    private readonly StaticObjectSet _statics;
    private readonly List<Body> _bodies = [];
    private readonly BodyGrid _grid = new();
    private readonly NearbyBodies _nearbyBodies;
    private readonly QueryContext _queryContext = new();
    private readonly SafeDistance _querySafeDistance = new();
    private readonly ContactLog _contactLog;
    private readonly WorldQueries _queries;
    private readonly StepClock _clock = new();
    private readonly KinematicSet _kinematics = new();
    private readonly SleepIslands _islands;
    private readonly Obstacles _obstacles;
    private readonly BodyStepper _stepper;
    private readonly IslandPlanner _planner;
    private readonly IslandMover _islandMover;
    private readonly EnergyGuard _energyGuard;
    private readonly int _sceneBodyCount;
    private Vector _gravity;
    private ColliderKind? _colliderOverride;
    private double _accumulatedTime;

    /// <summary>Creates an empty world with the gravity <see cref="Scene.DefaultGravity"/>.</summary>
    /// <param name="settings">Null for the default settings.</param>
    /// <exception cref="ArgumentException">A setting is out of range; the message names it.</exception>
    public PhysicsWorld(PhysicsSettings? settings = null)
        : this(new LoadedScene(new(), []), settings)
    {
    }

    /// <summary>Creates the world of a scene that was made in code, or loaded from a file.</summary>
    /// <inheritdoc cref="PhysicsWorld(LoadedScene, PhysicsSettings?, ColliderCache?)"/>
    /// <exception cref="FractalEngineException">An object names a file that is not loaded.</exception>
    public PhysicsWorld(Scene scene, PhysicsSettings? settings = null)
        : this(LoadedScene.Of(scene), settings)
    {
    }

    /// <summary>
    /// Creates the world of a scene: a body for each physics object, a static object for each other one. Colliders are built when they are
    /// first queried.
    /// </summary>
    /// <param name="scene">The scene with its models; it also gives gravity and character.</param>
    /// <param name="settings">Null for the default settings.</param>
    /// <param name="colliders">Colliders of earlier worlds to use, which receives those of this one; null for none.</param>
    /// <exception cref="ArgumentException">A setting is out of range; the message names it.</exception>
    /// <exception cref="SceneObjectException">No body can be made of a physics object; the message says why.</exception>
    /// <exception cref="FractalEngineException">The scene's player has impossible sizes.</exception>
    public PhysicsWorld(LoadedScene scene, PhysicsSettings? settings = null, ColliderCache? colliders = null)
    {
        ArgumentNullException.ThrowIfNull(scene);
        _scene = scene;
        _statics = new(_kinematics, _clock, InvalidateSurroundings, colliders);
        _gravity = scene.Scene.Gravity;
        Settings = settings ?? new();
        Settings.Validate();
        var nearbyBodies = new NearbyBodies(_grid, _bodies);
        _nearbyBodies = nearbyBodies;
        _islands = new(_bodies, nearbyBodies);
        _obstacles = new(_bodies, nearbyBodies, _queryContext, _kinematics);
        _contactLog = new(_bodies, _statics) { IsEnabled = Settings.ReportsContacts };
        _queries = new(_bodies, _statics, _obstacles, _kinematics, _queryContext);
        var maxThreads = Settings.MaxThreads ?? Environment.ProcessorCount;
        _planner = new(_bodies, nearbyBodies, _contactLog, new(), maxThreads);
        _stepper = new(Settings, _bodies, _grid, nearbyBodies, _obstacles, _islands, _planner, _queryContext, _contactLog);
        _islandMover = new(_bodies, _planner.Graph, _grid, nearbyBodies);
        _parallel = CreateParallelSteppers(maxThreads);
        _beginPart = BeginPart;
        _prepare = Prepare;
        _findNearSurfaces = FindNearSurfaces;
        _movePlanned = MovePlanned;
        _finishPlanned = FinishPlanned;
        _energyGuard = new(_bodies, _planner.Graph);
        _staticOfObject = new StaticObject?[scene.Objects.Length];
        for (var i = 0; i < scene.Objects.Length; i++)
        {
            if (scene.Objects[i].Declaration is PhysicsObject declared)
            {
                AppendBody(DescribeBody(scene.Objects[i], declared, i));
            }
            else
            {
                _staticOfObject[i] = AppendStatic(scene.Objects[i], i);
            }
        }

        _sceneBodyCount = _bodies.Count;
        Character = scene.Scene.Player is not { } player ? null
            : player.FindFault() is { } fault ? throw new FractalEngineException($"player: {fault}")
            : new(_bodies, _islands, _obstacles, player, _gravity);
        PlaceBodies();
    }

    /// <summary>Step length and thresholds of the world.</summary>
    public PhysicsSettings Settings { get; }

    /// <summary>Acceleration of all bodies in units per second². Setting another one wakes all bodies.</summary>
    /// <exception cref="ArgumentException">A coordinate is not finite.</exception>
    public Vector Gravity
    {
        get => _gravity;
        set
        {
            ArgumentCheck.RequireFinite(value, nameof(Gravity));
            if (_gravity != value)
            {
                _gravity = value;
                Character?.AlignWithGravity(_gravity);
                InvalidateSurroundings(mayOverlap: false);
            }
        }
    }

    /// <summary>
    /// The character that walks in the world; null for none. It is inactive until <see cref="CharacterController.IsActive"/> is set.
    /// </summary>
    public CharacterController? Character { get; private set; }

    /// <summary>All bodies: those of the scene in its order, then those that were added.</summary>
    public IReadOnlyList<Body> Bodies => _bodies;

    /// <summary>All static objects: those of the scene in its order, then those that were added.</summary>
    public IReadOnlyList<StaticObject> StaticObjects => _statics.Objects;

    /// <summary>Number of steps since the beginning or the last <see cref="Reset"/>.</summary>
    public long StepCount => _clock.StepCount;

    /// <summary>Simulated time in seconds: the sum of all steps since the beginning or the last <see cref="Reset"/>.</summary>
    public double Time => _clock.Time;

    /// <summary>
    /// Fraction of the next step for which <see cref="Advance"/> has been given time, from 0 to 1, see <see cref="Body.InterpolatedMap"/>.
    /// </summary>
    public double InterpolationAlpha => Math.Clamp(_accumulatedTime / Settings.TimeStep, 0, 1);

    /// <summary>True while an object moves by itself, or a body is awake, unless it is stuck and does not shrink.</summary>
    public bool IsMoving => _kinematics.IsMoving || _bodies.Exists(static body => !body.IsAsleep && (!body.IsStuck || body.IsShrinking));

    /// <summary>Triangles and bounding volumes that the last step tested, for all bodies and the character together.</summary>
    public (long FaceTests, long BoundTests) LastStepCost { get; private set; }

    /// <summary>What the joint solve of touching bodies has done since the world began or was reset.</summary>
    public IslandStatistics IslandStatistics => _planner.Statistics;

    /// <summary>Collider of all bodies instead of their own; null for their own. Setting another one wakes all bodies.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no such kind.</exception>
    public ColliderKind? ColliderOverride
    {
        get => _colliderOverride;
        set
        {
            ColliderFactory.ThrowIfUnknown(value ?? default);
            if (_colliderOverride != value)
            {
                _colliderOverride = value;
                InvalidateSurroundings(mayOverlap: false);
            }
        }
    }

    /// <summary>
    /// Fraction of its initial size that each body loses per second (paper §5.5), instead of its own; null for its own. Setting another one
    /// wakes all bodies.
    /// </summary>
    /// <exception cref="ArgumentException">It is negative or not finite.</exception>
    public double? ShrinkageOverride
    {
        get;
        set
        {
            ArgumentCheck.Require(
                value is null || (value >= 0 && double.IsFinite(value.Value)), "the shrinkage must not be negative", null, nameof(value));
            if (field != value)
            {
                field = value;
                _bodies.ForEach(body => body.Shrinkage = value ?? body.Description.Shrinkage);
                InvalidateSurroundings(mayOverlap: false);
            }
        }
    }

    /// <summary>
    /// Number of colliders of static objects that have been built, and how many there are, of the kind that the character uses.
    /// </summary>
    public (int Built, int All) ColliderCounts => _statics.CountColliders(CharacterColliderKind);

    /// <summary>
    /// Hash of positions, velocities, sizes and sleep of all bodies, and of the motion of all moving objects: 16 hexadecimal digits, equal
    /// for equal bits.
    /// </summary>
    public string StateHash => BodyStateHash.Compute(_bodies, _kinematics.Objects);

    private ColliderKind CharacterColliderKind => _colliderOverride ?? ColliderKind.Exact;

    /// <summary>
    /// Returns to the beginning: time is 0, scene bodies, character and all static objects are in their initial state, and bodies that were
    /// added are removed. Static objects that were added stay, at the placement they were added with.
    /// </summary>
    /// <remarks>
    /// <see cref="Gravity"/>, <see cref="ColliderOverride"/>, <see cref="ShrinkageOverride"/>, the character and all colliders are kept.
    /// Removed bodies no longer belong to this world.
    /// </remarks>
    public void Reset()
    {
        _bodies.RemoveRange(_sceneBodyCount, _bodies.Count - _sceneBodyCount);
        _statics.Reset();
        _bodies.ForEach(body => body.Reset(_gravity));
        Character?.Reset();
        _grid.Build(_bodies);
        _clock.Reset();
        ResetKinematics();
        _contactLog.Clear();
        _accumulatedTime = 0;
        LastStepCost = default;
        _planner.Reset();
    }

    /// <summary>Finds the closest point of all static objects.</summary>
    /// <param name="position">World space, finite.</param>
    /// <param name="kind">Kind of collider that answers.</param>
    /// <param name="closest">The closest point in world space, if there is one.</param>
    /// <returns>False where there are no static objects, or none with a face.</returns>
    /// <exception cref="ArgumentOutOfRangeException">A coordinate is not finite.</exception>
    public bool TryFindClosest(Vector position, ColliderKind kind, out ClosestPoint closest)
    {
        _obstacles.SetMover(_statics.CollidersOf(kind), BodyStepper.SingleSphereOffset, 0, _querySafeDistance, 0);
        return _obstacles.TryFindClosestPoint(position, double.PositiveInfinity, out closest);
    }

    private ColliderKind ColliderKindOf(Body body) => _colliderOverride ?? body.Description.Collider;

    private void InvalidateSurroundings(bool mayOverlap)
    {
        foreach (var body in _bodies)
        {
            body.InvalidateSurroundings(_gravity, mayOverlap);
        }

        Character?.InvalidateSurroundings();
    }
}
