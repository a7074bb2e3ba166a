using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Movement;

/// <summary>
/// A character that walks: a capsule that slides along walls, climbs slopes and steps, and jumps. Owned by a world, which moves it in each
/// step while it <see cref="IsActive"/>.
/// </summary>
/// <remarks>The capsule is a row of spheres half a radius apart: between them it is 3 % of the radius thinner.</remarks>
public sealed class CharacterController
{
    // Seconds for which a jump waits for ground.
    private const double JumpBufferTime = 0.1;

    private readonly GroundMovement _groundMovement;
    private readonly AirMovement _airMovement;
    private double _jumpBufferTime;
    private Vector _positionBeforeCarry;

    /// <summary>Creates a character at the position of its description, not active.</summary>
    /// <param name="bodies">The world's bodies.</param>
    /// <param name="islands">Wakes those that the character touches.</param>
    /// <param name="obstacles">The world's obstacles, which are set up anew in each step.</param>
    /// <param name="player">Already validated.</param>
    /// <param name="gravity">Units per second².</param>
    internal CharacterController(List<Body> bodies, SleepIslands islands, Obstacles obstacles, Player player, Vector gravity)
    {
        Description = player;
        Capsule = new(bodies, islands, obstacles, player);
        Capsule.AlignWithGravity(gravity);
        _groundMovement = new(Capsule, player.StepHeight);
        _airMovement = new(Capsule);
        Reset();
    }

    /// <summary>Sizes, speeds and initial position of the character.</summary>
    public Player Description { get; }

    /// <summary>Direction against gravity, of length 1; the y-axis where there is no gravity.</summary>
    public Vector Up => Capsule.Up;

    /// <summary>Current position of the capsule's centre, world space.</summary>
    public Vector Position => Capsule.Position;

    /// <summary>Position of the centre before the last step, for interpolation between steps.</summary>
    public Vector PreviousPosition { get; private set; }

    /// <summary>Current velocity in units per second.</summary>
    public Vector Velocity { get; private set; }

    /// <summary>
    /// How far the ground has turned the character about <see cref="Up"/> since it began, radians: a turntable turns it with it.
    /// </summary>
    /// <remarks>Positive in the sense of an angular velocity along <see cref="Up"/>.</remarks>
    public double CarriedAngle { get; private set; }

    /// <summary>That angle before the last step, for interpolation between steps.</summary>
    public double PreviousCarriedAngle { get; private set; }

    /// <summary>True where the character stands on something that is not too steep, or is caught between steep walls.</summary>
    public bool IsGrounded { get; private set; }

    /// <summary>Whether the character takes part in the world. While it does not, nothing touches or moves it.</summary>
    public bool IsActive
    {
        get;
        set
        {
            if (field != value)
            {
                field = value;
                // Something may have come to lie here; or lies on the character that leaves.
                Capsule.InvalidateSurroundings();
                Capsule.WakeTouchingBodies(Position);
            }
        }
    }

    /// <summary>
    /// Where to walk, in world space. The length is the fraction of the full speed, at most 1; the part along <see cref="Up"/> is ignored.
    /// </summary>
    public Vector MoveInput { get; set; }

    /// <summary>Where it is, and what it touches.</summary>
    internal CharacterCapsule Capsule { get; }

    /// <summary>Jumps now, or as soon as there is ground to jump from within a tenth of a second.</summary>
    public void Jump() => _jumpBufferTime = JumpBufferTime;

    /// <summary>Moves the character to a position at once, at rest.</summary>
    /// <param name="position">
    /// New position of the capsule's centre, finite. If it overlaps something there, the next step pushes it out.
    /// </param>
    /// <exception cref="ArgumentException">The position is not finite.</exception>
    public void Teleport(Vector position)
    {
        ArgumentCheck.RequireFinite(position, nameof(position));
        Capsule.Position = position;
        PreviousPosition = position;
        Velocity = Vector.Zero;
        IsGrounded = false;
        CarriedAngle = 0;
        PreviousCarriedAngle = 0;
        Capsule.Ground = null;
        _jumpBufferTime = 0;
        Capsule.InvalidateSurroundings();
    }

    /// <summary>Returns the character to its initial position, at rest.</summary>
    internal void Reset() => Teleport(Description.Position);

    /// <summary>Takes over the movement of a character with the same description.</summary>
    internal void ContinueFrom(CharacterController other)
    {
        Teleport(other.Position);
        PreviousPosition = other.PreviousPosition;
        Velocity = other.Velocity;
        IsGrounded = other.IsGrounded;
        CarriedAngle = other.CarriedAngle;
        PreviousCarriedAngle = other.PreviousCarriedAngle;
        MoveInput = other.MoveInput;
        IsActive = other.IsActive;
    }

    /// <summary>True where an object may come near the capsule in a step.</summary>
    internal bool IsNear(BoundingBox bounds) => bounds.DistanceSquared(Position) <= Description.Height * Description.Height;

    /// <summary>Saves the position before a step.</summary>
    internal void BeginStep()
    {
        PreviousPosition = Position;
        PreviousCarriedAngle = CarriedAngle;
    }

    /// <summary>Moves the character on with the ground, at the beginning of a step.</summary>
    /// <param name="stepLength">Seconds, positive.</param>
    internal void Carry(double stepLength)
    {
        _positionBeforeCarry = Position;
        CarriedAngle += IsGrounded ? Capsule.Carry(stepLength) : 0;
    }

    /// <summary>Moves the character through one step, or a part of one.</summary>
    /// <param name="colliders">What stands in the way; null for nothing.</param>
    /// <param name="gravity">Units per second².</param>
    /// <param name="stepLength">Seconds, positive.</param>
    internal void Step(StaticColliders? colliders, Vector gravity, double stepLength)
    {
        var speed = Math.Max(Description.WalkingSpeed, Velocity.Length());
        if (!Capsule.TryBeginStep(colliders, (2 * stepLength * speed) + Description.StepHeight))
        {
            Velocity = Vector.Zero;
            return;
        }

        var start = Position;
        var desiredVelocity = MoveInput - (Vector.Dot(MoveInput, Up) * Up);
        desiredVelocity *= Description.WalkingSpeed / Math.Max(1, desiredVelocity.Length());
        var isJumping = IsGrounded && _jumpBufferTime > 0;
        _jumpBufferTime = isJumping ? 0 : _jumpBufferTime - stepLength;
        bool isGrounded;
        if (IsGrounded && !isJumping)
        {
            Velocity = _groundMovement.Walk(desiredVelocity, stepLength, _positionBeforeCarry, out isGrounded);
        }
        else
        {
            // A jump from a lift begins with its speed; below a walker, ground that falls away takes none along.
            var liftSpeed = isJumping ? Math.Max(0, Vector.Dot(Position - _positionBeforeCarry, Up) / stepLength) : 0;
            var speedUpwards = isJumping ? Description.JumpSpeed(gravity.Length()) + liftSpeed : Vector.Dot(Velocity, Up);
            Capsule.Ground = null;
            Velocity = _airMovement.Fly(desiredVelocity + (speedUpwards * Up), gravity, stepLength, out isGrounded);
        }

        IsGrounded = isGrounded;
        if (!isGrounded)
        {
            Capsule.Ground = null;
        }

        if ((Position - start).MaxAbsComponent() <= Capsule.MinMoveDistance)
        {
            Capsule.Position = start;
        }
        else
        {
            Capsule.WakeTouchingBodies(_positionBeforeCarry);
        }
    }
}
