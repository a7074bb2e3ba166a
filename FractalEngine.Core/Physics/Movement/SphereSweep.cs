using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Movement;

/// <summary>
/// Moves spheres along a path until they touch something, by conservative advancement: as far as the free distance allows, then again
/// (Mirtich and Canny 1995). An advance goes a little beyond that distance, but never so far that a centre could reach a surface. So
/// nothing is passed through, however fast the spheres move.
/// </summary>
internal sealed class SphereSweep(Obstacles obstacles)
{
    // Relative to the radius. An obstacle grazed by less than 1/128 of it (the sagitta of an advance, 0.25²/8) may be missed.
    private const double MaxOverstep = 0.25;

    // Relative to the way that is left: where so much of it is known to be free, a query at its end tells more than one at its beginning.
    private const double SufficientPart = 0.5;

    // Relative to the radius: how close to touching the moment of an impact is found.
    private const double ImpactTolerance = 1e-10;

    // Relative to the largest coordinate: about four roundings of a double.
    private const double RoundingFraction = 1e-15;

    // Sine of the angle to a surface below which a path leads along it.
    private const double GrazingSine = 1e-12;

    private const int MaxSteps = 100_000;

    // After so many advances of a path by the sum of the speeds of mover and obstacles, what moves is looked at as the mover sees it.
    private const int MaxSummedAdvances = 1_000;

    private const int MaxRefinements = 60;
    private const int MaxFalsePositions = 40;

    private int _stepsLeft = MaxSteps;

    // Time of the obstacles at which the present path begins.
    private double _startTime;

    /// <summary>Restores the number of advances that may be spent, for another mover or time step.</summary>
    public void ResetStepBudget() => _stepsLeft = MaxSteps;

    /// <summary>
    /// Follows a path that begins where nothing is overlapped, at the time of the obstacles. It leaves them at the end of what it followed.
    /// </summary>
    /// <param name="motion">The path.</param>
    /// <param name="maxTime">Duration of the path, seconds.</param>
    /// <param name="hit">The first obstacle that was touched.</param>
    /// <param name="elapsed">Seconds of the path that were followed; fewer than all at an impact or after too many advances.</param>
    /// <returns>True when something was touched.</returns>
    public bool TryFindImpact(in SphereMotion motion, double maxTime, out Contact hit, out double elapsed)
    {
        hit = default;
        elapsed = 0;
        var radius = obstacles.Radius;
        _startTime = obstacles.Time;
        var obstacleSpeed = obstacles.MaxKinematicSpeed(in motion, maxTime);
        for (var advance = 0; _stepsLeft > 0 && elapsed < maxTime; advance++, _stepsLeft--)
        {
            var remaining = new SphereMotion(motion.PositionAt(elapsed), motion.VelocityAt(elapsed), motion.Acceleration);
            var timeLeft = maxTime - elapsed;
            var isBeside = obstacleSpeed > 0 && advance >= MaxSummedAdvances;
            var ownSpeed = isBeside ? 0 : obstacleSpeed;
            var maxTravel = remaining.MaxTravelDistance(timeLeft) + (ownSpeed * timeLeft);
            obstacles.Time = _startTime + elapsed;
            var freeDistance = obstacles.FreeDistance(
                remaining.Start, maxTravel, Math.Max(0, (SufficientPart * maxTravel) - (MaxOverstep * radius)), !isBeside);
            var isFree = maxTravel <= freeDistance;
            var duration = isFree ? timeLeft : Math.Min(
                timeLeft, remaining.MinTimeToTravel(Math.Max(freeDistance, 0) + (MaxOverstep * radius), ownSpeed));
            if (isBeside)
            {
                // What the mover goes along with comes no nearer: so that the mover stands, and obstacles move as it sees them.
                var standing = remaining with { Velocity = Vector.Zero };
                var speed = obstacles.MaxKinematicSpeed(in remaining, timeLeft, isRelative: true);
                var approach = standing.MaxTravelDistance(timeLeft) + (speed * timeLeft);
                var gap = obstacles.KinematicDistance(remaining.Start, approach);
                isFree &= approach <= gap;
                duration = Math.Min(duration, standing.MinTimeToTravel(Math.Max(gap, 0) + (MaxOverstep * radius), speed));
                maxTravel = Math.Max(maxTravel, approach);
            }

            if (isFree)
            {
                elapsed = maxTime;
                obstacles.Time = _startTime + elapsed;
                return false;
            }

            var isLast = duration >= timeLeft;
            var target = isLast ? motion.PositionAt(maxTime) : remaining.PositionAt(duration);
            obstacles.Time = _startTime + elapsed + duration;
            if (obstacles.TryFindClosestContact(target, maxTravel, out var overlapped)
                && overlapped.Gap(target) < -obstacles.TouchTolerance(target))
            {
                _startTime += elapsed;
                elapsed += FindTimeOfImpact(in remaining, duration, overlapped, out hit);
                return true;
            }

            elapsed = isLast ? maxTime : elapsed + duration;
        }

        return false;
    }

