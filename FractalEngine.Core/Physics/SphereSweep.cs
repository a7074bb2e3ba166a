using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>
/// Moves spheres along a path until they touch something, by conservative advancement: as far as the free distance allows, then again
/// (Mirtich and Canny 1995). A step goes a little beyond it, but never so far that a centre could reach a surface: so nothing is passed,
/// however fast.
/// </summary>
internal sealed class SphereSweep(Obstacles obstacles)
{
    // Of the radius. What is grazed by less than a 1/128 of the radius (the sagitta of a step, 0.25²/8) may be passed; nothing is passed
    // through.
    private const double MaxOverstep = 0.25;

    // Of the radius: how near to touching the moment of an impact is found.
    private const double ImpactTolerance = 1e-10;

    // Sine of the angle to a surface below which a path leads along it.
    private const double GrazingSine = 1e-12;

    private const int MaxSteps = 100_000;
    private int _stepsLeft = MaxSteps;
    private const int MaxRefinements = 60;

    /// <summary>Begins with another mover or time step: what may be spent on it is limited.</summary>
    public void ResetStepBudget() => _stepsLeft = MaxSteps;

    /// <summary>Goes along a path that begins where nothing is overlapped.</summary>
    /// <param name="motion">The path.</param>
    /// <param name="maxTime">How long.</param>
    /// <param name="hit">What was touched.</param>
    /// <param name="elapsed">How long it went; less than the time where something was touched, or where it took too many steps.</param>
    /// <returns>True when something was touched.</returns>
    public bool TryFindImpact(in Motion motion, double maxTime, out Contact hit, out double elapsed)
    {
        (hit, elapsed) = (default, 0);
        var radius = obstacles.Radius;
        for (; _stepsLeft > 0 && elapsed < maxTime; _stepsLeft--)
        {
            var remaining = new Motion(motion.PositionAt(elapsed), motion.VelocityAt(elapsed), motion.Acceleration);
            var timeLeft = maxTime - elapsed;
            var maxTravel = remaining.MaxTravelDistance(timeLeft);
            var freeDistance = obstacles.FreeDistance(remaining.Start, maxTravel);
            if (maxTravel <= freeDistance)
            {
                elapsed = maxTime;
                return false;
            }

            var duration = Math.Min(timeLeft, remaining.MinTimeToTravel(Math.Max(freeDistance, 0) + (MaxOverstep * radius)));
            var isLast = duration >= timeLeft;
            var target = isLast ? motion.PositionAt(maxTime) : remaining.PositionAt(duration);
            if (obstacles.TryFindClosestContact(target, maxTravel, out var overlapped)
                && overlapped.Gap(target) < -obstacles.TouchTolerance(target))
            {
                elapsed += FindImpactTime(in remaining, duration, overlapped, out hit);
                return true;
            }

            elapsed = isLast ? maxTime : elapsed + duration;
        }

        return false;
    }

    /// <summary>Finds the moment of an impact.</summary>
    /// <param name="motion">Overlaps nothing at its start.</param>
    /// <param name="upperTime">A time when it overlaps.</param>
    /// <param name="overlapped">What it overlaps then.</param>
    /// <param name="hit">Receives what is touched first.</param>
    private double FindImpactTime(in Motion motion, double upperTime, Contact overlapped, out Contact hit)
    {
        (hit, var lowerTime) = (overlapped, 0.0);
        for (var i = 0; i < MaxRefinements && lowerTime < upperTime; i++)
        {
            // The time at which what is overlapped last would be touched; now and then the middle, which always comes nearer.
            var time = i % 4 == 3 ? 0.5 * (lowerTime + upperTime) : FindTouchTime(in motion, in hit, lowerTime, upperTime);
            var position = motion.PositionAt(time);
            var tolerance = (ImpactTolerance * obstacles.Radius) + (1e-15 * position.MaxAbsComponent());
            var gap = obstacles.TryFindClosestContact(position, MaxOverstep * obstacles.Radius, out var found)
                ? found.Gap(position)
                : double.PositiveInfinity;
            if (Math.Abs(gap) <= tolerance)
            {
                if (IsApproaching(in motion, time, in found))
                {
                    hit = found;
                    return time;
                }

                // Something is touched all along, which may hide what is run into.
                if (Math.Abs(hit.Gap(position)) <= tolerance && IsApproaching(in motion, time, in hit))
                {
                    hit = RefreshContact(position, in hit, in motion, upperTime);
                    return time;
                }

                gap = 0;
            }

            if (gap < 0)
            {
                (upperTime, hit) = (time, found);
            }
            else
            {
                lowerTime = time;
            }
        }

        hit = RefreshContact(motion.PositionAt(lowerTime), in hit, in motion, upperTime);
        return lowerTime;
    }

