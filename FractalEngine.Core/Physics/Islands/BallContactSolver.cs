using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// The rounds of a <see cref="ContactSolver"/> for islands of balls. What happens along a normal turns no ball, so that one pass over both
/// bodies of a contact solves for its normal impulse and its friction.
/// </summary>
/// <remarks>
/// Contacts are copied to rows of two cache lines. A vector has the lanes x, y, z, 0; an impulse has friction in the lanes x, y, z, and
/// the part along the normal in the fourth. In most rounds only contacts take part that push: half of those in a heap are gaps.
/// </remarks>
internal sealed class BallContactSolver
{
    private const int InitialCapacity = 256;
    private const int ContactsPerBody = 4;
    private const int NormalLane = 3;

    private Body[] _bodies = new Body[InitialCapacity + 1];
    private Row[] _rows = new Row[InitialCapacity];
    private Turn[] _turns = new Turn[InitialCapacity];
    private Vector256<double>[] _changes = new Vector256<double>[InitialCapacity];
    private Vector256<double>[] _directions = new Vector256<double>[InitialCapacity];

    // The contacts of the next round, in their order.
    private int[] _active = new int[InitialCapacity];
    private int _activeCount;
    private int _count;
    private bool _hasTurns;

    // The body of surfaces and of bodies that do not give way: it has no velocity, and none is given to it.
    private int _firm;

    /// <summary>Part of a change of friction that is made, from 0 to 1.</summary>
    public double FrictionShare { get; set; }

    /// <summary>Copies the contacts of an island and their bodies.</summary>
    public void Load(ReadOnlySpan<ContactRow> rows, ReadOnlySpan<SolverBody> bodies)
    {
        Reserve(rows.Length, bodies.Length);
        _count = rows.Length;
        _firm = bodies.Length;
        _bodies[_firm] = default;
        _hasTurns = false;
        for (var i = 0; i < rows.Length; i++)
        {
            ref readonly var row = ref rows[i];
            _bodies[row.First] = new(in bodies[row.First]);
            if (row.Second >= 0)
            {
                _bodies[row.Second] = new(in bodies[row.Second]);
            }

            _rows[i] = new(in row, row.Second >= 0 ? row.Second : _firm);
            _hasTurns |= Turn.SlowsDown(in row);
        }

        for (var i = 0; _hasTurns && i < rows.Length; i++)
        {
            _turns[i] = new(in rows[i]);
        }
    }

    /// <summary>Copies the impulses and the velocities back.</summary>
    public void Store(Span<ContactRow> rows, Span<SolverBody> bodies)
    {
        for (var i = 0; i < rows.Length; i++)
        {
            ref readonly var row = ref _rows[i];
            rows[i].NormalImpulse = row.Impulse[NormalLane];
            rows[i].FrictionImpulse = SimdAffineMap.ToVector(row.Impulse);
            rows[i].TurnImpulse = _hasTurns ? SimdAffineMap.ToVector(_turns[i].Impulse) : Vector.Zero;
            _bodies[row.First].CopyTo(ref bodies[row.First]);
            if (row.Second != _firm)
            {
                _bodies[row.Second].CopyTo(ref bodies[row.Second]);
            }
        }
    }

    /// <summary>Solves each contact once in the order of the list, and once in the opposite one.</summary>
    /// <param name="isFull">False where only those contacts take part that pushed after the last full round.</param>
    /// <param name="norm">Square of the changes, weighed by masses.</param>
    /// <param name="maxImpulse">The largest impulse along a normal.</param>
    /// <returns>The largest change of an impulse.</returns>
    public double MakeRound(bool isFull, out double norm, out double maxImpulse)
    {
        if (isFull)
        {
            ChooseAll();
        }

        var active = _active.AsSpan(0, _activeCount);
        var changes = _changes;
        foreach (var i in active)
        {
            changes[i] = Vector256<double>.Zero;
            if (_hasTurns)
            {
                _turns[i].Change = Vector256<double>.Zero;
            }

            Solve(i);
        }

        norm = 0;
        maxImpulse = 0;
        var largest = Vector256<double>.Zero;
        for (var k = active.Length - 1; k >= 0; k--)
        {
            var i = active[k];
            Solve(i);
            var change = changes[i];
            norm += Vector256.Dot(change, change) * _rows[i].InverseNormalMass;
            largest = Vector256.MaxNative(largest, Vector256.Abs(change));
            maxImpulse = Math.Max(maxImpulse, _rows[i].Impulse[NormalLane]);
        }

        if (isFull)
        {
            ChooseActive();
        }

        return Math.Max(Math.Max(largest[0], largest[1]), Math.Max(largest[2], largest[3]));
    }

