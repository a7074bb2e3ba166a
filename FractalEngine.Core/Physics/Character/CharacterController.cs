using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Character;

/// <summary>
/// A player who walks: a capsule that slides along walls, climbs slopes and steps, and jumps. Owned by a <see cref="PhysicsWorld"/>, which
/// moves it at each step while it <see cref="IsActive"/>.
/// </summary>
/// <remarks>The capsule is a row of spheres half a radius apart: between them it is 3 % of the radius thinner.</remarks>
public sealed class CharacterController
{
    private const int MaxHits = 6;

    // Of the radius.
    private const double SphereSpacing = 0.5;

    // Of the radius: how far behind an edge it is looked what is there.
    private const double EdgeProbeDistance = 1e-3;

    // Of the radius: moves that are shorter are none. Who stands, stands.
    private const double MinMoveDistance = 1e-7;

    private readonly PhysicsWorld _world;
    private readonly Vector[] _sphereOffsets;
    private readonly SafeDistance _safeDistance = new();
    private readonly HalfSpaces _planes = new();
    private readonly Obstacles _obstacles;
    private readonly SphereSweep _sweep;
    private readonly OverlapResolver _overlapResolver;
    private readonly double _minGroundCosine;
    private readonly double _jumpSpeed;
    private readonly double _stepHeight;
    private double _jumpBufferTime;
    private bool _isOverlapResolved;
    private bool _isActive;

    internal CharacterController(PhysicsWorld world, Obstacles obstacles, Player player)
    {
        (_world, _obstacles, Description) = (world, obstacles, player);
        (_sweep, _overlapResolver) = (new(obstacles), new(obstacles, new()));
        Up = world.Gravity == Vector.Zero ? Vector.J : -world.Gravity.UnitVector();
        _minGroundCosine = Math.Cos(player.MaxSlopeAngle * Math.PI / 180);
        (_jumpSpeed, _stepHeight) = (player.JumpSpeed(world.Gravity.Length()), player.StepHeight);
        var halfSegment = (0.5 * player.Height) - player.Radius;
        var intervalCount = (int)Math.Ceiling(2 * halfSegment / (SphereSpacing * player.Radius));
        _sphereOffsets =
            [.. Enumerable.Range(0, intervalCount + 1)
            .Select(i => (intervalCount == 0 ? 0 : (2.0 * i / intervalCount) - 1) * halfSegment * Up)];
        Reset();
    }

    /// <summary>What the scene says of the player.</summary>
    public Player Description { get; }

    /// <summary>Against gravity, of length 1.</summary>
    public Vector Up { get; }

    /// <summary>Of the capsule's middle, world space.</summary>
    public Vector Position { get; private set; }

    /// <summary>The middle before the last step.</summary>
    public Vector PreviousPosition { get; private set; }

    /// <summary>Units a second.</summary>
    public Vector Velocity { get; private set; }

    /// <summary>True on something that is not too steep to stand on, and where nothing gives way.</summary>
    public bool IsGrounded { get; private set; }

    /// <summary>False while the player is not there: nothing touches or moves it.</summary>
    public bool IsActive
    {
        get => _isActive;
        set
        {
            if (_isActive != value)
            {
                _isActive = value;
                // Something may lie here by now; or have lain on who goes away.
                Invalidate();
                WakeTouchingBodies(Position);
            }
        }
    }

    /// <summary>
    /// Where to walk: a direction, and as its length the part of the full speed, at most 1. What leads up or down is left out.
    /// </summary>
    public Vector MoveInput { get; set; }

    /// <summary>The spheres of the capsule beside its position.</summary>
    internal ReadOnlySpan<Vector> SphereOffsets => _sphereOffsets;

    /// <summary>Jumps, now or as soon as there is ground to jump from within a tenth of a second.</summary>
    public void Jump() => _jumpBufferTime = 0.1;

    /// <summary>Moves the player elsewhere, at rest.</summary>
    /// <param name="position">Of the capsule's middle, finite. Out of what it overlaps there it is pushed at the next step.</param>
    /// <exception cref="ArgumentException">The position is not finite.</exception>
    public void Teleport(Vector position)
    {
        if (!position.IsFinite())
        {
            throw new ArgumentException("expected finite coordinates", nameof(position));
        }

        (Position, PreviousPosition, Velocity, IsGrounded, _isOverlapResolved, _jumpBufferTime) =
            (position, position, Vector.Zero, false, false, 0);
        _safeDistance.Invalidate();
    }

    /// <summary>Back to where the scene has it.</summary>
    internal void Reset() => Teleport(Description.Position);

    /// <summary>What is known of the surfaces is not true any more.</summary>
    internal void Invalidate()
    {
        _safeDistance.Invalidate();
        _isOverlapResolved = false;
    }

