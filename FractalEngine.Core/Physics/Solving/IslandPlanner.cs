using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <summary>
/// Plans the step of all bodies that touch others: the impulses of what approaches, then the forces that all contacts exert during the
/// step. Both are solved for a whole island at once.
/// </summary>
/// <remarks>
/// The forces are constant during the step, so that each body follows a parabola. They act along the mean of the line of contact before
/// and after the step. Along it, two balls that stay in touch do not come closer, so that the forces between them do no work.
/// </remarks>
internal sealed partial class IslandPlanner(
    List<Body> bodies, NearbyBodies nearbyBodies, ContactLog contactLog, ImpulseCache cache, int maxThreads)
{
    // Times that the lines of contact are corrected for how far the bodies move in the step.
    private const int MaxTurns = 4;

    // Radians: lines of contact that turn by less need no further correction.
    private const double TurnTolerance = 1e-10;

    // Relative to the speed: what rounding leaves of a velocity along a normal.
    private const double RelativeTolerance = 1e-13;

    private readonly ContactSolver _solver = new();
    private readonly ImpulseCache _cache = cache;
    private readonly SubstepSolver _substeps = new(bodies, cache, maxThreads);

    /// <summary>The contacts and islands of this step.</summary>
    public ContactGraph Graph { get; } = new(bodies, nearbyBodies, maxThreads);

    /// <summary>What has been solved so far.</summary>
    public IslandStatistics Statistics { get; private set; }

    /// <summary>True once balls of the islands of this step may end deep in others.</summary>
    public bool HasDeepOverlaps => _substeps.HasDeepOverlaps;

    /// <summary>Forgets what has been solved before.</summary>
    public void Reset()
    {
        Statistics = default;
        _cache.Clear();
    }

    /// <summary>Makes room for the bodies of a world and their contacts, before the first step with them.</summary>
    public void Reserve(int bodyCount, int contactCount)
    {
        Graph.Reserve(bodyCount, contactCount);
        _solver.Reserve(bodyCount, contactCount);
        _cache.Reserve(contactCount);
        _substeps.Reserve(bodyCount, contactCount);
        _rebounding.EnsureCapacity(contactCount);
    }

    /// <summary>Takes away all approaching velocities of bodies that touch. They must have been joined.</summary>
    public void StopApproaches()
    {
        Graph.Group(onlyImpacts: true);
        foreach (var island in Graph.Islands)
        {
            var rows = Graph.RowsOf(in island);
            if (rows.Length == 0)
            {
                continue;
            }

            // What then still approaches is stopped by the solve of the step.
            Bounce(in island, rows);
        }
    }

    /// <summary>Plans the step of all islands. Their bodies must have been joined.</summary>
    /// <param name="stepLength">Seconds.</param>
    public void Plan(double stepLength)
    {
        Graph.Group(onlyImpacts: false);
        _substeps.HasDeepOverlaps = false;
        for (var index = 0; index < Graph.Islands.Count; index++)
        {
            var island = Graph.Islands[index];
            var isConverged = Plan(index, in island, stepLength);
            Statistics = new(Statistics.Solves + 1, Statistics.Rounds, Statistics.Unconverged + (isConverged ? 0 : 1));
        }

        _cache.Store(Graph, maxThreads);
    }

    private bool Plan(int index, in Island island, double stepLength)
    {
        var rows = Graph.RowsOf(in island);
        if (Graph.MayBounce(Graph.BodiesOf(in island)))
        {
            // Bodies that have joined without touching another may run into surfaces.
            Bounce(in island, rows);
        }

        Join(in island, index);
        var isConverged = _substeps.Solve(Graph, in island, stepLength);
        for (var i = 0; contactLog.IsEnabled && i < rows.Length; i++)
        {
            if (_substeps.ImpulseOf(i) > 0 || !rows[i].IsAhead)
            {
                Log(in rows[i], _substeps.ImpulseOf(i));
            }
        }

        Statistics = Statistics with { Rounds = Statistics.Rounds + _substeps.Rounds };
        return isConverged;
    }

    private void Bounce(in Island island, Span<ContactRow> rows)
    {
        Load(Graph.BodiesOf(in island), rows);
        BounceAll(rows);
        StoreVelocities(Graph.BodiesOf(in island));
    }

    /// <summary>Tells bodies which island they are of.</summary>
    private void Join(in Island island, int islandIndex)
    {
        foreach (var index in Graph.BodiesOf(in island))
        {
            bodies[index].IslandIndex = islandIndex;
            bodies[index].MayTouchBodies = true;
            bodies[index].HasHeapMargin = true;
            bodies[index].PlannedStartOrientation = bodies[index].Orientation;
        }
    }

    private void Load(ReadOnlySpan<int> island, Span<ContactRow> rows)
    {
        foreach (var index in island)
        {
            _solver.Load(index, bodies[index]);
        }

        foreach (ref var row in rows)
        {
            _solver.ComputeMasses(ref row);
        }
    }

    /// <summary>Takes away all approaching velocities: by bounces where they are fast enough, else by one solve.</summary>
    private bool StopApproaches(Span<ContactRow> rows)
    {
        BounceAll(rows);
        var isApproaching = false;
        foreach (ref var row in rows)
        {
            isApproaching |= !row.IsAhead && NormalVelocity(in row) < -Rounding(in row);
        }

        if (!isApproaching)
        {
            return true;
        }

        // What does not touch yet exerts no impulse.
        foreach (ref var row in rows)
        {
            row.MinNormalVelocity = row.IsAhead ? double.NegativeInfinity : 0;
        }

        var isConverged = Solve(rows);
        Log(rows);
        return isConverged;
    }

    private void Log(ReadOnlySpan<ContactRow> rows)
    {
        if (!contactLog.IsEnabled)
        {
            return;
        }

        foreach (ref readonly var row in rows)
        {
            if (row.NormalImpulse > 0 || !row.IsAhead)
            {
                Log(in row, row.NormalImpulse);
            }
        }
    }

    private void Log(in ContactRow row, double impulse) => contactLog.Add(
        row.First, row.Second, bodies[row.First].Position + row.FirstArm - (row.FirstRadius * row.Normal), row.Normal, impulse);

    private double Threshold(in ContactRow row)
    {
        var threshold = bodies[row.First].RestitutionThreshold;
        return row.Second >= 0 ? Math.Max(threshold, bodies[row.Second].RestitutionThreshold) : threshold;
    }

    private double NormalVelocity(in ContactRow row) => Vector.Dot(_solver.RelativeVelocity(in row), row.Normal);

    private double Rounding(in ContactRow row)
    {
        var rounding = RelativeTolerance * _solver.Bodies[row.First].Velocity.MaxAbsComponent();
        return row.Second >= 0
            ? Math.Max(rounding, RelativeTolerance * _solver.Bodies[row.Second].Velocity.MaxAbsComponent()) : rounding;
    }

    private bool FindForces(ReadOnlySpan<int> island, Span<ContactRow> rows, double stepLength)
    {
        _cache.Recall(rows);
        FindFreeTurns(island, stepLength);
        var isConverged = false;
        var turn = double.PositiveInfinity;
        for (var i = 0; i < MaxTurns && turn > TurnTolerance; i++)
        {
            turn = 0;
            foreach (ref var row in rows)
            {
                turn = Math.Max(turn, SetConstraint(ref row, stepLength, isFirst: i == 0));
            }

            // Lines of contact of forces that have not converged need no correction.
            if (i > 0 && (turn <= TurnTolerance || (i > 1 && !isConverged)))
            {
                break;
            }

            foreach (var index in island)
            {
                ref var solverBody = ref _solver.Bodies[index];
                solverBody.Velocity = bodies[index].Velocity + (stepLength * bodies[index].FreeAcceleration);
                solverBody.Spin = bodies[index].IsCompound ? bodies[index].FreeSpin : bodies[index].AngularVelocity;
            }

            foreach (ref var row in rows)
            {
                ApplyKnownImpulses(ref row);
            }

            isConverged = Solve(rows);
        }

        return isConverged;
    }

    /// <summary>Gives the bodies of a contact the impulses from which the solve begins.</summary>
    private void ApplyKnownImpulses(ref ContactRow row)
    {
        row.FrictionImpulse -= Vector.Dot(row.FrictionImpulse, row.Normal) * row.Normal;
        _solver.Apply(in row, row.NormalImpulse, row.FrictionImpulse);
        _solver.ApplyTurn(in row, row.TurnImpulse);
    }

    private bool Solve(Span<ContactRow> rows)
    {
        var isConverged = _solver.Solve(rows);
        Statistics = Statistics with { Rounds = Statistics.Rounds + _solver.Rounds };
        return isConverged;
    }

    private void StoreVelocities(ReadOnlySpan<int> island)
    {
        foreach (var index in island)
        {
            bodies[index].Velocity = _solver.Bodies[index].Velocity;
            bodies[index].AngularVelocity = _solver.Bodies[index].Spin;
        }
    }
}
