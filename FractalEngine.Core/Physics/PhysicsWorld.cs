using System.Buffers.Binary;
using System.Security.Cryptography;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Character;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <summary>
/// The bodies of a scene and what they run into (paper §4.4): balls against meshes and fractals through the colliders, and against each
/// other. Deterministic: the same steps give the same bits. A step allocates nothing once all colliders are built. For one thread at a
/// time.
/// </summary>
public sealed partial class PhysicsWorld
{
    // Room for so many bodies near one; more are a matter of a larger list.
    private const int InitialNeighbourCapacity = 256;

    private readonly LoadedScene _scene;
    private readonly int[] _staticIndices;
    private readonly PlacedModel[] _staticModels;
    private readonly Dictionary<ColliderKind, StaticObjects> _staticObjects = [];
    private readonly List<Body> _bodies = [];
    private readonly List<int> _wakeNeighbours = new(InitialNeighbourCapacity);
    private readonly List<int> _wakeCandidates = new(InitialNeighbourCapacity);
    private readonly Stack<Body> _wakeStack = new(InitialNeighbourCapacity);
    private readonly BodyGrid _grid = new();
    private readonly QueryContext _queryContext = new();
    private readonly Obstacles _obstacles;
    private readonly BodyMover _mover;
    private readonly int _sceneBodyCount;
    private ColliderKind? _colliderOverride;
    private double _accumulatedTime;

    /// <summary>A world with a body for each physics object of a scene. Colliders are built when they are first asked.</summary>
    /// <param name="scene">With its files loaded. Objects that are no physics objects stand still.</param>
    /// <param name="settings">Null for the usual ones.</param>
    /// <exception cref="ArgumentException">A setting makes no sense, or an object has no size; the message names it.</exception>
    public PhysicsWorld(LoadedScene scene, PhysicsSettings? settings = null)
    {
        (_scene, Settings, Gravity) = (scene, settings ?? new(), scene.Scene.Gravity);
        Settings.Validate();
        _obstacles = new(_bodies, _grid, _queryContext);
        _mover = new(_bodies, _obstacles, WakeIsland);
        _staticIndices = new int[scene.Objects.Length];
        var staticModels = new List<PlacedModel>();
        for (var i = 0; i < scene.Objects.Length; i++)
        {
            if (scene.Objects[i].Declaration is PhysicsObject declared)
            {
                _staticIndices[i] = -1;
                AddBody(BodyDescription.FromPhysicsObject(scene.Objects[i], declared, i));
            }
            else
            {
                _staticIndices[i] = staticModels.Count;
                staticModels.Add(scene.Objects[i]);
            }
        }

        (_staticModels, _sceneBodyCount) = ([.. staticModels], _bodies.Count);
        Character = scene.Scene.Player is { } player ? new(this, _obstacles, player) : null;
        _grid.Build(_bodies);
    }

    /// <summary>How time is counted.</summary>
    public PhysicsSettings Settings { get; }

    /// <summary>Acceleration of all bodies, units a second².</summary>
    public Vector Gravity { get; }

    /// <summary>Who walks in the scene; null for nobody. Not active at first.</summary>
    public CharacterController? Character { get; private set; }

    /// <summary>In the order of the scene's objects, then of <see cref="Add"/>.</summary>
    public IReadOnlyList<Body> Bodies => _bodies;

    /// <summary>Steps so far.</summary>
    public long StepCount { get; private set; }

    /// <summary>Seconds so far.</summary>
    public double Time => StepCount * Settings.TimeStep;

    /// <summary>
    /// How far the time that has passed reaches into the step that comes next, from 0 to 1; see <see cref="Body.InterpolatedMap"/>.
    /// </summary>
    public double InterpolationAlpha => Math.Clamp(_accumulatedTime / Settings.TimeStep, 0, 1);

    /// <summary>True while a body is awake.</summary>
    public bool IsMoving => _bodies.Exists(static body => !body.IsAsleep && (!body.IsStuck || body.IsShrinking));

    /// <summary>What the last step cost, all bodies together: faces and bounding volumes looked at.</summary>
    public (long FaceTests, long BoundTests) LastStepCost { get; private set; }

    /// <summary>The collider of all bodies instead of their own; null for their own.</summary>
    public ColliderKind? ColliderOverride
    {
        get => _colliderOverride;
        set
        {
            if (_colliderOverride != value)
            {
                _colliderOverride = value;
                WakeAll(resolveOverlaps: false);
            }
        }
    }

