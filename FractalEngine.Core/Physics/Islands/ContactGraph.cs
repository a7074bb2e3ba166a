using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// Finds which bodies touch or may meet in a step, and groups them: an island is made of two or more awake bodies that touch, directly or
/// through others. Its order is that of the bodies' indices, whatever the order of the search.
/// </summary>
internal sealed partial class ContactGraph(List<Body> bodies, NearbyBodies nearbyBodies)
{
    private const int InitialCapacity = 256;

    private const int ContactsPerBody = 4;

    // Of the radius: how much farther than its free path a body is expected to get, pushed by others.
    private const double ReachMargin = 0.1;

    private readonly List<int> _neighbours = new(InitialCapacity);
    private readonly List<BodyPair> _pairs = new(InitialCapacity);
    private readonly List<Island> _islands = new(InitialCapacity);
    private readonly List<int> _islandBodies = new(InitialCapacity);
    private readonly DisjointSets _sets = new();
    private ContactRow[] _found = new ContactRow[InitialCapacity];
    private ContactRow[] _rows = new ContactRow[InitialCapacity];
    private int[] _islandOf = new int[InitialCapacity];
    private int[] _next = new int[InitialCapacity];
    private double[] _reach = new double[InitialCapacity];
    private double[] _push = new double[InitialCapacity];
    private double[] _kinematicPush = new double[InitialCapacity];
    private bool[] _hasPair = new bool[InitialCapacity];
    private double _stepLength;
    private int _count;

    /// <summary>The islands, in the order of their lowest body.</summary>
    public List<Island> Islands => _islands;

    /// <summary>The contacts of an island.</summary>
    public Span<ContactRow> RowsOf(in Island island) => _rows.AsSpan(island.FirstRow, island.RowCount);

    /// <summary>Number of contacts of all islands.</summary>
    public int RowCount { get; private set; }

    /// <summary>A contact of an island.</summary>
    public ref ContactRow Row(int index) => ref _rows[index];

    /// <summary>The bodies of an island, in the order of their indices.</summary>
    public ReadOnlySpan<int> BodiesOf(in Island island) =>
        CollectionsMarshal.AsSpan(_islandBodies).Slice(island.FirstBody, island.BodyCount);

    /// <summary>True for a body that is joined with others.</summary>
    public bool IsJoined(int body) => _sets.IsJoined(body);

    /// <summary>How far a body may get in the step.</summary>
    public double Reach(int body) => _reach[body];

    /// <summary>How far a body may get from where it would be without others, before it may meet what no contact knows of.</summary>
    public double DeviationLimit(int body) => Slack(bodies[body]) + _push[body] + _kinematicPush[body];

    /// <summary>Finds all pairs of bodies that touch or may meet.</summary>
    /// <param name="islands">Wakes bodies that sleep and are hit.</param>
    /// <param name="stepLength">Seconds.</param>
    /// <returns>True where bodies were woken, and the pairs must be collected again.</returns>
    public bool CollectPairs(SleepIslands islands, double stepLength)
    {
        Begin(stepLength);
        var hasWoken = false;
        for (var i = 0; i < bodies.Count && !hasWoken; i++)
        {
            hasWoken = _reach[i] > 0 && CollectPairsOf(i, islands);
        }

        return hasWoken;
    }

    /// <summary>True where impulses have made a body so fast that it may meet others than those of its pairs.</summary>
    public bool HasOutrun()
    {
        var hasOutrun = false;
        for (var i = 0; i < bodies.Count; i++)
        {
            hasOutrun |= _hasPair[i] && CanMove(bodies[i]) && Reach(bodies[i]) > _reach[i] * (1 + ReachMargin);
        }

        return hasOutrun;
    }

    /// <summary>Joins the bodies that touch, for the impulses of what approaches.</summary>
    public void JoinTouching()
    {
        _sets.Reset(bodies.Count);
        foreach (ref var pair in CollectionsMarshal.AsSpan(_pairs))
        {
            pair.IsRow = pair.IsTouching;
            if (pair.IsTouching && !pair.IsSecondFirm)
            {
                _sets.Join(pair.First, pair.Second);
            }
        }
    }

