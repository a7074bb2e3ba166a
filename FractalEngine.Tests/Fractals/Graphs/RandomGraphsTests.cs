using System.Numerics;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Graphs;
using FractalEngine.Core.Fractals.Levels.Building;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Fractals.Levels.Building;
using FractalEngine.Tests.Support;
using static FractalEngine.Tests.Fractals.Levels.Building.RecursiveChecks;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Fractals.Graphs;

/// <summary>
/// Graphs at random: steps, sums and recursives on each other, with several base meshes, against all their chains. All questions to the
/// hierarchy are compared with those to one mesh of all faces.
/// </summary>
public class RandomGraphsTests
{
    private const int MaxInstances = 1500;

    [Fact]
    public void Searches_InRandomGraphs_AgreeWithAllFaces() => Seeded.RunMost(400, CheckRandom, minShare: 0.6);

    [Fact]
    [Trait("Category", "Soak")]
    public void Searches_InManyRandomGraphs_AgreeWithAllFaces() => Seeded.RunMostInParallel(60_000, CheckRandom, minShare: 0.6);

    [Fact]
    public void FindClosest_OfPointsOfRandomDeepGraphs_IsAtThem() => Seeded.RunMost(10, CheckRandomDeep, minShare: 0.7);

    [Fact]
    [Trait("Category", "Soak")]
    public void FindClosest_OfPointsOfManyRandomDeepGraphs_IsAtThem() => Seeded.RunMostInParallel(5_000, CheckRandomDeep, minShare: 0.7);

    private static bool CheckRandom(Random random)
    {
        var graph = RandomGraph(random);
        var expanded = new ExpandedGraph(graph, MaxInstances);
        if (expanded.IsTooLarge)
        {
            return false;
        }

        CheckCounts(graph, expanded);
        var hierarchy = FractalHierarchyBuilder.Build(graph);
        if (expanded.FaceCount == 0)
        {
            Assert.True(hierarchy.Root.Box.IsEmpty);
            Assert.Empty(GraphExpansion.Expand(graph, 0));
            return true;
        }

        var box = expanded.Box;
        var tolerance = Tolerance * (box.Diagonal + box.MaxAbsCoordinate());
        var distinct = expanded.Distinct(tolerance);
        CheckExpansion(graph, distinct, tolerance);
        AssertHolds(hierarchy.Root.Box, box, tolerance);
        var searched = FractalBounds.ComputeBox(hierarchy);
        Near.Equal(box.Minimum, searched.Minimum, tolerance);
        Near.Equal(box.Maximum, searched.Maximum, tolerance);

        var collider = new ExactFractalCollider(hierarchy);
        var flat = new HierarchyCollider(expanded.Flatten());
        for (var query = 0; query < 3; query++)
        {
            var position = random.Next(2) == 0 ? RandomPosition(random, box) : NearSurface(random, expanded);
            var expected = ExpandedGraph.Distances(distinct, position);
            var found = collider.FindClosest(position);
            Near.Equal(expected.Min(), found.Distance, tolerance);
            Near.Equal(found.Distance, (found.Point - position).Length(), tolerance);
            Near.Equal(0, flat.FindClosest(found.Point).Distance, tolerance);
            CheckAllWithin(collider, expected, position, random, tolerance);
            CheckBoxes(collider, flat, position, random.NextDouble() * box.Size.Stretch(random.Vector()), tolerance);
        }

        var (roof, map) = (new HierarchyCollider(Roof), AffineMap.Translate(RandomPosition(random, box)));
        Near.Equal(roof.FindClosestPair(flat, map).Distance, roof.FindClosestPair(collider, map).Distance, tolerance);
        return true;
    }

    private static void CheckCounts(FractalGraph graph, ExpandedGraph expanded)
    {
        var counts = graph.BaseMeshes.Select(mesh => expanded.Instances.Count(instance => ReferenceEquals(instance.Mesh, mesh))).ToArray();
        Assert.Equal(counts.Select(static count => (BigInteger?)count), graph.ChainCounts);
        Assert.True(graph.Counts.HasAtMostInstances(counts.Sum()));
        Assert.False(graph.Counts.HasAtMostInstances(counts.Sum() - 1));
        Near.Equal(Math.Log10(Math.Max(1, counts.Sum())), graph.Counts.Digits, 1e-9);
    }

