using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Separation;

/// <summary>
/// Moves the bodies of an island all at once, to where their plan leads them. What the solve has left of overlaps is taken back; what it
/// did not foresee keeps bodies where they were, so that none ever enters another.
/// </summary>
internal sealed partial class IslandMover
{
    // Relative to the radius: how far others may have moved to where a body unexpectedly goes.
    private const double SearchMargin = 0.5;

    // Relative to the way that the speed tells: a body that gets less far is held up, and for how many steps it may be.
    private const double JamFraction = 0.5;
    private const int MaxJammedSteps = 8;

    private const int BodiesPerJob = 256;

    // Positions are told to the grid in at most so many groups.
    private const int MaxCellJobs = 32;

    private readonly List<Body> _bodies;
    private readonly ContactGraph _graph;
    private readonly BodyGrid _grid;
    private readonly NearbyBodies _nearbyBodies;
    private readonly int _maxThreads;
    private readonly Action<int> _testPairs;
    private readonly Action<int> _setTargets;
    private readonly Action<int> _takeWays;
    private readonly Action<int> _setWays;
    private readonly Action<int> _dampJammed;
    private readonly Action<int> _updateCells;
    private readonly List<int>[] _leftCells = [.. Enumerable.Range(0, MaxCellJobs).Select(static _ => new List<int>())];
    private readonly OverlapSeparator _separator;
    private readonly List<int> _neighbours = [];

    // Contacts that no plan knew.
    private readonly List<ContactRow> _unplanned = [];

    private Island _island;
    private double _stepLength;

    // Threads set it in any order, to the same.
    private volatile bool _hasDeviated;

    public IslandMover(List<Body> bodies, ContactGraph graph, BodyGrid grid, NearbyBodies nearbyBodies, int maxThreads)
    {
        _bodies = bodies;
        _graph = graph;
        _grid = grid;
        _nearbyBodies = nearbyBodies;
        _maxThreads = maxThreads;
        _separator = new(graph, maxThreads);
        _testPairs = TestPairs;
        _setTargets = SetTargets;
        _takeWays = TakeWays;
        _setWays = SetWays;
        _dampJammed = DampJammed;
        _updateCells = UpdateCells;
    }

    /// <summary>Number of times that a body had to stay where it was.</summary>
    public long ReturnCount { get; private set; }

    /// <summary>Makes room for the bodies of a world and their contacts.</summary>
    public void Reserve(int bodyCount, int contactCount)
    {
        _separator.Reserve(bodyCount, contactCount);
        _places = new Place[bodyCount];
        _neighbours.EnsureCapacity(bodyCount);
        _unplanned.EnsureCapacity(bodyCount / 2);
        foreach (var left in _leftCells)
        {
            left.EnsureCapacity(Math.Min(bodyCount, Math.Max(BodiesPerJob, (bodyCount + MaxCellJobs - 1) / MaxCellJobs)));
        }
    }

    /// <summary>Sets the targets of all bodies of all islands, which have been planned.</summary>
    public void SetTargets()
    {
        foreach (var island in _graph.Islands)
        {
            RunOnMembers(in island, _setTargets);
        }
    }

    /// <summary>Finds a body of no island that stands where one of an island will be. It has to go first.</summary>
    /// <param name="pairIndex">Index of the pair from which to search; receives that after the one found.</param>
    /// <returns>Null where there is none left.</returns>
    public Body? FindObstructing(ref int pairIndex)
    {
        var pairs = _graph.Islands is [var only] && only.BodyCount == _bodies.Count ? [] : _graph.Pairs;
        while (pairIndex < pairs.Length)
        {
            ref readonly var pair = ref pairs[pairIndex++];
            if (!pair.IsSecondImmovable && (_graph.IslandOf(pair.First) >= 0) != (_graph.IslandOf(pair.Second) >= 0))
            {
                var isFirstMember = _graph.IslandOf(pair.First) >= 0;
                var member = _bodies[isFirstMember ? pair.First : pair.Second];
                var single = _bodies[isFirstMember ? pair.Second : pair.First];
                var distance = (member.Radius + single.Radius) * (1 - OverlapSeparator.NegligibleOverlap);
                if (!single.HasMoved && (member.Target - single.Position).LengthSquared() < distance * distance)
                {
                    return single;
                }
            }
        }

        return null;
    }

    /// <summary>Begins the motion of an island.</summary>
    public void BeginIsland() => _unplanned.Clear();

    /// <summary>Adds a surface that a body has met on its way. It gives way along the surface's plane.</summary>
    /// <param name="body">Body of the present island.</param>
    /// <param name="hit">What it has met.</param>
    public void AddSurface(Body body, in Contact hit)
    {
        var offset = body.PlannedOffset(body.PlannedHitBall);
        body.IsHeld = false;
        var radius = body.BallRadius(body.PlannedHitBall);
        _unplanned.Add(new()
        {
            First = body.Index, Second = ContactRow.Immovable, Offset = hit.PointToCentre(body.PlannedStart + offset), MinDistance = radius,
            Normal = hit.CachedNormal, FirstRadius = radius,
        });
    }

