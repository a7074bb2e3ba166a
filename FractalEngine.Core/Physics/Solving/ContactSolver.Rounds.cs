using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <content>The rounds over contacts of which some have arms, or of few: one after the other, on the rows themselves.</content>
internal sealed partial class ContactSolver
{
    /// <summary>Solves each contact once in the order of the list, and once in the opposite one.</summary>
    private bool MakeRound(Span<ContactRow> rows, double tolerance)
    {
        for (var i = 0; i < rows.Length; i++)
        {
            _changes[i] = default;
            SolveContact(ref rows[i], ref _changes[i]);
        }

        var maxChange = 0.0;
        var maxImpulse = 0.0;
        for (var i = rows.Length - 1; i >= 0; i--)
        {
            ref var change = ref _changes[i];
            SolveContact(ref rows[i], ref change);
            maxChange = Math.Max(maxChange, Math.Max(Math.Abs(change.Normal), change.Across.MaxAbsComponent()));
            maxImpulse = Math.Max(maxImpulse, rows[i].NormalImpulse);
        }

        return maxChange <= Math.Max(tolerance * maxImpulse, _rounding);
    }

    private void SolveContact(ref ContactRow row, ref Direction change)
    {
        var missing = row.MinNormalVelocity - Vector.Dot(RelativeVelocity(in row), row.Normal);
        var impulse = Math.Max(0, row.NormalImpulse + (row.NormalMass * missing));
        var normalChange = impulse - row.NormalImpulse;
        if (normalChange != 0)
        {
            row.NormalImpulse = impulse;
            change.Normal += normalChange;
            ApplyAlongNormal(in row, normalChange);
        }

        if (row.Friction > 0 && (impulse > 0 || row.FrictionImpulse != Vector.Zero))
        {
            var across = row.FrictionImpulse - (row.FrictionMass * Slip(in row));
            var lengthSquared = across.LengthSquared();
            var limit = row.Friction * impulse;
            across = lengthSquared > limit * limit ? limit / Math.Sqrt(lengthSquared) * across : across;
            var acrossChange = _frictionShare * (across - row.FrictionImpulse);
            across = row.FrictionImpulse + acrossChange;
            row.FrictionImpulse = across;
            change.Across += acrossChange;
            ApplyAcross(in row, acrossChange);
        }

        if (row.IsSlowedDown && double.IsFinite(row.TurnInertia))
        {
            change.Turn += StopTurning(ref row);
        }
    }

    /// <summary>Slows down rolling and spinning as far as the normal impulse allows.</summary>
    private Vector StopTurning(ref ContactRow row)
    {
        var spin = _bodies[row.First].Spin - (row.Second >= 0 ? _bodies[row.Second].Spin : row.SurfaceSpin);
        var turn = row.TurnImpulse - (row.TurnInertia * spin);
        var about = Vector.Dot(turn, row.Normal);
        var rolling = turn - (about * row.Normal);
        var length = rolling.Length();
        var limit = row.RollingArm * row.NormalImpulse;
        rolling = length > limit ? limit / length * rolling : rolling;
        var spinningLimit = row.SpinningArm * row.NormalImpulse;
        var turnChange = rolling + (Math.Clamp(about, -spinningLimit, spinningLimit) * row.Normal) - row.TurnImpulse;
        row.TurnImpulse += turnChange;
        ApplyTurn(in row, turnChange);
        return turnChange;
    }

    /// <summary>A change of the impulse of one contact.</summary>
    private struct Direction
    {
        public double Normal;
        public Vector Across;
        public Vector Turn;
    }
}
