using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <content>How one contact is solved, and what of it and its bodies that needs.</content>
/// <remarks>
/// Contacts are copied to rows of two cache lines. A vector has the lanes x, y, z, 0; an impulse has friction in the lanes x, y, z, and
/// the part along the normal in the fourth.
/// </remarks>
internal sealed partial class BallContactSolver
{
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

        public static bool SlowsDown(in ContactRow row) => row.IsSlowedDown && double.IsFinite(row.TurnInertia);
    }
}
