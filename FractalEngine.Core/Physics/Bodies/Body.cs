using System.Globalization;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>
/// What falls, bounces and rests: the bounding sphere of a physics object (paper §4.3.3, §4.4.1), a sphere of its own, or several that are
/// rigidly joined. Owned by a <c>PhysicsWorld</c>.
/// </summary>
public sealed class Body
{
    // Relative to the squared speeds: what rounding adds.
    private const double EnergyRounding = 1e-12;

    /// <summary>Stands for the index of an island where the body is in none.</summary>
    internal const int NoIsland = -1;

    private double _scale;

    /// <summary>Creates a body in its initial state.</summary>
    /// <param name="description">Already validated.</param>
    /// <param name="index">Index among the bodies of the world.</param>
    internal Body(BodyDescription description, int index)
    {
        Description = description;
        Index = index;
        var ballCount = description.Mesh is null ? description.Shape?.Balls.Length ?? 1 : 0;
        Balls = [.. Enumerable.Range(0, ballCount).Select(static _ => new BodyBall())];
        Reset();
    }

    /// <summary>The description that the body was made from.</summary>
    public BodyDescription Description { get; }

    /// <summary>Index among the bodies of its world, from 0.</summary>
    public int Index { get; }

    /// <summary>Current position of the centre of mass in world space, scene units.</summary>
    public Vector Position { get; internal set; }

    /// <summary>Position of the centre before the last step, for interpolation between steps.</summary>
    public Vector PreviousPosition { get; internal set; }

    /// <summary>Current velocity in units per second, see <c>PhysicsWorld.SetVelocity</c>.</summary>
    public Vector Velocity { get; internal set; }

    /// <summary>Current angular velocity in radians per second, about the world's axes.</summary>
    /// <remarks>In the left-handed world, a ball that turns about +z by a positive angle turns x towards y.</remarks>
    public Vector AngularVelocity { get; internal set; }

    /// <summary>How the body has turned since the beginning.</summary>
    public Orientation Orientation { get; internal set; } = Orientation.Identity;

    /// <summary>Orientation before the last step, for interpolation between steps.</summary>
    public Orientation PreviousOrientation { get; internal set; } = Orientation.Identity;

    /// <summary>
    /// Constant force besides gravity, in kilograms times units per second², see <c>PhysicsWorld.SetForce</c>.
    /// </summary>
    public Vector Force { get; internal set; }

    /// <summary>Current radius of the sphere, or of that about the centre of mass which holds all of them; scene units.</summary>
    public double Radius { get; private set; }

    /// <summary>Current size relative to the initial one: 1, or less for a body that shrinks (paper §5.5).</summary>
    public double Scale
    {
        get => _scale;
        internal set
        {
            _scale = value;
            Radius = value * Description.Radius;
            UpdateBalls();
        }
    }

    /// <summary>
    /// Fraction of its initial size that the body loses per second: its own, or <c>PhysicsWorld.ShrinkageOverride</c>.
    /// </summary>
    public double Shrinkage { get; internal set; }

    /// <summary>Relative size before the last step, for interpolation between steps.</summary>
    public double PreviousScale { get; internal set; }

    /// <summary>True for a body at rest that costs nothing until something touches it.</summary>
    public bool IsAsleep { get; internal set; }

    /// <summary>True for a body that overlaps something and cannot be pushed out. It stays where it is.</summary>
    public bool IsStuck { get; internal set; }

    /// <summary>Number of triangles that the last step tested for this body.</summary>
    public long FaceTests { get; internal set; }

    /// <summary>Number of bounding volumes that the last step tested for this body.</summary>
    public long BoundTests { get; internal set; }

    /// <summary>Name for messages and tables: the description's, or the index after a number sign.</summary>
    public string Name => Description.Name ?? string.Create(CultureInfo.InvariantCulture, $"#{Index}");

