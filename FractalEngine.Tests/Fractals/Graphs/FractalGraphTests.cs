using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Graphs;
using FractalEngine.Core.Fractals.Levels.Building;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Fractals.Levels.Building;
using FractalEngine.Tests.Support;
using static FractalEngine.Tests.Fractals.Levels.Building.RecursiveChecks;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Fractals.Graphs;

/// <summary>Graphs of parts: counts, expansions, and the structure of their hierarchies.</summary>
public class FractalGraphTests
{
    private static readonly ImmutableArray<Mesh> Meshes = [Samples.Tetrahedron, Roof, Samples.Triangle];

    private static readonly AffineMap Smaller = MapOf(new(new(1, 0.2, 0), new(0, 20, 0), 0.6 * Vector.One));

    private static readonly AffineMap Step = AffineMap.Translate(new(0, 2, 0));

    /// <summary>The body <c>[g.] l + [turn.^0..2] [s.] l + b</c>: the product of two sets is a recursive of its own.</summary>
    private static FractalGraph Plant(int? levels)
    {
        var g = MapOf(new(new(0, 1.5, 0), new(0, 10, 0), 0.5 * Vector.One));
        var turn = MapOf(new(Vector.Zero, new(0, 120, 0), Vector.One));
        FractalRecursive z = new(
            0, [new(g, 0), new(AffineMap.Identity, 1, 0), new(turn, 1, 0), new(turn * turn, 1, 0), RecursiveCall.ToPart(1)]);
        FractalRecursive branch = new(0, [new(Smaller, 0)]);
        return new(Meshes, [new RecursivePart([z, branch], 0, levels)]);
    }

    [Fact]
    public void Plant_OfSetsAndAConstant_IsAllOfItsChains()
    {
        for (var levels = 0; levels <= 5; levels++)
        {
            var (hierarchy, expanded) = Create(Plant(levels));
            // Four calls of itself, and a constant at each level but the last.
            Assert.Equal(
                (int)((Math.Pow(4, levels) - 1) / 3), expanded.Instances.Count(static instance => ReferenceEquals(instance.Mesh, Roof)));
            Assert.Equal((expanded.Instances.Count, expanded.FaceCount), Count(hierarchy));
            AssertBounds(hierarchy, expanded, maxLooseness: 0.05);
            var collider = new ExactFractalCollider(hierarchy);
            Seeded.Run(20, random => AssertClosest(collider, expanded, RandomPosition(random, expanded.Box)));
        }
    }

    [Fact]
    public void Counts_OfAMillionLevels_AreThoseOfTheClosedForm()
    {
        var power = BigInteger.Pow(4, 1_000_000);
        AssertCounts(Plant(1_000_000), power, (power - 1) / 3, 0);
        Assert.Equal(602_060, (int)Plant(1_000_000).Counts.Digits);
        AssertCounts(Plant(null), null, null, 0);
        Assert.False(Plant(null).Counts.HasAtMostInstances(long.MaxValue));
    }

    /// <summary>Fibonacci's rabbits: the young become adults, and adults have young.</summary>
    [Fact]
    public void Counts_OfRecursivesInTurns_AreThoseOfTheirRecurrence()
    {
        FractalGraph Rabbits(int levels) => new(
            Meshes, [new RecursivePart([new(0, [new(Smaller, 1)]), new(1, [new(Smaller, 0), new(Step * Smaller, 1)])], 0, levels)]);
        var (young, adults) = (BigInteger.One, BigInteger.Zero);
        for (var levels = 0; levels < 100; levels++)
        {
            AssertCounts(Rabbits(levels), young, adults, 0);
            Assert.True(
                Rabbits(levels).Counts.HasAtMostInstances((long)BigInteger.Min(1L << 53, young + adults)) || young + adults > 1L << 53);
            (young, adults) = (adults, young + adults);
        }
    }

    [Fact]
    public void Counts_OfInfiniteGraphs_AreInfiniteWhereACycleLeads()
    {
        // The first calls the second once, which goes on for ever: the roof stands once, the triangle at each level.
        RecursivePart part = new(
            [new(0, [RecursiveCall.ToPart(1), new(Step, 1)]), new(0, [new(Smaller, 1), RecursiveCall.ToPart(2)])], 0, null);
        AssertCounts(new(Meshes, [part]), null, 1, null);
        var limit = RecursivePart.Of(2, null, new RecursiveCall(Smaller, 0));
        AssertCounts(new(Meshes, [limit, RecursivePart.Sum(RecursiveCall.ToPart(3))]), 0, 0, null);
    }

