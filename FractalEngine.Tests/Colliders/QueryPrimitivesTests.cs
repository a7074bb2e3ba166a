using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Colliders;

/// <summary>Tests what queries share: the queue of objects, powers of two for scales, similarities, and contexts.</summary>
public sealed class QueryPrimitivesTests
{
    [Fact]
    public void TryTake_OfManyEntries_GivesThemByBoundThenIndex() => Seeded.Run(20, random =>
    {
        var queue = new ObjectQueue();
        for (var round = 0; round < 2; round++)
        {
            Assert.Equal(double.PositiveInfinity, queue.Bound);
            (double Bound, int Index)[] added =
                [.. Enumerable.Range(0, random.Next(1, 300)).Select(_ => ((double)random.Next(0, 20), random.Next(-1, 40)))];
            foreach (var (bound, index) in added)
            {
                queue.Add(bound, index, (bound, index));
            }

            Assert.Equal(added.Min(entry => entry.Bound), queue.Bound);
            foreach (var expected in added.Order())
            {
                Assert.True(queue.TryTake(out var bound, out var index, out var target));
                Assert.Equal(expected, (bound, index));
                Assert.Equal(((double, int))target!, (bound, index));
            }

            Assert.False(queue.TryTake(out var none, out var untested, out var nothing));
            Assert.Equal((double.PositiveInfinity, ObjectQueue.Untested, null), (none, untested, nothing));
        }

        queue.Add(1, 2, queue);
        queue.Clear();
        Assert.Equal(double.PositiveInfinity, queue.Bound);
        Assert.False(queue.TryTake(out _, out _, out _));
    });

    [Fact]
    public void Clear_OfAQueueThatWasEmptied_KeepsNoObjectAlive()
    {
        var queue = new ObjectQueue();
        var references = Fill(queue);
        while (queue.TryTake(out _, out _, out _))
        {
        }

        queue.Clear();
        GC.Collect();
        Assert.All(references, reference => Assert.False(reference.IsAlive));
        GC.KeepAlive(queue);
    }

    [Fact]
    public void IsNeeded_OfAMagnitude_TellsWhetherProductsOfSixLeaveTheRange()
    {
        foreach (var magnitude in new[] { 0, 1e-40, 1, 1e40 })
        {
            Assert.False(QueryScale.IsNeeded(magnitude));
            Assert.Equal(1, QueryScale.Of(magnitude));
        }

        foreach (var magnitude in new[] { Math.BitDecrement(1e-40), double.Epsilon, Math.BitIncrement(1e40), double.MaxValue })
        {
            Assert.True(QueryScale.IsNeeded(magnitude));
            var scale = QueryScale.Of(magnitude);
            Assert.Equal(scale, Math.ScaleB(1, Math.ILogB(scale)));
            Assert.True(double.IsNormal(scale) || magnitude == double.MaxValue);
            Assert.InRange(magnitude * scale, magnitude == double.Epsilon ? 1e-30 : 1, Math.BitDecrement(2));
        }

        Assert.True(QueryScale.IsNeeded(double.NaN));
        Assert.Equal(1, QueryScale.Of(double.NaN));
        Assert.Equal(QueryScale.Of(double.MaxValue), QueryScale.Of(double.PositiveInfinity));
        Assert.Equal(Math.ScaleB(1, 1000), QueryScale.Of(double.Epsilon));
    }

    [Fact]
    public void Magnitude_OfAPositionAndAMappedShape_BoundsAllCoordinates()
    {
        var map = new AffineMap(Matrix.Diagonal(new(2, -5, 1)), new(0, 0, -7));
        Assert.Equal((5 * 3 * 4) + 7, QueryScale.Magnitude(new Vector(1, 2, 3), in map, 4));
        Assert.Equal(100, QueryScale.Magnitude(new Vector(1, -100, 3), in map, 4));
        Assert.Equal(0, QueryScale.Magnitude(Mesh.Empty));
        Assert.Equal(3, QueryScale.Magnitude(Samples.Tetrahedron));
        Assert.Equal(9, QueryScale.Magnitude(Samples.Triangle.Transform(v => v - new Vector(9, 0, 0))));
    }

    [Fact]
    public void ThrowIf_TooLargeOrInfinite_ThrowsBeyondTheLimitOnly()
    {
        ScaledQuery.ThrowIfTooLarge(1e40);
        ScaledQuery.ThrowIfInfinite(double.MaxValue);
        Assert.Contains("1E+40", Assert.Throws<FractalLimitException>(() => ScaledQuery.ThrowIfTooLarge(Math.BitIncrement(1e40))).Message);
        Assert.Throws<FractalLimitException>(() => ScaledQuery.ThrowIfInfinite(double.PositiveInfinity));
    }