    private static void CheckExpansion(FractalGraph graph, List<ExpandedGraph.Instance> distinct, double tolerance)
    {
        var instances = GraphExpansion.Expand(graph, MaxInstances);
        Assert.Equal(distinct.Count, instances.Length);
        Assert.Throws<FractalLimitException>(() => GraphExpansion.Expand(graph, 0));
        // No two are the same, so that as many of the expansion as of the chains are also the same ones.
        foreach (var (meshIndex, map, _) in instances.Take(50))
        {
            var mesh = graph.BaseMeshes[meshIndex];
            Assert.Contains(distinct, instance => ReferenceEquals(mesh, instance.Mesh)
                && Enumerable.Range(0, mesh.VertexCount).All(
                    i => Near.Difference(map * mesh.Vertex(i), instance.Map * mesh.Vertex(i)) <= tolerance));
        }
    }

    private static void AssertHolds(BoundingBox outer, BoundingBox inner, double tolerance)
    {
        var union = BoundingBox.Union(outer, inner);
        Near.Equal(outer.Minimum, union.Minimum, tolerance);
        Near.Equal(outer.Maximum, union.Maximum, tolerance);
    }

    private static void CheckAllWithin(
        ExactFractalCollider collider, double[] distances, Vector position, Random random, double tolerance)
    {
        // Faces at the radius, to rounding, may count or not.
        var radius = distances.Order().ElementAt(random.Next(Math.Min(distances.Length, 40))) + (10 * tolerance);
        var hits = collider.FindAllWithin(position, radius, 1_000_000);
        var expected = distances.Where(distance => distance <= radius + (2 * tolerance)).Order().ToArray();
        Assert.InRange(hits.Length, expected.Count(distance => distance <= radius - (2 * tolerance)), expected.Length);
        for (var i = 0; i < hits.Length; i++)
        {
            Near.Equal(expected[i], hits[i].Distance, tolerance);
        }
    }

    private static void CheckBoxes(
        ExactFractalCollider collider, HierarchyCollider flat, Vector centre, Vector halfSize, double tolerance)
    {
        var half = Vector.Max(halfSize, -halfSize);
        var margin = 10 * tolerance * Vector.One;
        var smaller = half - margin;
        var overlaps = collider.Overlaps(new BoundingBox(centre - half, centre + half));
        // Faces at the edge, to rounding, may count or not.
        Assert.True(overlaps || Math.Min(smaller.X, Math.Min(smaller.Y, smaller.Z)) < 0
            || !flat.Overlaps(new BoundingBox(centre - smaller, centre + smaller)));
        Assert.True(!overlaps || flat.Overlaps(new BoundingBox(centre - half - margin, centre + half + margin)));
    }

    private static Vector NearSurface(Random random, ExpandedGraph expanded)
    {
        var instances = expanded.Instances.Where(static instance => instance.Mesh.FaceCount > 0).ToArray();
        var instance = instances[random.Next(instances.Length)];
        return (instance.Map * instance.Mesh.Vertex(0)) + random.Vector(Math.Pow(10, -random.Next(0, 6)));
    }

    /// <summary>Chains of maps to the limit of a graph of infinitely, or of very many levels lead to points of it.</summary>
    private static bool CheckRandomDeep(Random random)
    {
        var graph = RandomDeepGraph(random);
        var part = (RecursivePart)graph.Parts[^1];
        var collider = new ExactFractalCollider(FractalHierarchyBuilder.Build(graph));
        var found = 0;
        for (var query = 0; query < 10; query++)
        {
            var map = AffineMap.Identity;
            var recursive = part.Root;
            var levels = part.Levels ?? int.MaxValue;
            int? end = null;
            for (var size = 1.0; end is null && size > 1e-19; size = map.Linear.MaxAbsEntry())
            {
                var calls = part.Recursives[recursive].Calls;
                if (calls.IsEmpty)
                {
                    break;
                }

                var call = calls[random.Next(calls.Length)];
                map *= call.Map;
                levels -= call.LevelsLess ?? 0;
                end = call.IsConstant ? call.Target : levels <= 0 ? part.Recursives[call.Target].BasePart : null;
                recursive = call.IsConstant ? recursive : call.Target;
            }

            if (end is { } index)
            {
                var parts = graph.Parts[..Math.Max(0, index - graph.BaseMeshes.Length + 1)];
                var instance = new ExpandedGraph(new(graph.BaseMeshes, parts));
                AssertIsFound(map * (index < graph.BaseMeshes.Length
                    ? graph.BaseMeshes[index].Vertex(0)
                    : instance.Instances[0].Map * instance.Instances[0].Mesh.Vertex(0)));
            }
            else if (map.Linear.MaxAbsEntry() <= 1e-19 && levels > 0)
            {
                AssertIsFound(map.Translation);
            }
        }

        return found > 0;

        void AssertIsFound(Vector point)
        {
            Near.Equal(0, collider.FindClosest(point).Distance, Tolerance * (1 + point.MaxAbsComponent()));
            found++;
        }
    }

