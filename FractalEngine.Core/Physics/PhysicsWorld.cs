using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Rays;
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
public sealed class PhysicsWorld
{
    private readonly LoadedScene _scene;
    private readonly StaticObject?[] _staticOfObject;
    private readonly StaticObjectSet _statics;
    private readonly List<Body> _bodies = [];
    private readonly WorldStepper _stepper;
    private readonly WorldQueries _queries;
    private readonly int _sceneBodyCount;
    private Vector _gravity;
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
        _statics = new(InvalidateSurroundings, colliders);
        _gravity = scene.Scene.Gravity;
        Settings = settings ?? new();
        Settings.Validate();
        _stepper = new(Settings, _bodies, _statics);
        _queries = new(_bodies, _statics, _stepper.Obstacles, _stepper.BodySurfaces, _stepper.QueryContext);
        _staticOfObject = new StaticObject?[scene.Objects.Length];
        for (var i = 0; i < scene.Objects.Length; i++)
        {
            if (scene.Objects[i].Declaration is PhysicsObject declared)
            {
                AppendBody(SceneBody.Describe(scene.Objects[i], declared, i));
            }
            else
            {
                _staticOfObject[i] = AppendStatic(scene.Objects[i], i);
            }
        }

        _sceneBodyCount = _bodies.Count;
        Character = scene.Scene.Player is not { } player ? null
            : player.FindFault() is { } fault ? throw new FractalEngineException($"player: {fault}")
            : CreateCharacter(player);
        _stepper.PlaceBodies();
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
                Character?.Capsule.AlignWithGravity(_gravity);
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
    public long StepCount => _statics.Clock.StepCount;

    /// <summary>Simulated time in seconds: the sum of all steps since the beginning or the last <see cref="Reset"/>.</summary>
    public double Time => _statics.Clock.Time;

    /// <summary>
    /// Fraction of the next step for which <see cref="Advance"/> has been given time, from 0 to 1, see <see cref="Body.InterpolatedMap"/>.
    /// </summary>
    public double InterpolationAlpha => Math.Clamp(_accumulatedTime / Settings.TimeStep, 0, 1);

    /// <summary>True while an object moves by itself, or a body is awake, unless it is stuck and does not shrink.</summary>
    public bool IsMoving =>
        _statics.Kinematics.IsMoving || _bodies.Exists(static body => !body.IsAsleep && (!body.IsStuck || body.IsShrinking));

    /// <summary>Triangles and bounding volumes that the last step tested, for all bodies and the character together.</summary>
    public (long FaceTests, long BoundTests) LastStepCost => _stepper.LastCost;

    /// <summary>What the joint solve of touching bodies has done since the world began or was reset.</summary>
    public IslandStatistics IslandStatistics => _stepper.Statistics;

