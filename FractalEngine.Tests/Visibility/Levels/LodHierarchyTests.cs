using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Parsing;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;

namespace FractalEngine.Tests.Visibility.Levels;

public class LodHierarchyTests
{
    /// <summary>All fractals of the assets, at depths of at most some thousand instances; −1 keeps the depth of the file.</summary>
    public static TheoryData<string, int> Assets => new()
    {
        { "appendix-b", 2 },
        { "appendix-b-structure", 2 },
        { "diamond", 1 },
        { "fern", 1 },
        { "googol", 3 },
        { "infinite-menger", 2 },
        { "menger", 2 },
        { "menger-3", 2 },
        { "menger-4", 2 },
        { "romanesco", 1 },
        { "shell", -1 },
        { "sierpinski", 3 },
        { "snowflake", -1 },
        { "terrain", 4 },
        { "tetrahedron", 3 },
        { "tree", 3 },
        { "tree-leaves", 3 },
    };

    [Theory]
    [MemberData(nameof(Assets))]
    public void Build_OfAnAsset_HasItsInstancesInItsBoxes(string name, int depth) =>
        Check(depth < 0 ? AssetFractals.Load(name) : AssetFractals.Load(name, depth));

    /// <summary>Bases that a map makes larger vanished from afar, and those that one makes thin grew.</summary>
    [Theory]
    [InlineData("(1000)", 1000, 1000)]
    [InlineData("(0.1, 1, 0.1)", 0.1, 1)]
    public void Proxy_OfABaseUnderASetOfOneMap_IsTheBaseUnderThatMap(string scale, double x, double y)
    {
        using var folder = new TemporaryFolder();
        var corners = string.Join(", ", Enumerable.Range(0, 8).Select(i =>
            $"(({(i % 2 * 500) - 250}, {(i / 2 % 2 * 500) - 250}, {(i / 4 * 500) - 250}), #, (1/2))"));
        var path = folder.Write("block.fdo", $"x. [(#, #, {scale})] box\nz<x>. [{corners}] x\n<$>. z 3\n");
        var hierarchy = LodHierarchy.Build(FractalFile.Read(path));
        var map = hierarchy.NodeAt(hierarchy.LevelCount).ProxyMap.ToAffineMap();
        Assert.Equal(AffineMap.Scale(new(x, y, x), Vector.Zero), map);
    }

    [Fact]
    public void Build_OfRandomFractals_HasTheirInstancesInTheirBoxes() => Seeded.Run(25, random => Check(RandomFractals.CreateAny(random)));

    [Fact]
    public void Build_OfRandomFractalsComponentwise_HasTheirInstancesInTheirBoxes() =>
        Seeded.Run(40, random => Check(RandomFractals.Create(random, Composition.Componentwise)));

    [Fact]
    [Trait("Category", "Soak")]
    public void Build_OfManyRandomFractals_HasTheirInstancesInTheirBoxes() =>
        Seeded.Run(600, random =>
            Check(RandomFractals.Create(random, random.Next(3) == 0 ? Composition.Componentwise : Composition.Affine)));

    [Fact]
    public void Build_OfRepetitionsInRepetitions_HasTheirInstancesInTheirBoxes() => Seeded.Run(30, random =>
    {
        TransformationSet Set() => new(
        [
            .. Enumerable.Range(0, random.Next(1, 3))
                .Select(_ => random.Next(3) == 0 ? Transformation.Identity : random.Transformation()),
        ]);
        var inner = new Repetition([Set(), Set()], random.Next(0, 3));
        var middle = new Repetition([Set(), inner], random.Next(1, 3));
        Check(new(new([Set(), new Repetition([middle, Set()], random.Next(1, 3))]), Samples.Tetrahedron));
    });

