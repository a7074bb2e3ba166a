using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <content>How the plan follows the turns of compounds, and plans for one of them alone.</content>
internal sealed partial class IslandPlanner
{
    /// <summary>Takes away all approaching velocities of a few bodies, of which one may be immovable to all others.</summary>
    /// <param name="members">Indices of the bodies.</param>
    /// <param name="rows">Their contacts.</param>
    public void StopApproachesOf(ReadOnlySpan<int> members, Span<ContactRow> rows)
    {
        Load(members, rows);
        _ = StopApproaches(rows);
        StoreVelocities(members);
    }

    /// <summary>Finds the forces on one body that lead it into none of its contacts.</summary>
    /// <param name="members">Its index.</param>
    /// <param name="rows">Its contacts, all with what is immovable.</param>
    /// <param name="duration">Seconds.</param>
    /// <param name="planned">Receives the velocities whose mean with those at the beginning is the way.</param>
    /// <returns>The velocities at the end of that time: what it has met meanwhile does not throw it back.</returns>
    public (Vector Velocity, Vector Spin) FindForcesOn(
        ReadOnlySpan<int> members, Span<ContactRow> rows, double duration, out (Vector Velocity, Vector Spin) planned)
    {
        Load(members, rows);
        var isConverged = FindForces(members, rows, duration);
        Statistics = Statistics with { Solves = Statistics.Solves + 1, Unconverged = Statistics.Unconverged + (isConverged ? 0 : 1) };
        planned = (_solver.Bodies[members[0]].Velocity, _solver.Bodies[members[0]].Spin);
        FindRebounding(rows, _rebounding);
        StopRebounds(rows, _rebounding);
        return (_solver.Bodies[members[0]].Velocity, _solver.Bodies[members[0]].Spin);
    }

    /// <summary>Reports the contacts that the last forces on one body came from.</summary>
    public void Report(ReadOnlySpan<ContactRow> rows) => Log(rows);

    /// <summary>Finds how compounds would turn if nothing touched them.</summary>
    private void FindFreeTurns(ReadOnlySpan<int> island, double duration)
    {
        foreach (var index in island)
        {
            if (bodies[index].IsCompound)
            {
                FreeTurn.Plan(bodies[index], duration);
            }
        }
    }

    /// <summary>Stores the turns of compounds, and what they mean for the contacts.</summary>
    private void StoreTurns(ReadOnlySpan<int> island, Span<ContactRow> rows, double stepLength)
    {
        var hasCompound = false;
        foreach (var index in island)
        {
            var body = bodies[index];
            if (body.IsCompound)
            {
                hasCompound = true;
                body.PlannedTurn = body.IsResting ? Vector.Zero : 0.5 * stepLength * (body.SpinBase + _solver.Bodies[index].Spin);
            }
        }

        if (!hasCompound)
        {
            return;
        }

        foreach (ref var row in rows)
        {
            if (row.HasArms)
            {
                row.TurnShift = Turned(bodies[row.First], row.FirstArm) - row.FirstArm;
                row.TurnShift -= row.Second >= 0 ? Turned(bodies[row.Second], row.SecondArm) - row.SecondArm : Vector.Zero;
            }
        }
    }

    private static Vector Turned(Body body, Vector arm) =>
        body.IsCompound ? Orientation.Identity.TurnedBy(body.PlannedTurn).Rotate(arm) : arm;

    /// <summary>Velocity of the first ball's centre relative to the second's, whose mean with that at the end is the way.</summary>
    private Vector BaseVelocity(in ContactRow row)
    {
        var velocity = BaseVelocity(bodies[row.First], row.FirstArm);
        return velocity - (row.Second >= 0 ? BaseVelocity(bodies[row.Second], row.SecondArm) : row.SurfaceVelocity);
    }

    private static Vector BaseVelocity(Body body, Vector arm) =>
        body.IsCompound ? body.Velocity + Vector.Cross(body.SpinBase, arm) : body.Velocity;

    /// <summary>How much farther the balls get by the turns of their bodies than straight ways lead them.</summary>
    private Vector TurnShift(in ContactRow row, double stepLength, bool isFirst)
    {
        var shift = TurnShift(row.First, row.FirstArm, stepLength, isFirst);
        return row.Second >= 0 ? shift - TurnShift(row.Second, row.SecondArm, stepLength, isFirst) : shift;
    }

    private Vector TurnShift(int index, Vector arm, double stepLength, bool isFirst)
    {
        if (!bodies[index].IsCompound)
        {
            return Vector.Zero;
        }

        var spin = isFirst ? bodies[index].FreeSpin : _solver.Bodies[index].Spin;
        var turn = 0.5 * stepLength * (bodies[index].SpinBase + spin);
        return Orientation.Identity.TurnedBy(turn).Rotate(arm) - arm - Vector.Cross(turn, arm);
    }
}