    /// <summary>Sets the ways of all bodies, and finds those that others meet which have got farther than was foreseen.</summary>
    public void FindUnplanned(in Island island, double stepLength)
    {
        _stepLength = stepLength;
        _hasDeviated = false;
        RunOnMembers(in island, _setWays);
        if (!_hasDeviated)
        {
            return;
        }

        foreach (var index in _graph.BodiesOf(in island))
        {
            if (_bodies[index].HasDeviated)
            {
                FindUnplanned(_bodies[index]);
            }
        }
    }

    private void FindUnplanned(Body body)
    {
        _neighbours.Clear();
        _nearbyBodies.CollectOverlaps(body.Target, body.Radius * (1 + SearchMargin), body.Index, _neighbours);
        foreach (var neighbour in _neighbours)
        {
            var other = _bodies[neighbour];
            if (other.IslandIndex == body.IslandIndex && !body.IsCompound && !other.IsCompound
                && (body.Target - other.Target).Length() < (body.Radius + other.Radius) * (1 - OverlapSeparator.NegligibleOverlap))
            {
                _unplanned.Add(new()
                {
                    First = body.Index, Second = neighbour, Offset = body.PlannedStart - other.PlannedStart,
                    MinDistance = body.Radius + other.Radius, IsBall = true, FirstRadius = body.Radius, SecondRadius = other.Radius,
                });
            }
        }
    }

    /// <summary>Changes the targets until the bodies overlap as little as the contacts tell. What is held gives way to nothing.</summary>
    public void SeparateTargets(in Island island)
    {
        _separator.Separate(in island, CollectionsMarshal.AsSpan(_unplanned));
        RunOnMembers(in island, _takeWays);
    }

    /// <summary>Does a job for each group of an island's bodies, on all threads.</summary>
    private void RunOnMembers(in Island island, Action<int> job)
    {
        _island = island;
        WorkerSet.Shared.Run((island.BodyCount + BodiesPerJob - 1) / BodiesPerJob, _maxThreads, job);
    }

    private ReadOnlySpan<int> MembersOf(int job)
    {
        var members = _graph.BodiesOf(in _island);
        return members[(job * BodiesPerJob)..Math.Min(members.Length, (job + 1) * BodiesPerJob)];
    }

    private void SetTargets(int job)
    {
        foreach (var index in MembersOf(job))
        {
            var body = _bodies[index];
            body.PlannedStart = body.Position;
            body.Target = body.Position + body.PlannedDisplacement;
            body.IsHeld = false;
        }
    }

    private void TakeWays(int job)
    {
        foreach (var index in MembersOf(job))
        {
            if (_separator.HasMoved(index))
            {
                _bodies[index].Target = _bodies[index].PlannedStart + _separator.DisplacementOf(index);
            }
        }
    }

    /// <summary>Slows down bodies that others have held up for some steps in a row: in a jam they would push for ever.</summary>
    /// <param name="island">Has moved, and its bodies have their new velocities.</param>
    /// <param name="stepLength">Seconds.</param>
    public void DampJammed(in Island island, double stepLength)
    {
        _stepLength = stepLength;
        RunOnMembers(in island, _dampJammed);
    }

    private void DampJammed(int job)
    {
        foreach (var index in MembersOf(job))
        {
            var body = _bodies[index];
            var way = JamFraction * _stepLength * body.Velocity;
            var isJammed = (body.Position - body.PlannedStart).LengthSquared() < way.LengthSquared();
            body.JammedSteps = isJammed ? body.JammedSteps + 1 : 0;
            if (body.JammedSteps >= MaxJammedSteps)
            {
                body.Velocity *= 0.5;
                body.AngularVelocity *= 0.5;
            }
        }
    }

    private void SetWays(int job)
    {
        foreach (var index in MembersOf(job))
        {
            var body = _bodies[index];
            _separator.SetBody(index, body.Target - body.PlannedStart, body.IsHeld ? 0 : 1 / body.Description.Mass);
            body.HasDeviated = HasDeviated(body, body.Target, _stepLength);
            if (body.HasDeviated)
            {
                _hasDeviated = true;
            }
        }
    }

    private bool HasDeviated(Body body, Vector position, double stepLength)
    {
        var free = body.PlannedStart + (stepLength * (body.PlannedVelocity + (0.5 * stepLength * body.FreeAcceleration)));
        var limit = _graph.DeviationLimit(body.Index);
        return (position - free).LengthSquared() > limit * limit;
    }
}
