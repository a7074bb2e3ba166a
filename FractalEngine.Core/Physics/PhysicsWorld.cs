using System.Buffers.Binary;
using System.Security.Cryptography;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <summary>
/// The bodies of a scene and what they run into (paper §4.4): balls against meshes and fractals through the colliders, and against each other. Deterministic: the
/// same steps give the same bits. A step allocates nothing once all colliders are built. For one thread at a time.
/// </summary>
public sealed partial class PhysicsWorld
{
    // Room for so many bodies near one; more are a matter of a larger list.
    private const int Neighbours = 256;

    private readonly LoadedScene _scene;
    private readonly int[] _surfaceIndices;
    private readonly PlacedModel[] _placed;
    private readonly Dictionary<ColliderKind, Surfaces> _surfaces = [];
    private readonly List<Body> _bodies = [];
    private readonly List<int> _touching = new(Neighbours);
    private readonly List<int> _left = new(Neighbours);
    private readonly Stack<Body> _waking = new(Neighbours);
    private readonly BodyGrid _grid = new();
    private readonly QueryRecord _record = new();
    private readonly Obstacles _obstacles;
    private readonly BodyMover _mover;
    private readonly int _sceneBodies;
    private ColliderKind? _collider;
    private double _pending;

    /// <summary>A world with a body for each physics object of a scene. Colliders are built when they are first asked.</summary>
    /// <param name="scene">With its files loaded. Objects that are no physics objects stand still.</param>
    /// <param name="settings">Null for the usual ones.</param>
    /// <exception cref="ArgumentException">A setting makes no sense, or an object has no size; the message names it.</exception>
    public PhysicsWorld(LoadedScene scene, PhysicsSettings? settings = null)
    {
        (_scene, Settings, Gravity) = (scene, settings ?? new(), scene.Scene.Gravity);
        Settings.Check();
        _obstacles = new(_bodies, _grid, _record);
        _mover = new(_bodies, _obstacles, Wake);
        _surfaceIndices = new int[scene.Objects.Length];
        var placed = new List<PlacedModel>();
        for (var i = 0; i < scene.Objects.Length; i++)
        {
            if (scene.Objects[i].Declaration is PhysicsObject declared)
            {
                _surfaceIndices[i] = -1;
                AddBody(BodyDescription.Of(scene.Objects[i], declared, i));
            }
            else
            {
                _surfaceIndices[i] = placed.Count;
                placed.Add(scene.Objects[i]);
            }
        }

        (_placed, _sceneBodies) = ([.. placed], _bodies.Count);
        Walker = scene.Scene.Player is { } player ? new(this, _obstacles, player) : null;
        _grid.Build(_bodies);
    }

    /// <summary>How time is counted.</summary>
    public PhysicsSettings Settings { get; }

    /// <summary>Acceleration of all bodies, units a second².</summary>
    public Vector Gravity { get; }

    /// <summary>Who walks in the scene; null for nobody. Not active at first.</summary>
    public Walker? Walker { get; private set; }

    /// <summary>In the order of the scene's objects, then of <see cref="Add"/>.</summary>
    public IReadOnlyList<Body> Bodies => _bodies;

    /// <summary>Steps so far.</summary>
    public long StepCount { get; private set; }

    /// <summary>Seconds so far.</summary>
    public double Time => StepCount * Settings.Step;

    /// <summary>How far the time that has passed reaches into the step that comes next, from 0 to 1; see <see cref="Body.MapAt"/>.</summary>
    public double Fraction => Math.Clamp(_pending / Settings.Step, 0, 1);

    /// <summary>True while a body is awake.</summary>
    public bool IsMoving => _bodies.Exists(static body => !body.IsAsleep && (!body.IsStuck || body.IsShrinking));

    /// <summary>What the last step cost, all bodies together: faces and bounding volumes looked at.</summary>
    public (long FaceTests, long BoundTests) Cost { get; private set; }