    /// <summary>Map that draws the body's object between its last two states, moved, turned and shrunk.</summary>
    /// <param name="alpha">Fraction of the last step that has passed, from 0 to 1: steps and frames have different rates.</param>
    public AffineMap InterpolatedMap(double alpha)
    {
        var scale = PreviousScale + (alpha * (Scale - PreviousScale));
        var linear = scale * Description.LinearPart;
        var origin = scale * Description.ObjectOffset;
        if (Orientation != Orientation.Identity || PreviousOrientation != Orientation.Identity)
        {
            var rotation = Orientation.Interpolate(PreviousOrientation, Orientation, alpha).ToMatrix();
            linear = rotation * linear;
            origin = rotation * origin;
        }

        var translation = PreviousPosition + (alpha * (Position - PreviousPosition));
        return new(linear, Description.ObjectOffset == Vector.Zero ? translation : translation + origin);
    }

    /// <summary>Throws for a vector with a coordinate that is NaN or infinite; the message names the body.</summary>
    /// <param name="vector">What must be finite.</param>
    /// <param name="parameterName">Name of the caller's parameter.</param>
    /// <exception cref="ArgumentException">A coordinate is not finite.</exception>
    internal void RequireFinite(Vector vector, string parameterName)
    {
        if (!vector.IsFinite())
        {
            throw new ArgumentException($"body {Name}: expected a finite {parameterName}", parameterName);
        }
    }

    /// <summary>Returns the body to its initial state.</summary>
    internal void Reset()
    {
        Position = Description.Position;
        PreviousPosition = Description.Position;
        Velocity = Description.Velocity;
        AngularVelocity = Description.IsRotationLocked ? Vector.Zero : Description.AngularVelocity;
        Orientation = Orientation.Identity;
        PreviousOrientation = Orientation.Identity;
        Force = Vector.Zero;
        StepForce = Vector.Zero;
        StepTorque = Vector.Zero;
        Scale = 1;
        PreviousScale = 1;
        IsAsleep = false;
        IsIdle = false;
        IsStuck = false;
        FaceTests = 0;
        BoundTests = 0;
        SleepTimer = 0;
        IsOverlapResolved = false;
        MayTouchBodies = true;
        HasHeapMargin = false;
        DiscardSurfaces();
    }

    /// <summary>Takes over the movement of a body with the same description, and discards everything that is known of surfaces.</summary>
    internal void ContinueFrom(Body other)
    {
        Position = other.Position;
        PreviousPosition = other.PreviousPosition;
        Velocity = other.Velocity;
        AngularVelocity = other.AngularVelocity;
        Orientation = other.Orientation;
        PreviousOrientation = other.PreviousOrientation;
        Force = other.Force;
        Scale = other.Scale;
        PreviousScale = other.PreviousScale;
        IsOverlapResolved = false;
        MayTouchBodies = true;
    }

    /// <summary>Saves the state before a step, and sets the costs to 0.</summary>
    internal void BeginStep()
    {
        PreviousPosition = Position;
        PreviousOrientation = Orientation;
        PreviousScale = Scale;
        FaceTests = 0;
        BoundTests = 0;
    }

    /// <summary>Begins one of the parts that a step is made in.</summary>
    internal void BeginPart()
    {
        IsPrepared = false;
        HasMoved = false;
        IslandIndex = NoIsland;
        BeganDeep = false;
        IsMovedAhead = false;
        IsFinished = false;
        foreach (var ball in Balls)
        {
            ball.NearSurfaces.Clear();
        }

        AreNearSurfacesKnown = false;
        KinematicPush = 0;
        SpinBefore = AngularVelocity;
    }

    /// <summary>Turns a ball by its mean angular velocity of the step. Compounds turn as they move.</summary>
    /// <param name="stepLength">Seconds.</param>
    internal void Turn(double stepLength)
    {
        if (!IsCompound && (AngularVelocity != Vector.Zero || SpinBefore != Vector.Zero))
        {
            Orientation = Orientation.TurnedBy(0.5 * stepLength * (SpinBefore + AngularVelocity));
        }
    }

    /// <summary>Discards everything that is known of surfaces and contacts, and wakes the body.</summary>
    /// <param name="mayOverlap">True where an obstacle may have come to overlap the body.</param>
    internal void InvalidateSurroundings(bool mayOverlap)
    {
        Wake();
        DiscardSurfaces();
        IsOverlapResolved &= !mayOverlap;
    }

    /// <summary>Ends the body's sleep and restarts its sleep timer.</summary>
    internal void Wake()
    {
        IsAsleep = false;
        IsIdle = false;
        SleepTimer = 0;
        MayTouchBodies = true;
    }