    /// <summary>Finds the time of impact by false position, each guess checked by a query.</summary>
    /// <param name="motion">Overlaps nothing at its start.</param>
    /// <param name="upperTime">A time at which it overlaps something.</param>
    /// <param name="overlapped">What it overlaps then.</param>
    /// <param name="hit">Receives what is touched first.</param>
    /// <returns>Seconds from the start of the path.</returns>
    private double FindTimeOfImpact(in SphereMotion motion, double upperTime, Contact overlapped, out Contact hit)
    {
        hit = overlapped;
        var lowerTime = 0.0;
        for (var i = 0; i < MaxRefinements && lowerTime < upperTime; i++)
        {
            // When the obstacle overlapped last would be touched; every fourth time the middle, which always shortens the interval.
            var time = i % 4 == 3 ? 0.5 * (lowerTime + upperTime) : FindTouchTime(in motion, in hit, lowerTime, upperTime);
            var position = PositionAt(in motion, time);
            var tolerance = (ImpactTolerance * obstacles.Radius) + (RoundingFraction * position.MaxAbsComponent());
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

                // Something touched all along may hide the obstacle that is run into.
                if (Math.Abs(hit.Gap(position)) <= tolerance && IsApproaching(in motion, time, in hit))
                {
                    hit = RefreshContact(position, in hit, in motion, upperTime);
                    return time;
                }

                gap = 0;
            }

            if (gap < 0)
            {
                upperTime = time;
                hit = found;
            }
            else
            {
                lowerTime = time;
            }
        }

        hit = RefreshContact(PositionAt(in motion, lowerTime), in hit, in motion, upperTime);
        return lowerTime;
    }

    /// <summary>Updates a surface contact of a later time to its closest point at a position.</summary>
    private Contact RefreshContact(Vector position, in Contact contact, in SphereMotion motion, double overlapTime)
    {
        if (contact.IsBody)
        {
            return contact;
        }

        var time = obstacles.Time;
        var later = contact with { CachedNormal = contact.Normal(PositionAt(in motion, overlapTime)) };
        obstacles.Time = time;
        return obstacles.TryUpdateContact(position, in later, out var updated) ? updated : contact;
    }

    /// <summary>Position at a time, to which the obstacles are set as well.</summary>
    private Vector PositionAt(in SphereMotion motion, double time)
    {
        obstacles.Time = _startTime + time;
        return motion.PositionAt(time);
    }

    private bool IsApproaching(in SphereMotion motion, double time, in Contact contact)
    {
        var position = PositionAt(in motion, time);
        var velocity = motion.VelocityAt(time) - contact.SurfaceVelocity(position);
        return Vector.Dot(velocity, contact.Normal(position)) < -GrazingSine * velocity.MaxAbsComponent();
    }

    /// <summary>Finds when one obstacle alone would be touched, between a time before and a time of overlap.</summary>
    private double FindTouchTime(in SphereMotion motion, in Contact contact, double lowerTime, double upperTime)
    {
        var normal = contact.Normal(PositionAt(in motion, upperTime));
        normal = contact.Kinematic?.RotateBack(normal) ?? normal;
        var isFlat = contact.IsFlat;
        var gapAtLower = Gap(in motion, in contact, normal, isFlat, lowerTime);
        if (isFlat && gapAtLower <= 0)
        {
            // Before, the centre was beside the face, beyond its plane: then an edge is met.
            isFlat = false;
            gapAtLower = Gap(in motion, in contact, normal, isFlat, lowerTime);
        }

        var gapAtUpper = Gap(in motion, in contact, normal, isFlat, upperTime);
        var tolerance = 0.1 * ImpactTolerance * contact.CombinedRadius;
        if (gapAtLower <= tolerance && !IsApproaching(in motion, lowerTime, in contact))
        {
            // It leaves what it touches, and returns later: begin at a time in between when it is free.
            var time = 0.5 * (lowerTime + upperTime);
            for (var i = 0; i < MaxRefinements && gapAtLower <= tolerance && time > lowerTime; i++, time = 0.5 * (lowerTime + time))
            {
                gapAtLower = Gap(in motion, in contact, normal, isFlat, time);
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

        // False position with halved weights (Illinois): keeps both sides, and gains about half as many digits again in each round.
        var side = 0;
        for (var i = 0; i < MaxFalsePositions && upperTime - lowerTime > 1e-16 * upperTime; i++)
        {
            var guess = ((lowerTime * gapAtUpper) - (upperTime * gapAtLower)) / (gapAtUpper - gapAtLower);
            if (!(guess > lowerTime && guess < upperTime))
            {
                break;
            }

            var gap = Gap(in motion, in contact, normal, isFlat, guess);
            if (Math.Abs(gap) <= tolerance)
            {
                return guess;
            }

            if (gap > 0)
            {
                lowerTime = guess;
                gapAtLower = gap;
                gapAtUpper = side == 1 ? 0.5 * gapAtUpper : gapAtUpper;
                side = 1;
            }
            else
            {
                upperTime = guess;
                gapAtUpper = gap;
                gapAtLower = side == -1 ? 0.5 * gapAtLower : gapAtLower;
                side = -1;
            }
        }

        return lowerTime;
    }

    /// <summary>Free distance from an obstacle at a time; for a flat one the distance from its plane, which may be negative.</summary>
    private double Gap(in SphereMotion motion, in Contact contact, Vector normal, bool isFlat, double time)
    {
        var pointToCentre = contact.PointToCentre(PositionAt(in motion, time));
        normal = contact.Kinematic?.Rotate(normal) ?? normal;
        return (isFlat ? Vector.Dot(pointToCentre, normal) : pointToCentre.Length()) - contact.CombinedRadius;
    }
}
