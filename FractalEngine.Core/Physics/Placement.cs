using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>Moves what overlaps something to the nearest place where it does not, if there is one that can be reached.</summary>
internal sealed class Placement(Obstacles obstacles, HalfSpaces planes)
{
    private const int MostPushes = 32;
    private const int MostSteps = 64;

    // Of the radius: how far before a surface a centre is put that was on it or behind it.
    private const double Before = 1e-6;

    // Of the radius: a centre so near to a surface is taken to be on it.
    private const double On = 1e-9;

    /// <summary>Finds a free place. All surfaces that are met on the way must be kept from at once, not only the last one.</summary>
    /// <param name="position">Receives the place; unchanged where there is none.</param>
    /// <param name="except">The mover's own number, −1 for none.</param>
    /// <returns>False where the mover is closed in.</returns>
    public bool TryFree(ref Vector position, int except)
    {
        var (first, touch) = (position, obstacles.Touch(position));
        var place = Outside(position);
        var start = place;
        planes.Clear();
        for (var push = 0; push < MostPushes; push++)
        {
            obstacles.Collect(new(place, Vector.Zero, Vector.Zero), 0, except);
            if (!obstacles.TryFind(place, 0, out var near) || near.Gap(place) >= -touch)
            {
                position = place;
                return true;
            }

            // Of two centres at one place none is to any side of the other.
            var normal = near.Separation(place).Length() > On * obstacles.Radius ? near.Normal(place) : Vector.J;
            planes.Add(normal, Vector.Dot(normal, near.Point - near.Offset) + near.Reach + (0.5 * touch));
            if (!planes.TryNearest(start, out var next) || !IsReachable(place, next))
            {
                break;
            }

            place = next;
        }

        position = first;
        return false;
    }

    /// <summary>The place itself; or, where it is on a surface or within a solid, one just before the surface.</summary>
    private Vector Outside(Vector position)
    {
        if (obstacles.TryFindSide(position, out var closest, out var isBehind)
            && (closest.Distance <= On * obstacles.Radius || isBehind))
        {
            return closest.Point + (Before * obstacles.Radius * closest.Normal);
        }

        return position;
    }

    /// <summary>True when a centre can go there without meeting a surface on the way.</summary>
    private bool IsReachable(Vector from, Vector to)
    {
        var (way, gone) = (to - from, 0.0);
        var length = way.Length();
        for (var step = 0; step < MostSteps && gone < length; step++)
        {
            var place = from + (gone / length * way);
            var distance = obstacles.SurfaceDistance(place, obstacles.Radius);
            if (distance < On * obstacles.Radius)
            {
                return false;
            }

            gone += 0.9 * distance;
        }

        return gone >= length;
    }
}