    /// <summary>Collider of all bodies instead of their own; null for their own. Setting another one wakes all bodies.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no such kind.</exception>
    public ColliderKind? ColliderOverride
    {
        get => _statics.ColliderOverride;
        set
        {
            ColliderFactory.ThrowIfUnknown(value ?? default);
            if (_statics.ColliderOverride != value)
            {
                _statics.ColliderOverride = value;
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
                value is null || (value >= 0 && double.IsFinite(value.Value)), "the shrinkage must not be negative", nameof(value));
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
    public (int Built, int All) ColliderCounts => _statics.CountColliders(_statics.CharacterKind);

    /// <summary>
    /// Hash of positions, velocities, sizes and sleep of all bodies, and of the motion of all moving objects: 16 hexadecimal digits, equal
    /// for equal bits.
    /// </summary>
    public string StateHash => BodyStateHash.Compute(_bodies, _statics.Kinematics.Objects);

    /// <summary>The static objects that have begun to move by themselves, in the order in which they began.</summary>
    public IEnumerable<StaticObject> MovingObjects => _statics.Kinematics.Objects.Select(static moved => moved.Target);

    /// <summary>
    /// What has begun, stayed and ended to touch in the last step, in the order of the bodies; empty unless
    /// <see cref="PhysicsSettings.ReportsContacts"/> is set.
    /// </summary>
    /// <remarks>
    /// The same list, with new contents after each step. A trigger (<see cref="StaticObject.IsTrigger"/>) is touched by bodies that reach
    /// into it at the end of the step.
    /// </remarks>
    public IReadOnlyList<ContactEvent> ContactEvents => _stepper.ContactLog.Events;

    /// <summary>Adds a fractal that bodies collide with. Equal fractals share one collider, and existing colliders are kept.</summary>
    /// <param name="fractal">May be infinite.</param>
    /// <param name="placement">Placement in world space; null to leave the fractal in its own frame.</param>
    /// <returns>The object, which can be moved.</returns>
    /// <exception cref="ArgumentException">A number of the placement is not finite, or its scale has no inverse.</exception>
    /// <remarks>Wakes all bodies. The collider is built at its first query, see <see cref="BuildColliders"/>.</remarks>
    public StaticObject AddStatic(Fractal fractal, Transformation? placement = null) => AddStatic(_statics.ModelOf(fractal), placement);

    /// <summary>Adds a mesh that bodies collide with. Equal meshes share one collider, and existing colliders are kept.</summary>
    /// <inheritdoc cref="AddStatic(Fractal, Transformation?)"/>
    /// <param name="mesh">Need not be closed.</param>
    /// <param name="placement">Placement in world space; null to leave the mesh in its own frame.</param>
    public StaticObject AddStatic(Mesh mesh, Transformation? placement = null) => AddStatic(_statics.ModelOf(mesh), placement);

    /// <summary>
    /// Adds a model that bodies collide with. Objects with the same model share its collider, and existing colliders are kept.
    /// </summary>
    /// <inheritdoc cref="AddStatic(Fractal, Transformation?)"/>
    /// <param name="model">A mesh or a fractal, possibly of the world's scene.</param>
    /// <param name="placement">Placement in world space; null to leave the model in its own frame.</param>
    public StaticObject AddStatic(Model model, Transformation? placement = null)
    {
        var actualPlacement = placement ?? Transformation.Identity;
        ArgumentCheck.RequirePlacement(actualPlacement, nameof(placement));
        var added = AppendStatic(new(new SceneObject(model) { Placement = actualPlacement }), objectIndex: null);
        InvalidateSurroundings(mayOverlap: true);
        return added;
    }

    /// <summary>Adds a sphere that moves, as <see cref="Add(BodyDescription)"/> does.</summary>
    /// <param name="position">Initial position of the centre in world space.</param>
    /// <param name="radius">Scene units, positive.</param>
    /// <param name="restitution">Fraction of the speed along the normal that a collision preserves, from 0 to 1.</param>
    /// <param name="velocity">Initial velocity, units per second.</param>
    /// <param name="mass">Kilograms, positive.</param>
    /// <param name="friction">Coulomb's coefficient, not negative.</param>
    /// <param name="damping">Rate at which the sphere loses speed, per second, not negative.</param>
    /// <returns>The body of the sphere.</returns>
    /// <exception cref="ArgumentException">A number is not finite, or outside its range; the message names it.</exception>
    public Body AddSphere(
        Vector position, double radius, double restitution = 0, Vector velocity = default, double mass = 1, double friction = 0,
        double damping = 0) => Add(new(position, radius)
        {
            Restitution = restitution, Velocity = velocity, Mass = mass, Friction = friction, Damping = damping,
        });

    /// <summary>
    /// Adds a body whose surface is a fractal with a finite depth, with the mass of its volume at a density of 1 and without friction.
    /// </summary>
    /// <param name="fractal">Its frame's origin is not the centre of mass, see <see cref="MeshShape.Centre"/>.</param>
    /// <param name="position">Initial position of the centre of mass in world space, scene units.</param>
    /// <returns>The body of the fractal.</returns>
    /// <exception cref="ArgumentException">The fractal is empty or infinite; the message says which.</exception>
    public Body Add(Fractal fractal, Vector position) => Add(new BodyDescription(position, new MeshShape(_statics.ModelOf(fractal))));

    /// <summary>Adds a body whose surface is a mesh, with the mass of its volume at a density of 1 and without friction.</summary>
    /// <inheritdoc cref="Add(Fractal, Vector)"/>
    /// <param name="mesh">Where it is not closed, its convex hull counts for the mass.</param>
    /// <param name="position">Initial position of the centre of mass in world space, scene units.</param>
    public Body Add(Mesh mesh, Vector position) => Add(new BodyDescription(position, new MeshShape(_statics.ModelOf(mesh))));

    /// <summary>Adds a body. It stays until <see cref="Reset"/>. Cost O(n·log n) for n bodies.</summary>
    /// <exception cref="ArgumentException">A number is not finite, or outside its range; the message names it and the body.</exception>
    public Body Add(BodyDescription description)
    {
        ArgumentNullException.ThrowIfNull(description);
        AddRange([description]);
        return _bodies[^1];
    }

    /// <summary>Adds several bodies, or none if one of them is invalid. Faster than adding them one by one.</summary>
    /// <inheritdoc cref="Add(BodyDescription)"/>
    public void AddRange(IEnumerable<BodyDescription> descriptions)
    {
        var all = descriptions.ToArray();
        Array.ForEach(all, Validate);
        Array.ForEach(all, description => AppendBody(description));
        _stepper.PlaceBodies();
    }

    /// <summary>Puts a character into the world, in place of the previous one. It is not yet active.</summary>
    /// <param name="player">Position and sizes in world space, scene units.</param>
    /// <exception cref="ArgumentException">
    /// The position is not finite, the radius is not positive, or the height is less than twice the radius or more than
    /// <see cref="Player.MaxHeightPerRadius"/> times.
    /// </exception>
    public CharacterController AddCharacter(Player player)
    {
        ArgumentNullException.ThrowIfNull(player);
        ArgumentCheck.Require(player.FindFault() is null, player.FindFault() ?? "", nameof(player));
        Character?.IsActive = false;
        return Character = CreateCharacter(player);
    }

    /// <summary>Builds all colliders that bodies, triggers and character use, instead of at their first queries.</summary>
    /// <remarks>Colliders that exist are kept.</remarks>
    /// <exception cref="ColliderMismatchException">A collider does not fit an object.</exception>
    /// <exception cref="FractalLimitException">A fractal is too large for its collider.</exception>
    /// <exception cref="OperationCanceledException">It was cancelled between two colliders.</exception>
    public void BuildColliders(CancellationToken cancellation = default)
    {
        var ofTriggers = _statics.Objects.Any(static target => target.IsTrigger) ? [ColliderKind.Exact] : Array.Empty<ColliderKind>();
        var kinds = _bodies.Select(body => _statics.KindFor(body.Description)).Append(_statics.CharacterKind).Concat(ofTriggers);
        foreach (var kind in kinds.Distinct())
        {
            _statics.AllCollidersOf(kind)?.Build(cancellation);
        }

        _bodies.ForEach(body => _ = _statics.CollidersOf(body.Description));
    }

    /// <summary>
    /// Continues another world after its scene was changed. Bodies whose declarations are unchanged go on where they are in the other
    /// world, as does the character. Bodies that were added to the other world, and are not of its scene, are added here too.
    /// </summary>
    /// <param name="previous">A world that is not stepped meanwhile, and no more afterwards. It stays as it is.</param>
    /// <remarks>All bodies are awake afterwards, since what they rest on may have changed.</remarks>
    public void Continue(PhysicsWorld previous)
    {
        ArgumentNullException.ThrowIfNull(previous);
        var unmatched = previous._bodies.Take(previous._sceneBodyCount)
            .ToLookup(body => previous._scene.Objects[body.Description.ObjectIndex!.Value].Declaration)
            .ToDictionary(static group => group.Key, static group => new Queue<Body>(group));
        foreach (var body in _bodies)
        {
            if (body.Description.ObjectIndex is { } index
                && unmatched.TryGetValue(_scene.Objects[index].Declaration, out var candidates) && candidates.TryDequeue(out var match))
            {
                body.ContinueFrom(match);
            }
        }

        foreach (var added in previous._bodies.Skip(previous._sceneBodyCount).Where(static body => body.Description.ObjectIndex is null))
        {
            AppendBody(added.Description).ContinueFrom(added);
        }

        _stepper.PlaceBodies();
        _statics.Clock = previous._statics.Clock;
        _statics.Kinematics.Reset(Time);
        _accumulatedTime = previous._accumulatedTime;
        if (previous.Character is { } previousCharacter)
        {
            ContinueCharacter(previousCharacter, isOfScene: previous._scene.Scene.Player == previousCharacter.Description);
        }
    }

    private void ContinueCharacter(CharacterController previousCharacter, bool isOfScene)
    {
        if (Character is null && !isOfScene)
        {
            AddCharacter(previousCharacter.Description);
        }

        if (Character is { } own && own.Description == previousCharacter.Description)
        {
            own.ContinueFrom(previousCharacter);
        }
    }

    /// <summary>Gives a body another velocity, and wakes it with all that touch it.</summary>
    /// <param name="body">A body of this world.</param>
    /// <param name="velocity">Units per second.</param>
    /// <exception cref="ArgumentException">The velocity is not finite, or the body is not of this world.</exception>
    public void SetVelocity(Body body, Vector velocity)
    {
        WakeFor(body, velocity, nameof(velocity));
        body.Velocity = velocity;
    }

    /// <summary>Lets a constant force act on a body, in place of the previous one, and wakes it with all that touch it.</summary>
    /// <param name="body">A body of this world.</param>
    /// <param name="force">Kilograms times units per second².</param>
    /// <exception cref="ArgumentException">The force is not finite, or the body is not of this world.</exception>
    public void SetForce(Body body, Vector force)
    {
        WakeFor(body, force, nameof(force));
        body.Force = force;
    }

    /// <summary>Moves a static object of the scene, see <see cref="StaticObject.MoveTo"/>.</summary>
    /// <param name="objectIndex">Index of the object in the scene, from 0.</param>
    /// <param name="placement">New placement in world space.</param>
    /// <exception cref="ArgumentOutOfRangeException">The scene has no such object.</exception>
    /// <exception cref="ArgumentException">The object is a body, or the placement is not finite or has no inverse.</exception>
    public void MoveObject(int objectIndex, Transformation placement)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(objectIndex);
        ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(objectIndex, _staticOfObject.Length);
        var target = _staticOfObject[objectIndex];
        ArgumentCheck.Require(target is not null, "the object is a body, which moves by itself", nameof(objectIndex));
        target.MoveTo(placement);
    }

    /// <summary>Gives a body an impulse at a point, which changes velocity and spin at once, and wakes it with all that touch it.</summary>
    /// <param name="body">A body of this world.</param>
    /// <param name="impulse">Kilograms times units per second.</param>
    /// <param name="point">Where it acts, world space; null for the centre.</param>
    /// <exception cref="ArgumentException">A coordinate is not finite, or the body is not of this world.</exception>
    public void ApplyImpulse(Body body, Vector impulse, Vector? point = null)
    {
        WakeFor(body, impulse, nameof(impulse), point);
        body.ApplyImpulse((point ?? body.Position) - body.Position, impulse);
    }

    /// <summary>
    /// Lets a force act on a body at a point during the next step, besides the constant one of <see cref="SetForce"/>, and wakes the body
    /// with all that touch it. Several forces add up.
    /// </summary>
    /// <param name="body">A body of this world.</param>
    /// <param name="force">Kilograms times units per second².</param>
    /// <param name="point">Where it acts, world space; null for the centre.</param>
    /// <exception cref="ArgumentException">A coordinate is not finite, or the body is not of this world.</exception>
    public void ApplyForce(Body body, Vector force, Vector? point = null)
    {
        WakeFor(body, force, nameof(force), point);
        _stepper.HasStepForces = true;
        body.StepForce += force;
        body.StepTorque += Vector.Cross((point ?? body.Position) - body.Position, force);
    }

    /// <summary>Makes as many steps of <see cref="PhysicsSettings.TimeStep"/> as fit into the time that has passed.</summary>
    /// <param name="seconds">Time since the last call; a negative one counts as 0. What does not fill a step is kept.</param>
    /// <returns>The number of steps.</returns>
    /// <exception cref="ArgumentException">The time is not finite.</exception>
    /// <exception cref="InvalidOperationException">A body has left the range of a double; the message names it.</exception>
    public int Advance(double seconds)
    {
        ArgumentCheck.Require(double.IsFinite(seconds), "expected a finite time", nameof(seconds));
        _accumulatedTime = Math.Min(_accumulatedTime + Math.Max(0, seconds), Settings.MaxStepsPerAdvance * Settings.TimeStep);
        var steps = 0;
        for (; _accumulatedTime >= Settings.TimeStep; steps++)
        {
            _accumulatedTime -= Settings.TimeStep;
            Step();
        }

        return steps;
    }

    /// <summary>Makes one step of <see cref="PhysicsSettings.TimeStep"/>.</summary>
    /// <exception cref="InvalidOperationException">A body has left the range of a double; the message names it.</exception>
    public void Step() => Step(Settings.TimeStep);

    /// <summary>
    /// Makes one step of any length. Steps may differ in length; default thresholds and sleep follow the length of each step.
    /// </summary>
    /// <param name="seconds">Length of the step, positive and finite.</param>
    /// <exception cref="ArgumentOutOfRangeException">The length is NaN, infinite, negative or zero.</exception>
    /// <exception cref="ColliderMismatchException">A collider that is built now does not fit an object.</exception>
    /// <exception cref="FractalLimitException">A fractal is too large for a collider that is built now.</exception>
    /// <exception cref="InvalidOperationException">A body has left the range of a double; the message names it.</exception>
    public void Step(double seconds)
    {
        ArgumentCheck.RequireInRange(
            seconds > 0 && double.IsFinite(seconds), seconds, "expected a positive and finite time step", nameof(seconds));
        _stepper.Step(Character is { IsActive: true } character ? character : null, _gravity, seconds);
    }

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
        _statics.Objects.ForEach(static target => target.ResetPlacement());
        _bodies.ForEach(static body => body.Reset());
        Character?.Reset();
        _statics.Clock = default;
        _statics.Kinematics.Reset(0);
        _stepper.Reset();
        _accumulatedTime = 0;
    }

