using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;

namespace FractalEngine.Core.Physics.Movement;

/// <summary>
/// Moves an overlapping mover to the closest free position, without turning it, if there is one that can be reached. Bodies give way to
/// bodies as those of an island do, and only to surfaces and the character here; the character gives way to all.
/// </summary>
internal sealed class OverlapResolver(Obstacles obstacles)
{
    private const int MaxPushes = 32;
    private const int MaxSteps = 64;

    // Relative to the free distance: how much of it a step towards a free position uses, so that rounding crosses no surface.
    private const double StepFraction = 0.9;

    // Relative to the radius: how far in front of a surface a centre is put that was on it or behind it.
    private const double SurfaceOffset = 1e-6;

    // Relative to the radius: a centre this close to a surface is taken to be on it.
    private const double OnSurfaceTolerance = 1e-9;

    private readonly HalfSpaces _planes = new();

    /// <summary>Finds a free position. It keeps clear of all obstacles that were met so far at once, not only of the last one.</summary>
    /// <param name="position">Position of the mover; receives the free position, and is unchanged where there is none.</param>
    /// <param name="body">The mover itself; null for the spheres of the obstacles.</param>
    /// <returns>False where the mover is closed in.</returns>
    public bool TryResolve(ref Vector position, Body? body)
    {
        var touchTolerance = obstacles.TouchTolerance(position);
        var start = body is { IsCompound: true } ? position : MoveOutOfSurface(position);
        var current = start;
        _planes.Clear();
        for (var push = 0; push < MaxPushes; push++)
        {
            if (body is null)
            {
                obstacles.CollectNearbyBodies(new(current, Vector.Zero, Vector.Zero), 0, Contact.NoBody);
            }

            if (!TryFindOverlap(body, current, touchTolerance, out var overlap))
            {
                position = current;
                return true;
            }

            // With two centres at one position, neither is to any side of the other.
            var normal = overlap.PointToCentre(current).Length() > OnSurfaceTolerance * obstacles.Radius
                ? overlap.Normal(current)
                : Vector.J;
            var offset = Vector.Dot(normal, overlap.Point - overlap.SphereOffset) + overlap.CombinedRadius + (0.5 * touchTolerance);
            _planes.Add(normal, offset);
            if (!_planes.TryProject(start, out var next) || !IsReachable(body, current, next))
            {
                return false;
            }

            current = next;
        }

        return false;
    }

    /// <summary>Finds what the mover overlaps most, if anything by more than a tolerance.</summary>
    private bool TryFindOverlap(Body? body, Vector position, double tolerance, out Contact overlap)
    {
        if (body is null)
        {
            return obstacles.TryFindClosestContact(position, 0, out overlap) && overlap.Gap(position) < -tolerance;
        }

        overlap = default;
        var minGap = 0.0;
        foreach (var ball in body.Balls)
        {
            var centre = position + ball.Offset;
            obstacles.SelectBall(ball.Radius, ball.SafeDistance);
            if (obstacles.TryFindClosestContact(centre, minGap, out var found) && found.Gap(centre) < Math.Min(minGap, -tolerance))
            {
                overlap = found with { SphereOffset = ball.Offset };
                minGap = found.Gap(centre);
            }
        }

        return minGap < 0;
    }

    private bool IsReachable(Body? body, Vector from, Vector to)
    {
        foreach (var ball in body?.Balls ?? [])
        {
            obstacles.SelectBall(ball.Radius, ball.SafeDistance);
            if (!IsReachable(from + ball.Offset, to + ball.Offset))
            {
                return false;
            }
        }

        return body is not null || IsReachable(from, to);
    }

    /// <summary>The position itself; or one just in front of the surface, where it is on a surface or inside a solid.</summary>
    private Vector MoveOutOfSurface(Vector position)
    {
        if (obstacles.TryFindSurfaceSide(position, out var closest, out var isInside)
            && (closest.Distance <= OnSurfaceTolerance * obstacles.Radius || isInside))
        {
            return closest.Point + (SurfaceOffset * obstacles.Radius * closest.Normal);
        }

        return position;
    }

    /// <summary>True when a centre can go straight to a position without meeting a surface.</summary>
    public bool IsReachable(Vector from, Vector to)
    {
        var path = to - from;
        var length = path.Length();
        var travelled = 0.0;
        for (var step = 0; step < MaxSteps && travelled < length; step++)
        {
            var position = from + (travelled / length * path);
            var distance = obstacles.SurfaceDistance(position, obstacles.Radius);
            if (distance < OnSurfaceTolerance * obstacles.Radius)
            {
                return false;
            }

            travelled += StepFraction * distance;
        }

        return travelled >= length;
    }
}
