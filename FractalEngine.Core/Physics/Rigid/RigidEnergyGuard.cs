using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// Takes back what contacts add to the energy of bodies that touch each other: no contact adds any, but the impulses of several that have
/// not converged do. Velocities are scaled, about that of the centre of mass where a group touches nothing immovable.
/// </summary>
internal sealed class RigidEnergyGuard
{
    // Part of the energy that a substep may add: what rounding and friction among several contacts do to bodies that lie.
    private const double MaxGain = 1e-4;

    private readonly DisjointSets _groups = new();
    private Group[] _sums = [];

    /// <summary>Notes the energy that there is before a substep.</summary>
    /// <param name="states">The bodies, and what no force moves.</param>
    /// <param name="rows">The contacts.</param>
    public void Begin(ReadOnlySpan<RigidState> states, ReadOnlySpan<RigidRow> rows)
    {
        if (_sums.Length < states.Length)
        {
            _sums = new Group[2 * states.Length];
        }

        _groups.Reset(states.Length);
        _sums.AsSpan(0, states.Length).Clear();
        foreach (ref readonly var row in rows)
        {
            if (states[row.Second].IsDynamic)
            {
                _groups.Join(row.First, row.Second);
            }
        }

        foreach (ref readonly var row in rows)
        {
            ref var sum = ref _sums[_groups.RootOf(row.First)];
            ref readonly var other = ref states[row.Second];
            sum.HasSurface |= !(states[row.First].IsDynamic && other.IsDynamic);
            // Surfaces that move do work, which is not known.
            sum.IsPushed |= row.Belt != Vector.Zero || (!other.IsDynamic && (other.Velocity != Vector.Zero || other.Spin != Vector.Zero));
        }

        for (var i = 0; i < states.Length; i++)
        {
            ref var sum = ref _sums[_groups.RootOf(i)];
            sum.EnergyBefore += states[i].IsDynamic ? states[i].KineticEnergy : 0;
            sum.IsPushed |= states[i].Torque != Vector.Zero;
        }
    }

    /// <summary>Takes back what has been gained since, beyond the work of gravity and forces.</summary>
    /// <param name="states">The same bodies.</param>
    public void End(Span<RigidState> states)
    {
        for (var i = 0; i < states.Length; i++)
        {
            ref readonly var state = ref states[i];
            if (state.IsDynamic)
            {
                ref var sum = ref _sums[_groups.RootOf(i)];
                sum.Energy += state.KineticEnergy;
                sum.Work += state.Work;
                sum.Mass += 1 / state.InverseMass;
                sum.Momentum += (1 / state.InverseMass) * state.Velocity;
            }
        }

        for (var i = 0; i < states.Length; i++)
        {
            ref readonly var sum = ref _sums[_groups.RootOf(i)];
            var maxEnergy = Math.Max(0, sum.EnergyBefore + sum.Work);
            if (states[i].HasContacts && !sum.IsPushed && sum.Energy > maxEnergy + (MaxGain * Math.Max(sum.Energy, sum.EnergyBefore)))
            {
                var centreVelocity = sum.HasSurface ? Vector.Zero : sum.Momentum / sum.Mass;
                var energyOfCentre = 0.5 * sum.Mass * centreVelocity.LengthSquared();
                var energyAbout = maxEnergy - energyOfCentre;
                var scale = energyAbout > 0 ? Math.Sqrt(energyAbout / (sum.Energy - energyOfCentre)) : 0;
                states[i].Velocity = centreVelocity + (scale * (states[i].Velocity - centreVelocity));
                states[i].Spin *= scale;
            }
        }
    }

    /// <summary>What is summed of bodies that touch each other, directly or through others.</summary>
    private struct Group
    {
        public double EnergyBefore;
        public double Energy;
        public double Work;
        public double Mass;
        public Vector Momentum;
        public bool HasSurface;
        public bool IsPushed;
    }
}
