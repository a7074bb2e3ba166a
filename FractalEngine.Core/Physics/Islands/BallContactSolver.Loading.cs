using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <content>How contacts and bodies are copied before a solve, and back after it.</content>
internal sealed partial class BallContactSolver
{
    /// <summary>Copies the contacts of an island and their bodies.</summary>
    /// <param name="rows">All contacts.</param>
    /// <param name="bodies">Bodies by their index in the world.</param>
    /// <param name="partEnds">The ends of the contacts of each part and of those between parts; empty for a single part.</param>
    public void Load(ReadOnlySpan<ContactRow> rows, ReadOnlySpan<SolverBody> bodies, ReadOnlySpan<int> partEnds)
    {
        Reserve(rows.Length, bodies.Length);
        SetGroups(rows.Length, partEnds);
        _firstFirm = bodies.Length;
        _surfaceCount = 0;
        Array.Clear(_bodies, _firstFirm, FirmCount);
        _hasTurns = false;
        _share = 0;
        for (var group = 0; group <= _partCount; group++)
        {
            for (var i = _groups[group].First; i < _groups[group].First + _groups[group].Count; i++)
            {
                Load(i, in rows[i], bodies, _firstFirm + (FirmStride * group));
            }
        }

        for (var i = 0; _hasTurns && i < rows.Length; i++)
        {
            _turns[i] = new(in rows[i]);
        }
    }

    private void Load(int index, in ContactRow row, ReadOnlySpan<SolverBody> bodies, int firm)
    {
        _bodies[row.First] = new(in bodies[row.First]);
        var second = row.Second;
        if (second >= 0)
        {
            _bodies[second] = new(in bodies[second]);
        }
        else
        {
            second = row.IsOnMovingSurface ? AddSurface(in row) : firm;
        }

        _rows[index] = new(in row, second);
        _changes[index] = Vector256<double>.Zero;
        _directions[index] = Vector256<double>.Zero;
        _hasTurns |= Turn.SlowsDown(in row);
    }

    /// <summary>Adds a body of infinite mass that moves like a surface.</summary>
    private int AddSurface(in ContactRow row)
    {
        var index = _firstFirm + FirmCount + _surfaceCount++;
        if (index == _bodies.Length)
        {
            Array.Resize(ref _bodies, 2 * _bodies.Length);
        }

        _bodies[index] = new(new SolverBody { Velocity = row.SurfaceVelocity, Spin = row.SurfaceSpin });
        return index;
    }

    /// <summary>Copies the impulses and the velocities back.</summary>
    public void Store(Span<ContactRow> rows, Span<SolverBody> bodies)
    {
        for (var i = 0; i < rows.Length; i++)
        {
            ref readonly var row = ref _rows[i];
            ref var stored = ref rows[i];
            stored.NormalImpulse = row.Impulse[NormalLane];
            stored.FrictionImpulse = SimdAffineMap.ToVector(row.Impulse);
            stored.TurnImpulse = _hasTurns ? SimdAffineMap.ToVector(_turns[i].Impulse) : Vector.Zero;
            _bodies[row.First].CopyTo(ref bodies[row.First]);
            if (row.Second < _firstFirm)
            {
                _bodies[row.Second].CopyTo(ref bodies[row.Second]);
            }
        }
    }

    private void Reserve(int rowCount, int bodyCount)
    {
        if (_bodies.Length < bodyCount + FirmCount)
        {
            // Room for a moving surface under each.
            _bodies = new Body[(2 * bodyCount) + FirmCount];
        }

        if (_rows.Length < rowCount)
        {
            // At once for all bodies, so that islands that grow allocate nothing.
            _rows = new Row[Math.Max(2 * rowCount, ContactsPerBody * bodyCount)];
            _turns = new Turn[_rows.Length];
            _changes = new Vector256<double>[_rows.Length];
            _directions = new Vector256<double>[_rows.Length];
            _active = new int[_rows.Length];
        }
    }

    private void SetGroups(int rowCount, ReadOnlySpan<int> partEnds)
    {
        _partCount = Math.Max(1, partEnds.Length - 1);
        var first = 0;
        for (var i = 0; i <= _partCount; i++)
        {
            var end = partEnds.Length > 0 ? partEnds[i] : rowCount;
            _groups[i].First = first;
            _groups[i].Count = end - first;
            _groups[i].ActiveCount = 0;
            first = end;
        }
    }
}
