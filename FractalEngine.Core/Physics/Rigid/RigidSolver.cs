using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// Finds the velocities of bodies that touch: sequential impulses in many small steps (Macklin et al. 2019). What is too close at the end
/// is moved apart without a change of velocities.
/// </summary>
internal static class RigidSolver
{
    private const int Rounds = 4;
    private const int BounceRounds = 4;

    // Rounds of displacements, and at most so many where gaps are too small afterwards.
    private const int DisplacementRounds = 4;
    private const int MaxDisplacementRounds = 100;

    // Part of what a gap misses that is restored in a substep.
    private const double RestoredFraction = 0.03;

    // Relative to the contact distance: by how much gaps may be too small at the end, and what is left of more.
    private const double MaxOverlap = 0.5;
    private const double KeptOverlap = 0.4;

    /// <summary>Finds the velocities of bodies with contacts in a substep, and moves them by these.</summary>
    /// <param name="states">The bodies, and what no force moves.</param>
    /// <param name="rows">The contacts; their impulses are those of the last substep for a start.</param>
    /// <param name="substep">Length of the substep, seconds.</param>
    /// <param name="maxAngle">Radians that a body may turn.</param>
    /// <returns>The seconds that have been made: fewer where a body would turn farther.</returns>
    public static double Solve(Span<RigidState> states, Span<RigidRow> rows, double substep, double maxAngle)
    {
        foreach (ref var row in rows)
        {
            Prepare(ref row, states);
        }

        Accelerate(states, substep);
        WarmStart(states, rows);
        SolveRounds(states, rows, substep);
        var made = MadeOf(states, substep, maxAngle);
        Move(states, made);
        Bounce(states, rows);
        RestoreGaps(states, rows);
        Accelerate(states, made - substep);
        return made;
    }

    /// <summary>The seconds of a substep in which no body turns farther than an angle.</summary>
    private static double MadeOf(ReadOnlySpan<RigidState> states, double substep, double maxAngle)
    {
        var made = substep;
        foreach (ref readonly var state in states)
        {
            made = state.IsDynamic && maxAngle < made * state.Spin.Length() ? maxAngle / state.Spin.Length() : made;
        }

        return made;
    }

    /// <summary>Moves bodies apart that are too close at the end. Their velocities stay as they are.</summary>
    private static void RestoreGaps(Span<RigidState> states, Span<RigidRow> rows)
    {
        foreach (ref var state in states)
        {
            state.TravelMoved = state.Travel;
            state.TurnMoved = state.Turn;
        }

        for (var i = 0; i < rows.Length; i++)
        {
            rows[i].Displacement = 0;
            rows[i].CurrentGap = Math.Max(
                (1 - RestoredFraction) * Math.Min(0, GapNow(in rows[i], states)), -KeptOverlap * rows[i].Distance);
        }

        var isTooClose = true;
        for (var round = 0; round < (isTooClose ? MaxDisplacementRounds : DisplacementRounds); round++)
        {
            isTooClose = false;
            for (var i = 0; i < rows.Length; i++)
            {
                ref var row = ref rows[i];
                var gap = GapNow(in row, states);
                isTooClose |= gap < -MaxOverlap * rows[i].Distance;
                var displacement = Math.Max(0, row.Displacement + (row.NormalMass * (row.CurrentGap - gap)));
                var change = (displacement - row.Displacement) * row.Normal;
                row.Displacement = displacement;
                if (change != Vector.Zero)
                {
                    ref var first = ref states[row.First];
                    ref var second = ref states[row.Second];
                    first.Displace(first.Turn.Rotate(row.Arm1), change);
                    second.Displace(second.Turn.Rotate(row.Arm2), -change);
                }
            }
        }

        foreach (ref var state in states)
        {
            if (state.IsDynamic && state.Turn != state.TurnMoved)
            {
                state.TurnTo(state.Turn, state.TurnMoved);
            }
        }
    }

    private static double GapNow(in RigidRow row, Span<RigidState> states) =>
        row.Gap - Vector.Dot(row.Normal, row.Between(in states[row.First], in states[row.Second]));

    private static void Accelerate(Span<RigidState> states, double substep)
    {
        if (substep == 0)
        {
            return;
        }

        foreach (ref var state in states)
        {
            if (state.HasContacts && state.IsDynamic && !state.IsHeld)
            {
                var kept = state.Damping > 0 ? Math.Exp(-state.Damping * substep) : 1;
                state.Velocity = kept * (state.Velocity + (substep * state.Acceleration));
                state.Spin = kept * (state.Spin + (substep * (state.InverseInertia * state.Torque)));
            }
        }
    }

    private static void Move(Span<RigidState> states, double substep)
    {
        foreach (ref var state in states)
        {
            if ((state.HasContacts && !state.IsHeld) || !state.IsDynamic)
            {
                state.Move(substep);
            }
        }
    }

    private static void WarmStart(Span<RigidState> states, Span<RigidRow> rows)
    {
        foreach (ref var row in rows)
        {
            Apply(in row, states, (row.NormalImpulse * row.Normal) + row.FrictionImpulse, row.RollingImpulse);
        }
    }

