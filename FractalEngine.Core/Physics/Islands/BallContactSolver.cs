using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// The rounds of a <see cref="ContactSolver"/> for large islands of balls. What happens along a normal turns no ball, so that one pass over
/// both bodies of a contact solves for its normal impulse and its friction.
/// </summary>
/// <remarks>Contacts are copied to rows of two cache lines. A vector has the lanes x, y, z, 0.</remarks>
internal sealed class BallContactSolver
{
    private const int InitialCapacity = 256;
    private const int ContactsPerBody = 4;

    private Body[] _bodies = new Body[InitialCapacity + 1];
    private Row[] _rows = new Row[InitialCapacity];
    private Change[] _changes = new Change[InitialCapacity];
    private Change[] _directions = new Change[InitialCapacity];
    private int _count;

    // The body of surfaces and of bodies that do not give way: it has no velocity, and none is given to it.
    private int _firm;

    /// <summary>Part of a change of friction that is made, from 0 to 1.</summary>
    public double FrictionShare { get; set; }

    /// <summary>Copies the contacts of an island and their bodies.</summary>
    public void Load(ReadOnlySpan<ContactRow> rows, ReadOnlySpan<SolverBody> bodies)
    {
        if (_bodies.Length <= bodies.Length)
        {
            _bodies = new Body[bodies.Length + 1];
        }

        if (_rows.Length < rows.Length)
        {
            // At once for all bodies, so that islands that grow allocate nothing.
            _rows = new Row[Math.Max(2 * rows.Length, ContactsPerBody * bodies.Length)];
            _changes = new Change[_rows.Length];
            _directions = new Change[_rows.Length];
        }

        _count = rows.Length;
        _firm = bodies.Length;
        _bodies[_firm] = default;
        for (var i = 0; i < rows.Length; i++)
        {
            ref readonly var row = ref rows[i];
            _bodies[row.First] = new(in bodies[row.First]);
            if (row.Second >= 0)
            {
                _bodies[row.Second] = new(in bodies[row.Second]);
            }

            _rows[i] = new(in row, row.Second >= 0 ? row.Second : _firm);
        }
    }

    /// <summary>Copies the impulses and the velocities back.</summary>
    public void Store(Span<ContactRow> rows, Span<SolverBody> bodies)
    {
        for (var i = 0; i < rows.Length; i++)
        {
            ref readonly var row = ref _rows[i];
            rows[i].NormalImpulse = row.NormalImpulse;
            rows[i].FrictionImpulse = SimdAffineMap.ToVector(row.FrictionImpulse);
            rows[i].TurnImpulse = SimdAffineMap.ToVector(row.TurnImpulse);
            _bodies[row.First].CopyTo(ref bodies[row.First]);
            if (row.Second != _firm)
            {
                _bodies[row.Second].CopyTo(ref bodies[row.Second]);
            }
        }
    }

    /// <summary>Solves each contact once in the order of the list, and once in the opposite one.</summary>
    /// <param name="norm">Square of the changes, weighed by masses.</param>
    /// <param name="maxImpulse">The largest impulse along a normal.</param>
    /// <returns>The largest change of an impulse.</returns>
    public double MakeRound(out double norm, out double maxImpulse)
    {
        var bodies = _bodies;
        var rows = _rows.AsSpan(0, _count);
        var changes = _changes.AsSpan(0, _count);
        for (var i = 0; i < rows.Length; i++)
        {
            changes[i] = default;
            Solve(ref rows[i], ref changes[i], bodies);
        }

        norm = 0;
        maxImpulse = 0;
        var largest = Vector256<double>.Zero;
        for (var i = rows.Length - 1; i >= 0; i--)
        {
            ref var change = ref changes[i];
            ref var row = ref rows[i];
            Solve(ref row, ref change, bodies);
            norm += ((change.Normal * change.Normal) + Dot(change.Across, change.Across)) * row.InverseNormalMass;
            largest = Vector256.MaxNative(
                largest, Vector256.MaxNative(Vector256.Abs(change.Across), Vector256.Create(Math.Abs(change.Normal))));
            maxImpulse = Math.Max(maxImpulse, row.NormalImpulse);
        }

        return Math.Max(Math.Max(largest[0], largest[1]), Math.Max(largest[2], largest[3]));
    }

    /// <summary>Goes on along the direction of the rounds before; at a share of 0 it begins anew.</summary>
    public void Extrapolate(double share)
    {
        var changes = _changes.AsSpan(0, _count);
        var directions = _directions.AsSpan(0, _count);
        if (!(share > 0))
        {
            changes.CopyTo(directions);
            return;
        }

        var bodies = _bodies;
        var rows = _rows.AsSpan(0, _count);
        var shares = Vector256.Create(share);
        for (var i = 0; i < rows.Length; i++)
        {
            ref var row = ref rows[i];
            ref var direction = ref directions[i];
            ref readonly var change = ref changes[i];
            direction.Normal *= share;
            direction.Across *= shares;
            row.NormalImpulse += direction.Normal;
            row.FrictionImpulse += direction.Across;
            ref var first = ref bodies[row.First];
            ref var second = ref bodies[row.Second];
            Apply(ref row, ref first, ref second, direction.Normal, direction.Across);
            direction.Normal += change.Normal;
            direction.Across += change.Across;
            if (row.IsSlowedDown)
            {
                direction.Turn *= shares;
                row.TurnImpulse += direction.Turn;
                ApplyTurn(ref first, ref second, direction.Turn);
                direction.Turn += change.Turn;
            }
        }
    }

