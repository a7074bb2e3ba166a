using System.Collections.Immutable;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals.Hierarchy;

/// <summary>Recursives that call each other, with several base meshes, against all their faces.</summary>
public class RecursiveLevelsTests
{
    private const double Tolerance = 1e-12;

    private static readonly Mesh Roof = new(
        [0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 0.5, 0.8, 0, 0.5, 0.8, 1], [0, 4, 1, 3, 2, 5, 0, 3, 5, 0, 5, 4, 1, 4, 5, 1, 5, 2]);

    /// <summary>The first two call each other and themselves; the third is a sum of both, the second with two levels less.</summary>
    private static readonly FractalRecursive[] Similar =
    [
        new(Samples.Tetrahedron, [Call(0, 0, 0, 10, 0.5, 0), Call(1.2, 0.1, 0, -25, 0.45, 1), Call(0, 0, 1.3, 40, 0.5, 0)]),
        new(Roof, [Call(0.1, 1, 0, 35, 0.6, 1), Call(1, 0, 0.9, 80, 0.4, 0)]),
        new(Samples.Triangle, [Call(0, 0, 0, 0, 1, 0), Call(3, 0.5, -1, 15, 0.8, 1, levelsLess: 2)]),
    ];

    private static readonly FractalRecursive[] Skewed =
    [
        new(Samples.Tetrahedron, [Skew(0, 0, 0, 0.5, 0.4, 0), Skew(1.2, 0.1, 0, 0.45, 0.6, 1), Skew(0, 0, 1.3, 0.5, 0.5, 0)]),
        new(Roof, [Skew(0.1, 1, 0, 0.6, 0.5, 1), Skew(1, 0, 0.9, 0.4, 0.5, 0)]),
        new(Samples.Triangle, [Skew(0, 0, 0, 1, 1, 0), Skew(3, 0.5, -1, 0.8, 0.7, 1, levelsLess: 2)]),
    ];

    /// <summary>Recursives, and the index of the one that is the fractal: each of both, and their sum.</summary>
    public static TheoryData<bool, int> Roots { get; } =
        new() { { true, 0 }, { true, 1 }, { true, 2 }, { false, 0 }, { false, 1 }, { false, 2 } };

    [Theory]
    [MemberData(nameof(Roots))]
    public void Bounds_OfRecursives_AreThoseOfAllFaces(bool isSimilar, int root)
    {
        for (var levels = 0; levels <= 6; levels++)
        {
            var (hierarchy, expanded) = Create(isSimilar ? Similar : Skewed, root, levels);
            AssertBounds(hierarchy, expanded, maxLooseness: 0.01);
        }
    }

    [Theory]
    [MemberData(nameof(Roots))]
    public void Counts_OfRecursives_AreThoseOfAllInstances(bool isSimilar, int root)
    {
        for (var levels = 0; levels <= 6; levels++)
        {
            var (hierarchy, expanded) = Create(isSimilar ? Similar : Skewed, root, levels);
            Assert.Equal((expanded.Instances.Count, expanded.FaceCount), Count(hierarchy));
        }
    }

    [Theory]
    [MemberData(nameof(Roots))]
    public void FindClosest_InRecursives_IsTheClosestOfAllFaces(bool isSimilar, int root)
    {
        for (var levels = 0; levels <= 6; levels++)
        {
            var (hierarchy, expanded) = Create(isSimilar ? Similar : Skewed, root, levels);
            var collider = new ExactFractalCollider(hierarchy);
            Seeded.Run(20, random => AssertClosest(collider, expanded, RandomPosition(random, expanded.Box)));
        }
    }

    [Theory]
    [MemberData(nameof(Roots))]
    public void FindAllWithin_InRecursives_FindsAllFaces(bool isSimilar, int root)
    {
        for (var levels = 0; levels <= 6; levels++)
        {
            var (hierarchy, expanded) = Create(isSimilar ? Similar : Skewed, root, levels);
            var collider = new ExactFractalCollider(hierarchy);
            Seeded.Run(10, random => AssertAllWithin(collider, expanded, RandomPosition(random, expanded.Box), random.Between(0, 2)));
        }
    }

