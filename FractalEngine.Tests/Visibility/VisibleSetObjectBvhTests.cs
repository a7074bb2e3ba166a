using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;

namespace FractalEngine.Tests.Visibility;

/// <summary>Culling many objects by a hierarchy over them gives the result of testing each of them, to the bit.</summary>
public class VisibleSetObjectBvhTests
{
    [Fact]
    public void Cull_OfManyObjects_EqualsCullingEachOfThem() => Seeded.Run(40, random =>
    {
        var objects = RandomObjects(random, random.Next(CulledObjectBvh.MinObjects - 2, 300));
        var settings = new CullingSettings
        {
            ThreadCount = random.Next(1, 3),
            OcclusionCulling = random.Next(2) == 0,
            MinProjectedSize = random.Next(3),
            // Sometimes below the number of visible instances, so that frames are culled again.
            InstanceBudget = random.Next(3) == 0 ? 500 : 500_000,
        };
        var (withBvh, without) = (new VisibleSet(), new VisibleSet { HasObjectBvh = false });
        for (var frame = 0; frame < 6; frame++)
        {
            var box = new BoundingBox(-10 * Vector.One, 10 * Vector.One);
            // From among the objects, with planes that clip them, or from afar.
            var corner = random.Vector(8);
            var view = CullingViews.RandomView(random, random.Next(3) == 0 ? box : new(corner, corner + (6 * Vector.One)));
            withBvh.Cull(in view, objects, settings);
            without.Cull(in view, objects, settings);
            AssertEqual(without, withBvh, objects.Length);
            var movedCount = random.Next(3) switch { 0 => 0, 1 => 3, _ => objects.Length / 2 };
            for (var i = 0; i < movedCount; i++)
            {
                var index = random.Next(objects.Length);
                objects[index] = objects[index] with { ObjectToWorld = RandomMap(random) };
            }
        }
    });

    [Fact]
    public void Cull_OfOtherObjectsThanBefore_EqualsCullingEachOfThem() => Seeded.Run(10, random =>
    {
        var (withBvh, without) = (new VisibleSet(), new VisibleSet { HasObjectBvh = false });
        for (var frame = 0; frame < 4; frame++)
        {
            var objects = RandomObjects(random, random.Next(40, 200));
            var view = CullingViews.RandomView(random, new(-5 * Vector.One, 5 * Vector.One));
            withBvh.Cull(in view, objects, new());
            without.Cull(in view, objects, new());
            AssertEqual(without, withBvh, objects.Length);
        }
    });

    [Fact]
    public void Cull_OfManyObjectsThatStand_AllocatesNothing()
    {
        var random = new Random(1);
        var objects = RandomObjects(random, 500);
        var view = CullingViews.RandomView(random, new(-5 * Vector.One, 5 * Vector.One));
        var settings = new CullingSettings { ThreadCount = 1 };
        var set = new VisibleSet();
        set.Cull(in view, objects, settings);
        set.Cull(in view, objects, settings);
        Assert.Equal(0, Allocation.Measure(() => set.Cull(in view, objects, settings)));
    }

    private static void AssertEqual(VisibleSet expected, VisibleSet actual, int objectCount)
    {
        Assert.Equal(expected.Statistics, actual.Statistics);
        Assert.Equal((expected.InstanceCount, expected.MinProjectedSize), (actual.InstanceCount, actual.MinProjectedSize));
        for (var index = 0; index < objectCount; index++)
        {
            Assert.Equal(expected.IsNearClipped(index), actual.IsNearClipped(index));
            for (var chunk = 0; chunk < VisibleSet.ChunkCount; chunk++)
            {
                Assert.Equal(expected.Instances(index, chunk).ToArray(), actual.Instances(index, chunk).ToArray());
            }
        }
    }

    private static CulledObject[] RandomObjects(Random random, int count)
    {
        CulledObject[] models =
        [
            CullingViews.CreateObject(CullingViews.Menger(1)),
            CullingViews.CreateObject(CullingViews.Menger(2)),
            CullingViews.CreateObject(Samples.Repeated(2, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.5))),
            CullingViews.CreateObject(new(Samples.Repeated(1, Samples.Move(1, 0, 0)).Description, new([], []))),
        ];
        return
        [
            .. Enumerable.Range(0, count)
                .Select(_ => models[random.Next(models.Length)] with { ObjectToWorld = RandomMap(random), IsOpaque = random.Next(4) > 0 }),
        ];
    }

    /// <summary>Often on a lattice, so that edges of boxes meet the edges of strips and objects are equally far.</summary>
    private static AffineMap RandomMap(Random random) => random.Next(20) switch
    {
        0 => new(Matrix.Diagonal(double.NaN * Vector.One), Vector.Zero),
        1 => AffineMap.Translate(random.Vector(1e6)),
        < 8 => AffineMap.Translate(new(random.Next(-9, 10), random.Next(-9, 10), random.Next(-9, 10))),
        _ => new(random.Transformation(0.1, 2).ToAffineMap().Linear, random.Vector(12)),
    };
}
