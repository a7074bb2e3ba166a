using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>Puts slow bodies to sleep, and wakes whole islands: a body with all that touch it, directly or through others.</summary>
internal sealed class SleepIslands(List<Body> bodies, NearbyBodies nearbyBodies)
{
    // Initial capacity of the list of neighbours; beyond it it grows.
    private const int InitialNeighbourCapacity = 256;

    private readonly List<int> _neighbours = new(InitialNeighbourCapacity);
    private readonly Stack<Body> _stack = [];

    /// <summary>True where a body may sleep; else nothing need be woken.</summary>
    public bool HasSleeping { get; set; }

    /// <summary>Makes room for islands of so many bodies.</summary>
    public void Reserve(int bodyCount) => _stack.EnsureCapacity(bodyCount);

    /// <summary>Puts a body to sleep that has barely moved for some time, unless it is of an island.</summary>
    /// <param name="body">Awake, after its step.</param>
    /// <param name="sleepSpeed">Average speed below which it counts as resting, units per second; at 0 it never rests.</param>
    /// <param name="timeBeforeSleep">Seconds for which it must rest.</param>
    /// <param name="stepLength">Length of the last step, seconds.</param>
    public void Update(Body body, double sleepSpeed, double timeBeforeSleep, double stepLength)
    {
        // What turns in place in a pile sleeps too: without spinning friction it would turn for ever.
        // Measured by distance: a jammed body may be pushed about and go nowhere.
        var maxDistance = sleepSpeed * stepLength;
        var isSlow = (body.Position - body.PreviousPosition).LengthSquared() < maxDistance * maxDistance
            && (body.IslandIndex >= 0 || body.AngularVelocity.LengthSquared() * body.Radius * body.Radius < sleepSpeed * sleepSpeed)
            && (body.IsTouching || body.IslandIndex >= 0) && !body.HasMovingSurface;
        var isResting = sleepSpeed > 0 && !body.IsShrinking && (isSlow || body.IsStuck);
        body.SleepTimer = isResting ? body.SleepTimer + stepLength : 0;
        if (body.SleepTimer >= timeBeforeSleep && isResting && body.IslandIndex < 0)
        {
            body.Sleep();
            HasSleeping = true;
        }
    }

    /// <summary>Wakes what touched a body before its step that moves: what slept on it may have lost its support.</summary>
    /// <param name="body">Has been updated.</param>
    public void WakeLeft(Body body)
    {
        if (HasSleeping && body.SleepTimer == 0)
        {
            WakeOverlapping(body.PreviousPosition, body.PreviousScale * body.Description.Radius, body.Index);
        }
    }

    /// <summary>Wakes a body and its whole island.</summary>
    public void Wake(Body body)
    {
        body.Wake();
        WakeOverlapping(body.Position, body.Radius, body.Index);
    }

    /// <summary>Wakes the islands of all bodies that touch a sphere.</summary>
    /// <param name="centre">World space.</param>
    /// <param name="radius">Scene units.</param>
    /// <param name="excludedIndex">Index of the body that the sphere belongs to.</param>
    public void WakeOverlapping(Vector centre, double radius, int excludedIndex = Contact.NoBody)
    {
        WakeTouching(centre, radius, excludedIndex);
        while (_stack.TryPop(out var next))
        {
            WakeTouching(next.Position, next.Radius, next.Index);
        }
    }

    /// <summary>Wakes the bodies that touch a sphere, and keeps them: others may touch them.</summary>
    private void WakeTouching(Vector centre, double radius, int excludedIndex)
    {
        _neighbours.Clear();
        nearbyBodies.CollectOverlaps(centre, radius * ContactTolerances.SupportRadiusFactor, excludedIndex, _neighbours);
        foreach (var index in _neighbours)
        {
            if (bodies[index].IsAsleep)
            {
                bodies[index].Wake();
                _stack.Push(bodies[index]);
            }
        }
    }
}
