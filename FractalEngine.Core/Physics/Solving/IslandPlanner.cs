using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <summary>
/// Plans the step of all bodies that touch others: bounces, and then the substeps of each island. For compounds that touch no other body,
/// it finds what their contacts do.
/// </summary>
/// <remarks>
/// The forces on one compound are constant during its plan, so that it follows a parabola. They act along the mean of the line of contact
/// before and after it.
/// </remarks>
internal sealed class IslandPlanner(
    List<Body> bodies, NearbyBodies nearbyBodies, ContactLog contactLog, ImpulseCache cache, int maxThreads)
{
    // Relative to the speed: what rounding leaves of a velocity along a normal.
    private const double RelativeTolerance = 1e-13;

    // Rounds of bounces, one contact after the other: more of them are balls that pass their speed to and fro.
    private const int MaxBounceRounds = 64;

    // Each takes energy away, so that none must converge.
    private const int MaxReboundRounds = 8;

    // Times that the lines of contact are corrected for how far the bodies move in the step.
    private const int MaxTurns = 4;

    // Radians: lines of contact that turn by less need no further correction.
    private const double TurnTolerance = 1e-10;

    // Relative to the restitution threshold: what is met more slowly is met at the end of the time, where that is known so far.
    private const double SlowFraction = 0.01;

    // Relative to the touch tolerance: smaller gaps are rounding, and stay.
    private const double NegligibleGap = 1e-9;

    private readonly ContactSolver _solver = new();
    private readonly SubstepSolver _substeps = new(bodies, cache, maxThreads);

    /// <summary>The islands of this step, with their contacts.</summary>
    public IslandSet Islands { get; } = new(bodies, nearbyBodies, maxThreads);

    /// <summary>What has been solved so far.</summary>
    public IslandStatistics Statistics { get; private set; }

    /// <summary>Number of equal parts that the step is made in, which need fewer substeps each.</summary>
    public int PartsOfStep { get; set; } = 1;

    /// <summary>True once balls of the islands of this step may end deep in others.</summary>
    public bool HasDeepOverlaps => _substeps.HasDeepOverlaps;

    /// <summary>Forgets what has been solved before.</summary>
    public void Reset()
    {
        Statistics = default;
        cache.Clear();
    }

    /// <summary>Makes room for the bodies of a world and their contacts, before the first step with them.</summary>
    public void Reserve(int bodyCount, int contactCount)
    {
        Islands.Reserve(bodyCount, contactCount);
        _solver.Reserve(bodyCount);
        cache.Reserve(contactCount);
        _substeps.Reserve(bodyCount, contactCount);
    }

    /// <summary>Lets bodies that touch bounce. They must have been joined.</summary>
    public void StopApproaches()
    {
        Islands.Group(onlyImpacts: true);
        foreach (var island in Islands.All)
        {
            if (Islands.RowsOf(in island) is { Length: > 0 } rows)
            {
                // What then still approaches is stopped by the solve of the step.
                Bounce(in island, rows);
            }
        }
    }

    /// <summary>Plans the step of all islands. Their bodies must have been joined.</summary>
    /// <param name="stepLength">Seconds.</param>
    public void Plan(double stepLength)
    {
        Islands.Group(onlyImpacts: false);
        _substeps.HasDeepOverlaps = false;
        for (var index = 0; index < Islands.All.Count; index++)
        {
            var island = Islands.All[index];
            var isConverged = Plan(index, in island, stepLength);
            Statistics = new(Statistics.Solves + 1, Statistics.Rounds, Statistics.Unconverged + (isConverged ? 0 : 1));
        }

        cache.Store(Islands, maxThreads);
    }

    private bool Plan(int index, in Island island, double stepLength)
    {
        var rows = Islands.RowsOf(in island);
        if (Islands.MayBounce(Islands.BodiesOf(in island)))
        {
            // Bodies that have joined without touching another may run into surfaces.
            Bounce(in island, rows);
        }

        Join(in island, index);
        var isConverged = _substeps.Solve(Islands, in island, stepLength, PartsOfStep);
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
        Load(Islands.BodiesOf(in island), rows);
        BounceAll(rows);
        StoreVelocities(Islands.BodiesOf(in island));
    }

    /// <summary>Tells bodies which island they are of.</summary>
    private void Join(in Island island, int islandIndex)
    {
        foreach (var index in Islands.BodiesOf(in island))
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

    /// <summary>Reports the contacts that the last forces came from.</summary>
    public void Log(ReadOnlySpan<ContactRow> rows)
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

    /// <summary>Lets all pairs bounce until none approaches fast enough any more.</summary>
    private void BounceAll(Span<ContactRow> rows)
    {
        for (var round = 0; round < MaxBounceRounds && Bounce(rows); round++)
        {
        }
    }

    /// <summary>Lets all pairs bounce once that approach fast enough, one after the other.</summary>
    private bool Bounce(Span<ContactRow> rows)
    {
        var hasBounced = false;
        foreach (ref var row in rows)
        {
            var speed = -NormalVelocity(in row);
            if (!row.IsAhead && row.Restitution > 0 && speed > Math.Max(Threshold(in row), Rounding(in row)))
            {
                var impulse = (1 + row.Restitution) * speed * row.NormalMass;
                if (row.HasArms)
                {
                    // First alone, since it changes the slip: both together could add energy.
                    _solver.Apply(in row, impulse, Vector.Zero);
                }

                var across = (-row.FrictionMass * _solver.Slip(in row)).ShortenedTo(row.Friction * impulse);
                _solver.Apply(in row, row.HasArms ? 0 : impulse, across);
                Log(in row, impulse);
                hasBounced = true;
            }
        }

        return hasBounced;
    }

    /// <summary>
    /// Lets those stay together that meet in this step and are too slow to bounce. The forces of a whole step would throw them back.
    /// </summary>
    private void StopRebounds(Span<ContactRow> rows)
    {
        var isRebounding = true;
        for (var round = 0; round < MaxReboundRounds && isRebounding; round++)
        {
            isRebounding = false;
            foreach (ref var row in rows)
            {
                // It pushes less, but does not pull.
                var impulse = row.MayRebound ? Math.Min(row.NormalImpulse, row.NormalMass * NormalVelocity(in row)) : 0;
                if (impulse > 0)
                {
                    row.NormalImpulse -= impulse;
                    _solver.Apply(in row, -impulse, Vector.Zero);
                    isRebounding = true;
                }
            }
        }
    }

    /// <summary>Takes away all approaching velocities of a few bodies: by bounces where they are fast enough, else by one solve.</summary>
    /// <param name="members">Indices of the bodies, of which one may be immovable to all others.</param>
    /// <param name="rows">Their contacts.</param>
    public void StopApproachesOf(ReadOnlySpan<int> members, Span<ContactRow> rows)
    {
        Load(members, rows);
        BounceAll(rows);
        var isApproaching = false;
        foreach (ref var row in rows)
        {
            isApproaching |= !row.IsAhead && NormalVelocity(in row) < -Rounding(in row);
            // What does not touch yet exerts no impulse.
            row.MinNormalVelocity = row.IsAhead ? double.NegativeInfinity : 0;
        }

        if (isApproaching)
        {
            _ = Solve(rows);
            Log(rows);
        }

        StoreVelocities(members);
    }

    /// <summary>Finds the forces on a compound that lead it into none of its contacts.</summary>
    /// <param name="body">The compound.</param>
    /// <param name="rows">Its contacts, all with what is immovable.</param>
    /// <param name="duration">Seconds.</param>
    /// <param name="planned">Receives the velocities whose mean with those at the beginning is the way.</param>
    /// <returns>The velocities at the end of that time: what it has met meanwhile does not throw it back.</returns>
    public (Vector Velocity, Vector Spin) FindForcesOn(
        Body body, Span<ContactRow> rows, double duration, out (Vector Velocity, Vector Spin) planned)
    {
        Load([body.Index], rows);
        foreach (ref var row in rows)
        {
            cache.Recall(ref row);
        }

        FreeTurn.Plan(body, duration);
        ref var solverBody = ref _solver.Bodies[body.Index];
        var isConverged = false;
        var turn = double.PositiveInfinity;
        for (var i = 0; i < MaxTurns && turn > TurnTolerance; i++)
        {
            turn = 0;
            foreach (ref var row in rows)
            {
                turn = Math.Max(turn, SetConstraint(ref row, duration, isFirst: i == 0));
            }

            // Lines of contact of forces that have not converged need no correction.
            if (i > 0 && (turn <= TurnTolerance || (i > 1 && !isConverged)))
            {
                break;
            }

            solverBody.Velocity = body.Velocity + (duration * body.FreeAcceleration);
            solverBody.Spin = body.FreeSpin;
            foreach (ref var row in rows)
            {
                // The impulses from which the solve begins.
                row.FrictionImpulse -= Vector.Dot(row.FrictionImpulse, row.Normal) * row.Normal;
                _solver.Apply(in row, row.NormalImpulse, row.FrictionImpulse);
                _solver.ApplyTurn(in row, row.TurnImpulse);
            }

            isConverged = Solve(rows);
        }

        Statistics = Statistics with { Solves = Statistics.Solves + 1, Unconverged = Statistics.Unconverged + (isConverged ? 0 : 1) };
        planned = (solverBody.Velocity, solverBody.Spin);
        StopRebounds(rows);
        return (solverBody.Velocity, solverBody.Spin);
    }

    /// <summary>Demands that a compound be at least as far from what it touches at the end of its plan as when they touch.</summary>
    /// <returns>By how much the line of contact has turned, radians.</returns>
    private double SetConstraint(ref ContactRow row, double stepLength, bool isFirst)
    {
        var body = bodies[row.First];
        var velocity = body.Velocity + Vector.Cross(body.SpinBase, row.FirstArm) - row.SurfaceVelocity;
        var shift = TurnShift(body, row.FirstArm, stepLength, isFirst);
        var distance = row.Offset.Length();
        var gap = distance - row.MinDistance;
        var turn = 0.0;
        if (isFirst && row.IsAhead)
        {
            row.IsBouncingAhead = -Vector.Dot(velocity, row.Normal) > SlowFraction * Threshold(in row);
        }

        if (row.IsBouncingAhead)
        {
            // Its way ends where it touches. It gives no impulse before it bounces, in the next step.
            row.MinNormalVelocity = double.NegativeInfinity;
            return 0;
        }

        if (!row.IsBall)
        {
            gap = RemoveRounding(Vector.Dot(row.Offset, row.Normal) - row.MinDistance, row.MinDistance);
            turn = (shift - row.TurnShift).MaxAbsComponent() / row.MinDistance;
        }
        else
        {
            var finalVelocity = isFirst ? velocity : _solver.RelativeVelocity(in row);
            var sum = (2 * row.Offset) + (0.5 * stepLength * (velocity + finalVelocity)) + shift;
            var length = sum.Length();
            var normal = sum / length;
            // |r₁|² − |r₀|² = (r₀ + r₁)·(r₁ − r₀) must not fall below d² − |r₀|².
            gap = RemoveRounding(gap, row.MinDistance) * (distance + row.MinDistance) / length;
            turn = (normal - row.Normal).MaxAbsComponent();
            row.Normal = normal;
        }

        row.TurnShift = shift;
        _solver.ComputeMasses(ref row);
        gap += Vector.Dot(shift, row.Normal);
        row.MinNormalVelocity = (-2 * gap / stepLength) - Vector.Dot(velocity, row.Normal);
        return turn;
    }

    /// <summary>The gap to close. Overlaps are left as they are, and rounding is no gap.</summary>
    private static double RemoveRounding(double gap, double minDistance) => gap > NegligibleGap * minDistance ? gap : 0;

    /// <summary>How much farther a ball of a compound gets by its turn than a straight way leads it.</summary>
    private Vector TurnShift(Body body, Vector arm, double duration, bool isFirst)
    {
        var spin = isFirst ? body.FreeSpin : _solver.Bodies[body.Index].Spin;
        var turn = 0.5 * duration * (body.SpinBase + spin);
        return Orientation.Identity.TurnedBy(turn).Rotate(arm) - arm - Vector.Cross(turn, arm);
    }
}
