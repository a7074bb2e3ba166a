using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <content>What the bodies of islands may meet in the step.</content>
internal sealed partial class ContactGraph
{
    // Made with the graph: a static one would be made by the first step that has such pairs, and steps allocate nothing.
    private readonly Comparison<BodyPair> _compareOthers =
        static (a, b) => a.First != b.First ? a.First.CompareTo(b.First) : a.Second.CompareTo(b.Second);

    /// <summary>
    /// Finds what the bodies of islands may meet: all that are near and no faster, since faster ones look for themselves.
    /// </summary>
    private void CollectNear()
    {
        for (var i = 0; i < bodies.Count; i++)
        {
            ref readonly var body = ref _states[i];
            if (_sets.IsJoined(i) && !body.HasLooked && (body.Reach > body.SearchReach || !body.MaySearch))
            {
                CollectNear(i);
            }
        }

        TakeFoundPairs();
    }

    /// <summary>Takes the pairs that the search for what touches has found too, of bodies that have been joined since.</summary>
    private void TakeFoundPairs()
    {
        foreach (var search in _searches.AsSpan(0, _searchCount))
        {
            foreach (ref var pair in CollectionsMarshal.AsSpan(search.NearPairs))
            {
                if (!pair.IsRow && (MustLook(pair.First) || MustLook(pair.Second)))
                {
                    pair.IsRow = true;
                    if (GapOf(pair.First, pair.Second) <= _states[pair.First].Reach + _states[pair.Second].Reach)
                    {
                        Add(pair with { IsRow = false });
                    }
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
            var gap = GapOf(index, neighbour);
            var isFound = (other.HasLooked && gap <= 2 * other.Reach) || IsFound(in body, in other, gap);
            if (!isFound && gap <= body.Reach + other.Reach)
            {
                AddNear(index, neighbour, _found);
            }
        }

        _found.Sort(_compareOthers);
        foreach (var pair in _found)
        {
            Add(pair);
        }
    }

    /// <summary>True where the search for what touches has found a pair as one that is near.</summary>
    private static bool IsFound(in GraphBody body, in GraphBody other, double gap) =>
        gap <= Math.Max(body.NearDistance, other.NearDistance) && gap <= body.SearchReach + other.SearchReach;

    private double GapOf(int first, int second) =>
        (_states[first].Position - _states[second].Position).Length() - _states[first].Radius - _states[second].Radius;

    /// <summary>Adds a pair that is near to a list, unless it touches.</summary>
    private void AddNear(int index, int neighbour, List<BodyPair> pairs)
    {
        var isFirm = !_states[neighbour].CanMove;
        var isInOrder = isFirm || index < neighbour;
        if (!AreTouching(index, neighbour, isInOrder))
        {
            pairs.Add(isInOrder ? new(index, neighbour, isFirm, false) : new(neighbour, index, false, false));
        }
    }

    private void Add(BodyPair pair)
    {
        _pairs.Add(pair);
        StorePush(in pair);
    }

    /// <summary>Stores how far each of two bodies may be pushed by the other one.</summary>
    private void StorePush(in BodyPair pair)
    {
        ref var first = ref _states[pair.First];
        ref var second = ref _states[pair.Second];
        var offset = first.Position - second.Position;
        var distance = offset.Length();
        var approach = distance > 0 ? -Vector.Dot(RelativeVelocity(in pair), offset) / distance : 0;
        var push = (_stepLength * approach) - Math.Max(distance - first.Radius - second.Radius, 0);
        first.Push = Math.Max(first.Push, push);
        second.Push = Math.Max(second.Push, push);
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

    /// <summary>Tells whether two bodies come so near on their straight ways that they may touch.</summary>
    private bool MayMeet(in BodyPair pair)
    {
        ref readonly var first = ref _states[pair.First];
        ref readonly var second = ref _states[pair.Second];
        var offset = first.Position - second.Position;
        var way = _stepLength * RelativeVelocity(in pair);
        var wayLengthSquared = way.LengthSquared();
        var share = wayLengthSquared > 0 ? Math.Clamp(-Vector.Dot(offset, way) / wayLengthSquared, 0, 1) : 0;
        var distance = first.Radius + second.Radius + DeviationLimit(in first) + (pair.IsSecondFirm ? 0 : DeviationLimit(in second));
        return (offset + (share * way)).LengthSquared() <= distance * distance;
    }
}
