using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Bodies;

/// <content>The balls that a body consists of: one, or those of a compound.</content>
public sealed partial class Body
{
    // Relative to the squared speeds: what rounding adds.
    private const double EnergyRounding = 1e-12;

    /// <summary>Number of balls that the body consists of: 1, or those of <see cref="BodyDescription.Shape"/>.</summary>
    public int BallCount => Balls.Length;

    /// <summary>True for a body with a shape of balls, which has an orientation that matters.</summary>
    internal bool IsCompound => Description.Shape is not null;

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
        if (Description.Shape is not { } shape)
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
            Balls[i].Offset = Scale * (rotation * shape.Balls[i].Offset);
            Balls[i].Radius = Scale * shape.Balls[i].Radius;
            MaxArm = Math.Max(MaxArm, Balls[i].Offset.Length());
            MinBallRadius = Math.Min(MinBallRadius, Balls[i].Radius);
        }

        InertiaTensor = Description.Mass * Scale * Scale * (rotation * shape.Inertia * rotation.Transpose());
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
}
