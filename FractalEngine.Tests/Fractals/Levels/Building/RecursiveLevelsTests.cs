using System.Collections.Immutable;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Graphs;
using FractalEngine.Core.Fractals.Levels.Building;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Queries.Closest;
using FractalEngine.Tests.Support;
using static FractalEngine.Tests.Fractals.Levels.Building.RecursiveChecks;

namespace FractalEngine.Tests.Fractals.Levels.Building;

/// <summary>Recursives that call each other, with several base meshes, against all their faces.</summary>
public class RecursiveLevelsTests
{
    private static readonly ImmutableArray<Mesh> Meshes = [Samples.Tetrahedron, Roof, Samples.Triangle];

    /// <summary>The first two call each other and themselves; the third is a sum of both, the second with two levels less.</summary>
    private static readonly FractalRecursive[] Similar =
    [
        new(0, [Call(0, 0, 0, 10, 0.5, 0), Call(1.2, 0.1, 0, -25, 0.45, 1), Call(0, 0, 1.3, 40, 0.5, 0)]),
        new(1, [Call(0.1, 1, 0, 35, 0.6, 1), Call(1, 0, 0.9, 80, 0.4, 0)]),
        new(2, [Call(0, 0, 0, 0, 1, 0), Call(3, 0.5, -1, 15, 0.8, 1, levelsLess: 2)]),
    ];