    /// <summary>Goes on along the direction of the rounds before; at a share of 0 it begins anew.</summary>
    public void Extrapolate(double share)
    {
        if (!(share > 0))
        {
            foreach (var i in _active.AsSpan(0, _activeCount))
            {
                _directions[i] = _changes[i];
                if (_hasTurns)
                {
                    _turns[i].Direction = _turns[i].Change;
                }
            }

            return;
        }

        var shares = Vector256.Create(share);
        foreach (var i in _active.AsSpan(0, _activeCount))
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

    private void Reserve(int rowCount, int bodyCount)
    {
        if (_bodies.Length <= bodyCount)
        {
            _bodies = new Body[bodyCount + 1];
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

    private void ChooseAll()
    {
        for (var i = 0; i < _count; i++)
        {
            _active[i] = i;
        }

        _activeCount = _count;
    }

    private void ChooseActive()
    {
        _activeCount = 0;
        for (var i = 0; i < _count; i++)
        {
            if (_hasTurns || _rows[i].Impulse != Vector256<double>.Zero || _changes[i] != Vector256<double>.Zero)
            {
                _active[_activeCount++] = i;
            }
            else
            {
                _directions[i] = Vector256<double>.Zero;
            }
        }
    }

    private void Solve(int index)
    {
        ref var row = ref _rows[index];
        ref var first = ref _bodies[row.First];
        ref var second = ref _bodies[row.Second];
        var normal = row.Normal;
        var impulse = row.Impulse;
        var alongNormal = impulse[NormalLane];
        var relative = first.Velocity - second.Velocity;
        var speed = Vector256.Dot(relative, normal);
        var newAlongNormal = Math.Max(0, alongNormal + (row.NormalMass * (row.MinNormalVelocity - speed)));
        if (newAlongNormal == 0 && impulse == Vector256<double>.Zero && !_hasTurns)
        {
            return;
        }

        var change = newAlongNormal - alongNormal;
        var across = Vector256<double>.Zero;
        var acrossChange = Vector256<double>.Zero;
        if (row.Friction > 0)
        {
            // The change along the normal turns nothing, and leaves the slip as it is.
            var oldAcross = impulse.WithElement(NormalLane, 0);
            var spin = (Vector256.Create(row.FirstRadius) * first.Spin) + (Vector256.Create(row.SecondRadius) * second.Spin);
            var slip = relative - (Vector256.Create(speed) * normal) + Cross(normal, spin);
            across = oldAcross - (Vector256.Create(row.FrictionMass) * slip);
            var squared = Vector256.Dot(across, across);
            var limit = row.Friction * newAlongNormal;
            if (squared > limit * limit)
            {
                across *= Vector256.Create(limit / Math.Sqrt(squared));
            }

            acrossChange = Vector256.Create(FrictionShare) * (across - oldAcross);
            across = oldAcross + acrossChange;
        }

        row.Impulse = across.WithElement(NormalLane, newAlongNormal);
        _changes[index] += acrossChange.WithElement(NormalLane, change);
        Apply(in row, ref first, ref second, change, acrossChange);
        if (_hasTurns && _turns[index].IsSlowedDown)
        {
            StopTurning(in row, ref _turns[index], ref first, ref second);
        }
    }

    /// <summary>Slows down rolling and spinning as far as the normal impulse allows.</summary>
    private static void StopTurning(in Row row, ref Turn turn, ref Body first, ref Body second)
    {
        var impulse = turn.Impulse - (Vector256.Create(turn.Inertia) * (first.Spin - second.Spin));
        var about = Vector256.Dot(impulse, row.Normal);
        var rolling = impulse - (Vector256.Create(about) * row.Normal);
        var length = Math.Sqrt(Vector256.Dot(rolling, rolling));
        var limit = turn.RollingArm * row.Impulse[NormalLane];
        rolling *= Vector256.Create(length > limit ? limit / length : 1);
        var spinningLimit = turn.SpinningArm * row.Impulse[NormalLane];
        var change = rolling + (Vector256.Create(Math.Clamp(about, -spinningLimit, spinningLimit)) * row.Normal) - turn.Impulse;
        turn.Impulse += change;
        turn.Change += change;
        ApplyTurn(ref first, ref second, change);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static void Apply(in Row row, ref Body first, ref Body second, double alongNormal, Vector256<double> across)
    {
        var push = (Vector256.Create(alongNormal) * row.Normal) + across;
        first.Velocity += Vector256.Create(first.InverseMass) * push;
        second.Velocity -= Vector256.Create(second.InverseMass) * push;
        if (row.Friction > 0)
        {
            var torque = Cross(row.Normal, across);
            first.Spin -= Vector256.Create(first.InverseInertia * row.FirstRadius) * torque;
            second.Spin -= Vector256.Create(second.InverseInertia * row.SecondRadius) * torque;
        }
    }

    private static void ApplyTurn(ref Body first, ref Body second, Vector256<double> turn)
    {
        first.Spin += Vector256.Create(first.InverseInertia) * turn;
        second.Spin -= Vector256.Create(second.InverseInertia) * turn;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> Cross(Vector256<double> a, Vector256<double> b) =>
        Rotate((a * Rotate(b)) - (Rotate(a) * b));

    /// <summary>Moves the lanes x, y, z to y, z, x.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> Rotate(Vector256<double> v) => Vector256.Shuffle(v, Vector256.Create(1L, 2, 0, 3));

    private struct Body
    {
        public Vector256<double> Velocity;
        public Vector256<double> Spin;
        public readonly double InverseMass;
        public readonly double InverseInertia;

        public Body(in SolverBody body)
        {
            Velocity = SimdAffineMap.ToVector256(body.Velocity);
            Spin = SimdAffineMap.ToVector256(body.Spin);
            InverseMass = body.InverseMass;
            InverseInertia = body.InverseInertia;
        }

        public readonly void CopyTo(ref SolverBody body)
        {
            body.Velocity = SimdAffineMap.ToVector(Velocity);
            body.Spin = SimdAffineMap.ToVector(Spin);
        }
    }

    /// <summary>A contact without what only few of them have: 128 bytes.</summary>
    private struct Row
    {
        public readonly Vector256<double> Normal;
        public Vector256<double> Impulse;
        public readonly double MinNormalVelocity;
        public readonly double NormalMass;
        public readonly double InverseNormalMass;
        public readonly double FrictionMass;
        public readonly double Friction;
        public readonly double FirstRadius;
        public readonly double SecondRadius;
        public readonly int First;
        public readonly int Second;

        public Row(in ContactRow row, int second)
        {
            Normal = SimdAffineMap.ToVector256(row.Normal);
            Impulse = Vector256.Create(row.FrictionImpulse.X, row.FrictionImpulse.Y, row.FrictionImpulse.Z, row.NormalImpulse);
            MinNormalVelocity = row.MinNormalVelocity;
            NormalMass = row.NormalMass;
            InverseNormalMass = 1 / row.NormalMass;
            FrictionMass = row.FrictionMass;
            Friction = row.Friction;
            FirstRadius = row.FirstRadius;
            SecondRadius = row.SecondRadius;
            First = row.First;
            Second = second;
        }
    }

    /// <summary>What slows down rolling and spinning at a contact.</summary>
    private struct Turn
    {
        public Vector256<double> Impulse;
        public Vector256<double> Change;
        public Vector256<double> Direction;
        public readonly double RollingArm;
        public readonly double SpinningArm;
        public readonly double Inertia;
        public readonly bool IsSlowedDown;

        public Turn(in ContactRow row)
        {
            Impulse = SimdAffineMap.ToVector256(row.TurnImpulse);
            RollingArm = row.RollingArm;
            SpinningArm = row.SpinningArm;
            Inertia = row.TurnInertia;
            IsSlowedDown = SlowsDown(in row);
        }

        public static bool SlowsDown(in ContactRow row) => row.RollingArm + row.SpinningArm > 0 && double.IsFinite(row.TurnInertia);
    }
}
