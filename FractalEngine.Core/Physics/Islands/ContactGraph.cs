using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// Finds which bodies touch or may meet in a step, and groups them: an island is made of two or more awake bodies that touch, directly or
/// through others. Its order is that of the bodies' indices, whatever the order of the search.
/// </summary>
internal sealed partial class ContactGraph(List<Body> bodies, NearbyBodies nearbyBodies, int maxThreads)
{
    // Relative to the radius: how much farther than its free path a body is expected to get, pushed by others.
    private const double ReachMargin = 0.1;

    // Relative to the radius: bodies that get farther do not search for all that they may meet before it is known that they touch anything.
    private const double MaxEarlyDistance = 4;

    private readonly List<int> _neighbours = [];
    private readonly List<BodyPair> _pairs = [];
    private readonly List<BodyPair> _found = [];
    private readonly List<Island> _islands = [];
    private readonly List<int> _islandBodies = [];
    private readonly DisjointSets _sets = new();
    private readonly NeighbourGrid _grid = new();
    private GraphBody[] _states = [];
    private BodyMaterial[] _materials = [];
    private BodyDescription?[] _descriptions = [];
    private bool _mayHavePairs;
    private double _stepLength;

    /// <summary>The islands, in the order of their lowest body.</summary>
    public List<Island> Islands => _islands;

    /// <summary>The contacts of an island.</summary>
    public Span<ContactRow> RowsOf(in Island island) => _rows.AsSpan(island.FirstRow, island.RowCount);

    /// <summary>Number of contacts of all islands.</summary>
    public int RowCount { get; private set; }

    /// <summary>Number of contacts that there is room for.</summary>
    public int RowCapacity => _rows.Length;

    /// <summary>A contact by its index among those of all islands, which stand one island after the other.</summary>
    public ref ContactRow Row(int index) => ref _rows[index];

    /// <summary>The bodies of an island, in the order of their indices.</summary>
    public ReadOnlySpan<int> BodiesOf(in Island island) =>
        CollectionsMarshal.AsSpan(_islandBodies).Slice(island.FirstBody, island.BodyCount);

    /// <summary>Number of bodies of all islands.</summary>
    public int IslandBodyCount => _islandBodies.Count;

    /// <summary>Index of the island of a body; negative for none.</summary>
    public int IslandOf(int body) => _islandOf[body];

    /// <summary>Number of bodies that are joined with others.</summary>
    public int JoinedCount => _sets.JoinedCount;

    /// <summary>True for a body that is joined with others.</summary>
    public bool IsJoined(int body) => _sets.IsJoined(body);

    /// <summary>All pairs that are known: those that touch, and those that bodies of islands may meet.</summary>
    public ReadOnlySpan<BodyPair> Pairs => CollectionsMarshal.AsSpan(_pairs);

    /// <summary>How far a body that can move may get in the step. Never 0, which is for bodies that do not move.</summary>
    public double ReachOf(int body) => _states[body].Reach;

    /// <summary>
    /// True for a body that gets farther from where it would be alone than was foreseen: it may meet what no contact knows of.
    /// </summary>
    /// <param name="body">Index of the body.</param>
    /// <param name="way">From where it is when the step begins.</param>
    public bool HasDeviated(int body, Vector way)
    {
        var limit = DeviationLimit(in _states[body]);
        return (way - (_stepLength * _states[body].Velocity)).LengthSquared() > limit * limit
            || way.LengthSquared() > _states[body].Reach * _states[body].Reach;
    }

    /// <summary>Joins the bodies that touch, for the impulses of what approaches.</summary>
    public void JoinTouching()
    {
        _sets.Reset(bodies.Count);
        for (var i = 0; !_mayHavePairs && i < bodies.Count; i++)
        {
            bodies[i].MayTouchBodies &= bodies[i].IsAsleep;
        }

        foreach (ref var pair in CollectionsMarshal.AsSpan(_pairs))
        {
            _states[pair.First].IsTouching = true;
            _states[pair.Second].IsTouching = true;
            pair.IsRow = true;
            if (!pair.IsSecondImmovable)
            {
                _sets.Join(pair.First, pair.Second);
            }
        }
    }

    /// <summary>
    /// Joins the bodies that stay in touch, with all that they may meet in the step. Bodies that touch nothing go their exact ways alone,
    /// and look for no others.
    /// </summary>
    public void JoinForStep()
    {
        _sets.Reset(bodies.Count);
        WorkerSet.Shared.Run(_searchCount, maxThreads, _updateStates!);
        if (!_mayHavePairs)
        {
            return;
        }

        CollectNearPushed();
        RunOnPairs(_testPairs!);
        var hasChanged = false;
        foreach (ref readonly var pair in CollectionsMarshal.AsSpan(_pairs))
        {
            if (pair is { IsRow: true, IsSecondImmovable: false })
            {
                _sets.Join(pair.First, pair.Second);
                hasChanged = true;
            }
        }

        while (hasChanged)
        {
            CollectNear();
            hasChanged = JoinNear();
        }
    }

