using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// Finds where two surfaces touch or nearly touch: all pairs of triangles within a margin, the outermost parts first, without those that
/// the contacts found so far hold apart.
/// </summary>
internal sealed class ContactSearch : PairSearch
{
    // Pairs of parts that are opened: the contacts found up to there have to do.
    private const int MaxPairs = 4_000;

    private readonly PriorityQueue<Pair, (double Inwardness, int Order)> _queue = new();
    private readonly FeatureContacts _features = new();
    private double _margin;
    private double _leastGap;
    private Vector _middle;
    private int _order;

    /// <summary>Finds the contacts of two surfaces.</summary>
    /// <param name="first">The first surface.</param>
    /// <param name="motion1">Where it is.</param>
    /// <param name="second">The second surface.</param>
    /// <param name="motion2">Where it is, in the same frame.</param>
    /// <param name="distance">The distance at which surfaces rest on each other, scene units.</param>
    /// <param name="margin">Largest gap that counts, at least that distance.</param>
    /// <param name="contacts">Receives the contacts, in the order of their groups.</param>
    /// <param name="near">Receives all that is within the margin.</param>
    /// <returns>The margin, or how far the surfaces are apart if that is more; 0 where there was too much to look at all of it.</returns>
    public double FindContacts(
        SurfaceNodes first, in SurfaceMotion motion1, SurfaceNodes second, in SurfaceMotion motion2, double distance, double margin,
        List<ContactPoint> contacts, List<NearPair> near)
    {
        SetPair(first, motion1.Stopped, second, motion2.Stopped);
        _margin = margin;
        var box1 = first[0].Place(in Motion1);
        var box2 = second[0].Place(in Motion2);
        _middle = box1.Radius < box2.Radius ? box1.Centre : box2.Centre;
        _queue.Clear();
        _order = 0;
        _leastGap = double.PositiveInfinity;
        _features.Begin((first.IsMirrored, second.IsMirrored), Math.Min(box1.Radius, box2.Radius), distance, margin, near);
        Enqueue(0, 0);
        for (var opened = 0; opened < MaxPairs && _queue.TryDequeue(out var pair, out _); opened++)
        {
            if (_features.Manifold.Holds(in pair.Box1, in pair.Box2))
            {
                near.Add(new(pair.First, -1, pair.Second, -1, pair.Axis, pair.Gap));
                continue;
            }

            if (first.IsLeaf(pair.First) && second.IsLeaf(pair.Second))
            {
                _leastGap = 0;
                _features.Add(first, pair.First, in Motion1, second, pair.Second, in Motion2);
                continue;
            }

            var children = OpenLarger(pair.First, pair.Second, out var opensFirst);
            for (var child = children.Start.Value; child < children.End.Value; child++)
            {
                Enqueue(opensFirst ? child : pair.First, opensFirst ? pair.Second : child);
            }
        }

        _features.End(contacts);
        FaceTests = _features.Tests;
        return _queue.Count > 0 ? 0 : near.Count > 0 ? margin : Math.Max(margin, _leastGap);
    }

    // Nothing moves, so that what is apart stays so for ever.
    private SeparationTest Test => new(in Motion1, in Motion2, Vector.Zero, 0, Vector.Zero, 0);

    private void Enqueue(int node1, int node2)
    {
        BoundTests++;
        var box1 = First[node1].Place(in Motion1);
        var box2 = Second[node2].Place(in Motion2);
        _ = Test.SafeTime(in box1, in box2, _margin, 1, out var best);
        if (best.Gap > _margin)
        {
            _leastGap = Math.Min(_leastGap, best.Gap);
        }
        else
        {
            ref readonly var smaller = ref box1.Radius < box2.Radius ? ref box1 : ref box2;
            _queue.Enqueue(
                new(node1, in box1, node2, in box2, in best), (-(smaller.Centre - _middle).Length() - smaller.Radius, ++_order));
        }
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
