using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <content>What bounces before the solve of a step, and what may not rebound after it.</content>
internal sealed partial class IslandPlanner
{
    // Rounds of bounces, one contact after the other: more of them are balls that pass their speed to and fro.
    private const int MaxBounceRounds = 64;

    // Each takes energy away, so that none must converge.
    private const int MaxReboundRounds = 8;

    private readonly List<int> _rebounding = [];

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

                var across = -row.FrictionMass * _solver.Slip(in row);
                var limit = row.Friction * impulse;
                var length = across.Length();
                _solver.Apply(in row, row.HasArms ? 0 : impulse, length > limit ? limit / length * across : across);
                Log(in row, impulse);
                hasBounced = true;
            }
        }

        return hasBounced;
    }

    private static void FindRebounding(ReadOnlySpan<ContactRow> rows, List<int> rebounding)
    {
        rebounding.Clear();
        for (var i = 0; i < rows.Length; i++)
        {
            if (rows[i].MayRebound)
            {
                rebounding.Add(i);
            }
        }
    }

    /// <summary>
    /// Lets those stay together that meet in this step and are too slow to bounce. The forces of a whole step would throw them back.
    /// </summary>
    private void StopRebounds(Span<ContactRow> rows, List<int> rebounding)
    {
        for (var round = 0; round < MaxReboundRounds && StopReboundsOnce(rows, rebounding); round++)
        {
        }
    }

    /// <summary>Goes once over contacts that may rebound, and leaves those of them that still push.</summary>
    /// <returns>True where one did.</returns>
    private bool StopReboundsOnce(Span<ContactRow> rows, List<int> rebounding)
    {
        var isRebounding = false;
        var count = 0;
        var places = CollectionsMarshal.AsSpan(rebounding);
        foreach (var i in places)
        {
            // It pushes less, but does not pull.
            ref var row = ref rows[i];
            var impulse = Math.Min(row.NormalImpulse, row.NormalMass * NormalVelocity(in row));
            if (impulse > 0)
            {
                row.NormalImpulse -= impulse;
                _solver.Apply(in row, -impulse, Vector.Zero);
                isRebounding = true;
            }

            if (row.NormalImpulse > 0)
            {
                places[count++] = i;
            }
        }

        CollectionsMarshal.SetCount(rebounding, count);
        return isRebounding;
    }
}
