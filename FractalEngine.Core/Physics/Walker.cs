using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <summary>
/// A player who walks: a capsule that slides along walls, climbs slopes and steps, and jumps. Owned by a <see cref="PhysicsWorld"/>, which moves it at each step
/// while it <see cref="IsActive"/>.
/// </summary>
/// <remarks>The capsule is a row of spheres half a radius apart: between them it is 3 % of the radius thinner.</remarks>
public sealed class Walker
{
    private const int MostHits = 6;

    // Of the radius.
    private const double SphereDistance = 0.5;

    // Of the radius: how far behind an edge it is looked what is there.
    private const double EdgeWidth = 1e-3;

    // Of the radius: moves that are shorter are none. Who stands, stands.
    private const double Still = 1e-7;

    private readonly PhysicsWorld _world;
    private readonly Vector[] _spheres;
    private readonly Clearance _clearance = new();
    private readonly HalfSpaces _planes = new();
    private readonly Obstacles _obstacles;
    private readonly Sweep _sweep;
    private readonly Placement _placement;
    private readonly double _leastClimb;
    private readonly double _jumpSpeed;
    private readonly double _stepHeight;
    private double _jumpTime;
    private bool _isPlaced;
    private bool _isActive;

    internal Walker(PhysicsWorld world, Obstacles obstacles, Player player)
    {
        (_world, _obstacles, Description) = (world, obstacles, player);
        (_sweep, _placement) = (new(obstacles), new(obstacles, new()));
        Up = world.Gravity == Vector.Zero ? Vector.J : -world.Gravity.UnitVector();
        _leastClimb = Math.Cos(player.Slope * Math.PI / 180);
        (_jumpSpeed, _stepHeight) = (player.JumpSpeed(world.Gravity.Length()), player.StepHeight);
        var half = (0.5 * player.Height) - player.Radius;
        var count = (int)Math.Ceiling(2 * half / (SphereDistance * player.Radius));
        _spheres = [.. Enumerable.Range(0, count + 1).Select(i => (count == 0 ? 0 : (2.0 * i / count) - 1) * half * Up)];
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
                Forget();
                WakeTouching(Position);
            }
        }
    }

    /// <summary>Where to walk: a direction, and as its length the part of the full speed, at most 1. What leads up or down is left out.</summary>
    public Vector Wish { get; set; }

    /// <summary>The spheres of the capsule beside its position.</summary>
    internal ReadOnlySpan<Vector> Spheres => _spheres;

    /// <summary>Jumps, now or as soon as there is ground to jump from within a tenth of a second.</summary>
    public void Jump() => _jumpTime = 0.1;

    /// <summary>Moves the player elsewhere, at rest.</summary>
    /// <param name="position">Of the capsule's middle, finite. Out of what it overlaps there it is pushed at the next step.</param>
    /// <exception cref="ArgumentException">The position is not finite.</exception>
    public void MoveTo(Vector position)
    {
        if (!position.IsFinite())
        {
            throw new ArgumentException("expected finite coordinates", nameof(position));
        }

        (Position, PreviousPosition, Velocity, IsGrounded, _isPlaced, _jumpTime) = (position, position, Vector.Zero, false, false, 0);
        _clearance.Forget();
    }

    /// <summary>Back to where the scene has it.</summary>
    internal void Reset() => MoveTo(Description.Position);

    /// <summary>What is known of the surfaces is not true any more.</summary>
    internal void Forget()
    {
        _clearance.Forget();
        _isPlaced = false;
    }

    /// <summary>Moves on.</summary>
    /// <param name="time">Seconds.</param>
    internal void Step(double time)
    {
        var speed = Math.Max(Description.WalkingSpeed, Velocity.Length());
        _world.Begin(_spheres, Description.Radius, _clearance, (2 * time * speed) + _stepHeight);
        _sweep.Begin();
        PreviousPosition = Position;
        if (!_isPlaced)
        {
            var place = Position;
            _isPlaced = _placement.TryFree(ref place, -1);
            Position = place;
            if (!_isPlaced)
            {
                Velocity = Vector.Zero;
                return;
            }
        }

        var wish = Wish - (Vector.Dot(Wish, Up) * Up);
        wish *= Description.WalkingSpeed / Math.Max(1, wish.Length());
        var start = Position;
        var jumps = IsGrounded && _jumpTime > 0;
        _jumpTime = jumps ? 0 : _jumpTime - time;
        if (IsGrounded && !jumps)
        {
            Walk(wish, time);
        }
        else
        {
            Fly(wish + ((jumps ? _jumpSpeed : Vector.Dot(Velocity, Up)) * Up), time);
        }

        if ((Position - start).MaximumComponent() <= Still * Description.Radius)
        {
            Position = start;
        }
        else
        {
            WakeTouching(PreviousPosition);
        }
    }

    private void WakeTouching(Vector position)
    {
        foreach (var sphere in _spheres)
        {
            _world.WakeAt(position + sphere, Description.Radius);
        }
    }

    /// <summary>Along the ground: up steps and slopes, and down again without losing it.</summary>
    private void Walk(Vector wish, double time)
    {
        var left = time;
        _planes.Clear();
        var velocity = wish;
        for (var hits = 0; hits < MostHits && left > 0 && velocity != Vector.Zero; hits++)
        {
            var isHit = Go(velocity, ref left, out var contact);
            if (!isHit)
            {
                break;
            }

            var normal = contact.Normal(Position);
            var isGround = IsGround(in contact, normal);
            if (isGround)
            {
                _planes.Add(normal, 0);
            }
            else if (contact.Body < 0 && TryStep(left * wish))
            {
                break;
            }
            else
            {
                // However it leans, it is a wall: nobody climbs it by walking against it.
                AddWall(normal);
                Push(in contact, normal, velocity);
            }

            velocity = Allowed(wish);
            if (isGround && velocity != Vector.Zero)
            {
                // Up a slope as fast as on the level.
                velocity *= wish.Length() / velocity.Length();
            }
        }

        var moved = (Position - PreviousPosition) / time;
        // The ground may fall away as steeply as may be walked, or by a step.
        var drop = _stepHeight + (time * wish.Length() * Math.Sqrt(1 - (_leastClimb * _leastClimb)) / Math.Max(_leastClimb, 0.01));
        IsGrounded = TryLand(drop);
        // Who walks over an edge falls, and does not fly on upwards.
        Velocity = moved - (Math.Max(0, Vector.Dot(moved, Up)) * Up);
    }

    /// <summary>Through the air, with all control: who holds a direction jumps there.</summary>
    private void Fly(Vector velocity, double time)
    {
        var (left, gravity) = (time, _world.Gravity);
        IsGrounded = false;
        _planes.Clear();
        for (var hits = 0; hits < MostHits && left > 0; hits++)
        {
            var steady = Allowed(gravity);
            if (velocity == Vector.Zero && steady == Vector.Zero)
            {
                break;
            }

            var motion = new Motion(Position, velocity, steady);
            _obstacles.Collect(in motion, left, -1);
            var isHit = _sweep.TryHit(in motion, left, out var contact, out var elapsed);
            (Position, velocity, left) = (motion.At(elapsed), motion.VelocityAt(elapsed), left - elapsed);
            if (!isHit)
            {
                break;
            }

            var normal = contact.Normal(Position);
            _planes.Add(normal, 0);
            Push(in contact, normal, velocity);
            if (IsGround(in contact, normal))
            {
                IsGrounded = true;
            }
            else
            {
                // Slides down it, but is not carried up by pushing against it.
                AddWall(normal);
            }

            velocity = Allowed(velocity);
        }

        // Between two steep walls one stands as well.
        IsGrounded |= _planes.Count > 0 && gravity != Vector.Zero && Allowed(gravity).LengthSquared() <= 1e-12 * gravity.LengthSquared();
        Velocity = velocity;
    }

    /// <summary>Lifts the player onto what is in the way, if it is low enough and can be stood on.</summary>
    private bool TryStep(Vector way)
    {
        var (start, length) = (Position, way.Length());
        if (length == 0 || _stepHeight <= 0)
        {
            return false;
        }

        var left = 1.0;
        Go(_stepHeight * Up, ref left, out _);
        var raised = Position;
        // As far on as a foot: on the edge itself nothing tells whether there is something to stand on.
        left = 1;
        var isBlocked = Go(Math.Max(1, Description.Radius / length) * way, ref left, out _);
        var isHigher = !isBlocked && TryLand(_stepHeight) && Vector.Dot(Position - start, Up) > Still * Description.Radius;
        Position = raised;
        left = 1;
        if (!isHigher || Go(way, ref left, out _))
        {
            Position = start;
            return false;
        }

        // On the edge for a while, which is steep; the ground behind it has been found.
        left = 1;
        Go(-Vector.Dot(Position - start, Up) * Up, ref left, out _);
        return true;
    }

    /// <summary>Goes straight down to the ground; nowhere if there is none.</summary>
    private bool TryLand(double drop)
    {
        var (start, left) = (Position, 1.0);
        if (Go(-drop * Up, ref left, out var contact) && IsGround(in contact, contact.Normal(Position)))
        {
            return true;
        }

        Position = start;
        return false;
    }

    /// <summary>Goes straight on until something is in the way.</summary>
    private bool Go(Vector velocity, ref double left, out Contact contact)
    {
        var motion = new Motion(Position, velocity, Vector.Zero);
        _obstacles.Collect(in motion, left, -1);
        var isHit = _sweep.TryHit(in motion, left, out contact, out var elapsed);
        (Position, left) = (motion.At(elapsed), left - elapsed);
        return isHit;
    }

    /// <summary>True for what can be stood on: level enough, or the edge of something that is.</summary>
    private bool IsGround(in Contact contact, Vector normal)
    {
        if (Vector.Dot(normal, Up) >= _leastClimb)
        {
            return true;
        }

        var outwards = normal - (Vector.Dot(normal, Up) * Up);
        if (contact.IsFlat || contact.Body >= 0 || !(Vector.Dot(normal, Up) > 0))
        {
            return false;
        }

        // Just above what lies behind the edge.
        var beside = EdgeWidth * Description.Radius;
        var place = contact.Point + (beside * (Up - outwards.DirectionOrZero()));
        return _obstacles.TryFindFace(place, 1.01 * beside, out var closest)
            && Math.Abs(Vector.Dot(closest.Normal, Up)) >= _leastClimb && Vector.Dot(place - closest.Point, Up) > 0;
    }

    private Vector Allowed(Vector vector) => _planes.TryNearest(vector, out var allowed) ? allowed : Vector.Zero;

    /// <summary>Lets nothing move against a wall, however it leans.</summary>
    private void AddWall(Vector normal)
    {
        var wall = (normal - (Vector.Dot(normal, Up) * Up)).DirectionOrZero();
        _planes.Add(wall == Vector.Zero ? normal : wall, 0);
    }

    /// <summary>Pushes a body that is in the way.</summary>
    private void Push(in Contact contact, Vector normal, Vector velocity)
    {
        if (contact.Body < 0)
        {
            return;
        }

        var body = _world.Bodies[contact.Body];
        var approach = Vector.Dot(velocity - body.Velocity, normal);
        if (approach < 0)
        {
            _world.SetVelocity(body, body.Velocity + (approach * normal));
        }
    }
}