    [Fact]
    public void IsSimilarity_OfMatricesThatAreNearlyOne_TellsAPartIn1e13()
    {
        Assert.True(Matrix.Identity.IsSimilarity());
        Assert.True((-2 * Matrix.Identity).IsSimilarity());
        foreach (var (error, expected) in new[] { (1e-14, true), (1e-12, false), (-1e-12, false), (-1e-14, true) })
        {
            foreach (var scale in new[] { 1, 1e-20, 1e20 })
            {
                Assert.Equal(expected, (scale * new Matrix(Vector.I, (1 + error) * Vector.J, Vector.K)).IsSimilarity());
                Assert.Equal(expected, (scale * new Matrix(Vector.I, Vector.J, (1 + error) * Vector.K)).IsSimilarity());
                Assert.Equal(expected, (scale * new Matrix(Vector.I, new(error, 1, 0), Vector.K)).IsSimilarity());
                Assert.Equal(expected, (scale * new Matrix(Vector.I, Vector.J, new(error, 0, 1))).IsSimilarity());
                Assert.Equal(expected, (scale * new Matrix(Vector.I, Vector.J, new(0, error, 1))).IsSimilarity());
            }
        }
    }

    [Theory]
    [InlineData(1e-91, false)]
    [InlineData(1e-89, true)]
    [InlineData(3, true)]
    [InlineData(1e89, true)]
    [InlineData(1e91, false)]
    public void TryCreate_OfAScale_TellsWhetherItsCofactorsStayInRange(double scale, bool expected)
    {
        Assert.Equal(expected, Similarity.TryCreate(new(scale * Matrix.Identity, Vector.I), out var similarity));
        Assert.Equal(expected ? scale : 1, similarity.Scale, scale * 1e-15);
        Assert.Equal(expected, similarity.Map.Translation == Vector.I);
    }

    [Fact]
    public void ToWorld_OfASimilarity_TakesPointDistanceNormalAndError() => Seeded.Run(50, random =>
    {
        var (scale, axes, move) = (random.Between(0.1, 10), random.Orthogonal(), random.Vector(5));
        Assert.True(Similarity.TryCreate(new(scale * axes, move), out var similarity));
        Near.Equal(scale, similarity.Scale, 1e-13);
        var (a, b, c) = (random.Vector(), random.Vector(), random.Vector());
        var position = random.Vector(3);
        var map = similarity.Map;
        var local = new ClosestPoint(2, a, TriangleKernel.UnitNormal(a, b, c), Vector.One, TriangleFeature.EdgeBC, 7) { ErrorBound = 0.5 };
        var world = similarity.ToWorld(local);
        Near.Equal(2 * scale, world.Distance, 1e-13);
        Near.Equal(map * a, world.Point, 1e-14);
        // The normal by the winding of the image, mirrored or not, which its points decide.
        Near.Equal(TriangleKernel.UnitNormal(map * a, map * b, map * c), world.Normal, 1e-9);
        Near.Equal((0.5 * scale) + (4e-15 * move.MaxAbsComponent()), world.ErrorBound, 1e-13);
        Assert.Equal((Vector.One, TriangleFeature.EdgeBC, 7), (world.Barycentrics, world.Feature, world.FaceIndex));
        Near.Equal(position, similarity.ToLocal(map * position), 1e-12);
    });

    [Fact]
    public void ToWorld_OfTheIdentity_IsTheSameBitForBit()
    {
        var local = new ClosestPoint(0.1, new(0.1, 0.2, 0.3), Vector.K, Vector.I, TriangleFeature.VertexA, 3) { ErrorBound = 0.01 };
        Assert.True(Similarity.TryCreate(AffineMap.Identity, out var unmoved));
        foreach (var similarity in new[] { Similarity.Identity, unmoved })
        {
            Assert.Equal(local, similarity.ToWorld(local));
            Assert.Equal(local.Point, similarity.ToLocal(local.Point));
            Assert.Equal(1, similarity.Scale);
        }
    }

    [Fact]
    public void SpareContext_ThatIsTaken_IsGivenToNoOther()
    {
        var spare = new SpareContext();
        var (first, second) = (spare.Take(), spare.Take());
        Assert.NotSame(first, second);
        spare.Return(first);
        Assert.Same(first, spare.Take());
        Assert.NotSame(first, spare.Take());
    }

