using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// Finds which bodies touch or may meet in a step, and joins those into islands. What it finds is in the order of the bodies'
/// indices, whatever the order of the search.
/// </summary>
internal sealed class ContactGraph(List<Body> bodies, NearbyBodies nearbyBodies, int maxThreads)
{
    // Pairs are tested in groups of so many.
    private const int PairsPerJob = 1024;

    private readonly PairSearch _search = new(bodies, nearbyBodies, maxThreads);
    private readonly List<int> _neighbours = [];
    private readonly List<BodyPair> _pairs = [];
    private readonly List<BodyPair> _found = [];
    private bool _mayHavePairs;

    /// <summary>The bodies that are joined with others.</summary>
    public DisjointSets Sets { get; } = new();

    /// <summary>All pairs that are known: those that touch, and those that bodies of islands may meet.</summary>
    public Span<BodyPair> Pairs => CollectionsMarshal.AsSpan(_pairs);

    /// <summary>The bodies as the search has copied them.</summary>
    public BodyCopies Copies => _search.Copies;

    /// <summary>Makes room for the bodies of a world and their contacts.</summary>
    public void Reserve(int bodyCount, int contactCount)
    {
        _search.Reserve(bodyCount, contactCount);
        Sets.Reserve(bodyCount);
        _neighbours.EnsureCapacity(bodyCount);
        _pairs.EnsureCapacity(contactCount);
        _found.EnsureCapacity(contactCount);
    }

    /// <summary>
    /// True for a body that gets farther from where it would be alone than was foreseen: it may meet what no contact knows of.
    /// </summary>
    /// <param name="body">Index of the body.</param>
    /// <param name="way">From where it is when the step begins.</param>
    public bool HasDeviated(int body, Vector way)
    {
        var limit = BodyCopies.DeviationLimit(in Copies[body]);
        return (way - (Copies.StepLength * Copies[body].Velocity)).LengthSquared() > limit * limit
            || way.LengthSquared() > Copies[body].Reach * Copies[body].Reach;
    }

    /// <summary>Finds all pairs of bodies that touch, and how far bodies are pushed.</summary>
    /// <param name="islands">Wakes bodies that sleep and are hit.</param>
    /// <param name="stepLength">Seconds.</param>
    /// <returns>True where bodies were woken, and the pairs must be collected again.</returns>
    public bool CollectTouching(SleepIslands islands, double stepLength)
    {
        _pairs.Clear();
        Copies.Clear(stepLength);
        _mayHavePairs = bodies.Exists(static body => body.KinematicPush > 0 || BodyCopies.MaySearch(body));
        if (!_mayHavePairs)
        {
            return false;
        }

        Copies.CopyAll();
        if (_search.Run() is var sleeper and >= 0)
        {
            islands.Wake(bodies[sleeper]);
            return true;
        }

        foreach (var found in _search.Results)
        {
            _pairs.AddRange(found.Pairs);
        }

        return PassPushes(islands);
    }

    /// <summary>Joins the bodies that touch, for the impulses of what approaches.</summary>
    public void JoinTouching()
    {
        Sets.Reset(bodies.Count);
        for (var i = 0; !_mayHavePairs && i < bodies.Count; i++)
        {
            bodies[i].MayTouchBodies &= bodies[i].IsAsleep;
        }

        foreach (ref var pair in CollectionsMarshal.AsSpan(_pairs))
        {
            Copies[pair.First].IsTouching = true;
            Copies[pair.Second].IsTouching = true;
            Join(ref pair);
        }
    }

    /// <summary>
    /// Joins the bodies that stay in touch, with all that they may meet in the step. Bodies that touch nothing go their exact ways alone,
    /// and look for no others.
    /// </summary>
    public void JoinForStep()
    {
        Sets.Reset(bodies.Count);
        Copies.UpdateAll();
        if (!_mayHavePairs)
        {
            return;
        }

        CollectNearPushed();
        RunOnPairs(static (graph, job) => graph.TestPairs(job));
        var hasChanged = false;
        foreach (ref var pair in CollectionsMarshal.AsSpan(_pairs))
        {
            if (pair.IsRow)
            {
                Join(ref pair);
                hasChanged |= !pair.IsSecondImmovable;
            }
        }

        while (hasChanged)
        {
            CollectNear();
            hasChanged = JoinNear();
        }
    }