    /// <summary>Finds the closest point of all static objects.</summary>
    /// <param name="position">World space, finite.</param>
    /// <param name="kind">Kind of collider that answers.</param>
    /// <param name="closest">The closest point in world space, if there is one.</param>
    /// <returns>False where there are no static objects, or none with a face.</returns>
    /// <exception cref="ArgumentOutOfRangeException">A coordinate is not finite.</exception>
    public bool TryFindClosest(Vector position, ColliderKind kind, out ClosestPoint closest)
    {
        closest = default;
        return _statics.CollidersOf(kind)?.FindClosest(position, double.PositiveInfinity, _stepper.QueryContext, out closest) is not null;
    }

    /// <summary>Finds what a sphere meets first on a straight path, as the world is now.</summary>
    /// <param name="start">Where its centre begins, world space.</param>
    /// <param name="radius">Scene units, positive.</param>
    /// <param name="displacement">Where to, from there: the length counts.</param>
    /// <param name="hit">What is met; at a distance of 0 where the sphere overlaps it from the beginning.</param>
    /// <param name="layer">Layer of the sphere, from 0 to 31, see <see cref="BodyDescription.Layer"/>.</param>
    /// <param name="mask">The layers that it meets, a bit for each.</param>
    /// <returns>False when the path is free.</returns>
    /// <exception cref="ArgumentException">A number is not finite, the radius is not positive, or there is no such layer.</exception>
    /// <remarks>
    /// Exact to 1e-10 of the radius. What is grazed by less than 1/128 of the radius may be missed. Allocates nothing once all colliders
    /// are built, but some 200 bytes at the first query that reaches an object. Nothing is woken.
    /// </remarks>
    public bool TryCastSphere(Vector start, double radius, Vector displacement, out CastHit hit, int layer = 0, uint mask = Layers.All)
    {
        ArgumentCheck.RequireFinite(start, nameof(start));
        ArgumentCheck.RequireFinite(displacement, nameof(displacement));
        ArgumentCheck.Require(radius > 0 && double.IsFinite(radius), "the radius must be positive", nameof(radius));
        Layers.Require(layer, nameof(layer));
        return _queries.TryCastSphere(start, radius, displacement, layer, mask, out hit);
    }

