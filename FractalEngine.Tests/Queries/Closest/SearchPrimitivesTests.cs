using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Queries.Closest;
using FractalEngine.Core.Queries.Regions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Queries.Closest;

/// <summary>Tests the queues, stacks and policies of searches on levels, each by itself.</summary>
public sealed class SearchPrimitivesTests
{
    private const double Rounding = 4e-15;

    private static readonly BoundingBox Unit = new(Vector.Zero, Vector.One);

    [Fact]
    public void TryPeek_OfChildren_GivesThemByBoundAndThoseAroundByCentre()
    {
        var queue = new ChildQueue(new double[16]);
        queue.SetBounds(Vector256.Create(0.0, 0, 4, 1), Vector256.Create(5.0, 2, 1, 9), 0);
        queue.SetBounds(Vector256.Create(double.PositiveInfinity, 4, 7, 0.5), Vector256.Create(1.0, 2, 9, 100), 4);
        Assert.True(queue.MayContain(0) && queue.MayContain(1) && !queue.MayContain(7));
        Assert.Equal((4.0, 7.0, 0.5), (queue.BoundOf(2), queue.BoundOf(6), queue.BoundOf(7)));
        Near.Equal(5e-4, queue.KeyOf(0), 1e-18);
        Near.Equal(4, queue.KeyOf(2), 1e-11);
        Assert.True(queue.KeyOf(2) < queue.KeyOf(5));
        foreach (var expected in new[] { 1, 0, 7, 3, 2, 5, 6 })
        {
            Assert.True(queue.TryPeek(double.PositiveInfinity, double.NaN, out var child));
            Assert.Equal(expected, child);
            Assert.False(queue.TryPeek(queue.BoundOf(child), double.NaN, out var none));
            Assert.Equal(-1, none);
            Assert.True(queue.TryPeek(Math.BitIncrement(queue.BoundOf(child)), double.NaN, out var same));
            Assert.Equal(expected, same);
            queue.Remove(child);
        }

        Assert.False(queue.TryPeek(double.PositiveInfinity, double.NaN, out _));
    }

    [Fact]
    public void Refine_OfAChild_TakesALargerBoundOnly()
    {
        var queue = new ChildQueue(new double[8]);
        queue.SetBounds(Vector256.Create(0.0, 3, 4, 5), Vector256.Create(1e6, 1, 1, 1), 0);
        Assert.False(queue.Refine(1, 3));
        Assert.False(queue.Refine(1, 2));
        Assert.False(queue.Refine(1, double.NaN));
        Assert.Equal(3, queue.BoundOf(1));
        Assert.True(queue.Refine(1, 4.5));
        Assert.Equal(4.5, queue.BoundOf(1));
        Near.Equal(4.5, queue.KeyOf(1), 1e-11);
        // The centre counted while the position was within the bounds, and hardly any more.
        Near.Equal(100, queue.KeyOf(0), 1e-12);
        Assert.True(queue.Refine(0, 4.2));
        Near.Equal(4.2 + 1e-6, queue.KeyOf(0), 1e-12);
        foreach (var expected in new[] { 2, 0, 1, 3 })
        {
            Assert.True(queue.TryPeek(double.PositiveInfinity, double.NaN, out var child));
            Assert.Equal(expected, child);
            queue.Remove(child);
        }
    }

    [Fact]
    public void Refine_OfAHugeBoxThatIsNearlyEmpty_LeavesAKeyOfTwiceTheBound()
    {
        var queue = new ChildQueue(new double[8]);
        queue.SetBounds(Vector256.Create(0.0, 0, 0, 0), Vector256.Create(1e20, 1, 1, 1), 0);
        Assert.True(queue.Refine(0, 3));
        Assert.Equal((3.0, 6.0), (queue.BoundOf(0), queue.KeyOf(0)));
    }

