using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>Puts to sleep what rests together, and wakes it together.</summary>
internal sealed class RigidSleep(PhysicsSettings settings, List<Body> bodies)
{
    private readonly DisjointSets _islands = new();

    /// <summary>Wakes what sleeps where something touches it that does not rest.</summary>
    /// <returns>True where something has been woken.</returns>
    public bool WakeIfPushed(Body body, Body other)
    {
        var sleeper = body.IsAsleep ? body : other;
        var pusher = body.IsAsleep ? other : body;
        if (!sleeper.IsAsleep || pusher.SleepTimer > 0)
        {
            return false;
        }

        WakeIsland(sleeper);
        return true;
    }

    /// <summary>Wakes what sleeps where objects come that move by themselves.</summary>
    public void WakeNearMoving(StaticObjectSet statics)
    {
        foreach (var moved in statics.Kinematics.Objects)
        {
            foreach (var body in moved.IsMoving ? bodies : [])
            {
                if (body.IsAsleep && moved.SweptBounds.DistanceSquared(body.Position) <= body.Radius * body.Radius)
                {
                    WakeIsland(body);
                }
            }
        }
    }

    /// <summary>Puts bodies to sleep that have barely moved for some time, with all that touch them.</summary>
    /// <param name="states">The bodies after the step.</param>
    /// <param name="rows">All contacts.</param>
    /// <param name="seconds">Length of the step.</param>
    public void EndStep(ReadOnlySpan<RigidState> states, ReadOnlySpan<RigidRow> rows, double seconds)
    {
        _islands.Reset(bodies.Count);
        foreach (ref readonly var row in rows)
        {
            if (row.Second < bodies.Count && row.NormalImpulseSum > 0)
            {
                _islands.Join(row.First, row.Second);
            }
        }

        for (var i = 0; i < bodies.Count; i++)
        {
            var body = bodies[i];
            body.IsRigidIslandAwake = false;
            if (!body.IsAsleep)
            {
                var speed = settings.SleepSpeed ?? 0.02 * Math.Sqrt(states[i].Acceleration.Length() * body.Radius);
                var isSlow = (body.Position - body.PreviousPosition).Length() < speed * seconds
                    && body.AngularVelocity.Length() * body.Radius < speed;
                body.SleepTimer = isSlow && states[i].HasContacts && !body.IsShrinking ? body.SleepTimer + seconds : 0;
            }
        }

        for (var i = 0; i < bodies.Count; i++)
        {
            bodies[_islands.RootOf(i)].IsRigidIslandAwake |= !bodies[i].IsAsleep && !(bodies[i].SleepTimer >= settings.TimeBeforeSleep);
        }

        for (var i = 0; i < bodies.Count; i++)
        {
            var body = bodies[i];
            if (!body.IsAsleep && !bodies[_islands.RootOf(i)].IsRigidIslandAwake)
            {
                body.Sleep();
                body.RigidIsland = _islands.RootOf(i);
            }
        }
    }

    private void WakeIsland(Body sleeper)
    {
        var island = sleeper.RigidIsland;
        foreach (var body in bodies)
        {
            if (body.IsAsleep && (body == sleeper || body.RigidIsland == island))
            {
                body.Wake();
            }
        }
    }
}
