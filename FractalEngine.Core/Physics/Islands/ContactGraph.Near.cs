using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <content>What the bodies of islands may meet in the step.</content>
internal sealed partial class ContactGraph
{
    /// <summary>
    /// Finds what the bodies of islands may meet: all that are near and no faster, since faster ones look for themselves.
    /// </summary>
    private void CollectNear()
    {
        for (var i = 0; i < bodies.Count; i++)
        {
            if (_sets.IsJoined(i) && !_states[i].HasLooked)
            {
                _states[i].HasLooked = true;
                CollectNear(i);
            }
        }
    }

    private void CollectNear(int index)
    {
        ref readonly var body = ref _states[index];
        var firstPair = _pairs.Count;
        if (2 * body.Reach <= body.NearDistance)
        {
            AddNear(index, CollectionsMarshal.AsSpan(_searches[index / _bodiesPerSearch].Near).Slice(body.FirstNear, body.NearCount));
        }
        else
        {
            _neighbours.Clear();
            CollectOverlaps(body.Position, body.Radius + (2 * body.Reach), index, _neighbours);
            AddNear(index, CollectionsMarshal.AsSpan(_neighbours));
        }

        // By the other body's index, whichever way it was found.
        CollectionsMarshal.AsSpan(_pairs)[firstPair..].Sort(_compareOthers);
        foreach (ref readonly var pair in CollectionsMarshal.AsSpan(_pairs)[firstPair..])
        {
            StorePush(in pair);
        }
    }

    // Made with the graph: a static one would be made by the first step that has such pairs, and steps allocate nothing.
    private readonly Comparison<BodyPair> _compareOthers =
        static (a, b) => a.First != b.First ? a.First.CompareTo(b.First) : a.Second.CompareTo(b.Second);

    private void AddNear(int index, ReadOnlySpan<int> neighbours)
    {
        ref readonly var body = ref _states[index];
        foreach (var neighbour in neighbours)
        {
            ref readonly var other = ref _states[neighbour];
            var gap = (body.Position - other.Position).Length() - body.Radius - other.Radius;
            var isFound = other.HasLooked && gap <= 2 * other.Reach;
            if (isFound || gap > body.Reach + other.Reach)
            {
                continue;
            }

            var isFirm = !other.CanMove;
            var isInOrder = isFirm || index < neighbour;
            if (!AreTouching(index, neighbour, isInOrder))
            {
                _pairs.Add(isInOrder ? new(index, neighbour, isFirm, false) : new(neighbour, index, false, false));
            }
        }
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