    /// <summary>A hash of the places and velocities of all bodies: equal for equal bits, and for nothing else that matters.</summary>
    public string StateHash
    {
        get
        {
            var bytes = new byte[_bodies.Count * 7 * sizeof(double)];
            var rest = bytes.AsSpan();
            foreach (var body in _bodies)
            {
                double[] numbers = [body.Position.X, body.Position.Y, body.Position.Z, body.Velocity.X, body.Velocity.Y, body.Velocity.Z,
                    body.IsAsleep ? -body.Scale : body.Scale];
                foreach (var number in numbers)
                {
                    BinaryPrimitives.WriteDoubleLittleEndian(rest, number);
                    rest = rest[sizeof(double)..];
                }
            }

            return Convert.ToHexStringLower(SHA256.HashData(bytes).AsSpan(0, 8));
        }
    }

    /// <summary>The scene with its objects where they are now.</summary>
    public LoadedScene GetCurrentScene()
    {
        var objects = _scene.Objects.ToBuilder();
        foreach (var body in _bodies.Where(body => body.Description.ObjectIndex >= 0))
        {
            var (index, original) = (body.Description.ObjectIndex, _scene.Objects[body.Description.ObjectIndex]);
            var originalPlacement = original.Declaration.Placement;
            objects[index] =
                new(original.Declaration with { Placement =
                originalPlacement with { Position = body.Position, Scale = body.Scale * originalPlacement.Scale } }, original.Model);
        }

        for (var i = 0; i < _staticIndices.Length; i++)
        {
            objects[i] = _staticIndices[i] < 0 ? objects[i] : _staticModels[_staticIndices[i]];
        }

        return new(_scene.Scene with { Objects = [.. objects.Select(placed => placed.Declaration)] }, objects.ToImmutable());
    }

    /// <summary>Adds a body.</summary>
    /// <exception cref="ArgumentException">A number is not finite, or outside of its range.</exception>
    public Body Add(BodyDescription description)
    {
        var body = AddBody(description);
        _grid.Build(_bodies);
        return body;
    }

    /// <summary>Adds bodies, which is faster than one by one.</summary>
    /// <exception cref="ArgumentException">A number is not finite, or outside of its range.</exception>
    public void AddRange(IEnumerable<BodyDescription> descriptions)
    {
        var all = descriptions.ToArray();
        foreach (var description in all)
        {
            description.Validate();
        }

        foreach (var description in all)
        {
            AddBody(description);
        }

        _grid.Build(_bodies);
    }

    /// <summary>Lets a player walk in the world, instead of the one before.</summary>
    /// <param name="player">Place and sizes in world space, scene units.</param>
    /// <exception cref="ArgumentException">
    /// The place is not finite, or the radius not positive, or the height less than twice as much.
    /// </exception>
    public CharacterController AddCharacter(Player player)
    {
        if (!player.Position.IsFinite() || !(player.Radius > 0) || !(player.Height >= 2 * player.Radius) || !double.IsFinite(player.Height))
        {
            throw new ArgumentException("expected a finite place, a positive radius and a height of at least twice the radius",
                nameof(player));
        }

        return Character = new(this, _obstacles, player);
    }

    /// <summary>How many colliders have been built, of those of all objects that stand still.</summary>
    public (int Built, int All) ColliderCounts => _staticObjects.TryGetValue(_colliderOverride ?? ColliderKind.Exact, out var staticObjects)
        ? staticObjects.Collider.ColliderCounts : (0, _staticModels.Select(static placed => placed.Model).Distinct().Count());

    /// <summary>Builds all colliders that bodies will ask, instead of at their first query.</summary>
    /// <exception cref="ColliderMismatchException">A collider does not fit an object.</exception>
    /// <exception cref="FractalLimitException">A fractal is too large for its collider.</exception>
    public void BuildColliders()
    {
        foreach (var kind in _bodies.Select(body => _colliderOverride ?? body.Description.Collider)
            .Append(_colliderOverride ?? ColliderKind.Exact).Distinct())
        {
            GetStaticObjects(kind)?.Build();
        }
    }

    /// <summary>Gives a body another velocity, and wakes it.</summary>
    /// <exception cref="ArgumentException">It is not finite.</exception>
    public void SetVelocity(Body body, Vector velocity)
    {
        RequireFinite(body, velocity, nameof(velocity));
        WakeIsland(body);
        body.Velocity = velocity;
    }

