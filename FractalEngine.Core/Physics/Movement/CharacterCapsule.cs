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
/// <param name="bodies">The world's bodies.</param>
/// <param name="islands">Wakes those that the character touches.</param>
/// <param name="obstacles">The world's obstacles, which are set up anew in each step.</param>
/// <param name="player">Already validated.</param>
internal sealed class CharacterCapsule(List<Body> bodies, SleepIslands islands, Obstacles obstacles, Player player)
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

    private readonly SphereSweep _sweep = new(obstacles);
    private readonly OverlapResolver _overlapResolver = new(obstacles);
    private readonly SafeDistance _safeDistance = new();
    private bool _isOverlapResolved;

    /// <summary>Position of the capsule's centre, world space.</summary>
    public Vector Position { get; set; }

    /// <summary>Direction against gravity, of length 1: the capsule's axis.</summary>
    public Vector Up { get; private set; }

    /// <summary>Cosine of the steepest slope that is ground.</summary>
    public double MinGroundCosine { get; } = Math.Cos(player.MaxSlopeAngle * Math.PI / 180);

    /// <summary>Radius of the capsule, scene units.</summary>
    public double Radius => player.Radius;

    /// <summary>Shortest move that counts as one, scene units.</summary>
    public double MinMoveDistance => MinMoveFraction * player.Radius;

    /// <summary>Offsets of the capsule's spheres from its position.</summary>
    public Vector[] SphereOffsets { get; private set; } = [];

    /// <summary>The planes that velocities must not lead into.</summary>
    public HalfSpaces Planes { get; } = new();

    /// <summary>The ground that was found last; null for none.</summary>
    public Contact? Ground { get; set; }

    /// <summary>Turns the capsule's axis against gravity; without gravity it is the y-axis.</summary>
    public void AlignWithGravity(Vector gravity)
    {
        Up = gravity == Vector.Zero ? Vector.J : -gravity.UnitVector();
        var halfSegment = (0.5 * player.Height) - player.Radius;
        var intervalCount = (int)Math.Ceiling(2 * halfSegment / (SphereSpacing * player.Radius));
        SphereOffsets = new Vector[intervalCount + 1];
        for (var i = 0; i <= intervalCount; i++)
        {
            SphereOffsets[i] = (intervalCount == 0 ? 0 : (2.0 * i / intervalCount) - 1) * halfSegment * Up;
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
        obstacles.SetMover(colliders, SphereOffsets, player.Radius, _safeDistance, searchMargin);
        _sweep.ResetStepBudget();
        // What moves may have come to overlap the capsule.
        if (!_isOverlapResolved || obstacles.TryFindNearKinematic(Position, -MaxKinematicOverlap * player.Radius, out _))
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
        obstacles.CollectNearbyBodies(in motion, timeLeft, Contact.NoBody);
        var isHit = _sweep.TryFindImpact(in motion, timeLeft, out contact, out elapsed);
        Position = motion.PositionAt(elapsed);
        timeLeft -= elapsed;
        return isHit;
    }

    /// <summary>Moves the capsule straight by a displacement, or up to what is in the way.</summary>
    /// <returns>True when something was in the way.</returns>
    public bool MoveBy(Vector displacement, out Contact contact)
    {
        var fractionLeft = 1.0;
        return MoveAlong(new(Position, displacement, Vector.Zero), ref fractionLeft, out contact, out _);
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
        var probeDistance = EdgeProbeDistance * player.Radius;
        var probe = contact.Point + (probeDistance * (Up - horizontalNormal.UnitVectorOrZero()));
        return obstacles.FindClosestPoint(probe, EdgeProbeMargin * probeDistance, out var closest) is not null
            && Math.Abs(Vector.Dot(closest.Normal, Up)) >= MinGroundCosine && Vector.Dot(probe - closest.Point, Up) > 0;
    }

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
        obstacles.Time = stepLength;
        Position = ground.ToWorld(reference) + (stepLength * belt);
        _safeDistance.Invalidate();
        return stepLength * Vector.Dot(ground.AngularVelocity, Up);
    }

    /// <summary>Lets no horizontal velocity lead into a wall, however it leans.</summary>
    public void AddWallPlane(Vector normal)
    {
        var wallNormal = (normal - (Vector.Dot(normal, Up) * Up)).UnitVectorOrZero();
        Planes.Add(wallNormal == Vector.Zero ? normal : wallNormal, 0);
    }

    /// <summary>Gives a body that is in the way the velocity of the character along the normal.</summary>
    public void PushBody(in Contact contact, Vector normal, Vector velocity)
    {
        if ((contact.IsBody ? bodies[contact.BodyIndex] : obstacles.BodyOf(in contact)) is not { } body)
        {
            return;
        }

        var approachSpeed = Vector.Dot(velocity - body.Velocity, normal);
        if (approachSpeed < 0)
        {
            var pushed = body.Velocity + (approachSpeed * normal);
            body.RequireFinite(pushed, nameof(velocity));
            islands.Wake(body);
            body.Velocity = pushed;
        }
    }

    /// <summary>Wakes the bodies that touch the capsule at a position.</summary>
    public void WakeTouchingBodies(Vector position)
    {
        foreach (var sphereOffset in SphereOffsets)
        {
            islands.WakeOverlapping(position + sphereOffset, player.Radius);
        }
    }
}