    [Fact]
    public void TryPeek_OfChildrenInSinglePrecision_AllowsTheError()
    {
        const float Error = 0.25f;
        var queue = new FloatChildQueue(new double[16], Error);
        var infinity = float.PositiveInfinity;
        queue.SetBounds(
            Vector256.Create(0f, 0, 4, 1, 0.0625f, 4, 9, 16), Vector256.Create(5f, 2, 1, 9, 1, 1, 1, 1), 0);
        queue.SetBounds(
            Vector256.Create(infinity, infinity, infinity, 0.5f, infinity, infinity, infinity, 25), Vector256<float>.One, 8);
        Assert.True(queue.MayContain(0) && queue.MayContain(4) && !queue.MayContain(11));
        Assert.Equal((0.0, 0.0), (queue.BoundOf(0), queue.BoundOf(4)));
        Assert.Equal((1.75 * 1.75, 4.75 * 4.75), (queue.BoundOf(2), queue.BoundOf(15)));
        foreach (var expected in new[] { 1, 0, 4, 11, 3, 2, 5, 6, 7, 15 })
        {
            Assert.True(queue.TryPeek(double.NaN, 100, out var child));
            Assert.Equal(expected, child);
            // Within the error of the cutoff, and a little more for the rounding of the limit.
            var distance = Math.Sqrt(queue.BoundOf(child));
            Assert.True(queue.TryPeek(double.NaN, distance, out var same));
            Assert.Equal(expected, same);
            Assert.False(distance > 0 && queue.TryPeek(double.NaN, distance - (1e-5 * (1 + distance)), out _));
            queue.Remove(child);
        }

        Assert.False(queue.TryPeek(double.NaN, 100, out _));
    }

    [Fact]
    public void Refine_OfAChildInSinglePrecision_TakesALargerBoundOnly()
    {
        var queue = new FloatChildQueue(new double[8], 0);
        queue.SetBounds(Vector256.Create(1f, 2, 3, 4, 5, 6, 7, 8), Vector256<float>.One, 0);
        Assert.False(queue.Refine(0, 1) || queue.Refine(1, 1.5) || queue.Refine(2, double.NaN));
        Assert.True(queue.Refine(0, 3.5));
        Near.Equal(3.5, queue.BoundOf(0), 2e-6);
        foreach (var expected in new[] { 1, 2, 0, 3, 4, 5, 6, 7 })
        {
            Assert.True(queue.TryPeek(double.NaN, 100, out var child));
            Assert.Equal(expected, child);
            queue.Remove(child);
        }
    }

    [Fact]
    public void FractalSearchState_AfterAHit_ExcludesWhatIsNoCloserUpToEpsilon()
    {
        var context = new QueryContext();
        var search = new FractalSearchState(10, 1, 5, 8, context);
        Assert.Equal((4.0, 0.25, -1, true), (search.BoundFactor, search.InverseBoundFactor, search.ClosestFace, search.IsComplete));
        Assert.True(search.ClosestDistanceSquared > 100);
        Near.Equal(100, search.ClosestDistanceSquared, 1e-11);
        Assert.False(search.Excludes(25));
        Assert.True(search.Excludes(25.001));
        Near.Equal(5, search.BoundCutoff, 1e-12);
        search.RecordChild(0, 3);
        search.RecordChild(1, 4);
        search.RecordChild(2, 5);
        search.UpdateClosest(9, 17, 2);
        Assert.Equal((17, 2, 9.0), (search.ClosestFace, search.ClosestDepth, search.ClosestDistanceSquared));
        Assert.Equal(new[] { 3, 4 }, context.BestPathBuffer(2)[..2].ToArray());
        // What differs by no more than rounding counts as equal.
        Assert.True(search.CutoffSquared < 9);
        Near.Equal(9, search.CutoffSquared, 1e-12);
        Assert.True(search.Excludes(2.25));
        Assert.False(search.Excludes(2.249999));
        Near.Equal(1.5, search.BoundCutoff, 1e-13);
        Assert.Equal(search.BoundCutoff, Math.Sqrt(search.BoundCutoffSquared));
    }

    [Fact]
    public void ErrorBound_OfASearch_SumsWhatIsOpenRoundingAndPrecision()
    {
        var search = new FractalSearchState(double.PositiveInfinity, 0, 5, 8, new());
        search.UpdateClosest(9, 0, 0);
        Near.Equal(8 * Rounding, search.ErrorBound(3, 0), 1e-28);
        Near.Equal(20 * Rounding, search.ErrorBound(3, 20), 1e-28);
        search.MinRadiusSquared = 1e-6;
        Near.Equal((8 * Rounding) + 2e-3, search.ErrorBound(3, 0), 1e-17);
        search.LeaveOpen(9);
        Assert.True(search.IsComplete);
        search.LeaveOpen(4);
        search.LeaveOpen(6);
        Assert.False(search.IsComplete);
        Assert.Equal(4, search.OpenBoundSquared);
        Near.Equal(1 + (8 * Rounding) + 2e-3, search.ErrorBound(3, 0), 1e-15);
    }