    private static readonly FractalRecursive[] Skewed =
    [
        new(0, [Skew(0, 0, 0, 0.5, 0.4, 0), Skew(1.2, 0.1, 0, 0.45, 0.6, 1), Skew(0, 0, 1.3, 0.5, 0.5, 0)]),
        new(1, [Skew(0.1, 1, 0, 0.6, 0.5, 1), Skew(1, 0, 0.9, 0.4, 0.5, 0)]),
        new(2, [Skew(0, 0, 0, 1, 1, 0), Skew(3, 0.5, -1, 0.8, 0.7, 1, levelsLess: 2)]),
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
            var (hierarchy, expanded) = Create(GraphOf(isSimilar ? Similar : Skewed, root, levels));
            AssertBounds(hierarchy, expanded, maxLooseness: 0.01);
        }
    }

    [Theory]
    [MemberData(nameof(Roots))]
    public void Counts_OfRecursives_AreThoseOfAllInstances(bool isSimilar, int root)
    {
        for (var levels = 0; levels <= 6; levels++)
        {
            var (hierarchy, expanded) = Create(GraphOf(isSimilar ? Similar : Skewed, root, levels));
            Assert.Equal((expanded.Instances.Count, expanded.FaceCount), Count(hierarchy));
        }
    }

    [Theory]
    [MemberData(nameof(Roots))]
    public void FindClosest_InRecursives_IsTheClosestOfAllFaces(bool isSimilar, int root)
    {
        for (var levels = 0; levels <= 6; levels++)
        {
            var (hierarchy, expanded) = Create(GraphOf(isSimilar ? Similar : Skewed, root, levels));
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
            var (hierarchy, expanded) = Create(GraphOf(isSimilar ? Similar : Skewed, root, levels));
            var collider = new ExactFractalCollider(hierarchy);
            Seeded.Run(10, random => AssertAllWithin(collider, expanded, RandomPosition(random, expanded.Box), random.Between(0, 2)));
        }
    }

    /// <summary>One recursive that calls itself is a repetition, and must have its bounds, counts and answers.</summary>
    [Fact]
    public void Hierarchy_OfOneRecursive_IsThatOfARepetition()
    {
        var fractal = Fractal.Of(Samples.Tetrahedron).Repeat([Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.5)], 30);
        var maps = fractal.LevelAt(0).Maps;
        FractalGraph graph = new(
            [Samples.Tetrahedron], [RecursivePart.Of(0, 30, [.. maps.Select(static map => new RecursiveCall(map, 0))])]);
        var (expected, actual) = (fractal.Hierarchy, FractalHierarchyBuilder.Build(graph));
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
            var recursives = isSimilar ? Similar : Skewed;
            var deep = FractalHierarchyBuilder.Build(GraphOf(recursives, root, levels));
            var limit = new ExactFractalCollider(FractalHierarchyBuilder.Build(GraphOf(recursives, root, 90)));
            var collider = new ExactFractalCollider(deep);
            Assert.Equal(root, (int)(deep.Levels % 3));
            Assert.InRange(collider.StorageBytes, 1, 400_000);
            var box = new ExpandedGraph(GraphOf(recursives, root, 5)).Box;
            Seeded.Run(20, random =>
            {
                var position = RandomPosition(random, box);
                Near.Equal(limit.FindClosest(position).Distance, collider.FindClosest(position).Distance, Tolerance);
            });
        }
    }

    [Theory]
    [MemberData(nameof(Roots))]
    public void BestFirstSearch_InRecursives_FindsTheClosestOfAllFaces(bool isSimilar, int root)
    {
        var (hierarchy, expanded) = Create(GraphOf(isSimilar ? Similar : Skewed, root, 4));
        BestFirstSearch bestFirst = new(hierarchy, Array.ConvertAll(hierarchy.BaseMeshes, TriangleBvh.For));
        Seeded.Run(20, random =>
        {
            var position = RandomPosition(random, expanded.Box);
            var search = new FractalSearchState(double.PositiveInfinity, 0, position.MaxAbsComponent(), expanded.Box.Diagonal, new());
            bestFirst.Run(position, AffineMap.Identity, ref search);
            Near.Equal(expanded.Distances(position).Min(), Math.Sqrt(search.ClosestDistanceSquared), Tolerance);
        });
    }

    /// <summary>Steps are applied to recursives as to a base mesh. An instance that the identity makes twice counts once.</summary>
    [Fact]
    public void Steps_OnRecursives_ApplyToAllTheirFaces()
    {
        TransformationSet stairs = new([Transformation.Identity, new(new(0, 2, 0), new(0, 30, 0), 0.9 * Vector.One)]);
        RecursivePart recursives = new([.. Similar], 2, 4);
        var hierarchy = FractalHierarchyBuilder.Build(new(Meshes, [recursives, new SteppedPart(3, [new Repetition([stairs], 3)])]));
        // The same as a sum of powers.
        var maps = Enumerable.Range(0, 4).Select(power => Enumerable.Repeat(stairs.Maps[1], power)
            .Aggregate(AffineMap.Identity, static (product, map) => product * map));
        var sum = RecursivePart.Sum([.. maps.Select(static map => RecursiveCall.ToPart(map, 3))]);
        var expanded = new ExpandedGraph(new(Meshes, [recursives, sum]));
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
        var (hierarchy, expanded) = Create(GraphOf(Similar, 2, 3));
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
        var (hierarchy, _) = Create(GraphOf(Similar, 1, 4));
        Assert.Equal((3 * 4) + 1, hierarchy.Levels);
        Assert.Equal([0, 1, 2], Enumerable.Range(0, 3).Select(level => hierarchy.AllLevels.Items[level].BaseIndex));
        Assert.Equal([true, true, true, false], Enumerable.Range(0, 4).Select(level => hierarchy.IsBase(level)));
    }

    [Fact]
    public void Part_OfCallsThatLeadNowhere_IsRefused()
    {
        static RecursivePart Calling(int root, int? levels, params RecursiveCall[] calls) =>
            new([.. calls.Select(static call => new FractalRecursive(0, [call]))], root, levels);
        Assert.Throws<ArgumentException>(() => Calling(0, 3, new RecursiveCall(AffineMap.Identity, 1)));
        Assert.Throws<ArgumentException>(() => Calling(0, 3, new RecursiveCall(AffineMap.Identity, 0, -1)));
        Assert.Throws<ArgumentException>(() => Calling(0, 3, new(AffineMap.Identity, 1, 0), new(AffineMap.Identity, 0, 0)));
        Assert.Throws<ArgumentOutOfRangeException>(() => Calling(1, 3, new RecursiveCall(AffineMap.Identity, 0)));
        Assert.Throws<ArgumentOutOfRangeException>(() => Calling(0, -1, new RecursiveCall(AffineMap.Identity, 0)));
        Assert.Equal([1, 0], Calling(0, 3, new(AffineMap.Identity, 1, 0), new(AffineMap.Identity, 0)).Order.ToArray());
    }

    [Fact]
    public void Graph_OfLaterPartsOrOfInfiniteOnes_IsRefused()
    {
        var infinite = RecursivePart.Of(0, null, new RecursiveCall(AffineMap.Scale(0.5 * Vector.One, Vector.Zero), 0));
        Assert.Throws<ArgumentException>(() => new FractalGraph([], []));
        Assert.Throws<ArgumentException>(() => new FractalGraph(Meshes, [new SteppedPart(3, [])]));
        Assert.Throws<ArgumentException>(() => new FractalGraph(Meshes, [RecursivePart.Sum(RecursiveCall.ToPart(-1))]));
        SteppedPart stepped = new(3, Samples.Repeated(1).Description.Steps);
        Assert.Throws<ArgumentException>(() => new FractalGraph(Meshes, [infinite, stepped]));
        var recursive = RecursivePart.Of(3, 2, new RecursiveCall(AffineMap.Identity, 0));
        Assert.Throws<ArgumentException>(() => new FractalGraph(Meshes, [infinite, recursive]));
        Assert.True(new FractalGraph(Meshes, [infinite, RecursivePart.Sum(RecursiveCall.ToPart(3), RecursiveCall.ToPart(1))]).IsInfinite);
    }

    private static FractalGraph GraphOf(FractalRecursive[] recursives, int root, int? levels) =>
        new(Meshes, [new RecursivePart([.. recursives], root, levels)]);

    private static RecursiveCall Call(double x, double y, double z, double degrees, double scale, int recursive, int levelsLess = 1) =>
        new(MapOf(new(new(x, y, z), new(degrees, 0.5 * degrees, 0), scale * Vector.One)), recursive, levelsLess);

    private static RecursiveCall Skew(double x, double y, double z, double scale, double width, int recursive, int levelsLess = 1) =>
        new(MapOf(new(new(x, y, z), new(20 * scale, 50 * width, 0), new(width, scale, scale))), recursive, levelsLess);
}
