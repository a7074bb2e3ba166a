using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// Takes back what an island has gained in its planned motion: by rounding, by forces that did not converge, or since a body was stopped
/// by something that no plan knew. Its velocities are scaled, about that of its centre of mass where it touches nothing firm.
/// </summary>
internal sealed class EnergyGuard(List<Body> bodies, ContactGraph graph, BodyGrid grid, NearbyBodies nearbyBodies)
{
    private const int InitialCapacity = 64;

    // Of the energy of motion: to take back more, bodies that wait in vain lose the time, and what forces would have given them in it.
    private const double MaxShare = 0.25;

    private readonly List<int> _neighbours = new(InitialCapacity);

    /// <summary>Checks all islands after all bodies have moved.</summary>
    public void Check()
    {
        foreach (var island in graph.Islands)
        {
            var gain = SumGains(in island);
            if (!(gain > 0))
            {
                continue;
            }

            var isFree = IsFree(in island);
            var centreVelocity = isFree ? CentreVelocity(in island) : Vector.Zero;
            if (!isFree && gain > MaxShare * EnergyAbout(in island, centreVelocity))
            {
                StopWaiting(in island);
                gain = Math.Max(0, SumGains(in island));
            }

            var energy = EnergyAbout(in island, centreVelocity);
            if (!isFree && gain > energy && CanReturn(in island))
            {
                Return(in island);
            }

            var scale = energy > gain ? Math.Sqrt(1 - (gain / energy)) : 0;
            foreach (var index in graph.BodiesOf(in island))
            {
                bodies[index].Velocity = centreVelocity + (scale * (bodies[index].Velocity - centreVelocity));
                bodies[index].AngularVelocity *= scale;
            }
        }
    }

    /// <summary>True where nothing has moved into the places that an island has left.</summary>
    private bool CanReturn(in Island island)
    {
        foreach (var index in graph.BodiesOf(in island))
        {
            var body = bodies[index];
            var start = body.PlannedMotion.Start;
            _neighbours.Clear();
            nearbyBodies.CollectOverlaps(new(start, start), body.Radius, index, _neighbours);
            foreach (var neighbour in _neighbours)
            {
                if (bodies[neighbour].IslandIndex != body.IslandIndex)
                {
                    return false;
                }
            }
        }

        return true;
    }

    /// <summary>Puts an island back to where its step began: what lifted it has more energy than it can give back.</summary>
    private void Return(in Island island)
    {
        foreach (var index in graph.BodiesOf(in island))
        {
            bodies[index].Position = bodies[index].PlannedMotion.Start;
            grid.Update(index);
        }
    }

    private void StopWaiting(in Island island)
    {
        foreach (var index in graph.BodiesOf(in island))
        {
            var body = bodies[index];
            if (body.IsWaiting)
            {
                var velocity = body.PlannedMotion.VelocityAt(body.PlannedTime);
                body.Velocity += velocity - body.PlannedEndVelocity;
                body.EnergyGain = body.EnergyGainOf(velocity, body.Position);
            }
        }
    }

    private double SumGains(in Island island)
    {
        var gain = 0.0;
        foreach (var index in graph.BodiesOf(in island))
        {
            gain += bodies[index].EnergyGain;
        }

        return gain;
    }

    private bool IsFree(in Island island)
    {
        var isFree = true;
        foreach (ref var row in graph.RowsOf(in island))
        {
            isFree &= row.Second >= 0;
        }

        return isFree;
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