    /// <summary>Lets the body lose a part of its size, if it shrinks.</summary>
    /// <param name="seconds">How long.</param>
    internal void Shrink(double seconds)
    {
        if (IsShrinking)
        {
            Scale = Math.Max(Description.MinScale, Scale - (Shrinkage * seconds));
        }
    }

    /// <summary>Puts the body to sleep at rest.</summary>
    internal void Sleep()
    {
        IsAsleep = true;
        SleepCount++;
        Velocity = Vector.Zero;
        AngularVelocity = Vector.Zero;
    }

    /// <summary>
    /// Number of balls that the body consists of: 1, those of <see cref="BodyDescription.Shape"/>, or none where a mesh collides.
    /// </summary>
    public int BallCount => Balls.Length;

    /// <summary>True for a body with a shape of its own, whose orientation matters.</summary>
    internal bool IsCompound => Inertia is not null;

    /// <summary>Inertia tensor of one kilogram of a shape at its first size; null for a ball.</summary>
    internal Matrix? Inertia => Description.Shape?.Inertia ?? Description.Mesh?.Inertia;

    /// <summary>The balls that are rigidly joined: those of a compound, or one at the body's position.</summary>
    internal BodyBall[] Balls { get; }

    /// <summary>Surfaces and bodies that the first ball touches.</summary>
    internal ContactSet Contacts => Balls[0].Contacts;

    /// <summary>Known lower bound on the distance of the first ball's centre to all surfaces.</summary>
    internal SafeDistance SafeDistance => Balls[0].SafeDistance;

    /// <summary>Faces that the first ball touches or may meet in this step, and no contact knows of.</summary>
    internal NearSurfaceList NearSurfaces => Balls[0].NearSurfaces;

    /// <summary>Inertia tensor of a compound about the world's axes, kg·unit².</summary>
    internal Matrix InertiaTensor { get; private set; }

    /// <summary>Inverse of the inertia tensor of a compound; zero where it does not turn.</summary>
    internal Matrix InverseInertiaTensor { get; private set; }

    /// <summary>1/(kilogram · unit²); 0 for a body that does not turn. Of a compound, at least that about any axis.</summary>
    internal double InverseInertia { get; private set; }

    /// <summary>Angular velocity of a compound at the end of the planned time, if nothing touched it.</summary>
    internal Vector FreeSpin { get; set; }

    /// <summary>
    /// Angular velocity whose mean with that at the end, times the planned time, is the turn of a compound. It differs from the one at the
    /// beginning where the body tumbles.
    /// </summary>
    internal Vector SpinBase { get; set; }

    /// <summary>Rotation vector of the planned turn of a compound, radians.</summary>
    internal Vector PlannedTurn { get; set; }

    /// <summary>Orientation of a compound at the beginning of the planned path.</summary>
    internal Orientation PlannedStartOrientation { get; set; } = Orientation.Identity;

    /// <summary>Largest distance of a ball's centre from the centre of mass, scene units; 0 for one ball.</summary>
    internal double MaxArm { get; private set; }

    /// <summary>Radius of the smallest ball, scene units.</summary>
    internal double MinBallRadius { get; private set; }

    /// <summary>Centre of one of the balls in world space, scene units.</summary>
    /// <param name="ball">Index from 0 to <see cref="BallCount"/> − 1.</param>
    public Vector BallCentre(int ball) => Position + Balls[ball].Offset;

    /// <summary>Radius of one of the balls, scene units.</summary>
    /// <param name="ball">Index from 0 to <see cref="BallCount"/> − 1.</param>
    public double BallRadius(int ball) => Balls[ball].Radius;

    /// <summary>Centre of a ball relative to the body's position.</summary>
    internal Vector BallOffset(int ball) => Balls[ball].Offset;

    /// <summary>True where the body touches a surface, or another body that it has met by itself.</summary>
    internal bool IsTouching => Array.Exists(Balls, static ball => ball.IsTouching);

    /// <summary>True where a surface is touched that moves. A compound rests on faces that no contact knows of.</summary>
    internal bool HasMovingSurface => Array.Exists(Balls, IsCompound
        ? static ball => ball.Contacts.HasMovingSurface || ball.NearSurfaces.HasMovingSurface
        : static ball => ball.Contacts.HasMovingSurface);

