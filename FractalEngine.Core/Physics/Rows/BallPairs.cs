using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rows;

/// <summary>Compares two bodies ball by ball.</summary>
internal static class BallPairs
{
    /// <summary>Free distance between two balls; negative where they overlap.</summary>
    public static double Gap(Body body, int ball, Body other, int otherBall) =>
        (body.BallCentre(ball) - other.BallCentre(otherBall)).Length() - body.BallRadius(ball) - other.BallRadius(otherBall);

    /// <summary>True where two bodies touch.</summary>
    public static bool AreTouching(Body body, Body other) => HasContact(body, other, double.NegativeInfinity);

    /// <summary>True where two bodies that touch approach fast enough to bounce.</summary>
    public static bool AreHitting(Body body, Body other) => HasContact(body, other, body.RestitutionThreshold);

    /// <summary>True where two bodies overlap by more than a share of the smaller ball's radius.</summary>
    public static bool AreOverlapping(Body body, Body other, double share)
    {
        var touchDistance = body.Radius + other.Radius;
        if ((body.Position - other.Position).LengthSquared() > touchDistance * touchDistance)
        {
            return false;
        }

        for (var i = 0; i < body.BallCount; i++)
        {
            for (var j = 0; j < other.BallCount; j++)
            {
                var radius = body.BallRadius(i);
                var otherRadius = other.BallRadius(j);
                var minDistance = radius + otherRadius - (share * Math.Min(radius, otherRadius));
                if ((body.BallCentre(i) - other.BallCentre(j)).LengthSquared() < minDistance * minDistance)
                {
                    return true;
                }
            }
        }

        return false;
    }

    private static bool HasContact(Body body, Body other, double minApproach)
    {
        for (var i = 0; i < body.BallCount; i++)
        {
            for (var j = 0; j < other.BallCount; j++)
            {
                var radius = Math.Min(body.BallRadius(i), other.BallRadius(j));
                var slop = ContactTolerances.TouchDistance(
                    radius, ContactTolerances.Slop(0, body.Position), body.HasHeapMargin && other.HasHeapMargin);
                if (Gap(body, i, other, j) <= slop && Approach(body, i, other, j) > minApproach)
                {
                    return true;
                }
            }
        }

        return false;
    }

    /// <summary>Speed at which two balls approach.</summary>
    private static double Approach(Body body, int ball, Body other, int otherBall)
    {
        var normal = (body.BallCentre(ball) - other.BallCentre(otherBall)).UnitVectorOrZero();
        return -Vector.Dot(body.VelocityAt(body.BallOffset(ball)) - other.VelocityAt(other.BallOffset(otherBall)), normal);
    }
}