    [Fact]
    public void InstancePath_ThatNobodyAskedForBefore_IsThatOfTheLastQuery()
    {
        var two = Samples.Repeated(2, Samples.MoveAndScale(1, 0, 0, 0.5), Samples.Move(0, 5, 0));
        var three = Samples.Repeated(3, Samples.Move(9, 0, 0));
        var away = new Ray(1000 * Vector.One, Vector.One);
        var context = new QueryContext();
        foreach (var (fractal, x) in new[] { (two, 0.0), (three, 27.0), (two, 3.0) })
        {
            var (collider, caster, position) = (Collider.For(fractal), RayCaster.For(fractal), new Vector(x, 5, 0));
            Assert.True(Collider.For(two).TryFindClosest(7 * Vector.One, 100, context, out _));
            Assert.True(collider.TryFindClosest(position, 100, context, out var closest));
            var path = collider.FindClosest(position).InstancePath;
            Assert.Equal(path, context.InstancePath.ToArray());
            Assert.NotEmpty(path);
            Assert.True(caster.TryFindNearest(new(position + Vector.One, closest.Point - position - Vector.One), context, out _));
            Assert.False(caster.TryFindNearest(away, context, out _));
            Assert.Empty(context.InstancePath.ToArray());
            Assert.True(collider.TryFindClosest(position, 100, context, out _));
            Assert.False(caster.HitsAny(away, context));
            Assert.Empty(context.InstancePath.ToArray());
        }
    }

    [Fact]
    public void SaveInstance_ThenRestoreInstance_GivesTheInstanceBack()
    {
        var context = new QueryContext { MeshIndex = 4 };
        Array.ForEach([3, 1, 2], context.AppendToPath);
        context.SaveInstance();
        context.ClearPath();
        context.AppendToPath(9);
        context.RestoreInstance();
        Assert.Equal(new[] { 3, 1, 2 }, context.InstancePath.ToArray());
        Assert.Equal(4, context.MeshIndex);
        context.ReversePath();
        context.ShortenPath(2);
        Assert.Equal(new[] { 2, 1 }, context.InstancePath.ToArray());
    }

    [Fact]
    public void Buffers_OfAContext_GrowAndKeepWhatTheyHold()
    {
        var context = new QueryContext();
        var path = context.PathBuffer(5);
        path[4] = 17;
        Assert.True(context.PathBuffer(6).Length >= 10);
        Assert.Equal(17, context.PathBuffer(100)[4]);
        Assert.True(context.PathBuffer(1).Length >= 100);
        context.BestPathBuffer(3)[2] = 8;
        Assert.Equal((8, 17), (context.BestPathBuffer(50)[2], context.PathBuffer(1)[4]));
        Assert.Equal(7, context.ObjectBoundsBuffer(7).Length);
        Assert.Equal(3, context.ObjectBoundsBuffer(3).Length);
        Assert.True(context.ScratchBuffer(40).Length >= 40);
        Assert.Same(context.ObjectQueue, context.ObjectQueue);
        Assert.Same(context.RayStack, context.RayStack);
        Assert.Same(context.TraversalStack, context.TraversalStack);
        Assert.Same(context.ExpandedChildren, context.ExpandedChildren);
        Assert.Same(context.DescentBeam, context.DescentBeam);
    }

    [Fact]
    public void Statistics_AddedAndReset_AreSumsAndZero()
    {
        var statistics = new QueryStatistics { FaceTests = 3, BoundTests = 5 };
        statistics.Add(new() { FaceTests = 10, BoundTests = 100 });
        Assert.Equal((13L, 105L), (statistics.FaceTests, statistics.BoundTests));
        statistics.Reset();
        Assert.Equal((0L, 0L), (statistics.FaceTests, statistics.BoundTests));
    }

    [Fact]
    public void FromRadius_OfAnyRadius_CountsWhatIsExactlyThere()
    {
        foreach (var radius in new[] { 0, 1e-200, 1e-30, 0.1, 1.0 / 3, 7, 1e30 })
        {
            var cutoff = DistanceCutoff.FromRadius(radius);
            Assert.True(cutoff > radius * radius);
            Assert.True(cutoff <= (radius * radius * (1 + 2e-15)) + double.Epsilon);
        }

        Assert.Equal(double.PositiveInfinity, DistanceCutoff.FromRadius(double.PositiveInfinity));
    }

    [System.Runtime.CompilerServices.MethodImpl(System.Runtime.CompilerServices.MethodImplOptions.NoInlining)]
    private static WeakReference[] Fill(ObjectQueue queue)
    {
        object[] targets = [.. Enumerable.Range(0, 100).Select(_ => new object())];
        for (var i = 0; i < targets.Length; i++)
        {
            queue.Add(i, i, targets[i]);
        }

        return [.. targets.Select(target => new WeakReference(target))];
    }
}
