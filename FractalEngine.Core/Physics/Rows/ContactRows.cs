using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rows;

/// <summary>Makes contacts of balls with surfaces and with each other.</summary>
internal static class ContactRows
{
    // Balls of a compound for which contacts with one and the same body differ.
    private const int MaxBalls = CompoundShape.MaxBalls;

    /// <summary>Makes the contact of a ball with a surface.</summary>
    /// <param name="body">The body.</param>
    /// <param name="ball">Index of its ball.</param>
    /// <param name="contact">The surface.</param>
    public static ContactRow OfSurface(Body body, int ball, in Contact contact)
    {
        var row = new ContactRow
        {
            First = body.Index,
            Second = ContactRow.Immovable,
            Offset = contact.PointToCentre(body.BallCentre(ball)),
            MinDistance = body.BallRadius(ball),
            FirstRadius = body.BallRadius(ball),
            Friction = body.Description.Friction,
            Restitution = body.Description.Restitution,
            IsAhead = contact.Gap(body.BallCentre(ball)) > ContactTolerances.Slop(body.BallRadius(ball), body.BallCentre(ball)),
            RollingArm = body.Description.RollingFriction * body.BallRadius(ball),
            SpinningArm = body.Description.SpinningFriction * body.BallRadius(ball),
            FeatureId = ball,
        };
        row.Normal = row.Offset.UnitVectorOrZero();
        if (body.IsCompound)
        {
            row.SetArms(body.BallOffset(ball), Vector.Zero);
        }

        if (contact.Kinematic is { } kinematic)
        {
            row.SetSurface(contact.SurfaceVelocity(body.BallCentre(ball)), kinematic.AngularVelocity);
        }

        return row;
    }

    /// <summary>Makes the contact of a ball with a face that it touches or may meet.</summary>
    /// <param name="body">The body.</param>
    /// <param name="ball">Index of its ball.</param>
    /// <param name="face">The face, with its normal.</param>
    public static ContactRow OfNearSurface(Body body, int ball, in Contact face)
    {
        var centre = body.BallCentre(ball);
        var row = OfSurface(body, ball, in face) with { Normal = face.CachedNormal };
        row.IsAhead = Vector.Dot(row.Offset, row.Normal) - row.MinDistance > ContactTolerances.Slop(row.MinDistance, centre);
        return row;
    }

    /// <summary>Makes the contact of two balls.</summary>
    /// <param name="row">Receives the contact; must be empty.</param>
    /// <param name="body">A body that can move.</param>
    /// <param name="ball">Index of its ball.</param>
    /// <param name="other">The other body.</param>
    /// <param name="otherBall">Index of the other one's ball.</param>
    /// <param name="isImmovable">True where the other one does not give way.</param>
    /// <param name="isAhead">True where they do not touch yet.</param>
    public static void SetBalls(ref ContactRow row, Body body, int ball, Body other, int otherBall, bool isImmovable, bool isAhead)
    {
        row.First = body.Index;
        row.Second = isImmovable ? ContactRow.Immovable : other.Index;
        row.IsAhead = isAhead;
        SetBalls(ref row, body.BallCentre(ball) - other.BallCentre(otherBall), body.BallRadius(ball), other.BallRadius(otherBall));
        SetMaterials(ref row, new(body.Description), new(other.Description));
        if (body.IsCompound || other.IsCompound)
        {
            row.SetArms(body.BallOffset(ball), other.BallOffset(otherBall));
        }

        row.FeatureId = (MaxBalls * otherBall) + ball;
    }

    /// <summary>Sets the shape of a contact of two balls.</summary>
    public static void SetBalls(ref ContactRow row, Vector offset, double firstRadius, double secondRadius)
    {
        row.Offset = offset;
        row.Normal = offset == Vector.Zero ? AnyDirection(row.First, row.Second) : offset.UnitVector();
        row.MinDistance = firstRadius + secondRadius;
        row.FirstRadius = firstRadius;
        row.SecondRadius = secondRadius;
        row.IsBall = true;
    }

    /// <summary>Two balls at one place come apart in a direction of their own: many would be pushed into a tower otherwise.</summary>
    private static Vector AnyDirection(int first, int second)
    {
        // Multiples of irrational numbers spread evenly.
        var (sine, cosine) = double.SinCosPi(Math.Sqrt(5) * (first + (Math.Sqrt(2) * second)));
        var height = 2 * Math.IEEERemainder(Math.Sqrt(2) * (first + (Math.Sqrt(3) * second)), 1);
        var across = Math.Sqrt(1 - (height * height));
        return new(across * cosine, height, across * sine);
    }

    /// <summary>Sets what the materials of two balls make of their contact, whose radii must be known.</summary>
    public static void SetMaterials(ref ContactRow row, in BodyMaterial first, in BodyMaterial second)
    {
        var radius = Math.Min(row.FirstRadius, row.SecondRadius);
        row.Friction = Math.Min(first.Friction, second.Friction);
        row.Restitution = Math.Min(first.Restitution, second.Restitution);
        row.RollingArm = radius * Math.Min(first.RollingFriction, second.RollingFriction);
        row.SpinningArm = radius * Math.Min(first.SpinningFriction, second.SpinningFriction);
        row.TurnImpulse = Vector.Zero;
    }
}