    [Fact]
    public void WithinBudget_AtItsLimits_EndsTheSearchUntilItIsReset()
    {
        var search = new FractalSearchState(10, 0, 1, 1, new()) { BoundTests = 49_999 };
        Assert.True(search.WithinBudget(QueryContext.MaxStackDepth - 1));
        Assert.False(search.HasExceededBudget);
        search.BoundTests++;
        Assert.False(search.WithinBudget(0));
        Assert.True(search.HasExceededBudget && search.Excludes(0));
        search.ResetBudget();
        Assert.False(search.HasExceededBudget || search.Excludes(99));
        search.BoundTests = 0;
        Assert.False(search.WithinBudget(QueryContext.MaxStackDepth));
        search.UpdateClosest(4, 1, 0);
        search.ResetBudget();
        Assert.True(search.Excludes(4));
        Assert.False(search.Excludes(3.999));
    }

    [Fact]
    public void FractalSearchState_OfMuchWork_TellsItsLimits()
    {
        var search = new FractalSearchState(10, 1e300, 1, 1, new()) { BoundTests = 2500 };
        Assert.True(double.IsFinite(search.BoundFactor));
        Assert.False(search.NeedsTightBounds);
        search.BoundTests = 2501;
        Assert.True(search.NeedsTightBounds);
        search.BoundTests = 999_999;
        Assert.False(search.HasMetWorkLimit);
        search.BoundTests = 1_000_000;
        Assert.True(search.HasMetWorkLimit);
        search.AddStatistics(new(1) { FaceTests = 3, BoundTests = 7 });
        search.AddStatistics(new(1) { FaceTests = 1, BoundTests = 2 });
        Assert.Equal((4L, 1_000_009L, 9L, 2), (search.FaceTests, search.BoundTests, search.MeshBoundTests, search.MeshSearches));
    }

    [Fact]
    public void RecordChild_DeeperThanTheBuffer_KeepsTheWholePath()
    {
        var context = new QueryContext();
        var search = new FractalSearchState(10, 0, 1, 1, context);
        for (var depth = 0; depth < 1000; depth++)
        {
            search.RecordChild(depth, depth % 7);
        }

        search.UpdateClosest(1, 0, 1000);
        Assert.Equal(Enumerable.Range(0, 1000).Select(depth => depth % 7), context.BestPathBuffer(1000)[..1000].ToArray());
        var slice = search.ScratchSlice(5000, 30);
        Assert.Equal(30, slice.Length);
    }

    [Fact]
    public void TraversalStack_OfNodes_GivesTheLastFirstWithItsPath()
    {
        var stack = new TraversalStack();
        for (var i = 0; i < 100; i++)
        {
            Assert.True(stack.TryPush(NodeOf(i), i, i % 3 == 1 ? -1 : i, i + 1));
        }

        Assert.True(stack.TryPush(NodeOf(0), double.PositiveInfinity, 0, 1));
        Assert.Equal(100, stack.Count);
        for (var i = 99; i >= 0; i--)
        {
            Assert.True(stack.TryPop(out var node, out var depth));
            Assert.Equal(((long)i, i + 1), (node.State.Level, depth));
            Assert.True(i % 3 == 1 || stack.Path(depth)[i] == i);
            Assert.Equal(depth, stack.Path(depth).Length);
        }

        Assert.False(stack.TryPop(out _, out _));
        Assert.False(stack.TryPush(NodeOf(5), double.NegativeInfinity, 0, 1));
        stack.Clear();
        Assert.False(stack.TryPop(out _, out _));
    }

