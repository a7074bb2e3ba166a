using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <summary>
/// Finds the impulses of all contacts of an island at once: along each normal the bodies come apart at least as fast as demanded, the
/// impulse pushes only, and pushes nothing that is faster. Across the normal it stops the slip, or is as large as friction allows.
/// </summary>
/// <remarks>Projected Gauss–Seidel, for the few contacts of one body.</remarks>
internal sealed class ContactSolver(int bodyCount = 0)
{
    // Relative to the largest impulse: a round that changes less has converged.
    private const double Tolerance = 1e-9;

    // Small islands converge to rounding in a few rounds, and large ones need not.
    private const double FineTolerance = 1e-13;
    private const int FineRounds = 32;
    private const int MaxRounds = 250;

    // Relative to the momentum of a contact's bodies.
    private const double RelativeRounding = 1e-14;

    private double _rounding;
    private SolverBody[] _bodies = new SolverBody[bodyCount];
    private Matrix[] _inverseInertias = new Matrix[bodyCount];

    /// <summary>Bodies by their index in the world.</summary>
    public Span<SolverBody> Bodies => _bodies;

    /// <summary>Rounds of the last solve.</summary>
    public int Rounds { get; private set; }

    /// <summary>Makes room for the bodies of a world.</summary>
    public void Reserve(int count)
    {
        _bodies = new SolverBody[count];
        _inverseInertias = new Matrix[count];
    }

    /// <summary>Computes the masses of a contact from those of its bodies.</summary>
    public void ComputeMasses(ref ContactRow row)
    {
        if (row.HasArms)
        {
            ComputeMassesOfArms(ref row);
            return;
        }

        ref readonly var first = ref _bodies[row.First];
        var normal = first.InverseMass;
        var spin = first.InverseInertia * row.FirstRadius * row.FirstRadius;
        if (row.Second >= 0)
        {
            ref readonly var second = ref _bodies[row.Second];
            normal += second.InverseMass;
            spin += second.InverseInertia * row.SecondRadius * row.SecondRadius;
        }

        row.TurnInertia = 1 / (first.InverseInertia + (row.Second >= 0 ? _bodies[row.Second].InverseInertia : 0));
        row.NormalMass = 1 / normal;
        row.FrictionMass = 1 / (normal + spin);
    }

    /// <summary>Velocity of the first body relative to the second.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector RelativeVelocity(in ContactRow row) => row.HasArms ? RelativeVelocityOfArms(in row)
        : _bodies[row.First].Velocity - (row.Second >= 0 ? _bodies[row.Second].Velocity : row.SurfaceVelocity);

    /// <summary>Velocity of the first body's touching point relative to the second's, across the normal.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector Slip(in ContactRow row)
    {
        var relative = RelativeVelocity(in row);
        var spin = row.FirstRadius * _bodies[row.First].Spin;
        if (row.Second >= 0)
        {
            spin += row.SecondRadius * _bodies[row.Second].Spin;
        }

        return relative - (Vector.Dot(relative, row.Normal) * row.Normal) + Vector.Cross(row.Normal, spin);
    }

