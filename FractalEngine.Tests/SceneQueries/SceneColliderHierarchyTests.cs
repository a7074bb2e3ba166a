using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.SceneQueries;

/// <summary>Scenes of many objects give the bits of a search that tests all of them, whatever moves.</summary>
public class SceneColliderHierarchyTests
{
    // Above the number of objects that are searched without a hierarchy.
    private const int MinCount = 65;

    private static readonly ColliderKind[] Kinds = [ColliderKind.Exact, ColliderKind.Hierarchy];

    [Fact]
    public void TryFindClosest_AmongManyObjects_EqualsTheLinearSearchToTheBit() => Seeded.Run(60, random =>
    {
        var kind = Kinds[random.Next(Kinds.Length)];
        var objects = RandomObjects(random, random.Next(1, 400));
        AssertEqualsLinearSearch(random, new(Scene(objects), kind), objects, kind, queries: 12);
    });

    [Fact]
    public void WithObject_AfterAnyMoves_EqualsTheLinearSearchToTheBit() => Seeded.Run(40, random =>
    {
        var objects = RandomObjects(random, random.Next(MinCount, 200));
        var collider = new SceneCollider(Scene(objects));
        var before = (Collider: collider, Objects: objects.ToList());
        for (var step = 0; step < 30; step++)
        {
            var index = random.Next(objects.Count);
            var placement = random.Next(3) == 0
                ? RandomPlacement(random)
                : Near(objects[index].Declaration.Placement);
            var moved = new PlacedModel(objects[index].Declaration with { Placement = placement }, objects[index].Model);
            if (random.Next(5) == 0)
            {
                objects.Add(moved);
                collider = collider.WithAddedObject(moved);
            }
            else
            {
                objects[index] = moved;
                collider = collider.WithObject(index, moved);
            }

            if (random.Next(2) == 0)
            {
                AssertEqualsLinearSearch(random, collider, objects, ColliderKind.Exact, queries: 2);
            }
        }

        Transformation Near(Transformation place) => place with { Position = place.Position + random.Vector(0.2) };

        // Colliders are immutable: that of the first placements still knows them.
        AssertEqualsLinearSearch(random, before.Collider, before.Objects, ColliderKind.Exact, queries: 2);
    });

    [Fact]
    public void WithObject_OfAnIndexBeyondTheScene_Throws()
    {
        var objects = RandomObjects(new(1), 20);
        var collider = new SceneCollider(Scene(objects));
        Assert.Throws<ArgumentOutOfRangeException>(() => collider.WithObject(20, objects[0]));
        Assert.Throws<ArgumentOutOfRangeException>(() => collider.WithObject(-1, objects[0]));
    }

    [Fact]
    public void TryFindClosest_OfEquallyCloseObjects_TakesTheFirstOfTheScene()
    {
        // All in one place, behind others that are farther.
        var model = new MeshModel(Samples.Tetrahedron);
        var objects = Enumerable.Range(0, 200)
            .Select(i => new PlacedModel(new(model) { Placement = Samples.Move(i < 50 ? 10 + i : 0, 0, 0) })).ToList();
        Assert.True(new SceneCollider(Scene(objects)).TryFindClosest(new(-1, -1, -1), 100, new(), out _, out var index));
        Assert.Equal(50, index);
        Assert.True(new SceneCollider(Scene(objects)).TryFindClosest(new(-1, -1, -1), 100, new(), out _, out index, excludedObject: 50));
        Assert.Equal(51, index);
    }

    [Fact]
    public void TryFindClosest_AmongManyObjects_AllocatesNothing()
    {
        var random = new Random(1);
        var collider = new SceneCollider(Scene(RandomObjects(random, 1000)));
        var positions = Enumerable.Range(0, 200).Select(_ => random.Vector(30)).ToArray();
        var context = new QueryContext();
        Assert.Equal(0, Allocation.Measure(() =>
        {
            foreach (var position in positions)
            {
                collider.TryFindClosest(position, double.PositiveInfinity, context, out _, out _);
            }
        }));
    }

    [Fact]
    public void TryFindClosest_OnManyThreads_GivesTheSameResults() => Seeded.Run(5, random =>
    {
        var objects = RandomObjects(random, 400);
        var positions = Enumerable.Range(0, 3000).Select(_ => random.Vector(30)).ToArray();
        var expected = Find(1);
        Assert.Equal(expected, Find(2));
        Assert.Equal(expected, Find(8));

        ClosestHit[] Find(int threads)
        {
            // A new collider each time, so that threads build its hierarchy together.
            var collider = new SceneCollider(Scene(objects));
            return [.. BatchQuery.Run(positions, (position, context) => collider.FindClosest(position, context), threads: threads)];
        }
    });

