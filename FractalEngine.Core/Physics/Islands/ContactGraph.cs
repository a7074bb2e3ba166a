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
    private bool[] _hasLooked = new bool[InitialCapacity];
    private double _stepLength;
    private int _count;

    /// <summary>The islands, in the order of their lowest body.</summary>
    public List<Island> Islands => _islands;

    /// <summary>The contacts of an island.</summary>
    public Span<ContactRow> RowsOf(in Island island) => _rows.AsSpan(island.FirstRow, island.RowCount);

    /// <summary>Number of contacts of all islands.</summary>
    public int RowCount { get; private set; }

    /// <summary>A contact by its index among those of all islands, which stand one island after the other.</summary>
    public ref ContactRow Row(int index) => ref _rows[index];

    /// <summary>The bodies of an island, in the order of their indices.</summary>
    public ReadOnlySpan<int> BodiesOf(in Island island) =>
        CollectionsMarshal.AsSpan(_islandBodies).Slice(island.FirstBody, island.BodyCount);

    /// <summary>True for a body that is joined with others.</summary>
    public bool IsJoined(int body) => _sets.IsJoined(body);

    /// <summary>All pairs that are known: those that touch, and those that bodies of islands may meet.</summary>
    public ReadOnlySpan<BodyPair> Pairs => CollectionsMarshal.AsSpan(_pairs);

    /// <summary>How far a body may get in the step. Never 0, which is for bodies that do not move.</summary>
    public double Reach(Body body) => (_stepLength * body.Velocity.Length()) + Slack(body) + body.KinematicPush;

    /// <summary>How far a body may get from where it would be without others, before it may meet what no contact knows of.</summary>
    public double DeviationLimit(int body) => Slack(bodies[body]) + _push[body] + bodies[body].KinematicPush;

    /// <summary>True for a body of an island that is farther from where it was than any pair foresees.</summary>
    public bool IsBeyondReach(Body body) => (body.Position - body.PlannedStart).LengthSquared() > _reach[body.Index] * _reach[body.Index];

    /// <summary>Finds all pairs of bodies that touch. Only those search that may: most bodies in flight have met no other.</summary>
    /// <param name="islands">Wakes bodies that sleep and are hit.</param>
    /// <param name="stepLength">Seconds.</param>
    /// <returns>True where bodies were woken, and the pairs must be collected again.</returns>
    public bool CollectTouching(SleepIslands islands, double stepLength)
    {
        Begin(stepLength);
        var hasWoken = false;
        for (var i = 0; i < bodies.Count && !hasWoken; i++)
        {
            hasWoken = MaySearch(bodies[i]) && CollectTouching(bodies[i], islands);
        }

        return hasWoken || PassPushes(islands);
    }

    /// <summary>Joins the bodies that touch, for the impulses of what approaches.</summary>
    public void JoinTouching()
    {
        _sets.Reset(bodies.Count);
        foreach (var body in bodies)
        {
            body.MayTouchBodies &= body.IsAsleep;
        }

        foreach (ref var pair in CollectionsMarshal.AsSpan(_pairs))
        {
            bodies[pair.First].MayTouchBodies = true;
            bodies[pair.Second].MayTouchBodies = true;
            pair.IsRow = pair.IsTouching;
            if (pair.IsTouching && !pair.IsSecondFirm)
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
        for (var i = 0; i < bodies.Count; i++)
        {
            _reach[i] = CanMove(bodies[i]) ? Reach(bodies[i]) : 0;
            _push[i] = 0;
            _hasLooked[i] = false;
        }

        CollectNearPushed();
        var hasChanged = false;
        foreach (ref var pair in CollectionsMarshal.AsSpan(_pairs))
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
            CollectNear();
            hasChanged = JoinNear();
        }
    }

    /// <summary>Finds how far bodies are pushed by those that kinematic objects push, and so on.</summary>
    /// <returns>True where a body was woken.</returns>
    private bool PassPushes(SleepIslands islands)
    {
        var hasChanged = true;
        while (hasChanged)
        {
            hasChanged = false;
            foreach (var body in bodies)
            {
                if (body.KinematicPush > 0 && CanMove(body))
                {
                    if (TryWakePushed(body, islands))
                    {
                        return true;
                    }

                    hasChanged |= PassPush(body);
                }
            }
        }

        return false;
    }

    private void CollectPushedBy(Body body)
    {
        _neighbours.Clear();
        nearbyBodies.CollectOverlaps(new(body.Position, body.Position), body.Radius + body.KinematicPush, body.Index, _neighbours);
        _neighbours.Sort();
    }

    private bool TryWakePushed(Body body, SleepIslands islands)
    {
        CollectPushedBy(body);
        foreach (var neighbour in _neighbours)
        {
            if (bodies[neighbour].IsAsleep)
            {
                islands.Wake(bodies[neighbour]);
                return true;
            }
        }

        return false;
    }

    private bool PassPush(Body body)
    {
        var hasChanged = false;
        CollectPushedBy(body);
        foreach (var neighbour in _neighbours)
        {
            var other = bodies[neighbour];
            var push = body.KinematicPush - Math.Max(0, (body.Position - other.Position).Length() - body.Radius - other.Radius);
            if (push > other.KinematicPush)
            {
                other.KinematicPush = push;
                hasChanged = true;
            }
        }

        return hasChanged;
    }

    /// <summary>Finds what bodies may meet that are pushed, which touch nothing yet.</summary>
    private void CollectNearPushed()
    {
        for (var i = 0; i < bodies.Count; i++)
        {
            if (bodies[i].KinematicPush > 0 && CanMove(bodies[i]))
            {
                _hasLooked[i] = true;
                CollectNear(i);
            }
        }
    }

    private bool IsPushed(in BodyPair pair) =>
        bodies[pair.First].KinematicPush > 0 || (!pair.IsSecondFirm && bodies[pair.Second].KinematicPush > 0);

    private static bool MaySearch(Body body) => CanMove(body) && (body.MayTouchBodies || body.IsCompound);

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
            _hasLooked = new bool[2 * bodies.Count];
            // Room for as many contacts as bodies in a heap have, so that steps need not allocate.
            var contacts = ContactsPerBody * _hasLooked.Length;
            _pairs.EnsureCapacity(contacts);
            _islands.EnsureCapacity(_hasLooked.Length);
            _islandBodies.EnsureCapacity(_hasLooked.Length);
            Array.Resize(ref _found, Math.Max(contacts, _found.Length));
            Array.Resize(ref _rows, _found.Length);
        }
    }

    private bool CollectTouching(Body body, SleepIslands islands)
    {
        _neighbours.Clear();
        var radius = body.Radius + ContactTolerances.Slop(body.Radius, body.Position);
        radius += body.HasHeapMargin ? ContactTolerances.HeapMargin * body.Radius : 0;
        nearbyBodies.CollectOverlaps(new(body.Position, body.Position), radius, body.Index, _neighbours);
        _neighbours.Sort();
        foreach (var neighbour in _neighbours)
        {
            var other = bodies[neighbour];
            var isFirm = !CanMove(other);
            // Of two that search, the first one finds the pair.
            var isInOrder = isFirm || body.Index < neighbour;
            if ((isInOrder || !MaySearch(other)) && (isInOrder ? BallPairs.AreTouching(body, other) : BallPairs.AreTouching(other, body)))
            {
                if (other.IsAsleep && BallPairs.AreHitting(body, other))
                {
                    islands.Wake(other);
                    return true;
                }

                _pairs.Add(isInOrder ? new(body.Index, neighbour, isFirm, true) : new(neighbour, body.Index, false, true));
            }
        }

        return false;
    }

    /// <summary>
    /// Finds what the bodies of islands may meet: all that are near and no faster, since faster ones look for themselves.
    /// </summary>
    private void CollectNear()
    {
        for (var i = 0; i < bodies.Count; i++)
        {
            if (_sets.IsJoined(i) && !_hasLooked[i])
            {
                _hasLooked[i] = true;
                CollectNear(i);
            }
        }
    }

    private void CollectNear(int index)
    {
        var body = bodies[index];
        _neighbours.Clear();
        nearbyBodies.CollectOverlaps(new(body.Position, body.Position), body.Radius + (2 * _reach[index]), index, _neighbours);
        _neighbours.Sort();
        foreach (var neighbour in _neighbours)
        {
            var other = bodies[neighbour];
            var gap = (body.Position - other.Position).Length() - body.Radius - other.Radius;
            var isFound = _hasLooked[neighbour] && gap <= 2 * _reach[neighbour];
            if (isFound || gap > _reach[index] + _reach[neighbour])
            {
                continue;
            }

            var isFirm = !CanMove(other);
            var isInOrder = isFirm || index < neighbour;
            if (!(isInOrder ? BallPairs.AreTouching(body, other) : BallPairs.AreTouching(other, body)))
            {
                AddNear(isInOrder ? new(index, neighbour, isFirm, false) : new(neighbour, index, false, false));
            }
        }
    }

    private void AddNear(BodyPair pair)
    {
        _pairs.Add(pair);
        // How far each may be pushed by the other one.
        var offset = bodies[pair.First].Position - bodies[pair.Second].Position;
        var gap = offset.Length() - bodies[pair.First].Radius - bodies[pair.Second].Radius;
        var push = (-_stepLength * Vector.Dot(RelativeVelocity(in pair), offset.UnitVectorOrZero())) - Math.Max(gap, 0);
        _push[pair.First] = Math.Max(_push[pair.First], push);
        _push[pair.Second] = Math.Max(_push[pair.Second], push);
    }

    /// <summary>Joins islands with all bodies that they may meet.</summary>
    /// <returns>True where a body was joined.</returns>
    private bool JoinNear()
    {
        var hasJoined = false;
        foreach (ref var pair in CollectionsMarshal.AsSpan(_pairs))
        {
            if (!pair.IsRow && (_sets.IsJoined(pair.First) || (!pair.IsSecondFirm && _sets.IsJoined(pair.Second))) && MayMeet(in pair))
            {
                pair.IsRow = true;
                if (!pair.IsSecondFirm)
                {
                    _sets.Join(pair.First, pair.Second);
                    hasJoined = true;
                }
            }
        }

        return hasJoined;
    }

    private double Slack(Body body) => (_stepLength * _stepLength * body.FreeAcceleration.Length()) + (ReachMargin * body.Radius);

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
        if (bodies[pair.First].IsCompound || bodies[pair.Second].IsCompound)
        {
            // Another part of them may come nearer.
            return false;
        }

        var normal = (bodies[pair.First].Position - bodies[pair.Second].Position).UnitVectorOrZero();
        return Vector.Dot(RelativeVelocity(in pair), normal) > _stepLength * bodies[pair.First].FreeAcceleration.Length();
    }
}