    private void Join(ref BodyPair pair)
    {
        pair.IsRow = true;
        if (!pair.IsSecondImmovable)
        {
            Sets.Join(pair.First, pair.Second);
        }
    }

    /// <summary>
    /// Finds what the bodies of islands may meet: all that are near and no faster, since faster ones look for themselves.
    /// </summary>
    private void CollectNear()
    {
        for (var group = 0; group < Copies.Groups.Length; group++)
        {
            var (first, end) = Copies.Groups[group].HasFaster ? Copies.BodiesOf(group) : default;
            for (var i = first; i < end; i++)
            {
                if (Sets.IsJoined(i) && !Copies[i].HasLooked && BodyCopies.IsFaster(in Copies[i]))
                {
                    CollectNear(i);
                }
            }
        }

        AddFoundPairs();
    }

    /// <summary>Adds the pairs that the search for what touches has found too, of bodies that have been joined since.</summary>
    private void AddFoundPairs()
    {
        WorkerSet.Shared.Run(_search.Results.Length, maxThreads, this, static (graph, i) => graph.TakeNear(i));
        foreach (var search in _search.Results)
        {
            foreach (ref var near in CollectionsMarshal.AsSpan(search.NearPairs))
            {
                if (near.Push > double.NegativeInfinity)
                {
                    Add(near.Pair, near.Push);
                    near.Push = double.NegativeInfinity;
                }
            }
        }
    }

    private void TakeNear(int index)
    {
        foreach (ref var near in CollectionsMarshal.AsSpan(_search.Results[index].NearPairs))
        {
            if (!near.IsTaken && (MustLook(near.Pair.First) || MustLook(near.Pair.Second)))
            {
                near.IsTaken = true;
                if (near.Gap <= Copies[near.Pair.First].Reach + Copies[near.Pair.Second].Reach)
                {
                    near.Push = PushOf(near.Pair);
                }
            }
        }
    }

    private bool MustLook(int body) => Sets.IsJoined(body) || Copies[body].HasLooked;

    /// <summary>Searches for what a body may meet that is faster than was known when what touches was searched for.</summary>
    private void CollectNear(int index)
    {
        ref var body = ref Copies[index];
        body.HasLooked = true;
        _neighbours.Clear();
        _search.CollectOverlaps(body.Position, body.Radius + (2 * body.Reach), index, _neighbours);
        _found.Clear();
        foreach (var neighbour in _neighbours)
        {
            ref readonly var other = ref Copies[neighbour];
            var isImmovable = !other.CanMove;
            var isInOrder = isImmovable || index < neighbour;
            var gap = _search.GapOf(index, neighbour, isInOrder);
            var isFound = (other.HasLooked && gap <= 2 * other.Reach) || IsFound(in body, in other, gap);
            if (!isFound && gap <= body.Reach + other.Reach && !_search.AreTouching(index, neighbour, isInOrder, gap))
            {
                _found.Add(isInOrder ? new(index, neighbour, isImmovable, false) : new(neighbour, index, false, false));
            }
        }

        PairSearch.SortByBodies(CollectionsMarshal.AsSpan(_found));
        foreach (var pair in _found)
        {
            Add(pair, PushOf(pair));
        }
    }

    /// <summary>True where the search for what touches has found a pair as one that is near.</summary>
    private static bool IsFound(in GraphBody body, in GraphBody other, double gap) =>
        gap <= Math.Max(body.NearDistance, other.NearDistance);

    private void Add(BodyPair pair, double push)
    {
        _pairs.Add(pair);
        ref var first = ref Copies[pair.First];
        ref var second = ref Copies[pair.Second];
        first.Push = Math.Max(first.Push, push);
        second.Push = Math.Max(second.Push, push);
    }

    /// <summary>How far each of two bodies may be pushed by the other one.</summary>
    private double PushOf(in BodyPair pair)
    {
        ref readonly var first = ref Copies[pair.First];
        ref readonly var second = ref Copies[pair.Second];
        var offset = first.Position - second.Position;
        var distance = offset.Length();
        var approach = distance > 0 ? -Vector.Dot(Copies.RelativeVelocity(in pair), offset) / distance : 0;
        return (Copies.StepLength * approach) - Math.Max(distance - first.Radius - second.Radius, 0);
    }