    /// <summary>Parts that are referred to twice are built once, so that 2¹⁰⁰⁰ chains take a thousand levels.</summary>
    [Fact]
    public void Hierarchy_OfPartsThatAreUsedTwice_GrowsWithTheParts()
    {
        FractalGraph Chain(int count, double factor) => new([Roof], [.. Enumerable.Range(0, count).Select(i => RecursivePart.Sum(
            RecursiveCall.ToPart(AffineMap.Translate(Math.Pow(factor, i) * Vector.I), i), RecursiveCall.ToPart(i)))]);
        Assert.Equal(BigInteger.Pow(2, 1000), Chain(1000, 1.01).ChainCounts[0]);
        var deep = FractalHierarchyBuilder.Build(Chain(1000, 1.01));
        Assert.Equal(1000, deep.Levels);
        Assert.InRange(deep.StorageBytes, 1, 30_000_000);
        var collider = new ExactFractalCollider(FractalHierarchyBuilder.Build(Chain(20, 3)));
        var expanded = new ExpandedGraph(Chain(5, 3));
        Seeded.Run(20, random =>
        {
            var position = new Vector(50, 0, 0) + (50 * random.Vector());
            Near.Equal(expanded.Distances(position).Min(), collider.FindClosest(position).Distance, 1e-9);
        });
    }

    /// <summary>One recursive with constants has the chains of a repetition, whose identities make no instance twice.</summary>
    [Theory]
    [InlineData(7)]
    [InlineData(300_000)]
    [InlineData(null)]
    public void Hierarchy_OfALinearRecursive_HasNoRepeatedInstances(int? levels)
    {
        FractalGraph graph = new(
            Meshes, [RecursivePart.Of(0, levels, new(AffineMap.Identity, 0), new(Smaller, 0), RecursiveCall.ToPart(Step, 1))]);
        var hierarchy = FractalHierarchyBuilder.Build(graph);
        Assert.InRange(hierarchy.StorageBytes, 1, 600_000);
        var collider = new ExactFractalCollider(hierarchy);
        // The powers of the map, as far as they are larger than rounding.
        var count = levels ?? 90;
        Mesh constant = Roof.Transform(v => Step * v);
        var powers = Enumerable.Range(0, Math.Min(count, 90)).Aggregate(
            new List<AffineMap> { AffineMap.Identity }, static (list, _) => [.. list, list[^1] * Smaller]);
        var all = RecursivePart.Sum([
            .. powers.Select(static power => RecursiveCall.ToPart(power, 0)),
            .. powers.Take(Math.Min(count, 90)).Select(static power => RecursiveCall.ToPart(power, 1))]);
        var expanded = new ExpandedGraph(new([Samples.Tetrahedron, constant], [all]));
        Seeded.Run(30, random =>
        {
            var position = RandomPosition(random, expanded.Box);
            Near.Equal(expanded.Distances(position).Min(), collider.FindClosest(position).Distance, Tolerance);
        });
        if (levels == 7)
        {
            Assert.Equal(expanded.Instances.Count, GraphExpansion.Expand(graph, 1000).Length);
            Assert.Equal((expanded.Instances.Count, expanded.FaceCount), Count(hierarchy));
        }
    }

    /// <summary>Of one map and a constant, levels that don't shrink double: a wall of a million storeys.</summary>
    [Fact]
    public void FindClosest_InAMillionStoreys_IsThatOfTheNearest()
    {
        FractalGraph graph = new(Meshes, [RecursivePart.Of(0, 1_000_000, new(Step, 0), RecursiveCall.ToPart(1))]);
        var collider = new ExactFractalCollider(FractalHierarchyBuilder.Build(graph));
        var roof = new HierarchyCollider(Roof);
        foreach (var storey in new[] { 0, 1, 77_777, 999_000 })
        {
            Vector offset = new(3, 0.4, 0.3);
            var position = offset + new Vector(0, 2.0 * storey, 0);
            Near.Equal(roof.FindClosest(offset).Distance, collider.FindClosest(position).Distance, 1e-9);
        }

        var top = new HierarchyCollider(Samples.Tetrahedron).FindClosest(new(-1, 2, 0)).Distance;
        Near.Equal(top, collider.FindClosest(new(-1, 2_000_002, 0)).Distance, 1e-9);
        AssertCounts(graph, 1, 1_000_000, 0);
    }