    /// <summary>Moves on.</summary>
    /// <param name="timeStep">Seconds.</param>
    internal void Step(double timeStep)
    {
        var speed = Math.Max(Description.WalkingSpeed, Velocity.Length());
        _world.PrepareObstacles(_sphereOffsets, Description.Radius, _safeDistance, (2 * timeStep * speed) + _stepHeight);
        _sweep.ResetStepBudget();
        PreviousPosition = Position;
        if (!_isOverlapResolved)
        {
            var position = Position;
            _isOverlapResolved = _overlapResolver.TryResolve(ref position, -1);
            Position = position;
            if (!_isOverlapResolved)
            {
                Velocity = Vector.Zero;
                return;
            }
        }

        var desiredVelocity = MoveInput - (Vector.Dot(MoveInput, Up) * Up);
        desiredVelocity *= Description.WalkingSpeed / Math.Max(1, desiredVelocity.Length());
        var start = Position;
        var isJumping = IsGrounded && _jumpBufferTime > 0;
        _jumpBufferTime = isJumping ? 0 : _jumpBufferTime - timeStep;
        if (IsGrounded && !isJumping)
        {
            Walk(desiredVelocity, timeStep);
        }
        else
        {
            Fly(desiredVelocity + ((isJumping ? _jumpSpeed : Vector.Dot(Velocity, Up)) * Up), timeStep);
        }

        if ((Position - start).MaxAbsComponent() <= MinMoveDistance * Description.Radius)
        {
            Position = start;
        }
        else
        {
            WakeTouchingBodies(PreviousPosition);
        }
    }

    private void WakeTouchingBodies(Vector position)
    {
        foreach (var sphereOffset in _sphereOffsets)
        {
            _world.WakeOverlapping(position + sphereOffset, Description.Radius);
        }
    }

    /// <summary>Along the ground: up steps and slopes, and down again without losing it.</summary>
    private void Walk(Vector desiredVelocity, double timeStep)
    {
        var timeLeft = timeStep;
        _planes.Clear();
        var velocity = desiredVelocity;
        for (var hits = 0; hits < MaxHits && timeLeft > 0 && velocity != Vector.Zero; hits++)
        {
            var isHit = MoveStraight(velocity, ref timeLeft, out var contact);
            if (!isHit)
            {
                break;
            }

            var normal = contact.Normal(Position);
            var isGround = IsWalkable(in contact, normal);
            if (isGround)
            {
                _planes.Add(normal, 0);
            }
            else if (contact.BodyIndex < 0 && TryStepUp(timeLeft * desiredVelocity))
            {
                break;
            }
            else
            {
                // However it leans, it is a wall: nobody climbs it by walking against it.
                AddWallPlane(normal);
                PushBody(in contact, normal, velocity);
            }

            velocity = ProjectOrZero(desiredVelocity);
            if (isGround && velocity != Vector.Zero)
            {
                // Up a slope as fast as on the level.
                velocity *= desiredVelocity.Length() / velocity.Length();
            }
        }

        var averageVelocity = (Position - PreviousPosition) / timeStep;
        // The ground may fall away as steeply as may be walked, or by a step.
        var maxDrop = _stepHeight
            + (timeStep * desiredVelocity.Length()
                * Math.Sqrt(1 - (_minGroundCosine * _minGroundCosine)) / Math.Max(_minGroundCosine, 0.01));
        IsGrounded = TrySnapToGround(maxDrop);
        // Who walks over an edge falls, and does not fly on upwards.
        Velocity = averageVelocity - (Math.Max(0, Vector.Dot(averageVelocity, Up)) * Up);
    }

    /// <summary>Through the air, with all control: who holds a direction jumps there.</summary>
    private void Fly(Vector velocity, double timeStep)
    {
        var (timeLeft, gravity) = (timeStep, _world.Gravity);
        IsGrounded = false;
        _planes.Clear();
        for (var hits = 0; hits < MaxHits && timeLeft > 0; hits++)
        {
            var netAcceleration = ProjectOrZero(gravity);
            if (velocity == Vector.Zero && netAcceleration == Vector.Zero)
            {
                break;
            }

            var motion = new Motion(Position, velocity, netAcceleration);
            _obstacles.CollectNearbyBodies(in motion, timeLeft, -1);
            var isHit = _sweep.TryFindImpact(in motion, timeLeft, out var contact, out var elapsed);
            (Position, velocity, timeLeft) = (motion.PositionAt(elapsed), motion.VelocityAt(elapsed), timeLeft - elapsed);
            if (!isHit)
            {
                break;
            }

            var normal = contact.Normal(Position);
            _planes.Add(normal, 0);
            PushBody(in contact, normal, velocity);
            if (IsWalkable(in contact, normal))
            {
                IsGrounded = true;
            }
            else
            {
                // Slides down it, but is not carried up by pushing against it.
                AddWallPlane(normal);
            }

            velocity = ProjectOrZero(velocity);
        }

        // Between two steep walls one stands as well.
        IsGrounded |= _planes.Count > 0 && gravity != Vector.Zero && ProjectOrZero(gravity).LengthSquared() <= 1e-12
            * gravity.LengthSquared();
        Velocity = velocity;
    }