    /// <summary>Finds what a ray meets first, as the world is now: faces from both sides, and the balls of bodies.</summary>
    /// <param name="ray">In world space.</param>
    /// <param name="hit">What is met; at a distance of 0 where the ray begins inside a ball.</param>
    /// <param name="maxDistance">Largest distance that counts, scene units; may be infinite.</param>
    /// <param name="layer">Layer of the ray, from 0 to 31, see <see cref="BodyDescription.Layer"/>.</param>
    /// <param name="mask">The layers that it meets, a bit for each.</param>
    /// <returns>False when nothing is met up to the distance.</returns>
    /// <exception cref="ArgumentException">
    /// The ray is not finite, its direction is 0, the distance is negative or NaN, or there is no such layer.
    /// </exception>
    /// <exception cref="FractalLimitException">A model can't be prepared, see <see cref="RayCaster.For(Fractal)"/>.</exception>
    /// <remarks>Cost O(n) for n bodies and objects. For many rays through objects alone see <see cref="SceneRayCaster"/>.</remarks>
    public bool TryCastRay(
        Ray ray, out CastHit hit, double maxDistance = double.PositiveInfinity, int layer = 0, uint mask = Layers.All)
    {
        Layers.Require(layer, nameof(layer));
        return _queries.TryCastRay(ray, maxDistance, layer, mask, out hit);
    }

