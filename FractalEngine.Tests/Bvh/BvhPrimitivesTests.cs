using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Bvh.Splitting;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Bvh;

/// <summary>Tests the small parts of the hierarchy over triangles, each by itself.</summary>
public sealed class BvhPrimitivesTests
{
    private const double HalfPlace = 1.0 / (1 << 24);

    [Fact]
    public void RemoveFrom_ALimit_KeepsWhatIsBelowItInItsOrder()
    {
        var list = new CandidateList(new ulong[CandidateList.Capacity]);
        list.Add(2, 7);
        list.Add(1, int.MaxValue);
        list.Add(3, 9);
        list.Add(0.5f, 4);
        list.Add(MathF.BitDecrement(2), 0);
        list.RemoveFrom(2);
        Assert.Equal(3, list.Count);
        Assert.Equal((int.MaxValue, 4, 0), (list[0], list[1], list[2]));
        list.Clear();
        Assert.Equal((0, false), (list.Count, list.IsFull));
    }

    [Fact]
    public void IsFull_OfAList_TellsWhetherAnotherLeafFits()
    {
        var list = new CandidateList(new ulong[CandidateList.Capacity]);
        for (var i = 0; i < CandidateList.Capacity; i++)
        {
            Assert.Equal(i + BvhLayout.MaxLeafTriangles > CandidateList.Capacity, list.IsFull);
            list.Add(i, i);
        }
    }

    [Fact]
    public void BvhChild_OfALeafOrANode_TellsWhatItWasMadeOf()
    {
        foreach (var first in new[] { 0, 1, 8, 12_345, 100_000_000 })
        {
            for (var count = 1; count <= BvhLayout.MaxLeafTriangles; count++)
            {
                var leaf = BvhChild.ForLeaf(first, count);
                Assert.Equal((false, first, count), (leaf.IsNode, leaf.FirstTriangle, leaf.TriangleCount));
                Assert.Equal(leaf, BvhChild.FromBits(Unsafe.BitCast<BvhChild, uint>(leaf)));
                Assert.Equal(leaf, leaf.Rebase(5));
                Assert.NotEqual(BvhChild.None, leaf);
            }
        }

        Assert.Equal((true, 17), (BvhChild.ForNode(17).IsNode, BvhChild.ForNode(17).NodeIndex));
        Assert.Equal(BvhChild.ForNode(22), BvhChild.ForNode(17).Rebase(5));
        Assert.Equal(BvhChild.ForNode(0), BvhChild.Root);
        Assert.True(BvhChild.Root.IsNode);
        Assert.False(BvhChild.None.IsNode);
        Assert.Equal(BvhChild.None, BvhChild.None.Rebase(5));
    }

    [Fact]
    public void DownAndUp_OfAnyNumbers_AreBeyondThemByNoMoreThanTwoPlaces() => Seeded.Run(50, random =>
    {
        var number = random.Between(-1, 1) * Math.Pow(10, random.Next(-44, 36));
        var numbers = Vector256.Create(number, -number, 0, (float)number);
        var (down, up) = (FloatRounding.Down(numbers), FloatRounding.Up(numbers));
        var nearest = FloatRounding.ToNearest(numbers);
        for (var i = 0; i < 4; i++)
        {
            Assert.Equal((float)numbers[i], nearest[i]);
            Assert.True(down[i] < numbers[i] && numbers[i] < up[i]);
            // A place is up to 2⁻²³ of a number, or the least normal float; the rounding to the nearest adds half of one.
            var allowed = (5 * HalfPlace * Math.Abs(numbers[i])) + 1.3e-38;
            Assert.InRange(numbers[i] - down[i], 0, allowed);
            Assert.InRange(up[i] - numbers[i], 0, allowed);
        }
    });

    [Fact]
    public void WidenHalf_OfEightFloats_GivesTheLowerThenTheUpperFour()
    {
        var floats = Vector256.Create(1f, 2, 3, 4, 5, 6, 7, 8);
        Assert.Equal(Vector256.Create(1.0, 2, 3, 4), FloatRounding.WidenHalf(floats, 0));
        Assert.Equal(Vector256.Create(5.0, 6, 7, 8), FloatRounding.WidenHalf(floats, 1));
    }

