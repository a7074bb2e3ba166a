using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// Takes back what an island has gained in its planned motion: by rounding, by forces that did not converge, or since a body was stopped
/// by something that no plan knew. Its velocities are scaled, about that of its centre of mass where it touches nothing firm.
/// </summary>
internal sealed class EnergyGuard(List<Body> bodies, ContactGraph graph, IslandMover mover)
{
    /// <summary>Checks an island after all of its bodies have moved, and have their new velocities.</summary>
    public void Check(in Island island)
    {
        var gain = SumGains(in island);
        if (!(gain > 0))
        {
            return;
        }

        var centreVelocity = island.IsFree ? CentreVelocity(in island) : Vector.Zero;
        var energy = EnergyAbout(in island, centreVelocity);
        var scale = energy > gain ? Math.Sqrt(1 - (gain / energy)) : 0;
        foreach (var index in graph.BodiesOf(in island))
        {
            bodies[index].Velocity = centreVelocity + (scale * (bodies[index].Velocity - centreVelocity));
            bodies[index].AngularVelocity *= scale;
        }

        if (scale == 0 && centreVelocity == Vector.Zero && !island.IsPushed)
        {
            // What has lifted it has more energy than it can give back: it rests.
            _ = mover.TryReturn(in island);
        }
    }

    /// <summary>What contacts have added to the energy: that of motion, less the work of gravity and forces.</summary>
    private double SumGains(in Island island)
    {
        var gain = 0.0;
        foreach (var index in graph.BodiesOf(in island))
        {
            var body = bodies[index];
            gain += body.KineticEnergy - body.PlannedStartEnergy
                - (body.Description.Mass * Vector.Dot(body.FreeAcceleration, body.Position - body.PlannedStart));
        }

        foreach (ref readonly var row in graph.RowsOf(in island))
        {
            // What moves does work.
            gain -= Vector.Dot((row.NormalImpulse * row.Normal) + row.FrictionImpulse, row.SurfaceVelocity)
                + Vector.Dot(row.TurnImpulse, row.SurfaceSpin);
        }

        return gain;
    }

    private Vector CentreVelocity(in Island island)
    {
        var mass = 0.0;
        var momentum = Vector.Zero;
        foreach (var index in graph.BodiesOf(in island))
        {
            mass += bodies[index].Description.Mass;
            momentum += bodies[index].Description.Mass * bodies[index].Velocity;
        }

        return momentum / mass;
    }

    private double EnergyAbout(in Island island, Vector centreVelocity)
    {
        var energy = 0.0;
        foreach (var index in graph.BodiesOf(in island))
        {
            energy += 0.5 * bodies[index].Description.Mass * (bodies[index].Velocity - centreVelocity).LengthSquared();
            energy += bodies[index].SpinEnergy;
        }

        return energy;
    }
}