    /// <summary>Draws recursives without identities: those make the same instances so often that searches meet their limit.</summary>
    private static FractalGraph RandomDeepGraph(Random random)
    {
        var isSimilar = random.Next(2) == 0;
        Mesh[] meshes = [Samples.Tetrahedron, Roof, Samples.Triangle];
        var sum = RecursivePart.Sum([.. Many(random.Next(1, 4), () => RecursiveCall.ToPart(Map(), random.Next(3)))]);
        var count = random.Next(1, 5);
        var recursives = Many(count, index => new FractalRecursive(random.Next(4),
        [
            .. Many(random.Next(1, 4), () => random.Next(4) switch
            {
                0 => RecursiveCall.ToPart(Map(), random.Next(4)),
                1 when index > 0 => new(Map(), random.Next(index), 0),
                _ => new(Map(), random.Next(count), random.Next(1, 3)),
            }),
        ]));
        var levels = random.Next(3) == 0 ? (int?)null : random.Next(2) == 0 ? random.Next(20, 2000) : random.Next(100_000, 500_000);
        return new([.. meshes], [sum, new RecursivePart([.. recursives], random.Next(count), levels)]);

        AffineMap Map() => MapOf(RandomShrinkage(random, isSimilar));
    }

    private static FractalGraph RandomGraph(Random random)
    {
        var isSimilar = random.Next(2) == 0;
        Mesh[] meshes = [Samples.Tetrahedron, Roof, Samples.Triangle, Mesh.Empty];
        random.Shuffle(meshes);
        meshes = meshes[..random.Next(1, 5)];
        var parts = new List<FractalPart>();
        for (var count = random.Next(1, 6); parts.Count < count;)
        {
            parts.Add(random.Next(3) switch
            {
                0 => new SteppedPart(Earlier(), [.. Many(random.Next(0, 3), () => RandomStep(random, isSimilar))]),
                1 => RecursivePart.Sum([.. Many(random.Next(1, 4), () => RecursiveCall.ToPart(Map(), Earlier()))]),
                _ => RandomRecursives(),
            });
        }

        return new([.. meshes], [.. parts]);

        AffineMap Map() => RandomMap(random, isSimilar);

        // The latest more often than others.
        int Earlier() => Math.Max(random.Next(meshes.Length + parts.Count), random.Next(meshes.Length + parts.Count));

        RecursivePart RandomRecursives()
        {
            var count = random.Next(1, 4);
            var order = Enumerable.Range(0, count).ToArray();
            random.Shuffle(order);
            return new([.. Many(count, index => new FractalRecursive(Earlier(),
            [
                .. Many(random.Next(random.Next(8) == 0 ? 0 : 1, 4), () =>
                {
                    var target = random.Next(count);
                    return random.Next(4) == 0 ? RecursiveCall.ToPart(Map(), Earlier())
                        : new(Map(), target, order[target] < order[index] && random.Next(2) == 0 ? 0 : random.Next(4) == 0 ? 2 : 1);
                }),
            ]))], random.Next(count), random.Next(5));
        }
    }

    private static FractalStep RandomStep(Random random, bool isSimilar)
    {
        var round = Many(random.Next(1, 3), () => TransformationSet.Of(
            Many(random.Next(random.Next(12) == 0 ? 0 : 1, 4), () => RandomTransformation(random, isSimilar)))).ToArray();
        return random.Next(2) == 0 ? round[0] : new Repetition([.. round], random.Next(0, random.Next(6) == 0 ? 12 : 4));
    }

    private static AffineMap RandomMap(Random random, bool isSimilar) => MapOf(RandomTransformation(random, isSimilar));

    private static Transformation RandomTransformation(Random random, bool isSimilar)
    {
        var transformation = random.Next(6) == 0 ? Transformation.Identity : RandomShrinkage(random, isSimilar);
        return random.Next(25) == 0
            ? transformation with { Position = Math.Pow(10, random.Next(2, 5)) * transformation.Position }
            : transformation;
    }

    private static Transformation RandomShrinkage(Random random, bool isSimilar)
    {
        var mirror = random.Next(4) == 0 ? new Vector(-1, 1, 1) : Vector.One;
        return isSimilar
            ? new(random.Vector(1.5), random.Degrees(), random.Between(0.3, 0.8) * mirror)
            : random.Transformation();
    }

    private static IEnumerable<T> Many<T>(int count, Func<T> create) => Many(count, _ => create());

    private static IEnumerable<T> Many<T>(int count, Func<int, T> create) => [.. Enumerable.Range(0, count).Select(create)];
}