    /// <summary>Finds arms, masses, gap and speed of a contact now.</summary>
    private static void Prepare(ref RigidRow row, Span<RigidState> states)
    {
        ref var first = ref states[row.First];
        ref var second = ref states[row.Second];
        // Both act at one point, in the middle of where it has gone with each, so that angular momentum is kept.
        var middle = 0.5 * row.Between(in first, in second);
        row.TurnedArm1 = first.Turn.Rotate(row.Arm1) + middle;
        row.TurnedArm2 = second.Turn.Rotate(row.Arm2) - middle;
        row.NormalMass = 1 / (first.Mobility(row.TurnedArm1, row.Normal) + second.Mobility(row.TurnedArm2, row.Normal));
        row.TangentMass1 = 1 / (first.Mobility(row.TurnedArm1, row.Tangent1) + second.Mobility(row.TurnedArm2, row.Tangent1));
        row.TangentMass2 = 1 / (first.Mobility(row.TurnedArm1, row.Tangent2) + second.Mobility(row.TurnedArm2, row.Tangent2));
        row.CurrentGap = GapNow(in row, states);
        row.SpeedBefore = Vector.Dot(row.Normal, RelativeVelocity(in row, states, row.TurnedArm1, row.TurnedArm2));
    }

    private static void SolveRounds(Span<RigidState> states, Span<RigidRow> rows, double substep)
    {
        for (var round = 0; round < Rounds; round++)
        {
            foreach (ref var row in rows)
            {
                SolveFriction(ref row, states);
                SolveNormal(ref row, states, substep);
            }
        }
    }

    private static void SolveNormal(ref RigidRow row, Span<RigidState> states, double substep)
    {
        var speed = Vector.Dot(row.Normal, RelativeVelocity(in row, states, row.TurnedArm1, row.TurnedArm2));
        var impulse = Math.Max(0, row.NormalImpulse - (row.NormalMass * (speed + (Math.Max(0, row.CurrentGap) / substep))));
        var change = impulse - row.NormalImpulse;
        row.NormalImpulse = impulse;
        Apply(in row, states, change * row.Normal, Vector.Zero);
    }

    private static void SolveFriction(ref RigidRow row, Span<RigidState> states)
    {
        var limit = row.Friction * row.NormalImpulse;
        if (limit > 0 || row.FrictionImpulse != Vector.Zero)
        {
            var slip = RelativeVelocity(in row, states, row.TurnedArm1, row.TurnedArm2) - row.Belt;
            var impulse = row.FrictionImpulse - (row.TangentMass1 * Vector.Dot(row.Tangent1, slip) * row.Tangent1)
                - (row.TangentMass2 * Vector.Dot(row.Tangent2, slip) * row.Tangent2);
            impulse = impulse.ShortenedTo(limit);
            var change = impulse - row.FrictionImpulse;
            row.FrictionImpulse = impulse;
            Apply(in row, states, change, Vector.Zero);
        }

        if (row.RollingArm > 0 || row.SpinningArm > 0)
        {
            var turn = states[row.First].Spin - states[row.Second].Spin;
            var impulse = row.RollingImpulse - (AngularMass(in row, states, turn) * turn);
            var aboutImpulse = Vector.Dot(row.Normal, impulse) * row.Normal;
            impulse = (impulse - aboutImpulse).ShortenedTo(row.RollingArm * row.NormalImpulse)
                + aboutImpulse.ShortenedTo(row.SpinningArm * row.NormalImpulse);
            var change = impulse - row.RollingImpulse;
            row.RollingImpulse = impulse;
            Apply(in row, states, Vector.Zero, change);
        }
    }

    private static double AngularMass(in RigidRow row, Span<RigidState> states, Vector turn)
    {
        var direction = turn.UnitVectorOrZero();
        var turned = (states[row.First].InverseInertia * direction) + (states[row.Second].InverseInertia * direction);
        var mobility = Vector.Dot(direction, turned);
        return mobility > 0 ? 1 / mobility : 0;
    }

    /// <summary>Lets contacts bounce that have stopped an approach.</summary>
    private static void Bounce(Span<RigidState> states, Span<RigidRow> rows)
    {
        for (var round = 0; round < BounceRounds; round++)
        {
            foreach (ref var row in rows)
            {
                if (row.Restitution > 0 && row.NormalImpulse > 0 && row.SpeedBefore < -row.BounceSpeed)
                {
                    var speed = Vector.Dot(row.Normal, RelativeVelocity(in row, states, row.TurnedArm1, row.TurnedArm2));
                    var change = Math.Max(-row.NormalImpulse, -row.NormalMass * (speed + (row.Restitution * row.SpeedBefore)));
                    row.NormalImpulse += change;
                    Apply(in row, states, change * row.Normal, Vector.Zero);
                }
            }
        }

        foreach (ref var row in rows)
        {
            row.NormalImpulseSum += row.NormalImpulse;
            ref readonly var second = ref states[row.Second];
            if (!second.IsDynamic && (second.Velocity != Vector.Zero || second.Spin != Vector.Zero))
            {
                states[row.First].SetPivot(
                    row.TurnedArm1, Vector.Dot(row.Normal, RelativeVelocity(in row, states, row.TurnedArm1, row.TurnedArm2)));
            }
        }
    }

    private static Vector RelativeVelocity(in RigidRow row, Span<RigidState> states, Vector arm1, Vector arm2) =>
        states[row.First].VelocityAt(arm1) - states[row.Second].VelocityAt(arm2);

    private static void Apply(in RigidRow row, Span<RigidState> states, Vector impulse, Vector angularImpulse)
    {
        ref var first = ref states[row.First];
        ref var second = ref states[row.Second];
        if (impulse != Vector.Zero)
        {
            first.ApplyImpulse(row.TurnedArm1, impulse);
            if (second.IsDynamic)
            {
                second.ApplyImpulse(row.TurnedArm2, -impulse);
            }
        }

        if (angularImpulse != Vector.Zero)
        {
            first.Spin += first.InverseInertia * angularImpulse;
            second.Spin -= second.InverseInertia * angularImpulse;
        }
    }
}