    /// <summary>
    /// Joins the bodies that stay in touch, with all that they may meet in the step. Bodies that touch nothing go their exact ways alone.
    /// </summary>
    public void JoinForStep()
    {
        _sets.Reset(bodies.Count);
        var pairs = CollectionsMarshal.AsSpan(_pairs);
        FindPushes(pairs);
        var hasChanged = false;
        foreach (ref var pair in pairs)
        {
            pair.IsRow = IsPushed(in pair) ? MayMeet(in pair) : pair.IsTouching && (pair.IsSecondFirm || !IsSeparating(in pair));
            if (pair is { IsRow: true, IsSecondFirm: false })
            {
                _sets.Join(pair.First, pair.Second);
                hasChanged = true;
            }
        }

        while (hasChanged)
        {
            hasChanged = false;
            foreach (ref var pair in pairs)
            {
                if (!pair.IsRow && (_sets.IsJoined(pair.First) || (!pair.IsSecondFirm && _sets.IsJoined(pair.Second))) && MayMeet(in pair))
                {
                    pair.IsRow = true;
                    if (!pair.IsSecondFirm)
                    {
                        _sets.Join(pair.First, pair.Second);
                        hasChanged = true;
                    }
                }
            }
        }
    }

    private static bool CanMove(Body body) => !body.IsAsleep && !body.IsStuck && body.IsOverlapResolved;

    private void Begin(double stepLength)
    {
        _stepLength = stepLength;
        _pairs.Clear();
        if (_islandOf.Length < bodies.Count)
        {
            _islandOf = new int[2 * bodies.Count];
            _next = new int[2 * bodies.Count];
            _reach = new double[2 * bodies.Count];
            _push = new double[2 * bodies.Count];
            _kinematicPush = new double[2 * bodies.Count];
            _hasPair = new bool[2 * bodies.Count];
            // Room for as many contacts as bodies in a heap have, so that steps need not allocate.
            var contacts = ContactsPerBody * _hasPair.Length;
            _pairs.EnsureCapacity(contacts);
            _islands.EnsureCapacity(_hasPair.Length);
            _islandBodies.EnsureCapacity(_hasPair.Length);
            Array.Resize(ref _found, Math.Max(contacts, _found.Length));
            Array.Resize(ref _rows, _found.Length);
        }

        for (var i = 0; i < bodies.Count; i++)
        {
            _reach[i] = CanMove(bodies[i]) ? Reach(bodies[i]) : 0;
            _hasPair[i] = false;
        }
    }

    private bool CollectPairsOf(int index, SleepIslands islands)
    {
        var body = bodies[index];
        _neighbours.Clear();
        nearbyBodies.CollectOverlaps(new(body.Position, body.Position), body.Radius + (2 * _reach[index]), index, _neighbours);
        _neighbours.Sort();
        foreach (var neighbour in _neighbours)
        {
            // The one that reaches farther finds the pair.
            if (_reach[neighbour] > _reach[index] || (_reach[neighbour] == _reach[index] && neighbour < index))
            {
                continue;
            }

            var other = bodies[neighbour];
            var gap = (body.Position - other.Position).Length() - body.Radius - other.Radius;
            if (gap > _reach[index] + _reach[neighbour])
            {
                continue;
            }

            var isTouching = gap <= ContactTolerances.Slop(Math.Min(body.Radius, other.Radius), body.Position);
            body.KinematicPush = Math.Max(body.KinematicPush, other.KinematicPush - Math.Max(0, gap));
            var push = body.KinematicPush - Math.Max(0, gap);
            if (other.IsAsleep && (push > 0 || (isTouching && IsHit(body, other))))
            {
                islands.Wake(other);
                return true;
            }

            other.KinematicPush = Math.Max(other.KinematicPush, push);
            var isFirm = !CanMove(other);
            _hasPair[index] = true;
            _hasPair[neighbour] |= !isFirm;
            _pairs.Add(isFirm || index < neighbour ? new(index, neighbour, isFirm, isTouching) : new(neighbour, index, false, isTouching));
        }

        return false;
    }