    [Theory]
    [InlineData(0, 4)]
    [InlineData(1, 3)]
    [InlineData(5, 5)]
    public void MoveNearestToTop_OfTheLastEntries_LeavesTheOthers(int first, int expectedTop)
    {
        var stack = new TraversalStack();
        double[] measures = [5, 3, 2, 2.5, 1, 7];
        measures[4] = first == 1 ? 6 : 1;
        measures[2] = first == 1 ? 4 : 2;
        for (var i = 0; i < measures.Length; i++)
        {
            stack.TryPush(NodeOf(i), measures[i], i, 1);
        }

        stack.MoveNearestToTop(first);
        Assert.True(stack.TryPop(out var top, out _));
        Assert.Equal(expectedTop, top.State.Level);
        var rest = new List<long>();
        while (stack.TryPop(out var node, out _))
        {
            rest.Add(node.State.Level);
        }

        Assert.Equal(Enumerable.Range(0, 6).Where(i => i != expectedTop).Select(i => (long)i), rest.Order());
        if (first == 5)
        {
            Assert.Equal(new long[] { 4, 3, 2, 1, 0 }, rest);
        }

        stack.MoveNearestToTop(0);
        Assert.Equal(0, stack.Count);
    }

    [Fact]
    public void Release_OfTheLastReference_FreesANodeAndItsAncestors()
    {
        var children = new ExpandedChildren();
        var root = children.AddNode(NodeBelow(-1, 0), 100);
        var parent = children.AddNode(NodeBelow(root, 1), 100);
        var child = children.AddNode(NodeBelow(parent, 2), 100);
        Assert.Equal((0, 1, 2), (root, parent, child));
        Assert.Equal((root, 1), (children.Node(parent).ParentNode, children.Node(parent).Depth));
        children.Release(root);
        children.Release(parent);
        Assert.Equal(3, children.AddNode(NodeBelow(child, 3), 100));
        children.Release(child);
        // The last one gives up all four.
        children.Release(3);
        int[] reused =
        [
            children.AddNode(NodeBelow(-1, 0), 100), children.AddNode(NodeBelow(-1, 0), 100),
            children.AddNode(NodeBelow(-1, 0), 100), children.AddNode(NodeBelow(-1, 0), 100),
        ];
        Assert.Equal(new[] { 0, 1, 2, 3 }, reused.Order());
        Assert.Equal(4, children.AddNode(NodeBelow(-1, 0), 100));
        children.Clear();
        Assert.Equal(0, children.AddNode(NodeBelow(-1, 0), 100));
    }

    [Fact]
    public void TryTake_OfExpandedChildren_GoesByKeyUntilThereAreTooManyNodes()
    {
        var children = new ExpandedChildren();
        var root = children.AddNode(NodeBelow(-1, 0), 3);
        children.Enqueue(new(1, 5, root, 0, false));
        children.Enqueue(new(1, 2, root, 1, false));
        children.AddNode(NodeBelow(root, 1), 3);
        children.Enqueue(new(1, 3, root, 2, false));
        children.AddNode(NodeBelow(root, 1), 3);
        children.Enqueue(new(1, 1, root, 3, false));
        children.Enqueue(new(1, 9, root, 4, false));
        foreach (var expected in new[] { 4, 3, 1, 2, 0 })
        {
            Assert.True(children.TryTake(out var child));
            Assert.Equal(expected, child.ChildIndex);
        }

        Assert.False(children.TryTake(out _));
    }

    [Fact]
    public void AddNode_OfManyNodes_KeepsAllOfThem()
    {
        var children = new ExpandedChildren();
        for (var i = 0; i < 200; i++)
        {
            Assert.Equal(i, children.AddNode(NodeBelow(i - 1, i), 1000));
        }

        for (var i = 0; i < 200; i++)
        {
            Assert.Equal((i - 1, i), (children.Node(i).ParentNode, children.Node(i).Depth));
            Assert.Equal(i == 199 ? 1 : 2, children.Node(i).ReferenceCount);
        }
    }

    [Fact]
    public void Slack_OfANode_IsThatOfItsLargestProducts()
    {
        var map = new AffineMap(Matrix.Diagonal(new(2, -3, 1)), new(1, 10, 0));
        var node = new ShapeNode(null, default, default, 0, in map, new(new(-1, -4, 0), Vector.One), 7);
        Assert.Equal(12 + 10, node.Reach);
        Near.Equal(22 * Rounding, node.Slack, 1e-28);
        Assert.Equal(new BoundingBox(new(-1, 7, 0), new(3, 22, 1)), node.Box);
        Assert.True(node.IsBoundedByBox && node.IsBase);
        Assert.Equal(100, new ShapeNode(null, default, default, 0, in map, Unit, 100).Reach);
        Assert.False(new ShapeNode(null, default, default, -1, in map, Unit, 0).IsBase);
        Assert.False(NodeOf(Unit, Turned(Vector.Zero)).IsBoundedByBox);
    }

