using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Movement;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>
/// Moves a compound along its path until one of its balls touches something, by conservative advancement: no point of it is faster than
/// |v| + |ω|·ρ. As with one ball, no centre gets so far that it could reach a surface, so nothing is passed through.
/// </summary>
internal sealed class CompoundSweep(Obstacles obstacles)
{
    // Relative to a ball's radius, as for one ball.
    private const double MaxOverstep = 0.25;

    // Relative to a ball's radius: how close to touching the moment of an impact is found.
    private const double ImpactTolerance = 1e-10;

    private const int MaxSteps = 100_000;
    private const int MaxRefinements = 60;

    private int _stepsLeft = MaxSteps;

    // Time of the obstacles at which the present path begins, and how fast they are at most.
    private double _startTime;
    private double _obstacleSpeed;

    /// <summary>Restores the number of advances that may be spent, for another body or time step.</summary>
    public void ResetStepBudget() => _stepsLeft = MaxSteps;

    /// <summary>Follows a path that begins where nothing is overlapped.</summary>
    /// <param name="body">The compound, at the beginning of the path. Obstacles must be set up for it.</param>
    /// <param name="path">The path.</param>
    /// <param name="duration">Seconds.</param>
    /// <param name="allowance">How deep a ball may dip into something at the middle of the path, see the remarks.</param>
    /// <param name="hit">The first obstacle that was touched.</param>
    /// <param name="ball">The ball that has touched it.</param>
    /// <param name="elapsed">Seconds of the path that were followed; fewer than all at an impact or after too many advances.</param>
    /// <returns>True when something was touched.</returns>
    /// <remarks>
    /// A ball that stays on a plane at both ends of a turn dips into it in between, by no more than the sagitta of the turn. It is allowed
    /// as much of that as a parabola has at the time, and nothing at both ends.
    /// </remarks>
    public bool TryFindImpact(
        Body body, in RigidPath path, double duration, double allowance, out Contact hit, out int ball, out double elapsed)
    {
        hit = default;
        ball = 0;
        elapsed = 0;
        _startTime = obstacles.Time;
        obstacles.SelectBall(body.Radius, body.SafeDistance);
        _obstacleSpeed = obstacles.MaxKinematicSpeed(path.Motion, duration);
        for (; _stepsLeft > 0 && elapsed < duration; _stepsLeft--)
        {
            var advance = FindFreeTime(body, in path, elapsed, duration - elapsed);
            if (double.IsPositiveInfinity(advance))
            {
                elapsed = duration;
                obstacles.Time = _startTime + elapsed;
                return false;
            }

            var target = advance >= duration - elapsed ? duration : elapsed + advance;
            if (FindDeepest(body, in path, target, duration, allowance, out var overlapped, out var overlappedBall) < 0)
            {
                hit = overlapped;
                ball = overlappedBall;
                elapsed = FindTimeOfImpact(body, in path, elapsed, target, duration, allowance, ref hit, ref ball);
                obstacles.Time = _startTime + elapsed;
                return true;
            }

            elapsed = target;
        }

        return false;
    }

    /// <summary>Centre of a ball at a time of the path.</summary>
    public static Vector CentreAt(Body body, int ball, in RigidPath path, double time) =>
        path.Motion.PositionAt(time) + path.TurnAt(time).Rotate(body.Balls[ball].Offset);

    /// <summary>Finds how long all balls are sure to be free, or to overlap little; infinite where that is to the end.</summary>
    private double FindFreeTime(Body body, in RigidPath path, double time, double timeLeft)
    {
        var isFree = true;
        var minTime = timeLeft;
        obstacles.Time = _startTime + time;
        for (var i = 0; i < body.Balls.Length; i++)
        {
            var ball = body.Balls[i];
            obstacles.SelectBall(ball.Radius, ball.SafeDistance);
            var arm = ball.Offset.Length();
            var maxTravel = path.MaxTravelDistance(time, arm, timeLeft) + (_obstacleSpeed * timeLeft);
            var freeDistance = obstacles.FreeDistance(CentreAt(body, i, in path, time), maxTravel, maxTravel);
            if (maxTravel > freeDistance)
            {
                isFree = false;
                minTime = Math.Min(
                    minTime, path.MinTimeToTravel(time, arm, _obstacleSpeed, Math.Max(freeDistance, 0) + (MaxOverstep * ball.Radius)));
            }
        }

        return isFree ? double.PositiveInfinity : minTime;
    }

    /// <summary>Finds the ball that overlaps most at a time, or is closest to something.</summary>
    /// <returns>Its gap over what is allowed, in units of its radius; infinite where nothing is near.</returns>
    private double FindDeepest(
        Body body, in RigidPath path, double time, double duration, double allowance, out Contact contact, out int ball)
    {
        contact = default;
        ball = 0;
        obstacles.Time = _startTime + time;
        var minGap = double.PositiveInfinity;
        var allowed = 4 * allowance * (time / duration) * (1 - (time / duration));
        for (var i = 0; i < body.Balls.Length; i++)
        {
            var radius = body.Balls[i].Radius;
            obstacles.SelectBall(radius, body.Balls[i].SafeDistance);
            var centre = CentreAt(body, i, in path, time);
            if (obstacles.TryFindClosestContact(centre, MaxOverstep * radius, out var found))
            {
                var gap = (found.Gap(centre) + Math.Min(allowed, 0.5 * MaxOverstep * radius) + obstacles.TouchTolerance(centre)) / radius;
                if (gap < minGap)
                {
                    minGap = gap;
                    contact = found;
                    ball = i;
                }
            }
        }

        return minGap;
    }

    /// <summary>Finds the last moment before an overlap, by false position with halved weights and bisection.</summary>
    private double FindTimeOfImpact(
        Body body, in RigidPath path, double lowerTime, double upperTime, double duration, double allowance, ref Contact hit, ref int ball)
    {
        var gap = FindDeepest(body, in path, lowerTime, duration, allowance, out _, out _);
        var lowerWeight = Math.Min(1, gap);
        var upperWeight = Math.Max(-1, FindDeepest(body, in path, upperTime, duration, allowance, out _, out _));
        for (var i = 0; i < MaxRefinements && gap > ImpactTolerance && upperTime - lowerTime > 1e-15 * upperTime; i++)
        {
            var middle = 0.5 * (lowerTime + upperTime);
            var time = i % 3 == 2 ? middle : ((lowerTime * upperWeight) - (upperTime * lowerWeight)) / (upperWeight - lowerWeight);
            time = time > lowerTime && time < upperTime ? time : middle;
            var gapThen = FindDeepest(body, in path, time, duration, allowance, out var found, out var foundBall);
            if (gapThen < 0)
            {
                upperTime = time;
                upperWeight = Math.Max(-1, gapThen);
                lowerWeight *= 0.5;
                hit = found;
                ball = foundBall;
            }
            else
            {
                gap = gapThen;
                lowerTime = time;
                lowerWeight = Math.Min(1, gap);
                upperWeight *= 0.5;
            }
        }

        return lowerTime;
    }
}
