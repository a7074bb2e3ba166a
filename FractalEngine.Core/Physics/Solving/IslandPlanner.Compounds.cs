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

    /// <summary>How much farther a ball of a compound gets by its turn than a straight way leads it.</summary>
    private Vector TurnShift(Body body, Vector arm, double duration, bool isFirst)
    {
        var spin = isFirst ? body.FreeSpin : _solver.Bodies[body.Index].Spin;
        var turn = 0.5 * duration * (body.SpinBase + spin);
        return Orientation.Identity.TurnedBy(turn).Rotate(arm) - arm - Vector.Cross(turn, arm);
    }
}