    [Fact]
    public void FindLowestPoint_OfABoxUnderAMap_IsTheCornerFarthestBack() => Seeded.Run(50, random =>
    {
        var map = new AffineMap(new(random.Vector(), random.Vector(), random.Vector()), random.Vector());
        var direction = random.Vector();
        var lowest = NodeOf(Unit, map).FindLowestPoint(direction, out var margin);
        Assert.Equal(0, margin);
        Near.Equal(Corners(Unit).Min(corner => Vector.Dot(direction, map * corner)), Vector.Dot(direction, lowest), 1e-14);
    });

    [Fact]
    public void LowerBoundSquared_OfTwoTurnedBoxes_IsTheirDistance()
    {
        var cube = new BoundingBox(-Vector.One, Vector.One);
        // Turned by 45°, an edge is √2 from the middle.
        var turned = NodeOf(cube, Turned(Vector.Zero));
        foreach (var (x, y, z) in new Vector[] { new(4, 0, 0), new(0, -5, 0), new(0, 0, 7), new(4, 0, 6) })
        {
            var other = NodeOf(cube, AffineMap.Translate(new(x, y, z)));
            var expected = new Vector(
                Math.Max(0, Math.Abs(x) - 1 - Math.Sqrt(2)), Math.Max(0, Math.Abs(y) - 1 - Math.Sqrt(2)), Math.Max(0, Math.Abs(z) - 2));
            Near.Equal(
                expected.LengthSquared(), ConvexPairDistance.LowerBoundSquared(in turned, in other, double.PositiveInfinity), 1e-12);
            Near.Equal(
                expected.LengthSquared(), ConvexPairDistance.LowerBoundSquared(in other, in turned, double.PositiveInfinity), 1e-12);
        }

        var overlapping = NodeOf(cube, AffineMap.Translate(Vector.One));
        Assert.Equal(0, ConvexPairDistance.LowerBoundSquared(in turned, in overlapping, double.PositiveInfinity));
    }

    /// <summary>The boxes around a turned cube and beside its edge overlap, but the cube does not reach there.</summary>
    [Fact]
    public void Measure_OfABoxPolicy_TellsOutsideInsideAndBetween()
    {
        var turned = NodeOf(new(-Vector.One, Vector.One), Turned(Vector.Zero));
        Assert.Equal(double.PositiveInfinity, PolicyOf(new(new(1.2, 1.2, 0), new(1.4, 1.4, 0.5))).Measure(in turned));
        Assert.Equal(double.PositiveInfinity, PolicyOf(new(new(1.5, 0, 0), new(2, 1, 1))).Measure(in turned));
        Assert.Equal(double.NegativeInfinity, PolicyOf(new(-2 * Vector.One, 2 * Vector.One)).Measure(in turned));
        Near.Equal(1 + 0.04, PolicyOf(new(new(1, 0.2, 0), new(2, 1, 1))).Measure(in turned), 1e-12);
        var cube = NodeOf(Unit, AffineMap.Identity);
        Assert.Equal(double.PositiveInfinity, PolicyOf(new(new(1.001, 0, 0), new(2, 1, 1))).Measure(in cube));
        Assert.Equal(0.25, PolicyOf(new(new(1, 0, 0), new(2, 1, 1))).Measure(in cube));
        Assert.Equal(5, PolicyOf(Unit).MaxBoundTests);
    }

    [Fact]
    public void MayCountX4_OfABoxPolicy_TellsWhichBoxesMeet()
    {
        var policy = PolicyOf(Unit);
        foreach (var axis in new[] { Vector.I, Vector.J, Vector.K })
        {
            var middle = 0.5 * Vector.One;
            Vector[] centres = [middle + (0.75 * axis), middle - (0.75 * axis), middle + (0.76 * axis), middle - (0.76 * axis)];
            var extents = VectorX4.Broadcast(0.25 * Vector.One);
            Assert.Equal(0b0011u, policy.MayCountX4(PackOf(centres), extents, 1e-9).ExtractMostSignificantBits());
            Assert.Equal(0b1111u, policy.MayCountX4(PackOf(centres), extents, 0.02).ExtractMostSignificantBits());
        }
    }

