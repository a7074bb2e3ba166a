using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>
/// Moves spheres along a path until they touch something, by conservative advancement: as far as the free distance allows, then again (Mirtich and
/// Canny 1995). A step goes a little beyond it, but never so far that a centre could reach a surface: so nothing is passed, however fast.
/// </summary>
internal sealed class Sweep(Obstacles obstacles)
{
    // Of the radius. What is grazed by less than a 1/128 of the radius (the sagitta of a step, 0.25²/8) may be passed; nothing is passed through.
    private const double Overreach = 0.25;

    // Of the radius: how near to touching the moment of an impact is found.
    private const double Precision = 1e-10;

    // Sine of the angle to a surface below which a path leads along it.
    private const double Grazing = 1e-12;

    private const int MostSteps = 100_000;
    private int _stepsLeft = MostSteps;
    private const int MostRefinements = 60;

    /// <summary>Begins with another mover or time step: what may be spent on it is limited.</summary>
    public void Begin() => _stepsLeft = MostSteps;

    /// <summary>Goes along a path that begins where nothing is overlapped.</summary>
    /// <param name="motion">The path.</param>
    /// <param name="time">How long.</param>
    /// <param name="hit">What was touched.</param>
    /// <param name="elapsed">How long it went; less than the time where something was touched, or where it took too many steps.</param>
    /// <returns>True when something was touched.</returns>
    public bool TryHit(in Motion motion, double time, out Contact hit, out double elapsed)
    {
        (hit, elapsed) = (default, 0);
        var radius = obstacles.Radius;
        for (; _stepsLeft > 0 && elapsed < time; _stepsLeft--)
        {
            var rest = new Motion(motion.At(elapsed), motion.VelocityAt(elapsed), motion.Acceleration);
            var left = time - elapsed;
            var length = rest.LengthWithin(left);
            var free = obstacles.FreeDistance(rest.Start, length);
            if (length <= free)
            {
                elapsed = time;
                return false;
            }

            var duration = Math.Min(left, rest.TimeFor(Math.Max(free, 0) + (Overreach * radius)));
            var isLast = duration >= left;
            var target = isLast ? motion.At(time) : rest.At(duration);
            if (obstacles.TryFind(target, length, out var near) && near.Gap(target) < -obstacles.Touch(target))
            {
                elapsed += ImpactTime(in rest, duration, near, out hit);
                return true;
            }

            elapsed = isLast ? time : elapsed + duration;
        }

        return false;
    }

    /// <summary>Finds the moment of an impact.</summary>
    /// <param name="motion">Overlaps nothing at its start.</param>
    /// <param name="late">A time when it overlaps.</param>
    /// <param name="near">What it overlaps then.</param>
    /// <param name="hit">Receives what is touched first.</param>
    private double ImpactTime(in Motion motion, double late, Contact near, out Contact hit)
    {
        (hit, var early) = (near, 0.0);
        for (var i = 0; i < MostRefinements && early < late; i++)
        {
            // The time at which what is overlapped last would be touched; now and then the middle, which always comes nearer.
            var time = i % 4 == 3 ? 0.5 * (early + late) : TouchTime(in motion, in hit, early, late);
            var place = motion.At(time);
            var precision = (Precision * obstacles.Radius) + (1e-15 * place.MaximumComponent());
            var gap = obstacles.TryFind(place, Overreach * obstacles.Radius, out var found) ? found.Gap(place) : double.PositiveInfinity;
            if (Math.Abs(gap) <= precision)
            {
                if (IsApproaching(in motion, time, in found))
                {
                    hit = found;
                    return time;
                }

                // Something is touched all along, which may hide what is run into.
                if (Math.Abs(hit.Gap(place)) <= precision && IsApproaching(in motion, time, in hit))
                {
                    hit = Nearer(place, in hit, in motion, late);
                    return time;
                }

                gap = 0;
            }

            if (gap < 0)
            {
                (late, hit) = (time, found);
            }
            else
            {
                early = time;
            }
        }

        hit = Nearer(motion.At(early), in hit, in motion, late);
        return early;
    }

    /// <summary>What was overlapped at a later time, with the point that is nearest now.</summary>
    private Contact Nearer(Vector place, in Contact contact, in Motion motion, double late) =>
        contact.Body < 0 && obstacles.TryFollow(place, contact with { Direction = contact.Normal(motion.At(late)) }, out var followed) ? followed : contact;

    private static bool IsApproaching(in Motion motion, double time, in Contact contact)
    {
        var velocity = motion.VelocityAt(time);
        return Vector.Dot(velocity, contact.Normal(motion.At(time))) < -Grazing * velocity.MaximumComponent();
    }

    /// <summary>When the distance from one contact would be its reach, between a time before and one after.</summary>
    private static double TouchTime(in Motion motion, in Contact contact, double early, double late)
    {
        var normal = contact.Normal(motion.At(late));
        var isFlat = contact.IsFlat;
        var gapEarly = Gap(in motion, in contact, early);
        if (isFlat && gapEarly <= 0)
        {
            // Before, the centre was beside the face, beyond its plane: then it is an edge that is met.
            isFlat = false;
            gapEarly = Gap(in motion, in contact, early);
        }

        var gapLate = Gap(in motion, in contact, late);
        var tiny = 0.1 * Precision * contact.Reach;
        if (gapEarly <= tiny && !IsApproaching(in motion, early, in contact))
        {
            // It leaves what it touches, and comes back later.
            var time = 0.5 * (early + late);
            for (var i = 0; i < MostRefinements && gapEarly <= tiny && time > early; i++, time = 0.5 * (early + time))
            {
                gapEarly = Gap(in motion, in contact, time);
                if (gapEarly > tiny)
                {
                    early = time;
                    break;
                }
            }
        }

        if (gapEarly <= tiny)
        {
            return early;
        }

        double Gap(in Motion path, in Contact to, double time)
        {
            var separation = to.Separation(path.At(time));
            return (isFlat ? Vector.Dot(separation, normal) : separation.Length()) - to.Reach;
        }

        // False position with halved weights (Illinois): keeps both sides, and gains about half as many digits again in each round.
        var side = 0;
        for (var i = 0; i < 40 && late - early > 1e-16 * late; i++)
        {
            var guess = ((early * gapLate) - (late * gapEarly)) / (gapLate - gapEarly);
            if (!(guess > early && guess < late))
            {
                break;
            }

            var gap = Gap(in motion, in contact, guess);
            if (Math.Abs(gap) <= tiny)
            {
                return guess;
            }

            if (gap > 0)
            {
                (early, gapEarly) = (guess, gap);
                gapLate = side == 1 ? 0.5 * gapLate : gapLate;
                side = 1;
            }
            else
            {
                (late, gapLate) = (guess, gap);
                gapEarly = side == -1 ? 0.5 * gapEarly : gapEarly;
                side = -1;
            }
        }

        return early;
    }
}
