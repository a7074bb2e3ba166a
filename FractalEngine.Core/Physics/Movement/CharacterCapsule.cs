using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Movement;

/// <summary>
/// The capsule of a character: casts it along paths, tells ground from walls, and keeps the planes that its velocity must not lead into.
/// </summary>
/// <remarks>The capsule is a row of spheres half a radius apart: between them it is 3 % of the radius thinner.</remarks>
internal sealed class CharacterCapsule
{
    /// <summary>Maximum number of obstacles that one move slides along.</summary>
    public const int MaxHits = 6;

    // Relative to the radius.
    private const double SphereSpacing = 0.5;

    // Relative to the radius: how far behind an edge the ground is probed, and how much farther than that the probe searches.
    private const double EdgeProbeDistance = 1e-3;
    private const double EdgeProbeMargin = 1.01;

    // Relative to the radius: more than rounding.
    private const double MaxKinematicOverlap = 1e-6;

    // Relative to the radius: a shorter move counts as none, so that a standing character stands.
    private const double MinMoveFraction = 1e-7;

    private readonly List<Body> _bodies;
    private readonly SleepIslands _islands;
    private readonly Obstacles _obstacles;
    private readonly Player _player;
    private readonly SphereSweep _sweep;
    private readonly OverlapResolver _overlapResolver;
    private readonly SafeDistance _safeDistance = new();
    private readonly HalfSpaces _planes = new();
    private Vector[] _sphereOffsets = [];
    private bool _isOverlapResolved;

    public CharacterCapsule(List<Body> bodies, SleepIslands islands, Obstacles obstacles, Player player, Vector gravity)
    {
        _bodies = bodies;
        _islands = islands;
        _obstacles = obstacles;
        _player = player;
        _sweep = new(obstacles);
        _overlapResolver = new(obstacles);
        MinGroundCosine = Math.Cos(player.MaxSlopeAngle * Math.PI / 180);
        AlignWithGravity(gravity);
    }

    /// <summary>Position of the capsule's centre, world space.</summary>
    public Vector Position { get; set; }

    /// <summary>Direction against gravity, of length 1: the capsule's axis.</summary>
    public Vector Up { get; private set; }

    /// <summary>Cosine of the steepest slope that is ground.</summary>
    public double MinGroundCosine { get; }

    /// <summary>Radius of the capsule, scene units.</summary>
    public double Radius => _player.Radius;

    /// <summary>Shortest move that counts as one, scene units.</summary>
    public double MinMoveDistance => MinMoveFraction * _player.Radius;

    /// <summary>Offsets of the capsule's spheres from its position.</summary>
    public ReadOnlySpan<Vector> SphereOffsets => _sphereOffsets;

    /// <summary>Number of planes that velocities are projected onto, see <see cref="ProjectVelocity"/>.</summary>
    public int PlaneCount => _planes.Count;

    /// <summary>Turns the capsule's axis against gravity; without gravity it is the y-axis.</summary>
    public void AlignWithGravity(Vector gravity)
    {
        Up = gravity == Vector.Zero ? Vector.J : -gravity.UnitVector();
        var halfSegment = (0.5 * _player.Height) - _player.Radius;
        var intervalCount = (int)Math.Ceiling(2 * halfSegment / (SphereSpacing * _player.Radius));
        _sphereOffsets = new Vector[intervalCount + 1];
        for (var i = 0; i <= intervalCount; i++)
        {
            _sphereOffsets[i] = (intervalCount == 0 ? 0 : (2.0 * i / intervalCount) - 1) * halfSegment * Up;
        }

        InvalidateSurroundings();
    }

    /// <summary>Discards what is known of surfaces, and lets the next step check for overlaps.</summary>
    public void InvalidateSurroundings()
    {
        _safeDistance.Invalidate();
        _isOverlapResolved = false;
    }

    /// <summary>Prepares a step: sets up the obstacles, and resolves an overlap.</summary>
    /// <param name="colliders">What stands in the way; null for nothing.</param>
    /// <param name="searchMargin">How much farther queries search than asked, so that the next steps need none.</param>
    /// <returns>False where the capsule is closed in.</returns>
    public bool TryBeginStep(StaticColliders? colliders, double searchMargin)
    {
        _obstacles.SetMover(colliders, _sphereOffsets, _player.Radius, _safeDistance, searchMargin);
        _sweep.ResetStepBudget();
        // What moves may have come to overlap the capsule.
        if (!_isOverlapResolved || _obstacles.TryFindNearKinematic(Position, -MaxKinematicOverlap * _player.Radius, out _))
        {
            var position = Position;
            _isOverlapResolved = _overlapResolver.TryResolve(ref position, body: null);
            Position = position;
        }

        return _isOverlapResolved;
    }