    [Fact]
    public void Searches_InRandomRecursives_AgreeWithAllFaces() => Seeded.RunMost(60, CheckRandom, minShare: 0.7);

    [Fact]
    [Trait("Category", "Soak")]
    public void Searches_InManyRandomRecursives_AgreeWithAllFaces() => Seeded.RunMostInParallel(20_000, CheckRandom, minShare: 0.7);

    /// <summary>One recursive that calls itself is a repetition, and must have its bounds, counts and answers.</summary>
    [Fact]
    public void Hierarchy_OfOneRecursive_IsThatOfARepetition()
    {
        var fractal = Fractal.Of(Samples.Tetrahedron).Repeat([Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.5)], 30);
        var maps = fractal.LevelAt(0).Maps;
        var description = HierarchyDescription.Of(
            [new(Samples.Tetrahedron, [.. maps.Select(static map => new RecursiveCall(map, 0))])], 0, 30);
        var (expected, actual) = (fractal.Hierarchy, FractalHierarchy.Build(description));
        Assert.Equal((expected.Levels, expected.Root.Box), (actual.Levels, actual.Root.Box));
        var (colliders, contexts) = (new[] { new ExactFractalCollider(fractal), new(actual) }, new QueryContext[] { new(), new() });
        Seeded.Run(50, random =>
        {
            var position = 2 * random.Vector();
            Assert.True(colliders[0].TryFindClosest(position, double.PositiveInfinity, contexts[0], out var closest));
            Assert.True(colliders[1].TryFindClosest(position, double.PositiveInfinity, contexts[1], out var other));
            Assert.Equal(closest, other);
            Assert.Equal(contexts[0].InstancePath.ToArray(), contexts[1].InstancePath.ToArray());
            Assert.Equal(contexts[0].Statistics.BoundTests, contexts[1].Statistics.BoundTests);
        });
    }

    /// <summary>Levels that recur share their sub-fractals: what is deeper than a coordinate's last digit changes nothing.</summary>
    [Theory]
    [InlineData(true, 1_000_000)]
    [InlineData(true, null)]
    [InlineData(false, 1_000_000)]
    [InlineData(false, null)]
    public void FindClosest_InDeepRecursives_IsThatOfTheirLimit(bool isSimilar, int? levels)
    {
        for (var root = 0; root < 3; root++)
        {
            ImmutableArray<FractalRecursive> recursives = [.. isSimilar ? Similar : Skewed];
            var deep = FractalHierarchy.Build(HierarchyDescription.Of(recursives, root, levels));
            var limit = new ExactFractalCollider(FractalHierarchy.Build(HierarchyDescription.Of(recursives, root, 90)));
            var collider = new ExactFractalCollider(deep);
            Assert.Equal(root, deep.StateAt(deep.Levels).Recursive);
            Assert.InRange(collider.StorageBytes, 1, 400_000);
            var box = new ExpandedRecursives(isSimilar ? Similar : Skewed, root, 5).Box;
            Seeded.Run(20, random =>
            {
                var position = RandomPosition(random, box);
                Near.Equal(limit.FindClosest(position).Distance, collider.FindClosest(position).Distance, Tolerance);
            });
        }
    }

    /// <summary>Steps are applied to recursives as to a base mesh. An instance that the identity makes twice counts once.</summary>
    [Fact]
    public void Steps_OnRecursives_ApplyToAllTheirFaces()
    {
        TransformationSet stairs = new([Transformation.Identity, new(new(0, 2, 0), new(0, 30, 0), 0.9 * Vector.One)]);
        var hierarchy = FractalHierarchy.Build(HierarchyDescription.Of([.. Similar], 2, 4, [new Repetition([stairs], 3)]));
        // The same as recursives: a chain of the steps, each a sum of what is below once and once more.
        var maps = Enumerable.Range(0, 4).Select(power => Enumerable.Repeat(stairs.Maps[1], power)
            .Aggregate(AffineMap.Identity, static (product, map) => product * map));
        FractalRecursive top = new(Mesh.Empty, [.. maps.Select(static map => new RecursiveCall(map, 2))]);
        var expanded = new ExpandedRecursives([.. Similar, top], 3, 5);
        AssertBounds(hierarchy, expanded, maxLooseness: 0.02);
        Assert.Equal((expanded.Instances.Count, expanded.FaceCount), Count(hierarchy));
        var collider = new ExactFractalCollider(hierarchy);
        Seeded.Run(30, random =>
        {
            var position = RandomPosition(random, expanded.Box);
            Near.Equal(expanded.Distances(position).Min(), collider.FindClosest(position).Distance, Tolerance);
        });
    }

    [Fact]
    public void FindClosestPair_OfRecursives_IsThatOfAllFaces()
    {
        var (hierarchy, expanded) = Create(Similar, 2, 3);
        var mesh = new HierarchyCollider(Roof);
        var collider = new ExactFractalCollider(hierarchy);
        Seeded.Run(10, random =>
        {
            var map = AffineMap.Translate(RandomPosition(random, expanded.Box));
            var expected = double.PositiveInfinity;
            foreach (var instance in expanded.Instances)
            {
                expected = Math.Min(expected, mesh.FindClosestPair(new HierarchyCollider(instance.Mesh), map * instance.Map).Distance);
            }

            Near.Equal(expected, mesh.FindClosestPair(collider, map).Distance, Tolerance);
        });
    }

    [Fact]
    public void Levels_OfRecursives_AreTheirStatesInTurns()
    {
        var (hierarchy, _) = Create(Similar, 1, 4);
        Assert.Equal(new(1, 4), hierarchy.StateAt(hierarchy.Levels));
        Assert.Equal([new(0, 0), new(1, 0), new(2, 0), new(0, 1)], Enumerable.Range(0, 4).Select(level => hierarchy.StateAt(level)));
        Assert.Equal([0, 1, 2], Enumerable.Range(0, 3).Select(level => hierarchy.AllLevels[level].BaseIndex));
        Assert.Equal([true, true, true, false], Enumerable.Range(0, 4).Select(level => hierarchy.IsBase(level)));
    }

    [Fact]
    public void Description_OfCallsThatLeadNowhere_IsRefused()
    {
        FractalRecursive Calling(int recursive, int levelsLess) =>
            new(Samples.Triangle, [new(AffineMap.Identity, recursive, levelsLess)]);
        Assert.Throws<ArgumentException>(() => HierarchyDescription.Of([Calling(1, 1)], 0, 3));
        Assert.Throws<ArgumentException>(() => HierarchyDescription.Of([Calling(0, 0)], 0, 3));
        var step = Samples.Repeated(1).Description.Steps[0];
        Assert.Throws<ArgumentException>(() => HierarchyDescription.Of([Calling(0, 1)], 0, null, [step]));
        Assert.Throws<ArgumentOutOfRangeException>(() => HierarchyDescription.Of([Calling(0, 1)], 1, 3));
        Assert.Throws<ArgumentOutOfRangeException>(() => HierarchyDescription.Of([Calling(0, 1)], 0, -1));
    }

    private static bool CheckRandom(Random random)
    {
        var isSimilar = random.Next(2) == 0;
        Mesh[] meshes = [Samples.Tetrahedron, Roof, Samples.Triangle, Mesh.Empty];
        var count = random.Next(1, 5);
        var recursives = Enumerable.Range(0, count).Select(_ => new FractalRecursive(
            meshes[random.Next(meshes.Length)],
            [.. Enumerable.Range(0, random.Next(random.Next(8) == 0 ? 0 : 1, 4)).Select(_ => new RecursiveCall(
                RandomMap(random, isSimilar), random.Next(count), random.Next(4) == 0 ? 2 : 1))])).ToArray();
        var (root, levels) = (random.Next(count), random.Next(6));
        var (hierarchy, expanded) = Create(recursives, root, levels);
        Assert.Equal((expanded.Instances.Count, expanded.FaceCount), Count(hierarchy));
        if (expanded.FaceCount == 0)
        {
            Assert.True(hierarchy.Root.Box.IsEmpty);
            return false;
        }

        AssertBounds(hierarchy, expanded, maxLooseness: 0.15);
        var collider = new ExactFractalCollider(hierarchy);
        for (var query = 0; query < 4; query++)
        {
            var position = RandomPosition(random, expanded.Box);
            AssertClosest(collider, expanded, position);
            AssertAllWithin(collider, expanded, position, random.Between(0, 1));
        }

        return true;
    }

    private static (FractalHierarchy Hierarchy, ExpandedRecursives Expanded) Create(FractalRecursive[] recursives, int root, int levels) =>
        (FractalHierarchy.Build(HierarchyDescription.Of([.. recursives], root, levels)), new(recursives, root, levels));

    private static (long Instances, long Faces) Count(FractalHierarchy hierarchy) => (
        new InstanceCounts(hierarchy, static _ => 1, 1L << 60).SumAt(hierarchy.Levels),
        new InstanceCounts(hierarchy, index => hierarchy.BaseMeshes[index].FaceCount, 1L << 60).SumAt(hierarchy.Levels));

    /// <summary>The box of the hierarchy holds all faces and is hardly larger; the searched one is exact.</summary>
    private static void AssertBounds(FractalHierarchy hierarchy, ExpandedRecursives expanded, double maxLooseness)
    {
        var (box, exact) = (hierarchy.Root.Box, expanded.Box);
        Near.Equal(box.Minimum, BoundingBox.Union(box, exact).Minimum, Tolerance);
        Near.Equal(box.Maximum, BoundingBox.Union(box, exact).Maximum, Tolerance);
        Near.Equal(exact.Minimum, box.Minimum, maxLooseness * exact.Diagonal);
        Near.Equal(exact.Maximum, box.Maximum, maxLooseness * exact.Diagonal);
        var searched = FractalBounds.ComputeBox(hierarchy);
        Near.Equal(exact.Minimum, searched.Minimum, Tolerance * exact.Diagonal);
        Near.Equal(exact.Maximum, searched.Maximum, Tolerance * exact.Diagonal);
    }

    private static void AssertClosest(ExactFractalCollider collider, ExpandedRecursives expanded, Vector position)
    {
        var context = new QueryContext();
        Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest));
        Near.Equal(expanded.Distances(position).Min(), closest.Distance, Tolerance);
        var (a, b, c) = expanded.FaceOf(context.InstancePath, closest.FaceIndex);
        Near.Equal(closest.Distance, Math.Sqrt(TriangleKernel.ClosestPoint(position, a, b, c).DistanceSquared), Tolerance);
        Assert.False(closest.Distance > 1e-9 && collider.TryFindClosest(position, closest.Distance - 1e-9, context, out _));
    }

    private static void AssertAllWithin(ExactFractalCollider collider, ExpandedRecursives expanded, Vector position, double radius)
    {
        var expected = expanded.Distances(position).Where(distance => distance <= radius).Order().ToArray();
        var hits = collider.FindAllWithin(position, radius, 1_000_000);
        Assert.Equal(expected.Length, hits.Length);
        for (var i = 0; i < expected.Length; i++)
        {
            Near.Equal(expected[i], hits[i].Distance, Tolerance);
            var (a, b, c) = expanded.FaceOf(hits[i].InstancePath.AsSpan(), hits[i].FaceIndex);
            Near.Equal(hits[i].Distance, Math.Sqrt(TriangleKernel.ClosestPoint(position, a, b, c).DistanceSquared), Tolerance);
        }
    }

    private static Vector RandomPosition(Random random, BoundingBox box) =>
        box.Centre + (0.7 * box.Size.Stretch(random.Vector()));

    private static AffineMap MapOf(Transformation transformation) => new TransformationSet([transformation]).Maps[0];

    private static AffineMap RandomMap(Random random, bool isSimilar) => MapOf(isSimilar
        ? new(random.Vector(1.5), random.Degrees(), random.Between(0.3, 0.8) * Vector.One)
        : random.Transformation());

    private static RecursiveCall Call(double x, double y, double z, double degrees, double scale, int recursive, int levelsLess = 1) =>
        new(MapOf(new(new(x, y, z), new(degrees, 0.5 * degrees, 0), scale * Vector.One)), recursive, levelsLess);

    private static RecursiveCall Skew(double x, double y, double z, double scale, double width, int recursive, int levelsLess = 1) =>
        new(MapOf(new(new(x, y, z), new(20 * scale, 50 * width, 0), new(width, scale, scale))), recursive, levelsLess);
}
