using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <summary>
/// Finds the impulses of all contacts of an island at once: along each normal the bodies come apart at least as fast as demanded, the
/// impulse pushes only, and pushes nothing that is faster. Across the normal it stops the slip, or is as large as friction allows.
/// </summary>
/// <remarks>Projected Gauss–Seidel, for the few contacts of one body.</remarks>
internal sealed partial class ContactSolver
{
    // Relative to the largest impulse: a round that changes less has converged.
    private const double Tolerance = 1e-9;

    // Small islands converge to rounding in a few rounds, and large ones need not.
    private const double FineTolerance = 1e-13;
    private const int FineRounds = 32;
    private const int MaxRounds = 250;

    // Relative to a change of friction, in late rounds: where balls pass their slip to and fro, smaller changes come to an end.
    private const double LateFrictionShare = 0.5;

    // Relative to the momentum of a contact's bodies.
    private const double RelativeRounding = 1e-14;

    private double _frictionShare = 1;
    private double _rounding;
    private SolverBody[] _bodies = [];
    private Direction[] _changes = [];

    /// <summary>Bodies by their index in the world.</summary>
    public Span<SolverBody> Bodies => _bodies;

    /// <summary>Rounds of the last solve.</summary>
    public int Rounds { get; private set; }

    /// <summary>Makes room for the bodies of a world and their contacts.</summary>
    public void Reserve(int bodyCount, int contactCount)
    {
        _bodies = new SolverBody[bodyCount];
        _inverseInertias = new Matrix[bodyCount];
        ReserveContacts(contactCount);
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
        ReserveContacts(rows.Length);
        _rounding = ComputeRounding(rows);
        _frictionShare = 1;
        for (Rounds = 1; Rounds < MaxRounds; Rounds++)
        {
            if (MakeRound(rows, Rounds <= FineRounds ? FineTolerance : Tolerance))
            {
                return true;
            }

            _frictionShare = Rounds < MaxRounds / 2 ? 1 : LateFrictionShare;
        }

        return MakeRound(rows, Tolerance);
    }


    private void ReserveContacts(int count)
    {
        if (_changes.Length < count)
        {
            _changes = new Direction[Math.Max(count, 2 * _changes.Length)];
        }
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
}