    /// <summary>Joins islands with all bodies that they may meet.</summary>
    /// <returns>True where a body was joined that was alone: only such look for what they may meet.</returns>
    private bool JoinNear()
    {
        RunOnPairs(static (graph, job) => graph.TestMeeting(job));
        var joinedBefore = Sets.JoinedCount;
        foreach (ref var pair in CollectionsMarshal.AsSpan(_pairs))
        {
            if (pair is { IsMeeting: true, IsRow: false })
            {
                Join(ref pair);
            }
        }

        return Sets.JoinedCount > joinedBefore;
    }

    private void TestMeeting(int job)
    {
        foreach (ref var pair in PairsOfJob(job))
        {
            pair.IsMeeting = !pair.IsRow && (Sets.IsJoined(pair.First) || (!pair.IsSecondImmovable && Sets.IsJoined(pair.Second)))
                && MayMeet(in pair);
        }
    }

    /// <summary>Tells which of the pairs that touch or are pushed are contacts of the step.</summary>
    private void TestPairs(int job)
    {
        foreach (ref var pair in PairsOfJob(job))
        {
            pair.IsRow = Copies.IsPushed(in pair) ? MayMeet(in pair)
                : pair.IsTouching && (pair.IsSecondImmovable || !IsSeparating(in pair));
        }
    }

    private void RunOnPairs(Action<ContactGraph, int> job) =>
        WorkerSet.Shared.Run((_pairs.Count + PairsPerJob - 1) / PairsPerJob, maxThreads, this, job);

    private Span<BodyPair> PairsOfJob(int job) =>
        CollectionsMarshal.AsSpan(_pairs)[(job * PairsPerJob)..Math.Min(_pairs.Count, (job + 1) * PairsPerJob)];

    /// <summary>Tells whether two bodies come so near on their straight ways that they may touch.</summary>
    private bool MayMeet(in BodyPair pair)
    {
        ref readonly var first = ref Copies[pair.First];
        ref readonly var second = ref Copies[pair.Second];
        var offset = first.Position - second.Position;
        var displacement = Copies.StepLength * Copies.RelativeVelocity(in pair);
        var lengthSquared = displacement.LengthSquared();
        var share = lengthSquared > 0 ? Math.Clamp(-Vector.Dot(offset, displacement) / lengthSquared, 0, 1) : 0;
        var deviation = BodyCopies.DeviationLimit(in first) + (pair.IsSecondImmovable ? 0 : BodyCopies.DeviationLimit(in second));
        var distance = first.Radius + second.Radius + deviation;
        return (offset + (share * displacement)).LengthSquared() <= distance * distance;
    }

    /// <summary>Finds how far bodies are pushed by those that kinematic objects push, and so on.</summary>
    /// <returns>True where a body was woken.</returns>
    private bool PassPushes(SleepIslands islands)
    {
        var hasChanged = Copies.ArePushed;
        while (hasChanged)
        {
            hasChanged = false;
            foreach (var body in bodies)
            {
                if (body.KinematicPush > 0 && BodyCopies.CanMove(body))
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
        nearbyBodies.CollectOverlaps(body.Position, body.Radius + body.KinematicPush, body.Index, _neighbours);
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
        var arePushed = false;
        for (var group = 0; group < Copies.Groups.Length; group++)
        {
            var (first, end) = Copies.Groups[group].HasPushed ? Copies.BodiesOf(group) : default;
            for (var i = first; i < end; i++)
            {
                if (Copies[i].KinematicPush > 0 && Copies[i].CanMove)
                {
                    CollectNear(i);
                    arePushed = true;
                }
            }
        }

        if (arePushed)
        {
            AddFoundPairs();
        }
    }

    /// <summary>True for two bodies that come apart faster than gravity could bring them together again in this step.</summary>
    private bool IsSeparating(in BodyPair pair)
    {
        ref readonly var first = ref Copies[pair.First];
        ref readonly var second = ref Copies[pair.Second];
        if (first.IsCompound || second.IsCompound)
        {
            // Another part of them may come nearer.
            return false;
        }

        var offset = first.Position - second.Position;
        var distance = offset.Length();
        // Those that overlap come apart only as an island: each alone would start within the other.
        var minDistance = first.Radius + second.Radius - ContactTolerances.Slop(Math.Min(first.Radius, second.Radius), first.Position);
        return Vector.Dot(Copies.RelativeVelocity(in pair), offset) > first.SpeedGain * distance && distance >= minDistance;
    }
}
