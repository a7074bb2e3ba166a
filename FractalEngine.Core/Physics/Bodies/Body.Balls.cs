using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Bodies;

/// <content>The balls that a body consists of: one, or those of a compound.</content>
public sealed partial class Body
{
    /// <summary>Number of balls that the body consists of: 1, or those of <see cref="BodyDescription.Shape"/>.</summary>
    public int BallCount => IsCompound ? Balls.Length : 1;

    /// <summary>True for a body of several balls, which has an orientation that matters.</summary>
    internal bool IsCompound => Balls.Length > 0;

    /// <summary>The balls of a compound; none for a body that is one ball.</summary>
    internal BodyBall[] Balls { get; }

    /// <summary>Inertia tensor of a compound about the world's axes, kg·unit².</summary>
    internal Matrix InertiaTensor { get; private set; }

    /// <summary>Inverse of the inertia tensor of a compound; zero where it does not turn.</summary>
    internal Matrix InverseInertiaTensor { get; private set; }

    /// <summary>Upper bound on the inverse moments of inertia of a compound, 1/(kg·unit²).</summary>
    internal double MaxInverseInertia { get; private set; }

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

    /// <summary>Centre of one of the balls in world space, scene units.</summary>
    /// <param name="ball">Index from 0 to <see cref="BallCount"/> − 1.</param>
    public Vector BallCentre(int ball) => IsCompound ? Position + Balls[ball].Offset : Position;

    /// <summary>Radius of one of the balls, scene units.</summary>
    /// <param name="ball">Index from 0 to <see cref="BallCount"/> − 1.</param>
    public double BallRadius(int ball) => IsCompound ? Balls[ball].Radius : Radius;

    /// <summary>Centre of a ball relative to the body's position.</summary>
    internal Vector BallOffset(int ball) => IsCompound ? Balls[ball].Offset : Vector.Zero;

    /// <summary>True where the body touches a surface, or another body that it has met by itself.</summary>
    internal bool IsTouching
    {
        get
        {
            var isTouching = Contacts.Count > 0;
            foreach (var ball in Balls)
            {
                isTouching |= ball.IsOnSurface || ball.Contacts.Count > 0;
            }

            return isTouching;
        }
    }

    /// <summary>True where a surface is touched that moves.</summary>
    internal bool HasMovingSurface
    {
        get
        {
            var hasMoving = Contacts.HasMovingSurface;
            foreach (var ball in Balls)
            {
                hasMoving |= ball.Contacts.HasMovingSurface || ball.NearSurfaces.HasMovingSurface;
            }

            return hasMoving;
        }
    }

    /// <summary>Velocity of the centre of a ball.</summary>
    /// <param name="offset">Its centre relative to the body's position.</param>
    internal Vector VelocityAt(Vector offset) => IsCompound ? Velocity + Vector.Cross(AngularVelocity, offset) : Velocity;

    /// <summary>Inverse of the mass that an impulse along a direction moves at a point of a compound, 1/kg.</summary>
    /// <param name="arm">The point relative to the centre of mass.</param>
    /// <param name="direction">Unit vector.</param>
    internal double InverseMassAt(Vector arm, Vector direction)
    {
        var torque = Vector.Cross(arm, direction);
        return (1 / Description.Mass) + Vector.Dot(torque, InverseInertiaTensor * torque);
    }

    /// <summary>Gives a compound an impulse at a point.</summary>
    /// <param name="arm">The point relative to the centre of mass.</param>
    /// <param name="impulse">Kilograms times units per second.</param>
    internal void ApplyImpulse(Vector arm, Vector impulse)
    {
        Velocity += impulse / Description.Mass;
        AngularVelocity += InverseInertiaTensor * Vector.Cross(arm, impulse);
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
            var impulse = approach / InverseMassAt(arm, normal) * normal;
            PlannedChange += impulse / Description.Mass;
            PlannedSpinChange += InverseInertiaTensor * Vector.Cross(arm, impulse);
        }
    }

    /// <summary>Sets the orientation, and puts the balls of a compound where it has them.</summary>
    internal void SetOrientation(Orientation orientation)
    {
        Orientation = orientation;
        UpdateBalls();
    }

    /// <summary>Puts the balls of a compound where its orientation and scale have them.</summary>
    internal void UpdateBalls()
    {
        if (Description.Shape is not { } shape)
        {
            return;
        }

        var rotation = Orientation.ToMatrix();
        MaxArm = 0;
        for (var i = 0; i < Balls.Length; i++)
        {
            Balls[i].Offset = Scale * (rotation * shape.Balls[i].Offset);
            Balls[i].Radius = Scale * shape.Balls[i].Radius;
            MaxArm = Math.Max(MaxArm, Balls[i].Offset.Length());
        }

        InertiaTensor = Description.Mass * Scale * Scale * (rotation * shape.Inertia * rotation.Transpose());
        InverseInertiaTensor = Description.IsRotationLocked ? 0 * Matrix.Identity : InertiaTensor.Inverse();
        // The trace is at least the largest eigenvalue.
        MaxInverseInertia = InverseInertiaTensor.V1.X + InverseInertiaTensor.V2.Y + InverseInertiaTensor.V3.Z;
    }

    /// <summary>Discards everything that is known of surfaces and contacts.</summary>
    private void DiscardSurfaces()
    {
        Contacts.Clear();
        SafeDistance.Invalidate();
        foreach (var ball in Balls)
        {
            ball.InvalidateSurroundings();
        }
    }
}