    /// <summary>Lifts the player onto what is in the way, if it is low enough and can be stood on.</summary>
    private bool TryStepUp(Vector displacement)
    {
        var (start, length) = (Position, displacement.Length());
        if (length == 0 || _stepHeight <= 0)
        {
            return false;
        }

        var fractionLeft = 1.0;
        MoveStraight(_stepHeight * Up, ref fractionLeft, out _);
        var raised = Position;
        // As far on as a foot: on the edge itself nothing tells whether there is something to stand on.
        fractionLeft = 1;
        var isBlocked = MoveStraight(Math.Max(1, Description.Radius / length) * displacement, ref fractionLeft, out _);
        var isHigher = !isBlocked && TrySnapToGround(_stepHeight) && Vector.Dot(Position - start, Up) > MinMoveDistance
            * Description.Radius;
        Position = raised;
        fractionLeft = 1;
        if (!isHigher || MoveStraight(displacement, ref fractionLeft, out _))
        {
            Position = start;
            return false;
        }

        // On the edge for a while, which is steep; the ground behind it has been found.
        fractionLeft = 1;
        MoveStraight(-Vector.Dot(Position - start, Up) * Up, ref fractionLeft, out _);
        return true;
    }

    /// <summary>Goes straight down to the ground; nowhere if there is none.</summary>
    private bool TrySnapToGround(double maxDrop)
    {
        var (start, fractionLeft) = (Position, 1.0);
        if (MoveStraight(-maxDrop * Up, ref fractionLeft, out var contact) && IsWalkable(in contact, contact.Normal(Position)))
        {
            return true;
        }

        Position = start;
        return false;
    }

    /// <summary>Goes straight on until something is in the way.</summary>
    private bool MoveStraight(Vector velocity, ref double timeLeft, out Contact contact)
    {
        var motion = new Motion(Position, velocity, Vector.Zero);
        _obstacles.CollectNearbyBodies(in motion, timeLeft, -1);
        var isHit = _sweep.TryFindImpact(in motion, timeLeft, out contact, out var elapsed);
        (Position, timeLeft) = (motion.PositionAt(elapsed), timeLeft - elapsed);
        return isHit;
    }

    /// <summary>True for what can be stood on: level enough, or the edge of something that is.</summary>
    private bool IsWalkable(in Contact contact, Vector normal)
    {
        if (Vector.Dot(normal, Up) >= _minGroundCosine)
        {
            return true;
        }

        var horizontalNormal = normal - (Vector.Dot(normal, Up) * Up);
        if (contact.IsFlat || contact.BodyIndex >= 0 || !(Vector.Dot(normal, Up) > 0))
        {
            return false;
        }

        // Just above what lies behind the edge.
        var probeDistance = EdgeProbeDistance * Description.Radius;
        var probe = contact.Point + (probeDistance * (Up - horizontalNormal.UnitVectorOrZero()));
        return _obstacles.TryFindClosestPoint(probe, 1.01 * probeDistance, out var closest)
            && Math.Abs(Vector.Dot(closest.Normal, Up)) >= _minGroundCosine && Vector.Dot(probe - closest.Point, Up) > 0;
    }

    private Vector ProjectOrZero(Vector vector) => _planes.TryProject(vector, out var projected) ? projected : Vector.Zero;

    /// <summary>Lets nothing move against a wall, however it leans.</summary>
    private void AddWallPlane(Vector normal)
    {
        var wallNormal = (normal - (Vector.Dot(normal, Up) * Up)).UnitVectorOrZero();
        _planes.Add(wallNormal == Vector.Zero ? normal : wallNormal, 0);
    }

    /// <summary>Pushes a body that is in the way.</summary>
    private void PushBody(in Contact contact, Vector normal, Vector velocity)
    {
        if (contact.BodyIndex < 0)
        {
            return;
        }

        var body = _world.Bodies[contact.BodyIndex];
        var approachSpeed = Vector.Dot(velocity - body.Velocity, normal);
        if (approachSpeed < 0)
        {
            _world.SetVelocity(body, body.Velocity + (approachSpeed * normal));
        }
    }
}