    [Fact]
    public void FloatCutoff_OfAnyDistance_IsBeyondItByTwiceTheErrorAndLittleMore() => Seeded.Run(100, random =>
    {
        var (coordinate, edge, kernel) = (random.Between(0, 200), random.Between(0, 4), random.Between(0, 1e-6));
        var distance = random.Next(4) == 0 ? 0 : random.Between(0, 300);
        var error = FloatCutoff.ErrorBound(coordinate, edge, kernel, distance);
        var limit = Math.Sqrt(FloatCutoff.Create(coordinate, edge, kernel).For((float)(distance * distance)));
        Ensure.That(limit >= distance + (1.99 * error), $"{limit} at {distance} with {error}");
        Ensure.That(limit <= distance + (2.2 * error) + (24 * HalfPlace * distance), $"{limit} at {distance} with {error}");
    });

    /// <summary>A position and a foot are rounded, √3 times half a place; the rest is proved in the documentation of colliders.</summary>
    [Fact]
    public void FloatErrorBound_OfEachPart_IsTheSumOfWhatRounds()
    {
        var least = FloatCutoff.ErrorBound(0, 0, 0, 0);
        Assert.InRange(least, Math.Sqrt(3) * 2 * HalfPlace, 4 * HalfPlace);
        Assert.InRange(FloatCutoff.ErrorBound(100, 0, 0, 0) - least, Math.Sqrt(3) * 100 * HalfPlace, 185 * HalfPlace);
        Near.Equal(24 * HalfPlace, FloatCutoff.ErrorBound(0, 0, 0, 1) - least, 1e-15);
        Near.Equal(34 * HalfPlace, FloatCutoff.ErrorBound(0, 1, 0, 0) - least, 1e-15);
        Near.Equal(1, FloatCutoff.ErrorBound(0, 0, 1, 0) - least, 1e-15);
    }

    [Fact]
    public void BoundCutoff_OfAnyDistance_HoldsForEachErrorOfTheKernel() => Seeded.Run(100, random =>
    {
        var (scale, slack, magnitude) = (random.Between(0.5, 4), Math.Pow(2, -random.Next(20, 41)), random.Between(1, 1000));
        var factor = random.Between(0.1, 1);
        var distance = random.Next(4) == 0 ? 0 : Math.Pow(10, random.Between(-13, 2));
        var error = magnitude * BoundCutoff.KernelError;
        var limit = BoundCutoff.Create(scale, factor, slack, magnitude).For(distance * distance);
        var scaled = scale * distance;
        Assert.Equal(Math.ScaleB(magnitude, -46), error);
        // (d + δ)² ≤ (1 + s)·d² + (1 + 1/s)·δ², and twice the slack for the bound's own error.
        Assert.True(limit >= factor * ((scaled + error) * (scaled + error) * (1 - 1e-15)));
        Assert.True(limit >= factor * scaled * scaled * (1 + (3 * slack)) * (1 - 1e-15));
        Assert.True(limit <= (factor * scaled * scaled * (1 + (5 * slack)) * (1 + 1e-15)) + ((1.1 + (1 / slack)) * error * error));
    });

    [Fact]
    public void SimdBoundingBox_OfPoints_HasTheirExtents()
    {
        var box = SimdBoundingBox.Of(Vector128.Create(1f, -2, 3, 0)).Including(SimdBoundingBox.Of(Vector128.Create(2f, 0, 0, 0)));
        Assert.Equal(Vector128.Create(1f, -2, 0, 0), box.Minimum);
        Assert.Equal(Vector128.Create(2f, 0, 3, 0), box.Maximum);
        Assert.Equal(Vector128.Create(3f, -2, 3, 0), box.DoubledCentre);
        // Sizes of 1, 2 and 3.
        Assert.Equal(11f, box.HalfArea);
        Assert.Equal(box, new SimdBoundingBox(box.Minimum, box.Maximum));
        Assert.Equal(box, SimdBoundingBox.Empty.Including(box));
        Assert.Equal(float.PositiveInfinity, SimdBoundingBox.Empty.HalfArea);
    }

