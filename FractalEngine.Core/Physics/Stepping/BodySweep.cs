using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>
/// Moves a body until one of its balls touches something. Each ball goes straight to where the turn of the body leads it, by the sweep of a
/// single one. So the centres of all balls go from pose to pose without coming near a surface, and nothing is passed through.
/// </summary>
internal sealed class BodySweep(Obstacles obstacles)
{
    /// <summary>Times that a way is shortened until it ends where something is touched.</summary>
    public const int MaxPlans = 12;

    // Relative to the smallest radius: how far a ball may be from where it was swept when it touches something, or in what it touched.
    private const double MaxBulge = 1e-7;

    // Relative to the touch tolerance: overlaps up to this are taken back as rounding.
    private const double MaxRoundingOverlap = 10;

    private readonly SphereSweep _sweep = new(obstacles);

    /// <summary>Restores the number of advances that may be spent, for another body or time step.</summary>
    public void ResetStepBudget() => _sweep.ResetStepBudget();

    /// <summary>Follows a path that begins where nothing is overlapped, at the time of the obstacles.</summary>
    /// <param name="body">The body at the beginning of the path. Obstacles must be set up for it.</param>
    /// <param name="motion">Path of its centre of mass.</param>
    /// <param name="turn">Rotation vector by which it turns meanwhile, radians.</param>
    /// <param name="duration">Seconds, positive for a compound.</param>
    /// <param name="hit">The first obstacle that was touched.</param>
    /// <param name="ball">Index of the ball that has touched it.</param>
    /// <param name="elapsed">Seconds of the path that were followed; fewer than all at an impact or after too many advances.</param>
    /// <returns>True when something was touched.</returns>
    /// <remarks>Only at the end of the path is a compound's ball where it was swept, see <see cref="IsOnWay"/>.</remarks>
    public bool TryFindImpact(
        Body body, in SphereMotion motion, Vector turn, double duration, out Contact hit, out int ball, out double elapsed)
    {
        ball = 0;
        if (!body.IsCompound)
        {
            return _sweep.TryFindImpact(in motion, duration, out hit, out elapsed);
        }

        hit = default;
        elapsed = duration;
        var isHit = false;
        var startTime = obstacles.Time;
        var turned = Orientation.Identity.TurnedBy(turn);
        for (var i = 0; i < body.Balls.Length; i++)
        {
            var offset = body.Balls[i].Offset;
            // What the solve leaves of contacts that the ball keeps is no impact.
            var slack = body.Balls[i].IsTouching ? MaxBulge * body.MinBallRadius : 0;
            obstacles.Time = startTime;
            obstacles.SelectBall(body.Balls[i].Radius - slack, body.Balls[i].SafeDistance);
            var path = new SphereMotion(
                motion.Start + offset, motion.Velocity + ((turned.Rotate(offset) - offset) / duration), motion.Acceleration);
            if (_sweep.TryFindImpact(in path, elapsed, out var met, out elapsed))
            {
                isHit = true;
                hit = met with { CombinedRadius = met.CombinedRadius + slack };
                ball = i;
            }
        }

        obstacles.Time = startTime + elapsed;
        return isHit;
    }

    /// <summary>Moves a body out of an obstacle that one of its balls overlaps by no more than rounding.</summary>
    public void RemoveRoundingOverlap(Body body, int ball, in Contact contact)
    {
        var centre = body.BallCentre(ball);
        var gap = contact.Gap(centre);
        if (gap < 0 && -gap <= MaxRoundingOverlap * obstacles.TouchTolerance(centre))
        {
            body.Position -= gap * contact.Normal(centre);
        }
    }

    /// <summary>True where all balls are as good as where they were swept, after a share of a turn.</summary>
    /// <param name="body">The body.</param>
    /// <param name="turn">Rotation vector of the whole turn, radians.</param>
    /// <param name="share">From 0 to 1.</param>
    /// <param name="bend">Acceleration of a centre of mass that was swept straight, times the squared duration; scene units.</param>
    public static bool IsOnWay(Body body, Vector turn, double share, double bend = 0) =>
        // The height of a circle over its chord is that of a parabola.
        0.5 * ((body.MaxArm * turn.LengthSquared()) + bend) * share * (1 - share) <= MaxBulge * body.MinBallRadius;
}
