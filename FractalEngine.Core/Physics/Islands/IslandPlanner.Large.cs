using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <content>
/// The plan of large islands of balls: one solve for the impulses and forces of all contacts together, which begins with those of the step
/// before. Its bodies go as far as their velocities after the step tell.
/// </content>
/// <remarks>
/// What a solve that has not converged leaves of approaching velocities is lost then. If bodies went by the mean of both velocities, the
/// forces would turn it into as much rebound, and a heap would need ten times as many rounds to come to rest.
/// </remarks>
internal sealed partial class IslandPlanner
{
    // A solve takes as many rounds as solve so many contacts.
    private const int MaxSolvesOfLarge = 25_000;
    private const int MinRoundsOfLarge = 8;

    private bool FindImpulses(in Island island, double stepLength)
    {
        var members = Graph.BodiesOf(in island);
        var rows = Graph.RowsOf(in island);
        BounceAll(rows);
        StoreVelocities(members);
        _cache.Recall(rows);
        foreach (var index in members)
        {
            _solver.Bodies[index].Velocity += stepLength * bodies[index].FreeAcceleration;
        }

        foreach (ref var row in rows)
        {
            SetDistanceConstraint(ref row, stepLength);
            ApplyKnownImpulses(ref row);
        }

        return Solve(rows, Math.Max(MinRoundsOfLarge, MaxSolvesOfLarge / rows.Length), Graph.PartEndsOf(in island));
    }

    /// <summary>Demands that two bodies that go by their velocities after the step do not get nearer than they touch.</summary>
    private void SetDistanceConstraint(ref ContactRow row, double stepLength)
    {
        var velocity = bodies[row.First].Velocity - (row.Second >= 0 ? bodies[row.Second].Velocity : row.SurfaceVelocity);
        if (row.IsAhead)
        {
            SetImpactAhead(ref row, stepLength, velocity);
        }

        if (row.IsBouncingAhead)
        {
            row.MinNormalVelocity = double.NegativeInfinity;
            return;
        }

        double gap;
        if (row.HasFixedNormal || !row.IsBall)
        {
            gap = RemoveRounding(Vector.Dot(row.Offset, row.Normal) - row.MinDistance, row.MinDistance);
        }
        else
        {
            // The mean of the lines of contact before the step and after it, as in SetConstraint.
            var distance = row.Offset.Length();
            var sum = (2 * row.Offset) + (stepLength * velocity);
            var length = sum.Length();
            gap = RemoveRounding(RemoveMargin(distance - row.MinDistance, in row), row.MinDistance)
                * (distance + row.MinDistance) / length;
            row.Normal = sum / length;
        }

        row.MinNormalVelocity = -gap / stepLength;
    }

    /// <summary>The gap to close so that a margin is left. A gap within it stays as it is.</summary>
    private static double RemoveMargin(double gap, in ContactRow row) => gap > 0
        ? Math.Max(0, gap - (ContactTolerances.HeapMargin * Math.Min(row.FirstRadius, row.SecondRadius))) : gap;
}