    /// <summary>Lets a force act on a body until it is changed, and wakes it.</summary>
    /// <param name="body">Of this world.</param>
    /// <param name="force">Kilograms times units a second².</param>
    /// <exception cref="ArgumentException">It is not finite.</exception>
    public void SetForce(Body body, Vector force)
    {
        RequireFinite(body, force, nameof(force));
        WakeIsland(body);
        body.Force = force;
    }

    /// <summary>
    /// Moves an object that is no body, and its collider with it. Bodies that it then overlaps are pushed out at the next step.
    /// </summary>
    /// <param name="objectIndex">Its place in the scene, from 0.</param>
    /// <param name="placement">Its new matrix m.</param>
    /// <exception cref="ArgumentException">The object is a body.</exception>
    public void MoveObject(int objectIndex, Transformation placement)
    {
        var index = _staticIndices[objectIndex];
        if (index < 0)
        {
            throw new ArgumentException("the object is a body: it moves by itself", nameof(objectIndex));
        }

        var original = _staticModels[index];
        ReplaceStaticObject(index, new(original.Declaration with { Placement = placement }, original.Model));
        WakeAll(resolveOverlaps: true);
    }

    /// <summary>
    /// Bodies and objects are where the scene has them, and bodies that were added are gone. A <see cref="ColliderOverride"/> and a player
    /// who were chosen stay.
    /// </summary>
    public void Reset()
    {
        _bodies.RemoveRange(_sceneBodyCount, _bodies.Count - _sceneBodyCount);
        for (var i = 0; i < _staticIndices.Length; i++)
        {
            if (_staticIndices[i] >= 0 && !ReferenceEquals(_staticModels[_staticIndices[i]], _scene.Objects[i]))
            {
                ReplaceStaticObject(_staticIndices[i], _scene.Objects[i]);
            }
        }

        _bodies.ForEach(body => body.Reset(Gravity));
        Character?.Reset();
        _grid.Build(_bodies);
        (StepCount, _accumulatedTime, LastStepCost) = (0, 0, default);
    }

    /// <summary>Finds the nearest point of all that bodies run into, as a body's collider sees it.</summary>
    /// <param name="position">World space, finite.</param>
    /// <param name="kind">Of the collider.</param>
    /// <param name="closest">The answer, if there is one.</param>
    public bool TryFindClosest(Vector position, ColliderKind kind, out ClosestPoint closest)
    {
        closest = default;
        return GetStaticObjects(kind) is { } staticObjects
            && staticObjects.Collider.TryFindClosest(position, double.PositiveInfinity, _queryContext, out closest, out _);
    }

    /// <summary>Prepares the obstacles for something that moves and is no body.</summary>
    internal void PrepareObstacles(Vector[] sphereOffsets, double radius, SafeDistance safeDistance, double searchMargin) =>
        _obstacles.SetMover(GetStaticObjects(_colliderOverride ?? ColliderKind.Exact), sphereOffsets, radius, safeDistance, searchMargin);

    private void ReplaceStaticObject(int index, PlacedModel placed)
    {
        _staticModels[index] = placed;
        foreach (var staticObjects in _staticObjects.Values)
        {
            staticObjects.Move(index, placed);
        }
    }

    private Body AddBody(BodyDescription description)
    {
        description.Validate();
        var body = new Body(description, _bodies.Count, Gravity);
        _bodies.Add(body);
        return body;
    }

    private StaticObjects? GetStaticObjects(ColliderKind kind)
    {
        if (_staticModels.Length == 0)
        {
            return null;
        }

        if (!_staticObjects.TryGetValue(kind, out var staticObjects))
        {
            _staticObjects[kind] = staticObjects = new(_staticModels, _scene.Scene, kind);
        }

        return staticObjects;
    }

    private void WakeAll(bool resolveOverlaps)
    {
        foreach (var body in _bodies)
        {
            body.Wake();
            body.NetAcceleration = Gravity;
            body.SafeDistance.Invalidate();
            body.Contacts.Clear();
            body.IsOverlapResolved &= !resolveOverlaps;
        }

        Character?.Invalidate();
    }

    private static void RequireFinite(Body body, Vector vector, string name)
    {
        if (!vector.IsFinite())
        {
            throw new ArgumentException($"body {body.Name}: expected a finite {name}", name);
        }
    }
}