    /// <summary>Gives both bodies an impulse.</summary>
    /// <param name="row">The contact.</param>
    /// <param name="alongNormal">Its part along the normal.</param>
    /// <param name="across">Its part across the normal.</param>
    public void Apply(in ContactRow row, double alongNormal, Vector across)
    {
        ApplyAlongNormal(in row, alongNormal);
        if (row.Friction > 0)
        {
            ApplyAcross(in row, across);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private void ApplyAlongNormal(in ContactRow row, double impulse)
    {
        if (row.HasArms)
        {
            ApplyToArms(in row, impulse * row.Normal);
            return;
        }

        ref var first = ref _bodies[row.First];
        first.Velocity += first.InverseMass * impulse * row.Normal;
        if (row.Second >= 0)
        {
            ref var second = ref _bodies[row.Second];
            second.Velocity -= second.InverseMass * impulse * row.Normal;
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private void ApplyAcross(in ContactRow row, Vector across)
    {
        if (row.HasArms)
        {
            ApplyToArms(in row, across);
            return;
        }

        var torque = Vector.Cross(row.Normal, across);
        ref var first = ref _bodies[row.First];
        first.Velocity += first.InverseMass * across;
        first.Spin -= first.InverseInertia * row.FirstRadius * torque;
        if (row.Second >= 0)
        {
            ref var second = ref _bodies[row.Second];
            second.Velocity -= second.InverseMass * across;
            second.Spin -= second.InverseInertia * row.SecondRadius * torque;
        }
    }

    /// <summary>Solves for the impulses. Those of the rows must have been given to the bodies already.</summary>
    /// <param name="rows">All contacts of an island; receive the impulses.</param>
    /// <returns>False where it has not converged: then the impulses are those of the last round.</returns>
    public bool Solve(Span<ContactRow> rows)
    {
        _rounding = ComputeRounding(rows);
        for (Rounds = 1; Rounds < MaxRounds; Rounds++)
        {
            if (MakeRound(rows, Rounds <= FineRounds ? FineTolerance : Tolerance))
            {
                return true;
            }
        }

        return MakeRound(rows, Tolerance);
    }

    /// <summary>Impulses that rounding cannot tell from 0: those of bodies that barely approach have no larger digits.</summary>
    private double ComputeRounding(Span<ContactRow> rows)
    {
        var impulse = 0.0;
        foreach (ref readonly var row in rows)
        {
            var speed = _bodies[row.First].Velocity.MaxAbsComponent();
            speed = row.Second >= 0 ? Math.Max(speed, _bodies[row.Second].Velocity.MaxAbsComponent()) : speed;
            impulse = Math.Max(impulse, row.NormalMass * speed);
        }

        return RelativeRounding * impulse;
    }

    /// <summary>Gives both bodies an angular impulse.</summary>
    public void ApplyTurn(in ContactRow row, Vector turn)
    {
        _bodies[row.First].Spin += SpinChange(row.First, turn);
        if (row.Second >= 0)
        {
            _bodies[row.Second].Spin -= SpinChange(row.Second, turn);
        }
    }

    /// <summary>Sets the velocities and inverse masses of a body.</summary>
    public void Load(int index, Body body)
    {
        _bodies[index] = new()
        {
            Velocity = body.Velocity, Spin = body.AngularVelocity, InverseMass = 1 / body.Description.Mass,
            InverseInertia = body.InverseInertia, IsCompound = body.IsCompound,
        };
        if (body.IsCompound)
        {
            _inverseInertias[index] = body.InverseInertiaTensor;
        }
    }

    /// <summary>Change of a body's angular velocity by an angular impulse.</summary>
    private Vector SpinChange(int body, Vector turn) =>
        _bodies[body].IsCompound ? _inverseInertias[body] * turn : _bodies[body].InverseInertia * turn;

    private void ComputeMassesOfArms(ref ContactRow row)
    {
        var alongNormal = _bodies[row.First].InverseMass + InverseInertiaAlong(row.First, row.FirstArm, row.Normal);
        var inverseInertia = _bodies[row.First].InverseInertia;
        var tangent = Vector.Cross(row.Normal, Math.Abs(row.Normal.X) < 0.5 ? Vector.I : Vector.J).UnitVector();
        var bitangent = Vector.Cross(row.Normal, tangent);
        var across = AcrossMatrix(row.First, row.FirstArm - (row.FirstRadius * row.Normal), tangent, bitangent);
        if (row.Second >= 0)
        {
            alongNormal += _bodies[row.Second].InverseMass + InverseInertiaAlong(row.Second, row.SecondArm, row.Normal);
            inverseInertia += _bodies[row.Second].InverseInertia;
            across += AcrossMatrix(row.Second, row.SecondArm + (row.SecondRadius * row.Normal), tangent, bitangent);
        }

        row.NormalMass = 1 / alongNormal;
        row.TurnInertia = 1 / inverseInertia;
        // Friction is as heavy in one direction as in the other only for balls. The lighter one keeps each change from going too far.
        row.FrictionMass = 1 / ((0.5 * (across.X + across.Z)) + double.Hypot(0.5 * (across.X - across.Z), across.Y));
    }

    private double InverseInertiaAlong(int body, Vector arm, Vector direction)
    {
        var torque = Vector.Cross(arm, direction);
        return Vector.Dot(torque, SpinChange(body, torque));
    }

    /// <summary>
    /// The symmetric 2 × 2 matrix of inverse masses across the normal: both diagonal entries, and in between the other one.
    /// </summary>
    private Vector AcrossMatrix(int body, Vector arm, Vector tangent, Vector bitangent)
    {
        var first = Vector.Cross(arm, tangent);
        var second = Vector.Cross(arm, bitangent);
        var change = SpinChange(body, first);
        var inverseMass = _bodies[body].InverseMass;
        return new(
            inverseMass + Vector.Dot(first, change),
            Vector.Dot(second, change),
            inverseMass + Vector.Dot(second, SpinChange(body, second)));
    }

    /// <summary>Velocity of the first ball's centre relative to the second's.</summary>
    private Vector RelativeVelocityOfArms(in ContactRow row)
    {
        ref readonly var first = ref _bodies[row.First];
        var velocity = first.Velocity + Vector.Cross(first.Spin, row.FirstArm);
        if (row.Second >= 0)
        {
            ref readonly var second = ref _bodies[row.Second];
            return velocity - second.Velocity - Vector.Cross(second.Spin, row.SecondArm);
        }

        return velocity - row.SurfaceVelocity;
    }

    /// <summary>Gives both bodies an impulse where they touch.</summary>
    private void ApplyToArms(in ContactRow row, Vector impulse)
    {
        ref var first = ref _bodies[row.First];
        first.Velocity += first.InverseMass * impulse;
        first.Spin += SpinChange(row.First, Vector.Cross(row.FirstArm - (row.FirstRadius * row.Normal), impulse));
        if (row.Second >= 0)
        {
            ref var second = ref _bodies[row.Second];
            second.Velocity -= second.InverseMass * impulse;
            second.Spin -= SpinChange(row.Second, Vector.Cross(row.SecondArm + (row.SecondRadius * row.Normal), impulse));
        }
    }

    /// <summary>Solves each contact once in the order of the list, and once in the opposite one.</summary>
    private bool MakeRound(Span<ContactRow> rows, double tolerance)
    {
        foreach (ref var row in rows)
        {
            _ = SolveContact(ref row);
        }

        var (maxChange, maxImpulse) = (0.0, 0.0);
        for (var i = rows.Length - 1; i >= 0; i--)
        {
            maxChange = Math.Max(maxChange, SolveContact(ref rows[i]));
            maxImpulse = Math.Max(maxImpulse, rows[i].NormalImpulse);
        }

        return maxChange <= Math.Max(tolerance * maxImpulse, _rounding);
    }

    /// <summary>Corrects the impulses of a contact.</summary>
    /// <returns>By how much they have changed.</returns>
    private double SolveContact(ref ContactRow row)
    {
        var missing = row.MinNormalVelocity - Vector.Dot(RelativeVelocity(in row), row.Normal);
        var impulse = Math.Max(0, row.NormalImpulse + (row.NormalMass * missing));
        var normalChange = impulse - row.NormalImpulse;
        var change = Math.Abs(normalChange);
        if (normalChange != 0)
        {
            row.NormalImpulse = impulse;
            ApplyAlongNormal(in row, normalChange);
        }

        if (row.Friction > 0 && (impulse > 0 || row.FrictionImpulse != Vector.Zero))
        {
            var across = row.FrictionImpulse - (row.FrictionMass * Slip(in row));
            var lengthSquared = across.LengthSquared();
            var limit = row.Friction * impulse;
            across = lengthSquared > limit * limit ? limit / Math.Sqrt(lengthSquared) * across : across;
            var acrossChange = across - row.FrictionImpulse;
            row.FrictionImpulse = across;
            change = Math.Max(change, acrossChange.MaxAbsComponent());
            ApplyAcross(in row, acrossChange);
        }

        if (row.IsSlowedDown && double.IsFinite(row.TurnInertia))
        {
            StopTurning(ref row);
        }

        return change;
    }

    /// <summary>Slows down rolling and spinning as far as the normal impulse allows.</summary>
    private void StopTurning(ref ContactRow row)
    {
        var spin = _bodies[row.First].Spin - (row.Second >= 0 ? _bodies[row.Second].Spin : row.SurfaceSpin);
        var turn = row.TurnImpulse - (row.TurnInertia * spin);
        var about = Vector.Dot(turn, row.Normal);
        var rolling = (turn - (about * row.Normal)).ShortenedTo(row.RollingArm * row.NormalImpulse);
        var spinningLimit = row.SpinningArm * row.NormalImpulse;
        var turnChange = rolling + (Math.Clamp(about, -spinningLimit, spinningLimit) * row.Normal) - row.TurnImpulse;
        row.TurnImpulse += turnChange;
        ApplyTurn(in row, turnChange);
    }
}
