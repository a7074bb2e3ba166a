using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Bvh.Objects;

/// <summary>The hierarchy over objects holds each once, in boxes that hold it, however its objects lie and move.</summary>
public class ObjectBvhTests
{
    [Fact]
    public void Build_OfAnyBoxes_HoldsEachLeafOnceInBoxesAboveIt() => Seeded.Run(200, random =>
    {
        var leaves = Enumerable.Range(0, random.Next(1, 200)).Select(i => new ObjectBvhLeaf(i, RandomBox(random))).ToArray();
        AssertHolds(ObjectBvh.Build(leaves), leaves);
    });

    [Fact]
    public void With_AfterAnyMoves_HoldsEachLeafOnceInBoxesAboveIt() => Seeded.Run(100, random =>
    {
        var leaves = Enumerable.Range(0, random.Next(1, 200)).Select(i => new ObjectBvhLeaf(i, RandomBox(random))).ToArray();
        var first = ObjectBvh.Build(leaves);
        var firstLeaves = leaves.ToArray();
        var bvh = first;
        for (var move = 0; move < 50; move++)
        {
            var index = random.Next(leaves.Length);
            leaves[index] = new(index, RandomBox(random));
            bvh = bvh.With(leaves[index]);
        }

        AssertHolds(bvh, leaves);
        AssertHolds(first, firstLeaves);
    });

    [Fact]
    public void DistanceBounds_OfAnyBoxes_AreAtMostTheDistancesAndCloseToThem() => Seeded.Run(300, random =>
    {
        var leaves = Enumerable.Range(0, random.Next(1, 5)).Select(i => new ObjectBvhLeaf(i, RandomBox(random))).ToArray();
        var position = random.Vector(5);
        var bounds = new ObjectBvhNode([.. leaves]).DistanceBounds(position);
        for (var slot = 0; slot < ObjectBvhNode.Width; slot++)
        {
            var distance = slot < leaves.Length
                ? Math.Sqrt(leaves[slot].Bounds.DistanceSquared(position)) : double.PositiveInfinity;
            Assert.InRange(bounds[slot], 0, distance);
            // Three coordinates of size 3 are rounded to single precision, each to a part in 2²³ at most; larger boxes overflow.
            Assert.True(distance - bounds[slot] < 1e-5 || distance > 1e100, $"{bounds[slot]} {distance}");
        }
    });

    [Fact]
    public void Build_OfManyBoxesInOnePlace_HasAPathToEach()
    {
        var leaves = Enumerable.Range(0, 5000).Select(i => new ObjectBvhLeaf(i, new(Vector.Zero, Vector.One))).ToArray();
        AssertHolds(ObjectBvh.Build(leaves), leaves);
    }

    [Fact]
    public void Build_OfGeometricallySpacedBoxes_HasAPathToEach()
    {
        // Splits by the heuristic separate one box at a time.
        var leaves = Enumerable.Range(0, 900)
            .Select(i => new ObjectBvhLeaf(i, new(Math.Pow(1.6, i - 450) * Vector.One, Math.Pow(1.6, i - 450) * Vector.One))).ToArray();
        var bvh = ObjectBvh.Build(leaves);
        AssertHolds(bvh, leaves);
        leaves[7] = new(7, new(-Vector.One, -Vector.One));
        AssertHolds(bvh.With(leaves[7]), leaves);
    }

    [Fact]
    public void IsDegraded_OnlyAfterBoxesHaveGrown()
    {
        var random = new Random(1);
        var leaves = Enumerable.Range(0, 1000).Select(i => Cube(i, random.Vector(10))).ToArray();
        var bvh = ObjectBvh.Build(leaves);
        for (var i = 0; i < leaves.Length; i++)
        {
            bvh = bvh.With(Cube(i, leaves[i].Bounds.Centre + random.Vector(0.01)));
        }

        Assert.False(bvh.IsDegraded, "after small moves");
        for (var i = 0; i < 100; i++)
        {
            bvh = bvh.With(Cube(i, random.Vector(10)));
        }

        Assert.True(bvh.IsDegraded, "after far moves");
        Assert.True(ObjectBvh.Build(leaves).With(new(3, new(double.NegativeInfinity * Vector.One, Vector.One))).IsDegraded, "unbounded");
    }

    private static ObjectBvhLeaf Cube(int index, Vector centre) =>
        new(index, new(centre - (0.1 * Vector.One), centre + (0.1 * Vector.One)));

    private static void AssertHolds(ObjectBvh bvh, ObjectBvhLeaf[] leaves)
    {
        Assert.Equal(leaves.Length, bvh.Count);
        var copied = new ObjectBvhLeaf[leaves.Length];
        bvh.CopyTo<ObjectBvhLeaf>(copied);
        Assert.Equal(leaves, copied);
        Assert.Equal(leaves.Length, CountLeaves(bvh.Root));
    }

    private static int CountLeaves(ObjectBvhNode node)
    {
        Assert.InRange(node.ChildCount, 1, ObjectBvhNode.Width);
        var count = 0;
        for (var slot = 0; slot < node.ChildCount; slot++)
        {
            // A union only selects coordinates, and those of a leaf are rounded outwards.
            var box = node[slot] is ObjectBvhNode inner ? inner.Box : ((ObjectBvhLeaf)node[slot]).Bounds;
            Assert.Equal(node.BoxOf(slot), BoundingBox.Union(node.BoxOf(slot), box));
            count += node[slot] is ObjectBvhNode child ? CountLeaves(child) : 1;
        }

        return count;
    }

    private static BoundingBox RandomBox(Random random)
    {
        var (corner1, corner2) = (random.Vector(3), random.Vector(3));
        return random.Next(12) switch
        {
            0 => BoundingBox.Empty,
            1 => new(corner1, double.NaN * Vector.One),
            2 => new(double.NegativeInfinity * Vector.One, corner1),
            3 => new(1e200 * corner1, 1e200 * corner1),
            4 => new(corner1, corner1),
            // Empty unless the corners happen to be in order.
            5 => new(corner1, corner2),
            _ => BoundingBox.Empty.Including(corner1).Including(corner2),
        };
    }
}
