using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Separation;

/// <summary>
/// Takes back what an island has gained in its planned motion: by rounding, by forces that did not converge, or since a body was stopped
/// by something that no plan knew. Its velocities are scaled, about that of its centre of mass where it touches nothing immovable.
/// </summary>
internal sealed class EnergyGuard
{
    private const int BodiesPerJob = 256;

    private readonly List<Body> _bodies;
    private readonly ContactGraph _graph;
    private readonly IslandMover _mover;
    private readonly int _maxThreads;
    private readonly Action<int> _addPlan;

    // What contacts have added to the energy of each group of bodies.
    private double[] _gains = [];
    private Island _island;

    public EnergyGuard(List<Body> bodies, ContactGraph graph, IslandMover mover, int maxThreads)
    {
        _bodies = bodies;
        _graph = graph;
        _mover = mover;
        _maxThreads = maxThreads;
        _addPlan = AddPlan;
    }

    /// <summary>Makes room for the bodies of a world.</summary>
    public void Reserve(int bodyCount) => _gains = new double[(bodyCount + BodiesPerJob - 1) / BodiesPerJob];

    /// <summary>Gives the bodies of an island, all of which have moved, their new velocities, and checks their energy.</summary>
    public void FinishVelocities(in Island island)
    {
        _island = island;
        var jobCount = (island.BodyCount + BodiesPerJob - 1) / BodiesPerJob;
        WorkerSet.Shared.Run(jobCount, _maxThreads, _addPlan);
        var gain = 0.0;
        foreach (var part in _gains.AsSpan(0, jobCount))
        {
            gain += part;
        }

        Check(in island, gain - WorkOfSurfaces(in island));
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
        foreach (var index in _graph.BodiesOf(in island))
        {
            _bodies[index].Velocity = centreVelocity + (scale * (_bodies[index].Velocity - centreVelocity));
            _bodies[index].AngularVelocity *= scale;
        }

        if (scale == 0 && centreVelocity == Vector.Zero && !island.IsPushed)
        {
            // What has lifted it has more energy than it can give back: it rests.
            _ = _mover.TryReturn(in island);
        }
    }

    /// <summary>Gives a group of bodies their new velocities, and sums what contacts have added to their energy.</summary>
    private void AddPlan(int job)
    {
        var gain = 0.0;
        var members = _graph.BodiesOf(in _island);
        foreach (var index in members[(job * BodiesPerJob)..Math.Min(members.Length, (job + 1) * BodiesPerJob)])
        {
            // The energy of motion, less the work of gravity and forces.
            var body = _bodies[index];
            body.Velocity += body.PlannedChange;
            body.AngularVelocity += body.PlannedSpinChange;
            gain += body.KineticEnergy - body.PlannedStartEnergy
                - (body.Description.Mass * Vector.Dot(body.FreeAcceleration, body.Position - body.PlannedStart));
        }

        _gains[job] = gain;
    }

    private double WorkOfSurfaces(in Island island)
    {
        var work = 0.0;
        foreach (ref readonly var row in island.HasMovingSurface ? _graph.RowsOf(in island) : [])
        {
            work += Vector.Dot((row.NormalImpulse * row.Normal) + row.FrictionImpulse, row.SurfaceVelocity)
                + Vector.Dot(row.TurnImpulse, row.SurfaceSpin);
        }

        return work;
    }

    private Vector CentreVelocity(in Island island)
    {
        var mass = 0.0;
        var momentum = Vector.Zero;
        foreach (var index in _graph.BodiesOf(in island))
        {
            mass += _bodies[index].Description.Mass;
            momentum += _bodies[index].Description.Mass * _bodies[index].Velocity;
        }

        return momentum / mass;
    }

    private double EnergyAbout(in Island island, Vector centreVelocity)
    {
        var energy = 0.0;
        foreach (var index in _graph.BodiesOf(in island))
        {
            energy += 0.5 * _bodies[index].Description.Mass * (_bodies[index].Velocity - centreVelocity).LengthSquared();
            energy += _bodies[index].SpinEnergy;
        }

        return energy;
    }
}