    private void Solve(ref Row row, ref Change change, Body[] bodies)
    {
        ref var first = ref bodies[row.First];
        ref var second = ref bodies[row.Second];
        var normal = row.Normal;
        var relative = first.Velocity - second.Velocity;
        var speed = Dot(relative, normal);
        var impulse = Math.Max(0, row.NormalImpulse + (row.NormalMass * (row.MinNormalVelocity - speed)));
        var normalChange = impulse - row.NormalImpulse;
        row.NormalImpulse = impulse;
        change.Normal += normalChange;
        if (!row.HasFriction)
        {
            var push = Vector256.Create(normalChange) * normal;
            first.Velocity += Vector256.Create(first.InverseMass) * push;
            second.Velocity -= Vector256.Create(second.InverseMass) * push;
        }
        else if (impulse > 0 || row.FrictionImpulse != Vector256<double>.Zero)
        {
            // The change along the normal turns nothing, and leaves the slip as it is.
            var spin = (Vector256.Create(row.FirstRadius) * first.Spin) + (Vector256.Create(row.SecondRadius) * second.Spin);
            var slip = relative - (Vector256.Create(speed) * normal) + Cross(normal, spin);
            var across = row.FrictionImpulse - (Vector256.Create(row.FrictionMass) * slip);
            var squared = Dot(across, across);
            var limit = row.Friction * impulse;
            across *= Vector256.Create(squared > limit * limit ? limit / Math.Sqrt(squared) : 1);
            var acrossChange = Vector256.Create(FrictionShare) * (across - row.FrictionImpulse);
            row.FrictionImpulse += acrossChange;
            change.Across += acrossChange;
            Apply(ref row, ref first, ref second, normalChange, acrossChange);
        }

        if (row.IsSlowedDown)
        {
            StopTurning(ref row, ref change, ref first, ref second);
        }
    }

    /// <summary>Slows down rolling and spinning as far as the normal impulse allows.</summary>
    private static void StopTurning(ref Row row, ref Change change, ref Body first, ref Body second)
    {
        var turn = row.TurnImpulse - (Vector256.Create(row.TurnInertia) * (first.Spin - second.Spin));
        var about = Dot(turn, row.Normal);
        var rolling = turn - (Vector256.Create(about) * row.Normal);
        var length = Math.Sqrt(Dot(rolling, rolling));
        var limit = row.RollingArm * row.NormalImpulse;
        rolling *= Vector256.Create(length > limit ? limit / length : 1);
        var spinningLimit = row.SpinningArm * row.NormalImpulse;
        var turnChange = rolling + (Vector256.Create(Math.Clamp(about, -spinningLimit, spinningLimit)) * row.Normal) - row.TurnImpulse;
        row.TurnImpulse += turnChange;
        change.Turn += turnChange;
        ApplyTurn(ref first, ref second, turnChange);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static void Apply(ref Row row, ref Body first, ref Body second, double alongNormal, Vector256<double> across)
    {
        var push = (Vector256.Create(alongNormal) * row.Normal) + across;
        first.Velocity += Vector256.Create(first.InverseMass) * push;
        second.Velocity -= Vector256.Create(second.InverseMass) * push;
        if (row.HasFriction)
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
    private static double Dot(Vector256<double> a, Vector256<double> b)
    {
        var product = a * b;
        var pair = product.GetLower() + product.GetUpper();
        return pair[0] + pair[1];
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

    private struct Row
    {
        public readonly Vector256<double> Normal;
        public Vector256<double> FrictionImpulse;
        public Vector256<double> TurnImpulse;
        public double NormalImpulse;
        public readonly double MinNormalVelocity;
        public readonly double NormalMass;
        public readonly double InverseNormalMass;
        public readonly double FrictionMass;
        public readonly double Friction;
        public readonly double FirstRadius;
        public readonly double SecondRadius;
        public readonly double RollingArm;
        public readonly double SpinningArm;
        public readonly double TurnInertia;
        public readonly int First;
        public readonly int Second;
        public readonly bool HasFriction;
        public readonly bool IsSlowedDown;

        public Row(in ContactRow row, int second)
        {
            Normal = SimdAffineMap.ToVector256(row.Normal);
            FrictionImpulse = SimdAffineMap.ToVector256(row.FrictionImpulse);
            TurnImpulse = SimdAffineMap.ToVector256(row.TurnImpulse);
            NormalImpulse = row.NormalImpulse;
            MinNormalVelocity = row.MinNormalVelocity;
            NormalMass = row.NormalMass;
            InverseNormalMass = 1 / row.NormalMass;
            FrictionMass = row.FrictionMass;
            Friction = row.Friction;
            FirstRadius = row.FirstRadius;
            SecondRadius = row.SecondRadius;
            RollingArm = row.RollingArm;
            SpinningArm = row.SpinningArm;
            TurnInertia = row.TurnInertia;
            First = row.First;
            Second = second;
            HasFriction = row.Friction > 0;
            IsSlowedDown = row.RollingArm + row.SpinningArm > 0 && double.IsFinite(row.TurnInertia);
        }
    }

    private struct Change
    {
        public double Normal;
        public Vector256<double> Across;
        public Vector256<double> Turn;
    }
}