    /// <summary>How far a body may get in the step. Never 0, which is for bodies that do not move.</summary>
    private double Reach(Body body) => (_stepLength * body.Velocity.Length()) + Slack(body) + body.KinematicPush;

    private double Slack(Body body) => (_stepLength * _stepLength * body.FreeAcceleration.Length()) + (ReachMargin * body.Radius);

    /// <summary>Finds how far bodies may be pushed by those that run into them.</summary>
    private void FindPushes(ReadOnlySpan<BodyPair> pairs)
    {
        Array.Clear(_push, 0, bodies.Count);
        foreach (ref readonly var pair in pairs)
        {
            var offset = bodies[pair.First].Position - bodies[pair.Second].Position;
            var gap = offset.Length() - bodies[pair.First].Radius - bodies[pair.Second].Radius;
            var push = (-_stepLength * Vector.Dot(RelativeVelocity(in pair), offset.UnitVectorOrZero())) - gap;
            _push[pair.First] = Math.Max(_push[pair.First], push);
            _push[pair.Second] = Math.Max(_push[pair.Second], push);
        }

        FindKinematicPushes(pairs);
    }

    /// <summary>Finds how far bodies are pushed by those that kinematic objects push, and so on.</summary>
    private void FindKinematicPushes(ReadOnlySpan<BodyPair> pairs)
    {
        var hasChanged = false;
        for (var i = 0; i < bodies.Count; i++)
        {
            _kinematicPush[i] = bodies[i].KinematicPush;
            hasChanged |= _kinematicPush[i] > 0;
        }

        while (hasChanged)
        {
            hasChanged = false;
            foreach (ref readonly var pair in pairs)
            {
                if (!pair.IsSecondFirm && _kinematicPush[pair.First] + _kinematicPush[pair.Second] > 0)
                {
                    var gap = (bodies[pair.First].Position - bodies[pair.Second].Position).Length()
                        - bodies[pair.First].Radius - bodies[pair.Second].Radius;
                    hasChanged |= PassPush(pair.First, pair.Second, gap) | PassPush(pair.Second, pair.First, gap);
                }
            }
        }
    }

    private bool PassPush(int from, int to, double gap)
    {
        var push = _kinematicPush[from] - Math.Max(0, gap);
        if (!(push > _kinematicPush[to]))
        {
            return false;
        }

        _kinematicPush[to] = push;
        return true;
    }

    private bool IsPushed(in BodyPair pair) =>
        _kinematicPush[pair.First] > 0 || (!pair.IsSecondFirm && _kinematicPush[pair.Second] > 0);

    /// <summary>Tells whether two bodies come so near on their straight ways that they may touch.</summary>
    private bool MayMeet(in BodyPair pair)
    {
        var offset = bodies[pair.First].Position - bodies[pair.Second].Position;
        var way = _stepLength * RelativeVelocity(in pair);
        var wayLengthSquared = way.LengthSquared();
        var share = wayLengthSquared > 0 ? Math.Clamp(-Vector.Dot(offset, way) / wayLengthSquared, 0, 1) : 0;
        var distance = bodies[pair.First].Radius + bodies[pair.Second].Radius + DeviationLimit(pair.First)
            + (pair.IsSecondFirm ? 0 : DeviationLimit(pair.Second));
        return (offset + (share * way)).LengthSquared() <= distance * distance;
    }

    private Vector RelativeVelocity(in BodyPair pair) => pair.IsSecondFirm
        ? bodies[pair.First].Velocity : bodies[pair.First].Velocity - bodies[pair.Second].Velocity;

    /// <summary>True for two bodies that come apart faster than gravity could bring them together again in this step.</summary>
    private bool IsSeparating(in BodyPair pair)
    {
        var normal = (bodies[pair.First].Position - bodies[pair.Second].Position).UnitVectorOrZero();
        return Vector.Dot(RelativeVelocity(in pair), normal) > _stepLength * bodies[pair.First].FreeAcceleration.Length();
    }

    private static bool IsHit(Body body, Body other) =>
        -Vector.Dot(body.Velocity - other.Velocity, (body.Position - other.Position).UnitVectorOrZero()) > body.RestitutionThreshold;
}
