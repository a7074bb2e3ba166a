using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// Finds where two surfaces touch or nearly touch: all pairs of triangles within a margin, the outermost corners first, without those
/// that the contacts found so far hold apart, or that do not come near.
/// </summary>
internal sealed class ContactSearch : PairSearch
{
    // Pairs of parts that are opened: the contacts found up to there have to do.
    private const int MaxPairs = 4_000;

    // Pairs of leaves of two searches that are remembered.
    private const int MaxLeaves = 64;

    // Relative to the contact distance: contacts are looked for where surfaces come so near by themselves.
    private const double ApproachDistance = 4;

    private readonly List<Pair> _pairs = [];
    private readonly PriorityQueue<int, (double Inwardness, int Order)> _open = new();
    private readonly FeatureContacts _features = new();
    private double _distance;
    private double _margin;
    private double _leastGap;
    private Vector _middle;

    /// <summary>True where the surfaces of the last search cross.</summary>
    public bool HasCrossed => _features.HasCrossed;

    /// <summary>Finds the contacts of two surfaces.</summary>
    /// <param name="first">The first surface.</param>
    /// <param name="motion1">Where it is.</param>
    /// <param name="second">The second surface.</param>
    /// <param name="motion2">Where it is, in the same frame.</param>
    /// <param name="distance">The distance at which surfaces rest on each other, scene units.</param>
    /// <param name="margin">Largest gap that counts, at least that distance.</param>
    /// <param name="contacts">Receives the contacts, in the order of their groups.</param>
    /// <param name="near">Receives all that is within the margin.</param>
    /// <param name="leaves">Leaves that the last search found contacts in: looked at first. Receives those of this one.</param>
    /// <returns>The margin, or how far the surfaces are apart if that is more; 0 where there was too much to look at all of it.</returns>
    public double FindContacts(
        SurfaceNodes first, in SurfaceMotion motion1, SurfaceNodes second, in SurfaceMotion motion2, double distance, double margin,
        List<ContactPoint> contacts, List<NearPair> near, List<(int First, int Second)> leaves)
    {
        SetPair(first, in motion1, second, in motion2);
        _distance = distance;
        _margin = margin;
        var box1 = first[0].Place(in Motion1);
        var box2 = second[0].Place(in Motion2);
        _middle = box1.Radius < box2.Radius ? box1.Centre : box2.Centre;
        _pairs.Clear();
        _open.Clear();
        _leastGap = double.PositiveInfinity;
        _features.Begin((first.IsMirrored, second.IsMirrored), Math.Min(box1.Radius, box2.Radius), distance, margin, near);
        var leafCount = leaves.Count;
        for (var i = 0; i < leafCount; i++)
        {
            AddLeaves(leaves[i].First, leaves[i].Second, leaves);
        }

        PushIfNear(0, in box1, 0, in box2);
        for (var opened = 0; opened < MaxPairs && _open.Count > 0; opened++)
        {
            var pair = _pairs[_open.Dequeue()];
            if (_features.Manifold.Holds(in pair.Box1, in pair.Box2) || !IsApproaching(in pair))
            {
                near.Add(new(pair.First, -1, pair.Second, -1, pair.Axis, pair.Gap));
            }
            else if (first.IsLeaf(pair.First) && second.IsLeaf(pair.Second))
            {
                _leastGap = 0;
                if (!CollectionsMarshal.AsSpan(leaves)[..leafCount].Contains((pair.First, pair.Second)))
                {
                    AddLeaves(pair.First, pair.Second, leaves);
                }
            }
            else
            {
                Open(in pair);
            }
        }

        leaves.RemoveRange(0, leafCount);
        _features.End(contacts);
        FaceTests = _features.Tests;
        return _open.Count > 0 ? 0 : near.Count > 0 ? margin : Math.Max(margin, _leastGap);
    }

    private void AddLeaves(int leaf1, int leaf2, List<(int First, int Second)> leaves)
    {
        var changesBefore = _features.Manifold.ChangeCount;
        _features.Add(First, leaf1, in Motion1, Second, leaf2, in Motion2);
        if (_features.Manifold.ChangeCount > changesBefore && leaves.Count < MaxLeaves)
        {
            leaves.Add((leaf1, leaf2));
        }
    }

    /// <summary>True for parts that come so near in the rest of the step that contacts are looked for in them.</summary>
    private bool IsApproaching(in Pair pair)
    {
        var test = new SeparationTest(
            in Motion1, in Motion2, pair.Box1.Centre, pair.Box1.Radius, pair.Box2.Centre, pair.Box2.Radius, out var relative);
        return !(pair.Gap > 0 && test.SafeTime(pair.Axis, in pair.Box1, in pair.Box2, ApproachDistance * _distance) >= 1);
    }

    private void Open(in Pair pair)
    {
        var children = OpenLarger(pair.First, pair.Second, out var opensFirst);
        for (var child = children.Start.Value; child < children.End.Value; child++)
        {
            PushChild(in pair, child, opensFirst);
        }
    }

    private void PushChild(in Pair pair, int child, bool opensFirst)
    {
        ref readonly var motion = ref opensFirst ? ref Motion1 : ref Motion2;
        ref readonly var local = ref opensFirst ? ref First[child] : ref Second[child];
        ref readonly var other = ref opensFirst ? ref pair.Box2 : ref pair.Box1;
        BoundTests++;
        var gap = ((motion.Map * local.Centre) - other.Centre).Length() - (motion.Scale * local.Radius) - other.Radius;
        if (gap > _margin)
        {
            _leastGap = Math.Min(_leastGap, gap);
            return;
        }

        var box = local.Place(in motion);
        PushIfNear(
            opensFirst ? child : pair.First, in opensFirst ? ref box : ref other, opensFirst ? pair.Second : child,
            in opensFirst ? ref other : ref box);
    }

    private void PushIfNear(int node1, in SurfaceBox box1, int node2, in SurfaceBox box2)
    {
        BoundTests++;
        var separation = SeparationTest.Separate(in box1, in box2, _margin);
        if (separation.Gap > _margin)
        {
            _leastGap = Math.Min(_leastGap, separation.Gap);
            return;
        }

        ref readonly var smaller = ref box1.Radius < box2.Radius ? ref box1 : ref box2;
        // The part with the outermost corner, and of its parts the one that has that corner.
        _open.Enqueue(_pairs.Count, (-(smaller.FarthestCorner(_middle) - _middle).Length(), -_pairs.Count));
        _pairs.Add(new(node1, in box1, node2, in box2, in separation));
    }

    private readonly struct Pair(int first, in SurfaceBox box1, int second, in SurfaceBox box2, in (Vector Axis, double Gap) separation)
    {
        public readonly SurfaceBox Box1 = box1;

        public readonly SurfaceBox Box2 = box2;

        public int First { get; } = first;

        public int Second { get; } = second;

        public Vector Axis { get; } = separation.Axis;

        public double Gap { get; } = separation.Gap;
    }
}
