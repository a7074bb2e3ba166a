using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Islands;

namespace FractalEngine.Core.Physics.Separation;

/// <summary>
/// Takes back what an island has gained in its planned motion: by rounding, by forces that did not converge, or since a body was stopped
/// by something that no plan knew. Its velocities are scaled, about that of its centre of mass where it touches nothing immovable.
/// </summary>
internal sealed class EnergyGuard(List<Body> bodies, IslandSet islands)
{
    /// <summary>Gives the bodies of an island, all of which have moved, their new velocities, and checks their energy.</summary>
    public void FinishVelocities(in Island island)
    {
        var gain = 0.0;
        foreach (var index in islands.BodiesOf(in island))
        {
            // The energy of motion, less the work of gravity and forces.
            var body = bodies[index];
            body.Velocity += body.PlannedChange;
            body.AngularVelocity += body.PlannedSpinChange;
            gain += body.KineticEnergy - body.PlannedStartEnergy
                - (body.Description.Mass * Vector.Dot(body.FreeAcceleration, body.Position - body.PlannedStart));
        }

        if (!island.HasMovingSurface)
        {
            // Surfaces that move do work, which is not known.
            Check(in island, gain);
        }
    }

    private void Check(in Island island, double gain)
    {
        if (!(gain > 0))
        {
            return;
        }

        var centreVelocity = island.IsFree ? CentreVelocity(in island) : Vector.Zero;
        var energy = EnergyAbout(in island, centreVelocity);
        var scale = energy > gain ? Math.Sqrt(1 - (gain / energy)) : 0;
        foreach (var index in islands.BodiesOf(in island))
        {
            bodies[index].Velocity = centreVelocity + (scale * (bodies[index].Velocity - centreVelocity));
            bodies[index].AngularVelocity *= scale;
        }
    }

    private Vector CentreVelocity(in Island island)
    {
        var mass = 0.0;
        var momentum = Vector.Zero;
        foreach (var index in islands.BodiesOf(in island))
        {
            mass += bodies[index].Description.Mass;
            momentum += bodies[index].Description.Mass * bodies[index].Velocity;
        }

        return momentum / mass;
    }

    private double EnergyAbout(in Island island, Vector centreVelocity)
    {
        var energy = 0.0;
        foreach (var index in islands.BodiesOf(in island))
        {
            energy += 0.5 * bodies[index].Description.Mass * (bodies[index].Velocity - centreVelocity).LengthSquared();
            energy += bodies[index].SpinEnergy;
        }

        return energy;
    }
}
