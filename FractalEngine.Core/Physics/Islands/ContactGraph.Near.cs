using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Islands;

/// <content>What the bodies of islands may meet in the step.</content>
internal sealed partial class ContactGraph
{
    // Pairs are tested in groups of so many.
    private const int PairsPerJob = 1024;

    private Action<int>? _takeNear;
    private Action<int>? _testPairs;
    private Action<int>? _testMeeting;

    /// <summary>
    /// Finds what the bodies of islands may meet: all that are near and no faster, since faster ones look for themselves.
    /// </summary>
    private void CollectNear()
    {
        for (var search = 0; search < _searchCount; search++)
        {
            var (first, end) = _searches[search].HasFaster ? BodiesOfSearch(search) : default;
            for (var i = first; i < end; i++)
            {
                if (_sets.IsJoined(i) && !_states[i].HasLooked && IsFaster(in _states[i]))
                {
                    CollectNear(i);
                }
            }
        }

        AddFoundPairs();
    }

    /// <summary>True for a body that gets farther than the search for what touches has looked.</summary>
    private static bool IsFaster(in GraphBody body) => body.Reach > body.SearchReach || !body.MaySearch;

    /// <summary>Adds the pairs that the search for what touches has found too, of bodies that have been joined since.</summary>
    private void AddFoundPairs()
    {
        WorkerSet.Shared.Run(_searchCount, maxThreads, _takeNear!);
        foreach (var search in _searches.AsSpan(0, _searchCount))
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
        foreach (ref var near in CollectionsMarshal.AsSpan(_searches[index].NearPairs))
        {
            if (!near.IsTaken && (MustLook(near.Pair.First) || MustLook(near.Pair.Second)))
            {
                near.IsTaken = true;
                if (near.Gap <= _states[near.Pair.First].Reach + _states[near.Pair.Second].Reach)
                {
                    near.Push = PushOf(near.Pair);
                }
            }
        }
    }

    private bool MustLook(int body) => _sets.IsJoined(body) || _states[body].HasLooked;

    /// <summary>Searches for what a body may meet that is faster than was known when what touches was searched for.</summary>
    private void CollectNear(int index)
    {
        ref var body = ref _states[index];
        body.HasLooked = true;
        _neighbours.Clear();
        CollectOverlaps(body.Position, body.Radius + (2 * body.Reach), index, _neighbours);
        _found.Clear();
        foreach (var neighbour in _neighbours)
        {
            ref readonly var other = ref _states[neighbour];
            var isImmovable = !other.CanMove;
            var isInOrder = isImmovable || index < neighbour;
            var gap = GapOf(index, neighbour, isInOrder);
            var isFound = (other.HasLooked && gap <= 2 * other.Reach) || IsFound(in body, in other, gap);
            if (!isFound && gap <= body.Reach + other.Reach && !AreTouching(index, neighbour, isInOrder, gap))
            {
                _found.Add(isInOrder ? new(index, neighbour, isImmovable, false) : new(neighbour, index, false, false));
            }
        }

        SortByBodies(CollectionsMarshal.AsSpan(_found));
        foreach (var pair in _found)
        {
            Add(pair, PushOf(pair));
        }
    }

    /// <summary>True where the search for what touches has found a pair as one that is near.</summary>
    private static bool IsFound(in GraphBody body, in GraphBody other, double gap) =>
        gap <= Math.Max(body.NearDistance, other.NearDistance) && gap <= body.SearchReach + other.SearchReach;

    private void Add(BodyPair pair, double push)
    {
        _pairs.Add(pair);
        ref var first = ref _states[pair.First];
        ref var second = ref _states[pair.Second];
        first.Push = Math.Max(first.Push, push);
        second.Push = Math.Max(second.Push, push);
    }

    /// <summary>How far each of two bodies may be pushed by the other one.</summary>
    private double PushOf(in BodyPair pair)
    {
        ref readonly var first = ref _states[pair.First];
        ref readonly var second = ref _states[pair.Second];
        var offset = first.Position - second.Position;
        var distance = offset.Length();
        var approach = distance > 0 ? -Vector.Dot(RelativeVelocity(in pair), offset) / distance : 0;
        return (_stepLength * approach) - Math.Max(distance - first.Radius - second.Radius, 0);
    }

    /// <summary>Joins islands with all bodies that they may meet.</summary>
    /// <returns>True where a body was joined that was alone: only such look for what they may meet.</returns>
    private bool JoinNear()
    {
        RunOnPairs(_testMeeting!);
        var joinedBefore = _sets.JoinedCount;
        foreach (ref var pair in CollectionsMarshal.AsSpan(_pairs))
        {
            if (pair is { IsMeeting: true, IsRow: false })
            {
                pair.IsRow = true;
                if (!pair.IsSecondImmovable)
                {
                    _sets.Join(pair.First, pair.Second);
                }
            }
        }

        return _sets.JoinedCount > joinedBefore;
    }

    private void TestMeeting(int job)
    {
        foreach (ref var pair in PairsOfJob(job))
        {
            pair.IsMeeting = !pair.IsRow && (_sets.IsJoined(pair.First) || (!pair.IsSecondImmovable && _sets.IsJoined(pair.Second)))
                && MayMeet(in pair);
        }
    }

    /// <summary>Tells which of the pairs that touch or are pushed are contacts of the step.</summary>
    private void TestPairs(int job)
    {
        foreach (ref var pair in PairsOfJob(job))
        {
            pair.IsRow = IsPushed(in pair) ? MayMeet(in pair) : pair.IsTouching && (pair.IsSecondImmovable || !IsSeparating(in pair));
        }
    }

    private void RunOnPairs(Action<int> job) => WorkerSet.Shared.Run((_pairs.Count + PairsPerJob - 1) / PairsPerJob, maxThreads, job);

    private Span<BodyPair> PairsOfJob(int job) =>
        CollectionsMarshal.AsSpan(_pairs)[(job * PairsPerJob)..Math.Min(_pairs.Count, (job + 1) * PairsPerJob)];

    /// <summary>Tells whether two bodies come so near on their straight ways that they may touch.</summary>
    private bool MayMeet(in BodyPair pair)
    {
        ref readonly var first = ref _states[pair.First];
        ref readonly var second = ref _states[pair.Second];
        var offset = first.Position - second.Position;
        var displacement = _stepLength * RelativeVelocity(in pair);
        var lengthSquared = displacement.LengthSquared();
        var share = lengthSquared > 0 ? Math.Clamp(-Vector.Dot(offset, displacement) / lengthSquared, 0, 1) : 0;
        var distance = first.Radius + second.Radius + DeviationLimit(in first) + (pair.IsSecondImmovable ? 0 : DeviationLimit(in second));
        return (offset + (share * displacement)).LengthSquared() <= distance * distance;
    }
}