    [Fact]
    public void Build_OfManyIdentitiesAndSums_HasEachComponentwiseInstanceOnce()
    {
        // Sums commute, so that most chains are equal to others.
        var set = new TransformationSet(
        [
            Transformation.Identity,
            Samples.Move(1, 0, 0),
            Samples.Move(0, 1, 0),
            new(new(0, 0, 1), new(10, 20, 30), 0.9 * Vector.One),
        ]);
        Check(new(new([new Repetition([set], 9)], Composition.Componentwise), Samples.Tetrahedron));
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(16)]
    [InlineData(17)]
    [InlineData(1000)]
    public void InstanceBvh_OfInstancesAtOnePosition_HasThemAll(int count)
    {
        // All centres are equal, so that no split separates them.
        var maps = Enumerable.Range(1, count).Select(i => new AffineMap(i * Matrix.Identity, Vector.Zero)).ToArray();
        var bvh = new InstanceBvh(new(-Vector.One, Vector.One), maps);
        var nodes = bvh.Nodes;
        var found = new List<AffineMap>();
        Expand(levels => nodes[levels], bvh.RootIndex, AffineMap.Identity, found);
        NaiveFractal.AssertSameMaps([.. maps.Select(NaiveFractal.Rows)], found, 0);
    }

    [Fact]
    public void Build_OfNothing_IsEmpty()
    {
        Fractal[] nothing =
        [
            new(new([new Repetition([new TransformationSet([Transformation.Identity])], 3)]), Mesh.Empty),
            new(new([new TransformationSet([])]), Samples.Tetrahedron),
            new(new([new TransformationSet([])], Composition.Componentwise), Samples.Tetrahedron),
            new(new([new TransformationSet([Transformation.Identity])], Composition.Componentwise), Mesh.Empty),
        ];
        foreach (var fractal in nothing)
        {
            var hierarchy = LodHierarchy.Build(fractal);
            Assert.True(hierarchy.NodeAt(hierarchy.LevelCount).IsEmpty);
            Assert.Empty(Expand(hierarchy));
        }

        var hierarchyOfMesh = LodHierarchy.Build(Mesh.Empty);
        Assert.True(hierarchyOfMesh.NodeAt(hierarchyOfMesh.LevelCount).IsEmpty);
    }

    [Fact]
    public void Build_OfOnePoint_ContainsIt()
    {
        var point = new Mesh([1, 2, 3], [0, 0, 0]);
        var description = Samples.Repeated(4, Samples.MoveAndScale(1, 0, 0, 0.5), Samples.MoveAndScale(0, 1, 0, -0.5)).Description;
        var hierarchy = LodHierarchy.Build(new Fractal(description, point));
        Assert.Equal(16, Expand(hierarchy).Count);
        Assert.True(hierarchy.NodeAt(hierarchy.LevelCount).Box.Size.IsFinite());
    }

    [Fact]
    [Trait("Category", "Soak")]
    public void Build_OfAFractalThatGrowsWithoutEnd_IsRefused()
    {
        Assert.Throws<FractalLimitException>(
            () => LodHierarchy.Build(Samples.Repeated(null, Samples.MoveAndScale(1, 0, 0, 2), Samples.MoveAndScale(0, 1, 0, 0.5))));
        Assert.Throws<FractalLimitException>(
            () => LodHierarchy.Build(Samples.Repeated(null, Samples.Move(1, 0, 0), Samples.MoveAndScale(0, 1, 0, 0.5))));
        Assert.Throws<FractalLimitException>(() => LodHierarchy.Build(Samples.Repeated(10_000, Samples.MoveAndScale(1, 0, 0, 2))));
    }

    [Fact]
    public void Build_OfAFlatMap_IsRefused()
    {
        var fractal = Samples.Repeated(2, new Transformation(Vector.I, Vector.Zero, new(0.5, 0.5, 0)), Samples.MoveAndScale(0, 1, 0, 0.5));
        Assert.Throws<SingularMatrixException>(() => LodHierarchy.Build(fractal));
    }

    private static void Check(Fractal fractal)
    {
        var hierarchy = LodHierarchy.Build(fractal);
        var expected = FractalGenerator.Expand(fractal, 1_000_000);
        var size = expected.Length == 0 ? 1 : expected.Max(map => Math.Max(map.Translation.MaxAbsComponent(), map.Linear.MaxAbsEntry()));
        var found = Expand(hierarchy);
        // The tolerance is that of the same products in another order.
        var counts = CullingViews.CountMatches([.. expected], found, 1e-11 * size, 1e-11 * size);
        Assert.True(counts.All(count => count > 0), $"{counts.Count(count => count == 0)} of {expected.Length} instances are missing");
        // Whether chains are equal is undecidable in general, but identities of one repetition must not repeat instances.
        if (!RepeatsIdentities(fractal.Description))
        {
            Assert.True(
                expected.Length == found.Count, $"{found.Count} instances for {expected.Length} distinct ones of {fractal.InstanceCount}");
        }

        CheckBoxes(hierarchy, hierarchy.LevelCount, []);
    }