    /// <summary>Velocity of the centre of a ball.</summary>
    /// <param name="offset">Its centre relative to the body's position.</param>
    internal Vector VelocityAt(Vector offset) => IsCompound ? Velocity + Vector.Cross(AngularVelocity, offset) : Velocity;

    /// <summary>Change of the angular velocity by an angular impulse.</summary>
    internal Vector SpinChange(Vector angularImpulse) =>
        IsCompound ? InverseInertiaTensor * angularImpulse : InverseInertia * angularImpulse;

    /// <summary>Gives the body an impulse at a point.</summary>
    /// <param name="arm">The point relative to the centre of mass.</param>
    /// <param name="impulse">Kilograms times units per second.</param>
    internal void ApplyImpulse(Vector arm, Vector impulse)
    {
        Velocity += impulse / Description.Mass;
        AngularVelocity += SpinChange(Vector.Cross(arm, impulse));
    }

    /// <summary>Plans to lose the velocity that leads into what holds the body, unless it bounces there in the next step.</summary>
    /// <param name="ball">Index of the ball that is held.</param>
    /// <param name="hit">What holds it.</param>
    internal void PlanStop(int ball, in Contact hit)
    {
        var normal = hit.Normal(BallCentre(ball));
        var arm = BallOffset(ball);
        var approach = Vector.Dot(hit.SurfaceVelocity(BallCentre(ball)) - VelocityAt(arm), normal);
        if (approach > 0 && (Description.Restitution == 0 || approach <= RestitutionThreshold))
        {
            var turn = SpinChange(Vector.Cross(arm, normal));
            var impulse = approach / ((1 / Description.Mass) + Vector.Dot(Vector.Cross(arm, normal), turn));
            PlannedChange += impulse / Description.Mass * normal;
            PlannedSpinChange += impulse * turn;
        }
    }

    /// <summary>Takes back what contacts have added to the energy of motion and rotation: what is immovable does no work.</summary>
    /// <param name="limit">Joules.</param>
    internal void LimitEnergy(double limit)
    {
        var energy = KineticEnergy;
        if (energy > 0 && energy > limit + (EnergyRounding * (energy + Math.Abs(limit))))
        {
            var scale = Math.Sqrt(Math.Max(0, limit) / energy);
            Velocity *= scale;
            AngularVelocity *= scale;
        }
    }

    /// <summary>Sets the orientation, and puts the balls where it has them.</summary>
    internal void SetOrientation(Orientation orientation)
    {
        if (orientation != Orientation)
        {
            Orientation = orientation;
            UpdateBalls();
        }
    }

    /// <summary>Puts the balls where the orientation and scale of the body have them, and its inertia as well.</summary>
    private void UpdateBalls()
    {
        if (Inertia is not { } inertia)
        {
            Balls[0].Radius = Radius;
            InverseInertia = Description.IsRotationLocked ? 0 : 1 / (Description.InertiaFactor * Description.Mass * Radius * Radius);
            return;
        }

        var rotation = Orientation.ToMatrix();
        MaxArm = 0;
        MinBallRadius = double.PositiveInfinity;
        for (var i = 0; i < Balls.Length; i++)
        {
            Balls[i].Offset = Scale * (rotation * Description.Shape!.Balls[i].Offset);
            Balls[i].Radius = Scale * Description.Shape.Balls[i].Radius;
            MaxArm = Math.Max(MaxArm, Balls[i].Offset.Length());
            MinBallRadius = Math.Min(MinBallRadius, Balls[i].Radius);
        }

        InertiaTensor = Description.Mass * Scale * Scale * (rotation * inertia * rotation.Transpose());
        InverseInertiaTensor = Description.IsRotationLocked ? 0 * Matrix.Identity : InertiaTensor.Inverse();
        // The trace is at least the largest eigenvalue.
        InverseInertia = InverseInertiaTensor.V1.X + InverseInertiaTensor.V2.Y + InverseInertiaTensor.V3.Z;
    }

    /// <summary>Discards everything that is known of surfaces and contacts.</summary>
    internal void DiscardSurfaces()
    {
        foreach (var ball in Balls)
        {
            ball.InvalidateSurroundings();
        }
    }

