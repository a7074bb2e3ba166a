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
    // Bodies are loaded in groups of so many.
    private const int BodiesPerJob = 256;

    private Island _large;
    private double _largeStepLength;
    private Action<int>? _loadBodies;
    private Action<int>? _beginPart;

    private bool FindImpulses(in Island island, double stepLength)
    {
        _large = island;
        _largeStepLength = stepLength;
        var rows = Graph.RowsOf(in island);
        if (Graph.MayBounce(Graph.BodiesOf(in island)))
        {
            Load(Graph.BodiesOf(in island), rows);
            BounceAll(rows);
            StoreVelocities(Graph.BodiesOf(in island));
        }

        WorkerSet.Shared.Run((island.BodyCount + BodiesPerJob - 1) / BodiesPerJob, maxThreads, _loadBodies ??= LoadBodies);
        WorkerSet.Shared.Run(island.PartCount, maxThreads, _beginPart ??= BeginPart);
        BeginPart(island.PartCount);
        return Solve(rows, RoundLimits.ForLarge(rows.Length), Graph.PartEndsOf(in island));
    }

    /// <summary>Loads a group of bodies with the velocities that they would have after the step without contacts.</summary>
    private void LoadBodies(int job)
    {
        var members = Graph.BodiesOf(in _large);
        foreach (var index in members[(job * BodiesPerJob)..Math.Min(members.Length, (job + 1) * BodiesPerJob)])
        {
            _solver.Load(index, bodies[index]);
            _solver.Bodies[index].Velocity += _largeStepLength * bodies[index].FreeAcceleration;
        }
    }

    /// <summary>Sets what the solve demands of the contacts of a part, and from which impulses it begins.</summary>
    private void BeginPart(int part)
    {
        var rows = Graph.RowsOfPart(in _large, part);
        _cache.Recall(rows);
        foreach (ref var row in rows)
        {
            _solver.ComputeMasses(ref row);
            SetDistanceConstraint(ref row, _largeStepLength);
            ApplyKnownImpulses(ref row);
        }
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