    /// <summary>Tells whether a set with the identity occurs again after the end of its repetition, as in nested repetitions.</summary>
    private static bool RepeatsIdentities(FractalDescription description) => description.Composition == Composition.Affine
        && description.Steps.OfType<Repetition>().Any(repetition =>
            repetition.NestingDepth > 1 && NaiveFractal.Levels([repetition]).Any(level => level.Any(map => map.IsIdentity)));

    private static List<AffineMap> Expand(LodHierarchy hierarchy)
    {
        var found = new List<AffineMap>();
        Expand(hierarchy.NodeAt, hierarchy.LevelCount, AffineMap.Identity, found);
        return found;
    }

    private static void Expand(Func<long, LodNode> nodeAt, long levels, AffineMap map, List<AffineMap> found)
    {
        var node = nodeAt(levels);
        if (node.IsEmpty)
        {
            return;
        }

        if (node.ChildMaps.Length == 0)
        {
            found.Add(map * node.ProxyMap.ToAffineMap());
        }

        for (var i = 0; i < node.ChildMaps.Length; i++)
        {
            Expand(nodeAt, ChildLevels(node, i, levels), map * node.ChildMaps[i].ToAffineMap(), found);
        }
    }

    private static long ChildLevels(LodNode node, int child, long levels) => node.ChildLevelSteps[child].RemainingLevels(levels);

    /// <summary>Checks that each node's box holds all vertices of its instances, and the boxes of its children those of theirs.</summary>
    private static void CheckBoxes(LodHierarchy hierarchy, long levels, HashSet<long> visited)
    {
        var node = hierarchy.NodeAt(levels);
        if (!visited.Add(levels) || node.IsEmpty)
        {
            return;
        }

        var instances = new List<AffineMap>();
        Expand(hierarchy.NodeAt, levels, AffineMap.Identity, instances);
        var rounding = 1e-12 * (node.Box.Diagonal + node.Box.Centre.MaxAbsComponent());
        AssertContained(hierarchy.Mesh, instances, node.Box, rounding, $"with {levels} levels left");
        Near.Equal(node.Box.Centre, SimdAffineMap.ToVector(node.Centre), rounding);
        Near.Equal(0.5 * node.Box.Size, SimdAffineMap.ToVector(node.HalfSize), rounding);
        for (var i = 0; i < node.ChildMaps.Length; i++)
        {
            var child = new List<AffineMap>();
            var childLevels = ChildLevels(node, i, levels);
            Expand(hierarchy.NodeAt, childLevels, node.ChildMaps[i].ToAffineMap(), child);
            var start = (i / LodNode.Lanes * LodNode.Lanes * LodNode.BoxRows) + (i % LodNode.Lanes);
            double Number(int row) => node.ChildBoxes[start + (row * LodNode.Lanes)];
            var centre = node.Box.Centre + new Vector(Number(0), Number(1), Number(2));
            var halfSize = new Vector(Number(3), Number(4), Number(5));
            // Boxes in single precision are documented to hold the children: the only tolerance is that of the sums here.
            var box = new BoundingBox(centre - halfSize, centre + halfSize);
            AssertContained(hierarchy.Mesh, child, box, rounding, $"child {i} with {levels} levels left");
            CheckBoxes(hierarchy, childLevels, visited);
        }

        Assert.True(Vector256.EqualsAll(node.Centre, node.Centre), "not a number");
    }

    private static void AssertContained(Mesh mesh, List<AffineMap> maps, BoundingBox box, double rounding, string where)
    {
        Vector[] corners = [.. mesh.VertexIndices.Distinct().Select(mesh.Vertex)];
        foreach (var map in maps)
        {
            foreach (var corner in corners)
            {
                var point = map * corner;
                Ensure.That(box.DistanceSquared(point) <= rounding * rounding, $"{point} is not in {box}, {where}");
            }
        }
    }
}