    /// <summary>Moves the capsule along a path until it touches something or the time is up.</summary>
    /// <param name="motion">Begins at <see cref="Position"/>.</param>
    /// <param name="timeLeft">Duration of the path; receives what is left of it.</param>
    /// <param name="contact">What is touched.</param>
    /// <param name="elapsed">The time that has passed.</param>
    /// <returns>True when something was touched.</returns>
    public bool MoveAlong(in SphereMotion motion, ref double timeLeft, out Contact contact, out double elapsed)
    {
        _obstacles.CollectNearbyBodies(in motion, timeLeft, Contact.NoBody);
        var isHit = _sweep.TryFindImpact(in motion, timeLeft, out contact, out elapsed);
        Position = motion.PositionAt(elapsed);
        timeLeft -= elapsed;
        return isHit;
    }

    /// <summary>Moves the capsule straight until it touches something or the time is up.</summary>
    /// <param name="velocity">Units per second; or a displacement, where the time is the fraction of it.</param>
    /// <param name="timeLeft">Duration of the move; receives what is left of it.</param>
    /// <param name="contact">What is touched.</param>
    /// <returns>True when something was touched.</returns>
    public bool MoveStraight(Vector velocity, ref double timeLeft, out Contact contact) =>
        MoveAlong(new(Position, velocity, Vector.Zero), ref timeLeft, out contact, out _);

    /// <summary>Moves the capsule straight by a displacement, or up to what is in the way.</summary>
    /// <returns>True when something was in the way.</returns>
    public bool MoveBy(Vector displacement, out Contact contact)
    {
        var fractionLeft = 1.0;
        return MoveStraight(displacement, ref fractionLeft, out contact);
    }

    /// <summary>True for what can be stood on: a slope that is level enough, or the edge of one.</summary>
    /// <param name="contact">What is touched.</param>
    /// <param name="normal">Its normal at the present position.</param>
    public bool IsWalkable(in Contact contact, Vector normal)
    {
        var isWalkable = IsGround(in contact, normal);
        Ground = isWalkable ? contact : Ground;
        return isWalkable;
    }

    private bool IsGround(in Contact contact, Vector normal)
    {
        if (Vector.Dot(normal, Up) >= MinGroundCosine)
        {
            return true;
        }

        var horizontalNormal = normal - (Vector.Dot(normal, Up) * Up);
        if (contact.IsFlat || contact.IsBody || !(Vector.Dot(normal, Up) > 0))
        {
            return false;
        }

        // Just above what lies behind the edge.
        var probeDistance = EdgeProbeDistance * _player.Radius;
        var probe = contact.Point + (probeDistance * (Up - horizontalNormal.UnitVectorOrZero()));
        return _obstacles.TryFindClosestPoint(probe, EdgeProbeMargin * probeDistance, out var closest)
            && Math.Abs(Vector.Dot(closest.Normal, Up)) >= MinGroundCosine && Vector.Dot(probe - closest.Point, Up) > 0;
    }

    /// <summary>The ground that was found last; none where it does not move.</summary>
    public Contact? Ground { get; private set; }

    /// <summary>Forgets what ground was found.</summary>
    public void ForgetGround() => Ground = null;

    /// <summary>Moves the capsule on with the ground that moves, for a step.</summary>
    /// <param name="stepLength">Seconds.</param>
    /// <returns>The angle by which the ground has turned about <see cref="Up"/>, radians.</returns>
    public double Carry(double stepLength)
    {
        if (Ground is not { Kinematic: { IsCarrying: true } ground } contact)
        {
            return 0;
        }

        var belt = contact.SurfaceVelocity(Position) - ground.VelocityAt(contact.Point);
        var reference = ground.ToReference(Position);
        _obstacles.Time = stepLength;
        Position = ground.ToWorld(reference) + (stepLength * belt);
        _safeDistance.Invalidate();
        return stepLength * Vector.Dot(ground.AngularVelocity, Up);
    }

    /// <summary>Removes all planes that velocities are projected onto.</summary>
    public void ClearPlanes() => _planes.Clear();

    /// <summary>Lets no velocity lead into a surface.</summary>
    public void AddPlane(Vector normal) => _planes.Add(normal, 0);

    /// <summary>Lets no horizontal velocity lead into a wall, however it leans.</summary>
    public void AddWallPlane(Vector normal)
    {
        var wallNormal = (normal - (Vector.Dot(normal, Up) * Up)).UnitVectorOrZero();
        _planes.Add(wallNormal == Vector.Zero ? normal : wallNormal, 0);
    }

    /// <summary>Projects a velocity or acceleration onto those that lead into no plane; zero where these leave no direction free.</summary>
    public Vector ProjectVelocity(Vector velocity) => _planes.ProjectOrZero(velocity);

    /// <summary>Gives a body that is in the way the velocity of the character along the normal.</summary>
    public void PushBody(in Contact contact, Vector normal, Vector velocity)
    {
        if (!contact.IsBody)
        {
            return;
        }

        var body = _bodies[contact.BodyIndex];
        var approachSpeed = Vector.Dot(velocity - body.Velocity, normal);
        if (approachSpeed < 0)
        {
            _islands.SetVelocity(body, body.Velocity + (approachSpeed * normal));
        }
    }

    /// <summary>Wakes the bodies that touch the capsule at a position.</summary>
    public void WakeTouchingBodies(Vector position)
    {
        foreach (var sphereOffset in _sphereOffsets)
        {
            _islands.WakeOverlapping(position + sphereOffset, _player.Radius);
        }
    }
}
