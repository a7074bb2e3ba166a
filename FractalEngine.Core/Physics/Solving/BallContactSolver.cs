using System.Runtime.Intrinsics;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Solving;

/// <summary>
/// The rounds of a <see cref="ContactSolver"/> for islands of balls. What happens along a normal turns no ball, so that one pass over both
/// bodies of a contact solves for its normal impulse and its friction. The parts of a large island are solved on all threads.
/// </summary>
/// <remarks>
/// A round goes over the contacts of each part in their order, then over those between parts forwards and backwards, then over those of
/// each part in the opposite order. In most rounds only contacts take part that push: half of those in a heap are gaps.
/// </remarks>
internal sealed partial class BallContactSolver
{
    private const int NormalLane = 3;
    private const int ImmovableStride = 2;
    private const int ImmovableCount = ImmovableStride * (IslandParts.MaxCount + 1);

    // The last group has the contacts between parts.
    private readonly Group[] _groups = [.. Enumerable.Range(0, IslandParts.MaxCount + 1).Select(static _ => new Group())];
    private readonly int _maxThreads;
    private readonly Action<int> _beginRound;
    private readonly Action<int> _endRound;
    private readonly Action<int> _loadBodies;
    private readonly Action<int> _loadGroup;
    private readonly Action<int> _storeBodies;
    private readonly Action<int> _storeGroup;
    private Body[] _bodies = [];
    private Row[] _rows = [];
    private Turn[] _turns = [];
    private Vector256<double>[] _changes = [];
    private Vector256<double>[] _directions = [];

    // The contacts of the next round of each group, in their order.
    private int[] _active = [];

    private int _partCount;
    private bool _hasTurns;
    private bool _isFull;
    private double _share;

    // The first of the bodies that stand for surfaces and for what does not give way: they have infinite mass. One of each group rests,
    // and each moving surface has its own. Threads write zeros to them, and so they are some lines of the cache apart.
    private int _firstImmovable;
    private int _surfaceCount;

    public BallContactSolver(int maxThreads)
    {
        _maxThreads = maxThreads;
        _beginRound = BeginRound;
        _endRound = EndRound;
        _loadBodies = LoadBodies;
        _loadGroup = LoadGroup;
        _storeBodies = StoreBodies;
        _storeGroup = StoreGroup;
    }

    /// <summary>Part of a change of friction that is made, from 0 to 1.</summary>
    public double FrictionShare { get; set; }

    private Group Between => _groups[_partCount];

    /// <summary>Solves each contact once in the order of the list, and once in the opposite one.</summary>
    /// <param name="isFull">False where only those contacts take part that pushed after the last full round.</param>
    /// <param name="norm">Square of the changes, weighed by masses.</param>
    /// <param name="maxImpulse">The largest impulse along a normal.</param>
    /// <returns>The largest change of an impulse.</returns>
    public double MakeRound(bool isFull, out double norm, out double maxImpulse)
    {
        _isFull = isFull;
        WorkerSet.Shared.Run(_partCount, _maxThreads, _beginRound);
        if (_partCount > 1)
        {
            BeginRound(_partCount);
            EndRound(_partCount);
        }

        WorkerSet.Shared.Run(_partCount, _maxThreads, _endRound);
        norm = 0;
        maxImpulse = 0;
        var maxChange = 0.0;
        foreach (var group in _groups.AsSpan(0, _partCount > 1 ? _partCount + 1 : 1))
        {
            norm += group.Norm;
            maxImpulse = Math.Max(maxImpulse, group.MaxImpulse);
            maxChange = Math.Max(maxChange, group.MaxChange);
        }

        return maxChange;
    }

    /// <summary>Goes on along the direction of the rounds before; at a share of 0 it begins anew.</summary>
    public void Extrapolate(double share)
    {
        // Those within parts are extrapolated when the next round begins.
        _share = share;
        Extrapolate(Between);
    }

    private void BeginRound(int index)
    {
        var group = _groups[index];
        if (index < _partCount)
        {
            Extrapolate(group);
        }

        if (_isFull)
        {
            ChooseAll(group);
        }

        foreach (var i in _active.AsSpan(group.First, group.ActiveCount))
        {
            _changes[i] = Vector256<double>.Zero;
            if (_hasTurns)
            {
                _turns[i].Change = Vector256<double>.Zero;
            }

            Solve(i);
        }
    }

    private void EndRound(int index)
    {
        var group = _groups[index];
        var norm = Vector256<double>.Zero;
        var maxImpulse = Vector256<double>.Zero;
        var largest = Vector256<double>.Zero;
        var active = _active.AsSpan(group.First, group.ActiveCount);
        for (var k = active.Length - 1; k >= 0; k--)
        {
            var i = active[k];
            Solve(i);
            var change = _changes[i];
            ref readonly var row = ref _rows[i];
            norm += Vector256.Create(row.InverseNormalMass) * (change * change);
            largest = Vector256.MaxNative(largest, Vector256.Abs(change));
            maxImpulse = Vector256.MaxNative(maxImpulse, row.Impulse);
        }

        if (_isFull)
        {
            ChooseActive(group);
        }

        group.Norm = Vector256.Sum(norm);
        group.MaxImpulse = maxImpulse[NormalLane];
        group.MaxChange = Math.Max(Math.Max(largest[0], largest[1]), Math.Max(largest[2], largest[3]));
    }

    private void Extrapolate(Group group)
    {
        var active = _active.AsSpan(group.First, group.ActiveCount);
        if (!(_share > 0))
        {
            foreach (var i in active)
            {
                _directions[i] = _changes[i];
                if (_hasTurns)
                {
                    _turns[i].Direction = _turns[i].Change;
                }
            }

            return;
        }

        var shares = Vector256.Create(_share);
        foreach (var i in active)
        {
            ref var row = ref _rows[i];
            var direction = shares * _directions[i];
            row.Impulse += direction;
            ref var first = ref _bodies[row.First];
            ref var second = ref _bodies[row.Second];
            Apply(in row, ref first, ref second, direction[NormalLane], direction.WithElement(NormalLane, 0));
            _directions[i] = direction + _changes[i];
            if (_hasTurns && _turns[i].IsSlowedDown)
            {
                ref var turn = ref _turns[i];
                turn.Direction *= shares;
                turn.Impulse += turn.Direction;
                ApplyTurn(ref first, ref second, turn.Direction);
                turn.Direction += turn.Change;
            }
        }
    }

    private void ChooseAll(Group group)
    {
        for (var i = 0; i < group.Count; i++)
        {
            _active[group.First + i] = group.First + i;
        }

        group.ActiveCount = group.Count;
    }

    private void ChooseActive(Group group)
    {
        group.ActiveCount = 0;
        for (var i = group.First; i < group.First + group.Count; i++)
        {
            if (_hasTurns || _rows[i].Impulse != Vector256<double>.Zero || _changes[i] != Vector256<double>.Zero)
            {
                _active[group.First + group.ActiveCount++] = i;
            }
            else
            {
                _directions[i] = Vector256<double>.Zero;
            }
        }
    }

    /// <summary>The contacts of a part, or those between parts, as a range of all.</summary>
    private sealed class Group
    {
        public int First { get; set; }

        public int Count { get; set; }

        public int ActiveCount { get; set; }

        public double Norm { get; set; }

        public double MaxChange { get; set; }

        public double MaxImpulse { get; set; }

        public double MaxStoppingImpulse { get; set; }

        public bool HasTurns { get; set; }
    }
}