    [Fact]
    public void CentreBins_OfCentres_DivideEachAxisThatIsWide()
    {
        var bounds = SimdBoundingBox.Of(Vector128.Create(-4f, 10, 1, 0))
            .Including(SimdBoundingBox.Of(Vector128.Create(4f, 12, 1, 0)));
        var bins = CentreBins.Create(bounds, 16);
        Assert.Equal(Vector128.Create(2f, 8, 0, 0), bins.Scale);
        Assert.Equal(Vector128.Create(0, 0, 0, 0), bins.IndicesOf(Vector128.Create(-4f, 10, 1, 0)));
        Assert.Equal(Vector128.Create(7, 8, 0, 0), bins.IndicesOf(Vector128.Create(-0.25f, 11, 1, 0)));
        // The largest centre belongs to the last bin, and rounding leads to none beyond the first.
        Assert.Equal(Vector128.Create(15, 15, 0, 0), bins.IndicesOf(Vector128.Create(4f, 12, 1, 0)));
        Assert.Equal(Vector128.Create(0, 0, 0, 0), bins.IndicesOf(Vector128.Create(-5f, 9, 1, 0)));
    }

    [Fact]
    public void VectorX4_OfAnyVectors_ComputesAsEachOfThem() => Seeded.Run(50, random =>
    {
        var (first, second) = (Four(random), Four(random));
        var (v, w) = (Pack(first), Pack(second));
        var map = new AffineMap(new(random.Vector(), random.Vector(), random.Vector()), random.Vector());
        var factors = Vector256.Create(2.0, -1, 0.5, 3);
        for (var i = 0; i < VectorX4.Count; i++)
        {
            Assert.Equal(first[i], v[i]);
            Assert.Equal(first[i] + second[i], (v + w)[i]);
            Assert.Equal(first[i] - second[i], (v - w)[i]);
            Assert.Equal(factors[i] * first[i], (factors * v)[i]);
            Near.Equal(Vector.Dot(first[i], second[i]), VectorX4.Dot(v, w)[i], 1e-15);
            Near.Equal(first[i].LengthSquared(), v.LengthSquared()[i], 1e-15);
            Near.Equal(Vector.Cross(first[i], second[i]), VectorX4.Cross(v, w)[i], 1e-15);
            Near.Equal(map * first[i], v.Transform(in map)[i], 4e-15);
            Assert.Equal(first[i].Absolute(), v.Absolute()[i]);
            Assert.Equal(Vector.Max(first[i], second[i]), VectorX4.Max(v, w)[i]);
            Assert.Equal(Vector.Max(first[i], second[i]), VectorX4.MaxNative(v, w)[i]);
            var mask = Vector256.GreaterThan(factors, Vector256<double>.One);
            Assert.Equal(factors[i] > 1 ? first[i] : second[i], VectorX4.ConditionalSelect(mask, v, w)[i]);
            Assert.Equal(first[0], VectorX4.Broadcast(first[0])[i]);
            Assert.Equal(first[0], VectorX4.Broadcast(SimdAffineMap.ToVector256(first[0]))[i]);
            Assert.Equal(Vector.Zero, VectorX4.Zero[i]);
        }
    });

    [Fact]
    public void LoadAndGather_OfRowsAndPositions_TakeTheRightOnes()
    {
        double[] rows = [.. Enumerable.Range(0, 24).Select(i => (double)i)];
        var loaded = VectorX4.Load(ref rows[0], 4, 8);
        var gathered = VectorX4.Gather(rows, Vector128.Create(7, 0, 3, 5));
        int[] vertices = [7, 0, 3, 5];
        for (var i = 0; i < VectorX4.Count; i++)
        {
            Assert.Equal(new(4 + i, 12 + i, 20 + i), loaded[i]);
            Assert.Equal(new(3 * vertices[i], (3 * vertices[i]) + 1, (3 * vertices[i]) + 2), gathered[i]);
        }
    }

    [Theory]
    [InlineData(0, 0)]
    [InlineData(1, 4)]
    [InlineData(4, 4)]
    [InlineData(5, 8)]
    [InlineData(64, 64)]
    public void PaddedCount_OfACount_IsTheNextMultipleOfFour(int count, int expected) =>
        Assert.Equal(expected, VectorX4.PaddedCount(count));

