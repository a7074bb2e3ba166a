using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <content>What the world consists of: adding and changing static objects, bodies and the character.</content>
public sealed partial class PhysicsWorld
{
    // Contacts and bodies that it may meet, of a ball in a heap.
    private const int ContactsPerBall = 4;

    private int _bodyRoom;
    private int _contactRoom;

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

    /// <summary>Adds a sphere that moves, as <see cref="Add"/> does.</summary>
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

    /// <summary>Adds a body. It stays until <see cref="Reset"/>. Cost O(n·log n) for n bodies.</summary>
    /// <exception cref="ArgumentException">A number is not finite, or outside its range; the message names it and the body.</exception>
    public Body Add(BodyDescription description)
    {
        ArgumentNullException.ThrowIfNull(description);
        Validate(description);
        var body = AppendBody(description);
        PlaceBodies();
        return body;
    }

    /// <summary>Adds several bodies, or none if one of them is invalid. Faster than adding them one by one.</summary>
    /// <inheritdoc cref="Add"/>
    public void AddRange(IEnumerable<BodyDescription> descriptions)
    {
        var all = descriptions.ToArray();
        foreach (var description in all)
        {
            Validate(description);
        }

        foreach (var description in all)
        {
            AppendBody(description);
        }

        PlaceBodies();
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
        ArgumentCheck.Require(player.FindFault() is null, player.FindFault() ?? "", null, nameof(player));
        if (Character is { } previous)
        {
            previous.IsActive = false;
        }

        return Character = new(_bodies, _islands, _obstacles, player, _gravity);
    }

    /// <summary>Builds all colliders that bodies, triggers and character use, instead of at their first queries.</summary>
    /// <remarks>Colliders that exist are kept.</remarks>
    /// <exception cref="ColliderMismatchException">A collider does not fit an object.</exception>
    /// <exception cref="FractalLimitException">A fractal is too large for its collider.</exception>
    /// <exception cref="OperationCanceledException">It was cancelled between two colliders.</exception>
    public void BuildColliders(CancellationToken cancellation = default)
    {
        var ofTriggers = _statics.Objects.Any(static target => target.IsTrigger) ? [ColliderKind.Exact] : Array.Empty<ColliderKind>();
        foreach (var kind in _bodies.Select(ColliderKindOf).Append(CharacterColliderKind).Concat(ofTriggers).Distinct())
        {
            _statics.AllCollidersOf(kind)?.Build(cancellation);
        }

        _bodies.ForEach(body => _ = CollidersOf(body));
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

        PlaceBodies();
        _clock.ContinueFrom(previous._clock);
        _accumulatedTime = previous._accumulatedTime;
        ResetKinematics();
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
        RequireOwn(body);
        _islands.SetVelocity(body, velocity);
    }

    /// <summary>Lets a constant force act on a body, in place of the previous one, and wakes it with all that touch it.</summary>
    /// <param name="body">A body of this world.</param>
    /// <param name="force">Kilograms times units per second².</param>
    /// <exception cref="ArgumentException">The force is not finite, or the body is not of this world.</exception>
    public void SetForce(Body body, Vector force)
    {
        RequireOwn(body);
        body.RequireFinite(force, nameof(force));
        _islands.Wake(body);
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
        ArgumentCheck.Require(target is not null, "the object is a body, which moves by itself", null, nameof(objectIndex));
        target.MoveTo(placement);
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
        var body = new Body(description, _bodies.Count, _gravity) { Shrinkage = ShrinkageOverride ?? description.Shrinkage };
        _bodies.Add(body);
        _areMixed |= body.IsCompound || description.Collider != _bodies[0].Description.Collider;
        _nearbyBodies.HasFilters |= description.Mask != Layers.All || description.Layer != 0;
        return body;
    }

    /// <summary>Puts all bodies into the grid, and makes room for their steps, which then allocate nothing.</summary>
    private void PlaceBodies()
    {
        _grid.Build(_bodies);
        _parallel.Reserve(_bodies.Count);
        var contactCount = ContactsPerBall * _bodies.Sum(static body => body.BallCount);
        if (_bodies.Count <= _bodyRoom && contactCount <= _contactRoom)
        {
            return;
        }

        // Twice as much as is needed, so that adding one by one takes linear time.
        _bodyRoom = 2 * _bodies.Count;
        _contactRoom = 2 * contactCount;
        _queryContext.MakeRoom();
        _stepper.Reserve(_bodyRoom);
        _islands.Reserve(_bodyRoom);
        _planner.Reserve(_bodyRoom, _contactRoom);
        _islandMover.Reserve(_bodyRoom);
        _contactLog.Reserve(_contactRoom);
    }

    private void Validate(BodyDescription description)
    {
        description.Validate();
        ArgumentCheck.Require(
            description.ObjectIndex is not { } index || (index >= 0 && index < _scene.Objects.Length),
            "the object index must be that of an object of the scene", description.Name is { } name ? $"body {name}" : null);
    }

    private void RequireOwn(Body body) => ArgumentCheck.Require(
        body.Index < _bodies.Count && ReferenceEquals(_bodies[body.Index], body), "the body is not of this world", null, nameof(body));
}