    /// <summary>What was overlapped at a later time, with the point that is nearest now.</summary>
    private Contact RefreshContact(Vector position, in Contact contact, in Motion motion, double overlapTime) =>
        contact.BodyIndex < 0
        && obstacles.TryUpdateContact(position, contact with { CachedNormal = contact.Normal(motion.PositionAt(overlapTime)) },
        out var updated) ? updated : contact;

    private static bool IsApproaching(in Motion motion, double time, in Contact contact)
    {
        var velocity = motion.VelocityAt(time);
        return Vector.Dot(velocity, contact.Normal(motion.PositionAt(time))) < -GrazingSine * velocity.MaxAbsComponent();
    }

    /// <summary>When the distance from one contact would be its reach, between a time before and one after.</summary>
    private static double FindTouchTime(in Motion motion, in Contact contact, double lowerTime, double upperTime)
    {
        var normal = contact.Normal(motion.PositionAt(upperTime));
        var isFlat = contact.IsFlat;
        var gapAtLower = Gap(in motion, in contact, lowerTime);
        if (isFlat && gapAtLower <= 0)
        {
            // Before, the centre was beside the face, beyond its plane: then it is an edge that is met.
            isFlat = false;
            gapAtLower = Gap(in motion, in contact, lowerTime);
        }

        var gapAtUpper = Gap(in motion, in contact, upperTime);
        var tolerance = 0.1 * ImpactTolerance * contact.CombinedRadius;
        if (gapAtLower <= tolerance && !IsApproaching(in motion, lowerTime, in contact))
        {
            // It leaves what it touches, and comes back later.
            var time = 0.5 * (lowerTime + upperTime);
            for (var i = 0; i < MaxRefinements && gapAtLower <= tolerance && time > lowerTime; i++, time = 0.5 * (lowerTime + time))
            {
                gapAtLower = Gap(in motion, in contact, time);
                if (gapAtLower > tolerance)
                {
                    lowerTime = time;
                    break;
                }
            }
        }

        if (gapAtLower <= tolerance)
        {
            return lowerTime;
        }

        double Gap(in Motion path, in Contact to, double time)
        {
            var separation = to.PointToCentre(path.PositionAt(time));
            return (isFlat ? Vector.Dot(separation, normal) : separation.Length()) - to.CombinedRadius;
        }

        // False position with halved weights (Illinois): keeps both sides, and gains about half as many digits again in each round.
        var side = 0;
        for (var i = 0; i < 40 && upperTime - lowerTime > 1e-16 * upperTime; i++)
        {
            var guess = ((lowerTime * gapAtUpper) - (upperTime * gapAtLower)) / (gapAtUpper - gapAtLower);
            if (!(guess > lowerTime && guess < upperTime))
            {
                break;
            }

            var gap = Gap(in motion, in contact, guess);
            if (Math.Abs(gap) <= tolerance)
            {
                return guess;
            }

            if (gap > 0)
            {
                (lowerTime, gapAtLower) = (guess, gap);
                gapAtUpper = side == 1 ? 0.5 * gapAtUpper : gapAtUpper;
                side = 1;
            }
            else
            {
                (upperTime, gapAtUpper) = (guess, gap);
                gapAtLower = side == -1 ? 0.5 * gapAtLower : gapAtLower;
                side = -1;
            }
        }

        return lowerTime;
    }
}
