using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Solving;

/// <content>How contacts and bodies are copied before a solve, and back after it.</content>
internal sealed partial class BallContactSolver
{
    private const int BodiesPerJob = 256;

    private ContactGraph? _graph;
    private SolverBody[] _solverBodies = [];
    private List<int>[] _rebounding = [];
    private Island _island;

    /// <summary>Copies contacts and their bodies.</summary>
    /// <param name="rows">All contacts of an island.</param>
    /// <param name="bodies">Bodies by their index in the world.</param>
    public void Load(Span<ContactRow> rows, ReadOnlySpan<SolverBody> bodies)
    {
        Begin(rows.Length, bodies.Length, []);
        foreach (ref readonly var row in rows)
        {
            _bodies[row.First] = new(in bodies[row.First]);
            if (row.Second >= 0)
            {
                _bodies[row.Second] = new(in bodies[row.Second]);
            }
        }

        Load(_groups[0], rows, _firstImmovable);
        LoadTurns(_groups[0], rows);
    }

    /// <summary>Copies the contacts of a large island and their bodies, on all threads.</summary>
    /// <param name="graph">Has the island's contacts.</param>
    /// <param name="island">The island.</param>
    /// <param name="bodies">Bodies by their index in the world.</param>
    /// <returns>The largest impulse that would stop a contact's bodies.</returns>
    public double Load(ContactGraph graph, in Island island, SolverBody[] bodies)
    {
        _graph = graph;
        _island = island;
        _solverBodies = bodies;
        Begin(island.RowCount, bodies.Length, graph.PartEndsOf(in island));
        var groupCount = ContactGraph.GroupCountOf(in island);
        WorkerSet.Shared.Run((island.BodyCount + BodiesPerJob - 1) / BodiesPerJob, _maxThreads, _loadBodies);
        // Surfaces that move become bodies in the order of their contacts.
        WorkerSet.Shared.Run(groupCount, island.HasMovingSurface ? 1 : _maxThreads, _loadGroup);
        var largest = 0.0;
        foreach (var group in _groups.AsSpan(0, groupCount))
        {
            largest = Math.Max(largest, group.MaxStoppingImpulse);
            LoadTurns(group, graph.RowsOf(in island));
        }

        return largest;
    }

    /// <summary>Copies the impulses and the velocities back.</summary>
    public void Store(Span<ContactRow> rows, Span<SolverBody> bodies)
    {
        for (var i = 0; i < rows.Length; i++)
        {
            ref readonly var row = ref _rows[i];
            Store(i, ref rows[i]);
            _bodies[row.First].CopyTo(ref bodies[row.First]);
            if (row.Second < _firstImmovable)
            {
                _bodies[row.Second].CopyTo(ref bodies[row.Second]);
            }
        }
    }

    /// <summary>Copies the impulses and the velocities of a large island back, on all threads.</summary>
    /// <param name="rebounding">Receives the places of the contacts of each group that may rebound.</param>
    public void Store(List<int>[] rebounding)
    {
        _rebounding = rebounding;
        WorkerSet.Shared.Run(ContactGraph.GroupCountOf(in _island), _maxThreads, _storeGroup);
        WorkerSet.Shared.Run((_island.BodyCount + BodiesPerJob - 1) / BodiesPerJob, _maxThreads, _storeBodies);
    }

    private ReadOnlySpan<int> MembersOf(int job)
    {
        var members = _graph!.BodiesOf(in _island);
        return members[(job * BodiesPerJob)..Math.Min(members.Length, (job + 1) * BodiesPerJob)];
    }

    private void LoadBodies(int job)
    {
        foreach (var index in MembersOf(job))
        {
            _bodies[index] = new(in _solverBodies[index]);
        }
    }

    private void StoreBodies(int job)
    {
        foreach (var index in MembersOf(job))
        {
            _bodies[index].CopyTo(ref _solverBodies[index]);
        }
    }

    private void LoadGroup(int index)
    {
        var group = _groups[index];
        var rows = _graph!.RowsOf(in _island);
        Load(group, rows, _firstImmovable + (ImmovableStride * index));
        var largest = 0.0;
        foreach (ref readonly var row in rows.Slice(group.First, group.Count))
        {
            largest = Math.Max(largest, ContactSolver.StoppingImpulse(in row, _solverBodies));
        }

        group.MaxStoppingImpulse = largest;
    }

    private void StoreGroup(int index)
    {
        var group = _groups[index];
        var rows = _graph!.RowsOf(in _island);
        var rebounding = _rebounding[index];
        rebounding.Clear();
        for (var i = group.First; i < group.First + group.Count; i++)
        {
            Store(i, ref rows[i]);
            if (rows[i].MayRebound)
            {
                rebounding.Add(i - group.First);
            }
        }
    }

    private void Begin(int rowCount, int bodyCount, ReadOnlySpan<int> partEnds)
    {
        Reserve(rowCount, bodyCount);
        SetGroups(rowCount, partEnds);
        _firstImmovable = bodyCount;
        _surfaceCount = 0;
        Array.Clear(_bodies, _firstImmovable, ImmovableCount);
        _hasTurns = false;
        _share = 0;
    }

    private void Load(Group group, ReadOnlySpan<ContactRow> rows, int immovable)
    {
        var hasTurns = false;
        for (var i = group.First; i < group.First + group.Count; i++)
        {
            ref readonly var row = ref rows[i];
            _rows[i] = new(in row, row.Second >= 0 ? row.Second : row.IsOnMovingSurface ? AddSurface(in row) : immovable);
            _changes[i] = Vector256<double>.Zero;
            _directions[i] = Vector256<double>.Zero;
            hasTurns |= Turn.SlowsDown(in row);
        }

        group.HasTurns = hasTurns;
    }

    private void LoadTurns(Group group, ReadOnlySpan<ContactRow> rows)
    {
        if (!group.HasTurns)
        {
            return;
        }

        if (!_hasTurns)
        {
            // Those of groups that have none are read as well.
            Array.Clear(_turns);
            _hasTurns = true;
        }

        for (var i = group.First; i < group.First + group.Count; i++)
        {
            _turns[i] = new(in rows[i]);
        }
    }

    private void Store(int index, ref ContactRow stored)
    {
        ref readonly var row = ref _rows[index];
        stored.NormalImpulse = row.Impulse[NormalLane];
        stored.FrictionImpulse = SimdAffineMap.ToVector(row.Impulse);
        stored.TurnImpulse = _hasTurns ? SimdAffineMap.ToVector(_turns[index].Impulse) : Vector.Zero;
    }

    /// <summary>Adds a body of infinite mass that moves like a surface.</summary>
    private int AddSurface(in ContactRow row)
    {
        var index = _firstImmovable + ImmovableCount + _surfaceCount++;
        if (index == _bodies.Length)
        {
            Array.Resize(ref _bodies, 2 * _bodies.Length);
        }

        _bodies[index] = new(new SolverBody { Velocity = row.SurfaceVelocity, Spin = row.SurfaceSpin });
        return index;
    }

    /// <summary>Makes room for contacts, and for bodies with a moving surface under each.</summary>
    public void Reserve(int rowCount, int bodyCount)
    {
        if (_bodies.Length < bodyCount + ImmovableCount)
        {
            _bodies = new Body[(2 * bodyCount) + ImmovableCount];
        }

        if (_rows.Length < rowCount)
        {
            _rows = new Row[Math.Max(rowCount, 2 * _rows.Length)];
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
