using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>How an object of a scene moves by itself, whatever is in its way: straight on, to and fro, turning, or all of it.</summary>
public sealed record ObjectMotion
{
    // Relative to the length of a path: how far the position of an object on it may lie beside it.
    private const double PathTolerance = 1e-6;

    /// <summary>Velocity in units a second. On a path its length is the speed, and its direction that of the beginning.</summary>
    public Vector Velocity { get; init; }

    /// <summary>
    /// Angular velocity in degrees a second about the world's axes, in the sense of a placement's angles. The object turns about its own
    /// position.
    /// </summary>
    public Vector Spin { get; init; }

    /// <summary>Where a path begins along which the object goes to and fro, world space; null for one that goes straight on.</summary>
    public Vector? From { get; init; }

    /// <summary>Where that path ends, world space; null together with <see cref="From"/>.</summary>
    public Vector? To { get; init; }

    /// <summary>Describes what makes the motion impossible for an object; null for a possible one.</summary>
    /// <param name="start">Position of the object at the beginning, world space.</param>
    public string? FindFault(Vector start)
    {
        if (!Velocity.IsFinite() || !Spin.IsFinite() || From?.IsFinite() == false || To?.IsFinite() == false)
        {
            return "the motion must be finite";
        }

        if (From is not { } from || To is not { } to)
        {
            return From.HasValue == To.HasValue ? null : "a path needs both its ends, 'from' and 'to'";
        }

        var length = (to - from).Length();
        var direction = length > 0 ? (to - from) / length : Vector.Zero;
        var along = Vector.Dot(start - from, direction);
        return !(length > 0) ? "the ends of the path must differ"
            : Vector.Cross(Velocity, direction).Length() > PathTolerance * Velocity.Length() ? "the velocity must lead along the path"
            : (start - from - (along * direction)).Length() > PathTolerance * length
                || along < -PathTolerance * length || along > (1 + PathTolerance) * length
                ? "the object's position must lie on the path, between its ends"
            : null;
    }

    /// <summary>The same motion of an object that has been put elsewhere: its path goes along.</summary>
    /// <param name="offset">How far, scene units.</param>
    public ObjectMotion MovedBy(Vector offset) => this with { From = From + offset, To = To + offset };

    /// <summary>Computes where the object is after a time.</summary>
    /// <param name="start">Position of the object at the beginning, world space.</param>
    /// <param name="time">Seconds, not negative.</param>
    public Vector PositionAt(Vector start, double time)
    {
        if (From is not { } from || To is not { } to)
        {
            return start + (time * Velocity);
        }

        var length = (to - from).Length();
        var direction = (to - from) / length;
        var first = Vector.Dot(start - from, direction);
        // Back and forth is once around a circle of twice the length.
        var around = (first + (time * Vector.Dot(Velocity, direction))) % (2 * length);
        around = around < 0 ? around + (2 * length) : around;
        return start + ((Math.Min(around, (2 * length) - around) - first) * direction);
    }
}
