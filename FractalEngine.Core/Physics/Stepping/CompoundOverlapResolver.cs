using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Movement;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>Moves an overlapping compound to the closest free position, without turning it, if there is one that can be reached.</summary>
internal sealed class CompoundOverlapResolver(Obstacles obstacles)
{
    private const int MaxPushes = 64;

    private readonly HalfSpaces _planes = new();
    private readonly OverlapResolver _ballResolver = new(obstacles);

    /// <summary>Finds a free position for a compound, and moves it there.</summary>
    /// <returns>False where it is closed in; then it stays where it was.</returns>
    public bool TryResolve(Body body)
    {
        var start = body.Position;
        _planes.Clear();
        for (var push = 0; push < MaxPushes; push++)
        {
            obstacles.SelectBall(body.Radius, body.SafeDistance);
            obstacles.CollectNearbyBodies(new(body.Position, Vector.Zero, Vector.Zero), 0, body.Index);
            if (!TryFindOverlap(body, out var overlap, out var ball))
            {
                return true;
            }

            var normal = overlap.Normal(body.BallCentre(ball));
            normal = normal == Vector.Zero ? Vector.J : normal;
            var margin = 0.5 * ContactTolerances.Touch(body.Balls[ball].Radius, start);
            _planes.Add(normal, Vector.Dot(normal, overlap.Point - body.Balls[ball].Offset) + overlap.CombinedRadius + margin);
            if (!_planes.TryProject(start, out var next) || !IsReachable(body, next - body.Position))
            {
                break;
            }

            body.Position = next;
        }

        body.Position = start;
        return false;
    }

    private bool TryFindOverlap(Body body, out Contact overlap, out int ball)
    {
        overlap = default;
        ball = -1;
        var minGap = 0.0;
        for (var i = 0; i < body.Balls.Length; i++)
        {
            body.Balls[i].SafeDistance.Invalidate();
            obstacles.SelectBall(body.Balls[i].Radius, body.Balls[i].SafeDistance);
            var centre = body.BallCentre(i);
            if (obstacles.TryFindClosestContact(centre, minGap, out var found)
                && found.Gap(centre) < Math.Min(minGap, -obstacles.TouchTolerance(centre)))
            {
                overlap = found;
                ball = i;
                minGap = found.Gap(centre);
            }
        }

        return ball >= 0;
    }

    private bool IsReachable(Body body, Vector way)
    {
        for (var i = 0; i < body.Balls.Length; i++)
        {
            obstacles.SelectBall(body.Balls[i].Radius, body.Balls[i].SafeDistance);
            if (!_ballResolver.IsReachable(body.BallCentre(i), body.BallCentre(i) + way))
            {
                return false;
            }
        }

        return true;
    }
}