    private static bool CanMove(Body body) => !body.IsAsleep && !body.IsStuck && body.IsOverlapResolved;

    private static bool MaySearch(Body body) => CanMove(body) && (body.MayTouchBodies || body.IsCompound);

    private void Begin(double stepLength)
    {
        _stepLength = stepLength;
        _pairs.Clear();
        _searchCount = 0;
        _mayHavePairs = bodies.Exists(static body => body.KinematicPush > 0 || MaySearch(body));
        if (!_mayHavePairs)
        {
            return;
        }

        SetSearches();
        WorkerSet.Shared.Run(_searchCount, maxThreads, _copyStates!);
        HasSleeping = false;
        var bounds = GridBounds.None;
        foreach (var search in _searches.AsSpan(0, _searchCount))
        {
            HasSleeping |= search.HasSleeping;
            bounds = GridBounds.Union(bounds, search.Bounds);
        }

        _grid.Build(nearbyBodies.HasFilters ? [] : _states.AsSpan(0, bodies.Count), in bounds);
    }

    private void CreateJobs()
    {
        _runSearch ??= RunSearch;
        _copyStates ??= CopyStates;
        _updateStates ??= UpdateStates;
        _takeNear ??= TakeNear;
        _testPairs ??= TestPairs;
        _testMeeting ??= TestMeeting;
        _countSurfaces ??= CountSurfaces;
        _fillPart ??= FillPart;
    }

    /// <summary>Puts islands to sleep whose bodies have all rested for some time.</summary>
    /// <param name="timeBeforeSleep">Seconds for which they must rest.</param>
    public void PutToSleep(double timeBeforeSleep)
    {
        foreach (var island in Islands)
        {
            var isResting = true;
            foreach (var index in BodiesOf(in island))
            {
                isResting &= bodies[index].SleepTimer > 0 && bodies[index].SleepTimer >= timeBeforeSleep;
            }

            foreach (var index in isResting ? BodiesOf(in island) : [])
            {
                bodies[index].Sleep();
            }
        }
    }

    /// <summary>Makes room for the bodies of a world and their contacts, and makes what threads run.</summary>
    public void Reserve(int bodyCount, int contactCount)
    {
        CreateJobs();
        _states = new GraphBody[bodyCount];
        _materials = new BodyMaterial[bodyCount];
        _descriptions = new BodyDescription?[bodyCount];
        _idleCopies = new (Body?, int)[bodyCount];
        _grid.Reserve(bodyCount);
        _parts.Reserve(bodyCount);
        _sets.Reserve(bodyCount);
        _islandOf = new int[bodyCount];
        _next = new int[bodyCount + 1];
        ReserveSearches(contactCount);
        _neighbours.EnsureCapacity(bodyCount);
        _pairs.EnsureCapacity(contactCount);
        _found.EnsureCapacity(contactCount);
        _sortedPairs.EnsureCapacity(contactCount);
        _partPairs.EnsureCapacity(contactCount);
        _partEnds.EnsureCapacity(bodyCount);
        _allPartBodyEnds.EnsureCapacity(bodyCount);
        _islands.EnsureCapacity(bodyCount);
        _islandBodies.EnsureCapacity(bodyCount);
        _partBodies.EnsureCapacity(bodyCount);
        ReserveRows(contactCount);
    }

    private double ReachOf(in GraphBody body) => (_stepLength * body.Velocity.Length()) + body.Slack + body.KinematicPush;

    private static double DeviationLimit(in GraphBody body) => body.Slack + body.Push + body.KinematicPush;

    private Vector RelativeVelocity(in BodyPair pair) => pair.IsSecondImmovable
        ? _states[pair.First].Velocity : _states[pair.First].Velocity - _states[pair.Second].Velocity;

    /// <summary>True for two bodies that come apart faster than gravity could bring them together again in this step.</summary>
    private bool IsSeparating(in BodyPair pair)
    {
        ref readonly var first = ref _states[pair.First];
        ref readonly var second = ref _states[pair.Second];
        if (first.IsCompound || second.IsCompound)
        {
            // Another part of them may come nearer.
            return false;
        }

        var offset = first.Position - second.Position;
        var distance = offset.Length();
        // Those that overlap come apart only as an island: each alone would start within the other.
        var minDistance = first.Radius + second.Radius - ContactTolerances.Slop(Math.Min(first.Radius, second.Radius), first.Position);
        return Vector.Dot(RelativeVelocity(in pair), offset) > first.SpeedGain * distance && distance >= minDistance;
    }
}