    [Fact]
    public void BallPolicy_OfFaces_TakesThoseAtExactlyTheRadius()
    {
        var hits = new List<BallHit>();
        var policy = new BallPolicy(new(0, 0, 3), 3, 50, hits, 2);
        var leaf = NodeOf(Unit, AffineMap.Identity);
        Assert.Equal(50, policy.MaxBoundTests);
        Assert.True(policy.Visit(4, Vector.Zero, Vector.I, Vector.J, in leaf, [1, 2]));
        Assert.True(policy.Visit(5, -1e-9 * Vector.K, Vector.I - Vector.K, Vector.J - Vector.K, in leaf, [1, 2]));
        Assert.True(policy.Visit(6, Vector.K, Vector.I, Vector.J, in leaf, [1, 2]));
        Assert.False(policy.Visit(7, 2 * Vector.K, Vector.I, Vector.J, in leaf, [3]));
        Assert.Equal(new[] { 4, 6, 7 }, hits.Select(hit => hit.FaceIndex));
        Assert.Equal((3.0, Vector.Zero, Vector.K), (hits[0].Distance, hits[0].Point, hits[0].Normal));
        Assert.Same(hits[0].Path, hits[1].Path);
        Assert.Equal(new[] { 3 }, hits[2].Path);
        Assert.Equal(50 + 300, policy.MaxBoundTests);
        Assert.Equal(0.25 + 0.25 + 6.25, policy.Measure(in leaf));
        Assert.Equal(double.PositiveInfinity, policy.Measure(NodeOf(Unit, AffineMap.Translate(new(0, 3.1, 3)))));
        Vector[] centres = [new(3.5, 0, 3), new(0, -3.5, 3), new(0, 0, 6.6), new(2.7, 2.7, 3)];
        Assert.Equal(
            0b0011u, policy.MayCountX4(PackOf(centres), VectorX4.Broadcast(0.5 * Vector.One), 1e-9).ExtractMostSignificantBits());
    }

    [Fact]
    public void DistanceSquared_OfMappedBoxes_IsThatToTheBoxesAroundTheImages() => Seeded.Run(50, random =>
    {
        var map = new AffineMap(new(random.Vector(), random.Vector(), random.Vector()), random.Vector());
        Vector[] centres = [random.Vector(), random.Vector(), random.Vector(), random.Vector()];
        var halfSize = random.Vector().Absolute();
        var position = random.Vector(5);
        var distances = TransformedBoxDistance.DistanceSquared(
            PackOf([.. centres.Select(centre => position - (map * centre))]), VectorX4.Broadcast(halfSize),
            VectorX4.Broadcast(map.Linear.V1), VectorX4.Broadcast(map.Linear.V2), VectorX4.Broadcast(map.Linear.V3));
        for (var i = 0; i < 4; i++)
        {
            var box = new BoundingBox(centres[i] - halfSize, centres[i] + halfSize).Transform(map);
            Near.Equal(box.DistanceSquared(position), distances[i], 1e-12);
        }
    });

    private static BoxPolicy PolicyOf(BoundingBox box) => new(box, true, 5);

    private static ShapeNode NodeOf(long number) => new(null, new(number, 0), default, 0, AffineMap.Identity, Unit, 0);

    private static ShapeNode NodeOf(BoundingBox box, AffineMap map) => new(null, default, default, 0, in map, box, 0);

    private static SearchNode NodeBelow(int parent, int depth) =>
        new(null!, default, SimdAffineMap.Identity, SimdAffineMap.Identity, parent, 0, depth);

    private static AffineMap Turned(Vector translation) => new(new Vector(0, 0, 45).LocalAxesFromDegrees(), translation);

    private static VectorX4 PackOf(Vector[] vectors) => new(
        Vector256.Create(vectors[0].X, vectors[1].X, vectors[2].X, vectors[3].X),
        Vector256.Create(vectors[0].Y, vectors[1].Y, vectors[2].Y, vectors[3].Y),
        Vector256.Create(vectors[0].Z, vectors[1].Z, vectors[2].Z, vectors[3].Z));

    private static IEnumerable<Vector> Corners(BoundingBox box) =>
        from x in new[] { box.Minimum.X, box.Maximum.X }
        from y in new[] { box.Minimum.Y, box.Maximum.Y }
        from z in new[] { box.Minimum.Z, box.Maximum.Z }
        select new Vector(x, y, z);
}