    /// <summary>The world's scene with all objects where they are now, followed by the static objects that were added.</summary>
    /// <param name="alpha">Fraction of the last step that has passed, from 0 to 1: frames between two steps show what lies between.</param>
    /// <remarks>Bodies that were added have no model and are not part of it.</remarks>
    public LoadedScene GetCurrentScene(double alpha = 1)
    {
        var objects = _scene.Objects.ToBuilder();
        foreach (var body in _bodies)
        {
            if (body.Description.ObjectIndex is { } index)
            {
                objects[index] = SceneBody.PlaceAt(body, _scene.Objects[index], alpha);
            }
        }

        foreach (var placed in _statics.Objects)
        {
            var present = alpha == 1 ? placed.Placed : placed.PlaceAt(alpha);
            if (placed.ObjectIndex is { } index)
            {
                objects[index] = present;
            }
            else
            {
                objects.Add(present);
            }
        }

        var scene = _scene.Scene with { Gravity = _gravity, Objects = [.. objects.Select(static placed => placed.Declaration)] };
        return new(scene, objects.ToImmutable());
    }

    private StaticObject AppendStatic(PlacedModel placed, int? objectIndex)
    {
        var added = new StaticObject(_statics, placed, _statics.Objects.Count, objectIndex);
        if (placed.Declaration.Motion?.FindFault(placed.ObjectToWorld.Translation) is { } fault)
        {
            throw new SceneObjectException(objectIndex ?? 0, ErrorKind.Input, $"object {placed.Declaration.DisplayName}: {fault}");
        }

        _statics.Add(added);
        if (placed.Declaration.Motion is not null || placed.Declaration.Belt != Vector.Zero)
        {
            added.Kinematic = _statics.AddKinematic(added);
        }

        return added;
    }