    /// <summary>Time in seconds for which the body has barely moved.</summary>
    internal double SleepTimer { get; set; }

    /// <summary>True once the body has been checked for an initial overlap, and is free of it.</summary>
    internal bool IsOverlapResolved { get; set; }

    /// <summary>True for a body that has slept through the beginning of a step: the next ones change nothing of it.</summary>
    internal bool IsIdle { get; set; }

    /// <summary>How often the body has fallen asleep.</summary>
    internal int SleepCount { get; private set; }

    /// <summary>Energy of motion and rotation, joules.</summary>
    internal double KineticEnergy => (0.5 * Description.Mass * Velocity.LengthSquared()) + SpinEnergy;

    /// <summary>Energy of rotation, joules.</summary>
    internal double SpinEnergy => Description.IsRotationLocked ? 0
        : IsCompound ? 0.5 * Vector.Dot(AngularVelocity, InertiaTensor * AngularVelocity)
        : 0.5 * AngularVelocity.LengthSquared() / InverseInertia;

    /// <summary>Force in the next step besides the constant one.</summary>
    internal Vector StepForce { get; set; }

    /// <summary>Torque that callers exert during the next step only, about the centre of mass.</summary>
    internal Vector StepTorque { get; set; }

    /// <summary>Angular velocity before the step.</summary>
    internal Vector SpinBefore { get; set; }

    /// <summary>Acceleration by gravity and forces in this step, units per second².</summary>
    internal Vector FreeAcceleration { get; set; }

    /// <summary>Approach speed below which the body does not bounce in this step, units per second.</summary>
    internal double RestitutionThreshold { get; set; }

    /// <summary>Index of the island that the body belongs to in this step; negative where it touches no other body.</summary>
    internal int IslandIndex { get; set; } = NoIsland;

    /// <summary>How far a kinematic object pushes the body in this step at most; 0 for one that none pushes.</summary>
    internal double KinematicPush { get; set; }

    /// <summary>True once the step has begun for the body: it has shrunk, and its contacts with surfaces are up to date.</summary>
    internal bool IsPrepared { get; set; }

    /// <summary>True where the body may touch others: it has met one, was of an island, or has just come.</summary>
    internal bool MayTouchBodies { get; set; }

    /// <summary>True once a body of no island has made its step.</summary>
    internal bool HasMoved { get; set; }

    /// <summary>What gravity and all contacts add to the velocity in the step.</summary>
    internal Vector PlannedChange { get; set; }

    /// <summary>What all contacts add to the angular velocity in the step.</summary>
    internal Vector PlannedSpinChange { get; set; }

    /// <summary>Position at the beginning of the planned path.</summary>
    internal Vector PlannedStart { get; set; }

    /// <summary>True for a body that was of an island of balls last, see <see cref="ContactTolerances.HeapMargin"/>.</summary>
    internal bool HasHeapMargin { get; set; }

    /// <summary>Energy of motion and rotation at the beginning of the planned path, joules.</summary>
    internal double PlannedStartEnergy { get; set; }

    /// <summary>Where the planned path leads.</summary>
    internal Vector Target { get; set; }

    /// <summary>True where the body is deep in another one when its planned path begins: it must get out, past whatever is there.</summary>
    internal bool BeganDeep { get; set; }

    /// <summary>True where something stops the body on its planned path that no plan knew.</summary>
    internal bool IsHeld { get; set; }

    /// <summary>True once it has gone its planned way together with others, before what it met is looked at.</summary>
    internal bool IsMovedAhead { get; set; }

    /// <summary>True once it has ended its step together with others, and has still to tell those around it.</summary>
    internal bool IsFinished { get; set; }

    /// <summary>True once these faces have been searched for in this step.</summary>
    internal bool AreNearSurfacesKnown { get; set; }

    /// <summary>The bodies with the same number fell asleep together, and wake together.</summary>
    internal int RigidIsland { get; set; }

    /// <summary>True where a body of those that this one stands for has to stay awake.</summary>
    internal bool IsRigidIslandAwake { get; set; }

    /// <summary>True while the body shrinks and has not reached its minimum scale.</summary>
    internal bool IsShrinking => Shrinkage > 0 && Scale > Description.MinScale;
}