    /// <summary>The collider of all bodies instead of their own; null for their own.</summary>
    public ColliderKind? Collider
    {
        get => _collider;
        set
        {
            if (_collider != value)
            {
                _collider = value;
                WakeAll(placesAnew: false);
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
                double[] numbers = [body.Position.X, body.Position.Y, body.Position.Z, body.Velocity.X, body.Velocity.Y, body.Velocity.Z, body.IsAsleep ? -body.Scale : body.Scale];
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
    public LoadedScene SceneNow()
    {
        var objects = _scene.Objects.ToBuilder();
        foreach (var body in _bodies.Where(body => body.Description.ObjectIndex >= 0))
        {
            var (index, before) = (body.Description.ObjectIndex, _scene.Objects[body.Description.ObjectIndex]);
            var placement = before.Declaration.Placement;
            objects[index] = new(before.Declaration with { Placement = placement with { Position = body.Position, Scale = body.Scale * placement.Scale } }, before.Model);
        }

        for (var i = 0; i < _surfaceIndices.Length; i++)
        {
            objects[i] = _surfaceIndices[i] < 0 ? objects[i] : _placed[_surfaceIndices[i]];
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
            description.Check();
        }

        foreach (var description in all)
        {
            AddBody(description);
        }

        _grid.Build(_bodies);
    }

    /// <summary>Lets a player walk in the world, instead of the one before.</summary>
    /// <param name="player">Place and sizes in world space, scene units.</param>
    /// <exception cref="ArgumentException">The place is not finite, or the radius not positive, or the height less than twice as much.</exception>
    public Walker AddWalker(Player player)
    {
        if (!player.Position.IsFinite() || !(player.Radius > 0) || !(player.Height >= 2 * player.Radius) || !double.IsFinite(player.Height))
        {
            throw new ArgumentException("expected a finite place, a positive radius and a height of at least twice the radius", nameof(player));
        }

        return Walker = new(this, _obstacles, player);
    }

    /// <summary>How many colliders have been built, of those of all objects that stand still.</summary>
    public (int Built, int All) ColliderCounts => _surfaces.TryGetValue(_collider ?? ColliderKind.Exact, out var surfaces)
        ? surfaces.Collider.Counts : (0, _placed.Select(static placed => placed.Model).Distinct().Count());

    /// <summary>Builds all colliders that bodies will ask, instead of at their first query.</summary>
    /// <exception cref="ColliderMismatchException">A collider does not fit an object.</exception>
    /// <exception cref="FractalLimitException">A fractal is too large for its collider.</exception>
    public void BuildColliders()
    {
        foreach (var kind in _bodies.Select(body => _collider ?? body.Description.Collider).Append(_collider ?? ColliderKind.Exact).Distinct())
        {
            SurfacesOf(kind)?.Build();
        }
    }

    /// <summary>Gives a body another velocity, and wakes it.</summary>
    /// <exception cref="ArgumentException">It is not finite.</exception>
    public void SetVelocity(Body body, Vector velocity)
    {
        RequireFinite(body, velocity, nameof(velocity));
        Wake(body);
        body.Velocity = velocity;
    }

    /// <summary>Lets a force act on a body until it is changed, and wakes it.</summary>
    /// <param name="body">Of this world.</param>
    /// <param name="force">Kilograms times units a second².</param>
    /// <exception cref="ArgumentException">It is not finite.</exception>
    public void SetForce(Body body, Vector force)
    {
        RequireFinite(body, force, nameof(force));
        Wake(body);
        body.Force = force;
    }

    /// <summary>Moves an object that is no body, and its collider with it. Bodies that it then overlaps are pushed out at the next step.</summary>
    /// <param name="objectIndex">Its place in the scene, from 0.</param>
    /// <param name="placement">Its new matrix m.</param>
    /// <exception cref="ArgumentException">The object is a body.</exception>
    public void MoveObject(int objectIndex, Transformation placement)
    {
        var index = _surfaceIndices[objectIndex];
        if (index < 0)
        {
            throw new ArgumentException("the object is a body: it moves by itself", nameof(objectIndex));
        }

        var before = _placed[index];
        Place(index, new(before.Declaration with { Placement = placement }, before.Model));
        WakeAll(placesAnew: true);
    }

    /// <summary>Bodies and objects are where the scene has them, and bodies that were added are gone. A <see cref="Collider"/> and a player who were chosen stay.</summary>
    public void Reset()
    {
        _bodies.RemoveRange(_sceneBodies, _bodies.Count - _sceneBodies);
        for (var i = 0; i < _surfaceIndices.Length; i++)
        {
            if (_surfaceIndices[i] >= 0 && !ReferenceEquals(_placed[_surfaceIndices[i]], _scene.Objects[i]))
            {
                Place(_surfaceIndices[i], _scene.Objects[i]);
            }
        }

        _bodies.ForEach(body => body.Reset(Gravity));
        Walker?.Reset();
        _grid.Build(_bodies);
        (StepCount, _pending, Cost) = (0, 0, default);
    }

    /// <summary>Finds the nearest point of all that bodies run into, as a body's collider sees it.</summary>
    /// <param name="position">World space, finite.</param>
    /// <param name="kind">Of the collider.</param>
    /// <param name="closest">The answer, if there is one.</param>
    public bool TryFindClosest(Vector position, ColliderKind kind, out ClosestPoint closest)
    {
        closest = default;
        return SurfacesOf(kind) is { } surfaces && surfaces.Collider.TryFindClosest(position, double.PositiveInfinity, _record, out closest, out _);
    }

    /// <summary>Prepares the obstacles for something that moves and is no body.</summary>
    internal void Begin(Vector[] spheres, double radius, Clearance clearance, double lookahead) =>
        _obstacles.Begin(SurfacesOf(_collider ?? ColliderKind.Exact), spheres, radius, clearance, lookahead);

    private void Place(int index, PlacedModel placed)
    {
        _placed[index] = placed;
        foreach (var surfaces in _surfaces.Values)
        {
            surfaces.Move(index, placed);
        }
    }

    private Body AddBody(BodyDescription description)
    {
        description.Check();
        var body = new Body(description, _bodies.Count, Gravity);
        _bodies.Add(body);
        return body;
    }

    private Surfaces? SurfacesOf(ColliderKind kind)
    {
        if (_placed.Length == 0)
        {
            return null;
        }

        if (!_surfaces.TryGetValue(kind, out var surfaces))
        {
            _surfaces[kind] = surfaces = new(_placed, _scene.Scene, kind);
        }

        return surfaces;
    }

    private void WakeAll(bool placesAnew)
    {
        foreach (var body in _bodies)
        {
            body.Wake();
            body.FreeAcceleration = Gravity;
            body.Clearance.Forget();
            body.Contacts.Clear();
            body.IsPlaced &= !placesAnew;
        }

        Walker?.Forget();
    }

    private static void RequireFinite(Body body, Vector vector, string name)
    {
        if (!vector.IsFinite())
        {
            throw new ArgumentException($"body {body.Name}: expected a finite {name}", name);
        }
    }
}