    private Body AppendBody(BodyDescription description)
    {
        var body = new Body(description, _bodies.Count) { Shrinkage = ShrinkageOverride ?? description.Shrinkage };
        _bodies.Add(body);
        return body;
    }

    private CharacterController CreateCharacter(Player player) => new(_bodies, _stepper.Islands, _stepper.Obstacles, player, _gravity);

    private void Validate(BodyDescription description)
    {
        description.Validate();
        ArgumentCheck.Require(
            description.ObjectIndex is not { } index || (index >= 0 && index < _scene.Objects.Length),
            $"{(description.Name is { } name ? $"body {name}: " : "")}the object index must be that of an object of the scene");
    }

    /// <summary>Wakes a body of this world, with all that touch it, for something that callers do to it.</summary>
    private void WakeFor(Body body, Vector change, string name, Vector? point = null)
    {
        var isOwn = body.Index < _bodies.Count && ReferenceEquals(_bodies[body.Index], body);
        ArgumentCheck.Require(isOwn, "the body is not of this world", nameof(body));
        body.RequireFinite(change, name);
        body.RequireFinite(point ?? Vector.Zero, nameof(point));
        _stepper.Islands.Wake(body);
    }

    private void InvalidateSurroundings(bool mayOverlap)
    {
        foreach (var body in _bodies)
        {
            body.InvalidateSurroundings(mayOverlap);
        }

        Character?.Capsule.InvalidateSurroundings();
    }
}
