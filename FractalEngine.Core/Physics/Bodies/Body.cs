using System.Globalization;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>
/// What falls, bounces and rests: the bounding sphere of a physics object (paper §4.3.3, §4.4.1), a sphere of its own, or several that are
/// rigidly joined. Owned by a <c>PhysicsWorld</c>.
/// </summary>
public sealed partial class Body
{
    private double _scale;

    /// <summary>Creates a body in its initial state.</summary>
    /// <param name="description">Already validated.</param>
    /// <param name="index">Index among the bodies of the world.</param>
    /// <param name="acceleration">Acceleration of free fall, until contacts take their part of it.</param>
    internal Body(BodyDescription description, int index, Vector acceleration)
    {
        Description = description;
        Index = index;
        Balls = [.. Enumerable.Range(0, description.Shape?.Balls.Length ?? 1).Select(static _ => new BodyBall())];
        Reset(acceleration);
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
    /// <param name="acceleration">Acceleration of free fall.</param>
    internal void Reset(Vector acceleration)
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
        NetAcceleration = acceleration;
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
    /// <param name="acceleration">Acceleration of free fall.</param>
    /// <param name="mayOverlap">True where an obstacle may have come to overlap the body.</param>
    internal void InvalidateSurroundings(Vector acceleration, bool mayOverlap)
    {
        Wake();
        NetAcceleration = acceleration;
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

    /// <summary>Puts the body to sleep at rest.</summary>
    internal void Sleep()
    {
        IsAsleep = true;
        SleepCount++;
        Velocity = Vector.Zero;
        AngularVelocity = Vector.Zero;
        NetAcceleration = Vector.Zero;
    }
}