    [Fact]
    public void Update_OfTheClosestTriangle_TakesTheSmallestIndexOfATie()
    {
        var closest = new ClosestTriangle(4);
        closest.Update(Vector256.Create(2.0, 1, 1, 3), [9, 5, 3, 7]);
        Assert.Equal((1.0, 3), (closest.DistanceSquared, closest.FaceIndex));
        closest.Update(Vector256.Create(1.0, 1, 1, 1), [8, 9]);
        Assert.Equal((1.0, 3), (closest.DistanceSquared, closest.FaceIndex));
        closest.Update(Vector256.Create(1.5, 1, 1, 1), [1, 2]);
        Assert.Equal((1.0, 2), (closest.DistanceSquared, closest.FaceIndex));
        closest.Update(Vector256.Create(double.NaN, 2, double.NaN, 0.5), [0, 1, 2, 6]);
        Assert.Equal((0.5, 6), (closest.DistanceSquared, closest.FaceIndex));
        // Nearer than a smaller index that is farther.
        closest.Update(Vector256.Create(0.25, 0.5, 0.5, 0.5), [11, 0]);
        Assert.Equal((0.25, 11), (closest.DistanceSquared, closest.FaceIndex));
    }

    [Fact]
    public void Update_BeyondTheLimitOrOfInfinity_ChangesNothing()
    {
        var closest = new ClosestTriangle(4);
        closest.Update(Vector256.Create(4.5, 5, 6, double.NaN), [0, 1, 2, 3]);
        Assert.Equal((4.0, -1), (closest.DistanceSquared, closest.FaceIndex));
        var endless = new ClosestTriangle(double.PositiveInfinity);
        endless.Update(Vector256.Create(double.PositiveInfinity, double.NaN, double.PositiveInfinity, double.NaN), [0, 1, 2, 3]);
        Assert.Equal(-1, endless.FaceIndex);
        endless.Update(Vector256.Create(double.PositiveInfinity, 1e300, double.NaN, double.NaN), [0, 1, 2, 3]);
        Assert.Equal((1e300, 1), (endless.DistanceSquared, endless.FaceIndex));
    }

    [Fact]
    public void Push_OfChildrenThatAreHit_LeavesTheClosestOnTop() => Seeded.Run(100, random =>
    {
        float[] bounds = [.. Enumerable.Range(0, 8).Select(_ => (float)random.Next(0, 6))];
        bool[] areHit = [.. Enumerable.Range(0, 8).Select(_ => random.Next(3) > 0)];
        var stack = new ulong[2 + 8 + ChildStack.Slack];
        (stack[0], stack[1]) = (77, 78);
        int[] masks = [.. areHit.Select(isHit => isHit ? -1 : 0)];
        var hits = Vector256.Create(masks).AsSingle();
        ChildStack.Push(Vector256.Create(bounds), hits, Vector256.Create(100u, 101, 102, 103, 104, 105, 106, 107), ref stack[2]);
        var pushed = stack.AsSpan(2, areHit.Count(isHit => isHit));
        var expected = Enumerable.Range(0, 8).Where(i => areHit[i]).OrderByDescending(i => (bounds[i], i)).ToArray();
        Assert.Equal((77ul, 78ul), (stack[0], stack[1]));
        for (var i = 0; i < expected.Length; i++)
        {
            Assert.Equal(100u + (uint)expected[i], (uint)pushed[i]);
            // The lane replaces the last three bits.
            var bits = BitConverter.SingleToUInt32Bits(bounds[expected[i]]);
            Assert.Equal((bits & ~7u) | (uint)expected[i], (uint)(pushed[i] >> 32));
        }
    });

    private static Vector[] Four(Random random) => [random.Vector(), random.Vector(), random.Vector(), random.Vector()];

    private static VectorX4 Pack(Vector[] vectors) => new(
        Vector256.Create([.. vectors.Select(v => v.X)]), Vector256.Create([.. vectors.Select(v => v.Y)]),
        Vector256.Create([.. vectors.Select(v => v.Z)]));
}
