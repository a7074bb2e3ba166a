using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>Moves what overlaps something to the nearest place where it does not, if there is one that can be reached.</summary>
internal sealed class OverlapResolver(Obstacles obstacles, HalfSpaces planes)
{
    private const int MaxPushes = 32;
    private const int MaxSteps = 64;

    // Of the radius: how far before a surface a centre is put that was on it or behind it.
    private const double SurfaceOffset = 1e-6;

    // Of the radius: a centre so near to a surface is taken to be on it.
    private const double OnSurfaceTolerance = 1e-9;

    /// <summary>Finds a free place. All surfaces that are met on the way must be kept from at once, not only the last one.</summary>
    /// <param name="position">Receives the place; unchanged where there is none.</param>
    /// <param name="excludedIndex">The mover's own number, −1 for none.</param>
    /// <returns>False where the mover is closed in.</returns>
    public bool TryResolve(ref Vector position, int excludedIndex)
    {
        var (original, touchTolerance) = (position, obstacles.TouchTolerance(position));
        var current = MoveOutOfSurface(position);
        var start = current;
        planes.Clear();
        for (var push = 0; push < MaxPushes; push++)
        {
            obstacles.CollectNearbyBodies(new(current, Vector.Zero, Vector.Zero), 0, excludedIndex);
            if (!obstacles.TryFindClosestContact(current, 0, out var overlap) || overlap.Gap(current) >= -touchTolerance)
            {
                position = current;
                return true;
            }

            // Of two centres at one place none is to any side of the other.
            var normal = overlap.PointToCentre(current).Length() > OnSurfaceTolerance * obstacles.Radius
                ? overlap.Normal(current)
                : Vector.J;
            planes.Add(normal, Vector.Dot(normal, overlap.Point - overlap.SphereOffset) + overlap.CombinedRadius + (0.5 * touchTolerance));
            if (!planes.TryProject(start, out var next) || !IsReachable(current, next))
            {
                break;
            }

            current = next;
        }

        position = original;
        return false;
    }

    /// <summary>The place itself; or, where it is on a surface or within a solid, one just before the surface.</summary>
    private Vector MoveOutOfSurface(Vector position)
    {
        if (obstacles.TryFindSurfaceSide(position, out var closest, out var isBehind)
            && (closest.Distance <= OnSurfaceTolerance * obstacles.Radius || isBehind))
        {
            return closest.Point + (SurfaceOffset * obstacles.Radius * closest.Normal);
        }

        return position;
    }

    /// <summary>True when a centre can go there without meeting a surface on the way.</summary>
    private bool IsReachable(Vector from, Vector to)
    {
        var (path, travelled) = (to - from, 0.0);
        var length = path.Length();
        for (var step = 0; step < MaxSteps && travelled < length; step++)
        {
            var position = from + (travelled / length * path);
            var distance = obstacles.SurfaceDistance(position, obstacles.Radius);
            if (distance < OnSurfaceTolerance * obstacles.Radius)
            {
                return false;
            }

            travelled += 0.9 * distance;
        }

        return travelled >= length;
    }
}