    /// <summary>The linear case: the same as the fractal of the steps.</summary>
    [Fact]
    public void Expansion_OfStepsOnOneMesh_IsThatOfTheGenerator()
    {
        for (var depth = 0; depth <= 3; depth++)
        {
            var fractal = Samples.AppendixBAt(depth);
            var instances = GraphExpansion.Expand(fractal.Graph, 100_000);
            Assert.Equal(fractal.Expand(100_000), instances.Select(static instance => instance.Map));
        }
    }

    [Fact]
    public void Expansion_OfFewOfManyChains_FindsTheDistinctOnes()
    {
        FractalGraph graph = new(Meshes, [RecursivePart.Of(0, 60, new(AffineMap.Identity, 0), new(Step, 0)), new SteppedPart(3, [])]);
        Assert.Equal(61, GraphExpansion.Expand(graph, 100).Length);
        Assert.Throws<FractalLimitException>(() => GraphExpansion.Expand(graph, 60));
        Assert.Throws<FractalLimitException>(() => GraphExpansion.Expand(Plant(null), 1000));
        // A million levels of one chain, and branches that lead to nothing.
        FractalRecursive empty = new(1, [new(Smaller, 1), new(Step, 1)]);
        FractalGraph deep = new(
            [Samples.Triangle, Mesh.Empty], [new RecursivePart([new(0, [new(Step, 0), new(Step, 1)]), empty], 0, 1_000_000)]);
        Assert.Equal(2e6, Assert.Single(GraphExpansion.Expand(deep, 10)).Map.Translation.Y);
    }

    /// <summary>Sums of infinite parts are searched as others.</summary>
    [Fact]
    public void FindClosest_InASumOfInfiniteParts_IsTheSmallerDistance()
    {
        var infinite = RecursivePart.Of(0, null, new(Smaller, 0), new(MapOf(new(new(-1, 1, 0), Vector.Zero, 0.4 * Vector.One)), 0));
        var joint = (RecursivePart)Plant(null).Parts[0];
        var far = AffineMap.Translate(new(4, 0, 0));
        FractalGraph graph = new(
            Meshes, [infinite, joint, RecursivePart.Sum(RecursiveCall.ToPart(3), RecursiveCall.ToPart(far, 4), RecursiveCall.ToPart(2))]);
        Assert.True(graph.IsInfinite);
        var collider = new ExactFractalCollider(FractalHierarchyBuilder.Build(graph));
        var terms = Array.ConvertAll<FractalPart, ExactFractalCollider>(
            [infinite, joint], static part => new(FractalHierarchyBuilder.Build(new(Meshes, [part]))));
        var triangle = new HierarchyCollider(Samples.Triangle);
        Seeded.Run(30, random =>
        {
            var position = new Vector(2, 0, 0) + (5 * random.Vector());
            var expected = Math.Min(
                triangle.FindClosest(position).Distance,
                Math.Min(terms[0].FindClosest(position).Distance, terms[1].FindClosest(position - far.Translation).Distance));
            Near.Equal(expected, collider.FindClosest(position).Distance, 1e-11);
        });
    }

    /// <summary>Low levels of one large mesh are searched as meshes, also where some are empty.</summary>
    [Fact]
    public void FindClosest_InSumsOfOneLargeMesh_IsThatOfAllFaces()
    {
        var sphere = MeshGenerators.Create("icosphere", 1, 80);
        FractalGraph graph = new([sphere],
        [
            new SteppedPart(0, [TransformationSet.Of([])]),
            RecursivePart.Sum(RecursiveCall.ToPart(1), RecursiveCall.ToPart(Smaller, 0)),
            RecursivePart.Of(2, 3, new(Smaller, 0), RecursiveCall.ToPart(Step, 0), RecursiveCall.ToPart(1)),
        ]);
        var expanded = new ExpandedGraph(graph);
        var collider = new ExactFractalCollider(FractalHierarchyBuilder.Build(graph));
        Seeded.Run(50, random =>
        {
            var position = RandomPosition(random, expanded.Box);
            Near.Equal(expanded.Distances(position).Min(), collider.FindClosest(position).Distance, Tolerance);
        });
    }

    // Not by the assertion of equal numbers, which would write them out.
    private static void AssertCounts(FractalGraph graph, params BigInteger?[] counts) =>
        Assert.True(graph.ChainCounts.SequenceEqual(counts), "the counts differ");
}
