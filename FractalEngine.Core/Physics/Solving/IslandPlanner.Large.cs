using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Solving;

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

    private Action<int>? _storePlan;
    private Action<int>? _stopRebounds;
    private Action<int>? _storeChanges;
    private int _largeIndex;

    private void CreateJobs()
    {
        _loadBodies ??= LoadBodies;
        _beginPart ??= BeginPart;
        _storePlan ??= StorePlan;
        _stopRebounds ??= StopRebounds;
        _storeChanges ??= StoreChanges;
    }

    private bool PlanLarge(int index, in Island island, double stepLength)
    {
        _large = island;
        _largeIndex = index;
        _largeStepLength = stepLength;
        var isConverged = FindImpulses(in island);
        var jobCount = (island.BodyCount + BodiesPerJob - 1) / BodiesPerJob;
        WorkerSet.Shared.Run(jobCount, maxThreads, _storePlan!);
        StopReboundsOfParts(in island);
        WorkerSet.Shared.Run(jobCount, maxThreads, _storeChanges!);
        return isConverged;
    }

    private bool FindImpulses(in Island island)
    {
        var rows = Graph.RowsOf(in island);
        if (Graph.MayBounce(Graph.BodiesOf(in island)))
        {
            Load(Graph.BodiesOf(in island), rows);
            BounceAll(rows);
            StoreVelocities(Graph.BodiesOf(in island));
        }

        WorkerSet.Shared.Run((island.BodyCount + BodiesPerJob - 1) / BodiesPerJob, maxThreads, _loadBodies!);
        WorkerSet.Shared.Run(ContactGraph.GroupCountOf(in island), maxThreads, _beginPart!);
        foreach (ref var row in island.PartCount > 1 ? Graph.RowsOfPart(in island, island.PartCount) : [])
        {
            // Their bodies are of two parts.
            ApplyKnownImpulses(ref row);
        }

        var isConverged = _solver.SolveLarge(Graph, in island, RoundLimits.ForLarge(rows.Length), _reboundingOfParts);
        Statistics = Statistics with { Rounds = Statistics.Rounds + _solver.Rounds };
        return isConverged;
    }

    /// <summary>Loads a group of bodies with the velocities that they would have after the step without contacts.</summary>
    private void LoadBodies(int job)
    {
        var members = MembersOf(job);
        Join(members, _largeIndex, isLarge: true);
        foreach (var index in members)
        {
            _solver.Load(index, bodies[index]);
            _solver.Bodies[index].Velocity += _largeStepLength * bodies[index].FreeAcceleration;
        }
    }

    private ReadOnlySpan<int> MembersOf(int job)
    {
        var members = Graph.BodiesOf(in _large);
        return members[(job * BodiesPerJob)..Math.Min(members.Length, (job + 1) * BodiesPerJob)];
    }

    private void StorePlan(int job) => StorePlan(MembersOf(job), _largeStepLength, isLarge: true);

    private void StoreChanges(int job) => StoreChanges(MembersOf(job));

    /// <summary>Stops rebounds part by part on all threads, and those across cuts in between.</summary>
    private void StopReboundsOfParts(in Island island)
    {
        var groupCount = ContactGraph.GroupCountOf(in island);
        if (groupCount == 1)
        {
            StopRebounds(Graph.RowsOf(in island), _reboundingOfParts[0]);
            return;
        }

        var isRebounding = true;
        for (var round = 0; round < MaxReboundRounds && isRebounding; round++)
        {
            WorkerSet.Shared.Run(island.PartCount, maxThreads, _stopRebounds!);
            StopRebounds(island.PartCount);
            isRebounding = _isRebounding.AsSpan(0, groupCount).Contains(true);
        }
    }

    private void StopRebounds(int part) =>
        _isRebounding[part] = StopReboundsOnce(Graph.RowsOfPart(in _large, part), _reboundingOfParts[part]);

    /// <summary>Sets what the solve demands of the contacts of a part, and from which impulses it begins.</summary>
    private void BeginPart(int part)
    {
        var rows = Graph.RowsOfPart(in _large, part);
        foreach (ref var row in rows)
        {
            _cache.Recall(ref row);
            _solver.ComputeMasses(ref row);
            SetDistanceConstraint(ref row, _largeStepLength);
            if (part < _large.PartCount)
            {
                ApplyKnownImpulses(ref row);
            }
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