    [Fact]
    public void TryFindClosest_AmongAThousandTimesMoreObjects_TestsAtMostFourTimesTheBoxes()
    {
        Assert.InRange(BoundTests(100_000) / BoundTests(100), 0.5, 4);

        static double BoundTests(int count)
        {
            var random = new Random(count);
            var model = new MeshModel(Samples.Triangle);
            var size = Math.Cbrt(count);
            var objects = Enumerable.Range(0, count)
                .Select(_ => Transformation.Identity with { Position = random.Vector(size) })
                .Select(placement => new PlacedModel(new SceneObject(model) { Placement = placement }))
                .ToList();
            var collider = new SceneCollider(Scene(objects));
            var context = new QueryContext();
            for (var query = 0; query < 500; query++)
            {
                collider.TryFindClosest(random.Vector(size), double.PositiveInfinity, context, out _, out _);
            }

            return context.Statistics.BoundTests;
        }
    }

    private static LoadedScene Scene(IEnumerable<PlacedModel> objects) => new(new(), [.. objects]);

    private static void AssertEqualsLinearSearch(
        Random random, SceneCollider collider, List<PlacedModel> objects, ColliderKind kind, int queries)
    {
        var linear = new LinearSceneSearch(objects, kind);
        var (expectedContext, actualContext) = (new QueryContext(), new QueryContext());
        for (var query = 0; query < queries; query++)
        {
            // Often on a lattice, where many boxes are equally close.
            var position = random.Next(2) == 0 ? random.Vector(12) : new(random.Next(-8, 9), random.Next(-8, 9), random.Next(-8, 9));
            var maxDistance = random.Next(2) == 0 ? double.PositiveInfinity : random.Next(6);
            var excluded = random.Next(-1, objects.Count);
            var epsilon = random.Next(3) == 0 ? 0.5 : 0;
            var isExpected =
                linear.TryFindClosest(position, maxDistance, expectedContext, out var expected, out var expectedIndex, excluded, epsilon);
            var isFound =
                collider.TryFindClosest(position, maxDistance, actualContext, out var actual, out var index, excluded, epsilon);
            // Which objects are tested, and so what is known of the others, may differ; the result does not.
            Assert.Equal((isExpected, expectedIndex, expected with { ErrorBound = 0 }), (isFound, index, actual with { ErrorBound = 0 }));
            Assert.True(actual.ErrorBound <= actual.Distance, $"{actual.ErrorBound} beyond {actual.Distance}");
            Assert.Equal(expectedContext.InstancePath.ToArray(), actualContext.InstancePath.ToArray());
            // The same objects were searched with the same radii.
            Assert.Equal(expectedContext.Statistics.FaceTests, actualContext.Statistics.FaceTests);
        }
    }

    private static List<PlacedModel> RandomObjects(Random random, int count)
    {
        Model[] models =
        [
            new MeshModel(Samples.Tetrahedron),
            new MeshModel(Samples.Triangle),
            new FractalModel(Samples.Repeated(3, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.5))),
            new MeshModel(new Mesh([], [])),
        ];
        return
        [
            .. Enumerable.Range(0, count).Select(_ =>
                new PlacedModel(new SceneObject(models[random.Next(10) switch { < 3 => 0, < 6 => 1, < 9 => 2, _ => 3 }])
                {
                    Placement = RandomPlacement(random),
                })),
        ];
    }

    private static Transformation RandomPlacement(Random random) => random.Next(20) switch
    {
        0 => random.Transformation(),
        1 => new(random.Vector(1e3), random.Degrees(), random.Between(1, 100) * Vector.One),
        // The square of this distance overflows.
        2 => Samples.MoveAndScale(1e200 * random.Between(-1, 1), 0, 0, 1e200),
        < 10 => Samples.Move(random.Next(-5, 6), random.Next(-5, 6), random.Next(-5, 6)),
        _ => new(random.Vector(10), random.Degrees(), random.Between(0.3, 2) * (random.Next(2) == 0 ? Vector.One : new(-1, 1, 1))),
    };
}
