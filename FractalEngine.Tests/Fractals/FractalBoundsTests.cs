using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals;

public class FractalBoundsTests
{
    // The bounds are those of the vertices of 4⁹ tiles: deeper levels add less than 0.55⁹ of the terrain's height, 1.4.
    private static readonly Lazy<BoundingBox> TerrainAtDepth9 =
        new(static () => FractalGenerator.Flatten(AssetFractals.Load("terrain", 9), 10_000_000).Bounds);

    public static TheoryData<Composition> Compositions { get; } = [Composition.Affine, Composition.Componentwise];

    /// <summary>Each set alone rotates or stretches, and only a round of them shrinks: bounds set by set would grow without end.</summary>
    [Theory]
    [InlineData(20)]
    [InlineData(60)]
    public void Bounds_OfRoundsThatShrinkOnlyAsAWhole_AreThoseOfTheirLimit(int depth)
    {
        var expanded = TerrainAtDepth9.Value;
        var bounds = AssetFractals.Load("terrain", depth).Bounds;
        var rest = 1.4 * Math.Pow(0.55, 9);
        Near.Equal(expanded.Minimum, bounds.Minimum, rest);
        Near.Equal(expanded.Maximum, bounds.Maximum, rest);
        Assert.True(bounds.Minimum.Y <= expanded.Minimum.Y && bounds.Maximum.Y >= expanded.Maximum.Y);
    }

    [Theory]
    [InlineData(1000)]
    [InlineData(1_000_000)]
    [Trait("Category", "Soak")]
    public void Bounds_OfRoundsThatShrinkOnlyAsAWholeInOtherCases_AreThoseOfTheirLimit(int depth) =>
        Bounds_OfRoundsThatShrinkOnlyAsAWhole_AreThoseOfTheirLimit(depth);

    /// <summary>Sets of more maps than one node has, under and above placements that turn.</summary>
    [Theory]
    [InlineData(65)]
    [InlineData(300)]
    public void Bounds_OfAWideSetBetweenPlacements_AreThoseOfItsFaces(int count) => Seeded.Run(5, random =>
    {
        var maps = Enumerable.Range(0, count).Select(_ => random.Transformation()).ToArray();
        var fractal = Fractal.Of(Samples.Tetrahedron).Apply([random.Transformation()]).Apply(maps).Apply([random.Transformation()]);
        var expected = FractalGenerator.Flatten(fractal, 10_000).Bounds;
        Near.Equal(expected.Minimum, fractal.Bounds.Minimum, 1e-12 * expected.Diagonal);
        Near.Equal(expected.Maximum, fractal.Bounds.Maximum, 1e-12 * expected.Diagonal);
    });

    /// <summary>
    /// 32,768 trees on one plane, turned about its normal. All are candidates for the highest twig, but only 16 of them differ in height.
    /// </summary>
    [Theory]
    [InlineData("forest")]
    [InlineData("forest-leaves")]
    public void Bounds_OfAForest_ReachAsHighAsItsHighestTree(string name)
    {
        var forest = AssetFractals.Load(name);
        var trees = new Fractal(new([.. forest.Description.Steps[7..]]), forest.BaseMesh);
        Assert.Equal(4, trees.LevelAt(0).Transformations.Length);
        Near.Equal(trees.Bounds.Minimum.Y, forest.Bounds.Minimum.Y, 1e-12);
        Near.Equal(trees.Bounds.Maximum.Y, forest.Bounds.Maximum.Y, 1e-12);
    }

    [Fact]
    public void LevelBoxes_OfRoundsOfManyMaps_DoNotMultiplyThemOut() => Seeded.Run(1, random =>
    {
        // Multiplied out they would be nine million products of 96 bytes.
        var set = new TransformationSet([.. Enumerable.Range(0, 3000).Select(_ => random.Transformation())]);
        var fractal = new Fractal(new([new Repetition([set, set], 3)]), Samples.Triangle);
        var before = GC.GetAllocatedBytesForCurrentThread();
        Assert.True(LevelBoxes.ComputeBox(fractal).Size.IsFinite());
        Assert.InRange(GC.GetAllocatedBytesForCurrentThread() - before, 0, 10_000_000);
    });

    [Fact]
    public void Bounds_OfAnyFractal_AreThoseOfItsExpandedVertices() => Seeded.Run(300, random =>
    {
        var fractal = RandomFractals.CreateAny(random);
        if (fractal.BaseMesh.VertexIndices.Distinct().Count() == fractal.BaseMesh.VertexCount)
        {
            AssertNear(BruteForce(fractal), fractal.Bounds, 1e-9);
        }
        else
        {
            // Vertices that no face uses may widen the box.
            var faces = NaiveFractal.Corners(fractal.Description, fractal.BaseMesh, NaiveFractal.MapOf(Transformation.Identity));
            AssertContains(fractal.Bounds, NaiveFractal.Box(faces));
        }
    });

    /// <summary>What a small object of a mesh far from its origin is searched by: the rounding of the mesh is no measure of it.</summary>
    [Fact]
    public void Bounds_OfAMeshFarAwayThatIsPlacedTiny_AreThoseOfItsExpandedVertices() => Seeded.Run(100, random =>
    {
        var offset = Math.Pow(10, random.Between(0, 7)) * random.Direction();
        var (tetrahedron, scale) = (Samples.Tetrahedron, Math.Pow(10, -random.Between(0, 12)));
        var mesh = tetrahedron.Transform(v => v.Stretch(new(1, 1e-3, 1)) + offset);
        Transformation[] maps = [random.Transformation(), random.Transformation(), random.Transformation()];
        var placement = new Transformation(random.Vector(scale), random.Degrees(), scale * Vector.One);
        var fractal = Fractal.Of(mesh).Apply(maps.Select(map => map with { Position = -(map.ToAffineMap().Linear * offset) }));
        AssertNear(BruteForce(fractal.WithPlacement(placement)), fractal.WithPlacement(placement).Bounds, 1e-9, scale * offset.Length());
    });

    /// <summary>Wide levels are searched by groups of their children, which have the map of their parent.</summary>
    [Theory]
    [InlineData(65, 1)]
    [InlineData(300, 1)]
    [InlineData(3000, 1)]
    [InlineData(100, 2)]
    public void Bounds_OfWideSets_AreThoseOfTheirExpandedVertices(int width, int levels) => CheckWideSets(width, levels, sets: 2);

    [Theory]
    [InlineData(300, 2)]
    [Trait("Category", "Soak")]
    public void Bounds_OfWiderSets_AreThoseOfTheirExpandedVertices(int width, int levels) => CheckWideSets(width, levels, sets: 3);

    private static void CheckWideSets(int width, int levels, int sets) => Seeded.Run(sets, random =>
    {
        var maps = Enumerable.Range(0, width).Select(_ => random.Transformation());
        var fractal = new Fractal(new([new Repetition([new TransformationSet([.. maps])], levels)]), Samples.Triangle);
        AssertNear(BruteForce(fractal), fractal.Bounds, 1e-9);
    });

    [Fact]
    public void Bounds_OfMoreSumsThanAreListed_AreTheSumsWidenedByTheMesh()
    {
        var mesh = Samples.Triangle.Transform(v => 3 * v);
        var half = Samples.MoveAndScale(1, 0, 0, 2) with { Rotation = Vector.I };
        var fractal = new Fractal(
            new(
                [
                    TransformationSet.Of(Samples.MoveAndScale(0, 0, 0, 1.5)),
                    new Repetition([TransformationSet.Of([Samples.Move(0, -1, 0), Samples.Move(1, 0, 2)])], 200),
                    TransformationSet.Of(half),
                ],
                Composition.Componentwise),
            mesh);
        AssertNear(new(new Vector(1, -200, 0) - (9 * Vector.One), new Vector(201, 0, 400) + (9 * Vector.One)), fractal.Bounds, 1e-12);
    }

    [Fact]
    public void Bounds_OfAnyComponentwiseFractal_AreThoseOfItsExpandedVertices() => Seeded.Run(300, random =>
    {
        var fractal = RandomFractals.Create(random, Composition.Componentwise);
        AssertNear(BruteForce(fractal), fractal.Bounds, 1e-9);
    });

    [Fact]
    public void Bounds_OfAFractalThatGrows_AreThoseOfItsExpandedVertices() => Seeded.Run(100, random =>
    {
        var fractal = Samples.Repeated(3, random.Transformation(0.8, 3), random.Transformation(0.8, 3), random.Transformation(0.8, 3));
        AssertNear(BruteForce(fractal), fractal.Bounds, 1e-9);
    });

    [Theory]
    [MemberData(nameof(Compositions))]
    public void Bounds_OfAppendixBAtDepthTwo_AreThoseOfItsExpandedVertices(Composition composition) =>
        AssertNear(BruteForce(Samples.AppendixBAt(2, composition)), Samples.AppendixBAt(2, composition).Bounds, 1e-9);

    [Fact]
    public void Bounds_OfTheInfiniteAppendixB_AreFiniteAndHoldEveryDepth()
    {
        var file = Samples.ParseFractal(Samples.AppendixB.Replace("<$>. z 6", "<$>. z", StringComparison.Ordinal));
        var infinite = new Fractal(file.Description, Samples.Triangle);
        Assert.True(infinite.Description.IsInfinite);
        Assert.True(infinite.Bounds.Minimum.IsFinite() && infinite.Bounds.Maximum.IsFinite(), infinite.Bounds.ToString());
        AssertContains(infinite.Bounds, BruteForce(infinite.WithDepth(2)));
    }

    [Fact]
    public void Bounds_OfAnInfiniteSierpinski_AreTheWholeTetrahedrons()
    {
        // Child instances of half the size in the corners: the limit has the same corners as the base mesh.
        var mesh = new Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], [0, 1, 2, 0, 1, 3]);
        var infinite = new Fractal(Samples.Repeated(
            null, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(0.5, 0, 0, 0.5), Samples.MoveAndScale(0, 0.5, 0, 0.5),
            Samples.MoveAndScale(0, 0, 0.5, 0.5)).Description, mesh);
        AssertNear(new(Vector.Zero, Vector.One), infinite.Bounds, 1e-9);
    }

    /// <summary>The last digits of coordinates change from level to level without end.</summary>
    [Fact]
    public void Bounds_OfTheInfiniteWithMirrors_AreThoseOfADeepOne() => Seeded.Run(100, random =>
    {
        var centre = Math.Pow(10, random.Next(9)) * random.Direction();
        var maps = Enumerable.Range(0, random.Next(1, 5)).Select(_ => random.Transformation(0.1, 0.5) with { Rotation = Vector.Zero })
            .Select(map => map with { Position = map.Position + centre - centre.Stretch(map.Scale) }).ToArray();
        var fractal = Fractal.Of(Samples.Tetrahedron.Transform(v => v + centre)).Repeat(maps);
        AssertNear(fractal.WithDepth(100).Bounds, fractal.Bounds, 1e-9);
    });

    [Theory]
    [InlineData(4, -1)]
    [InlineData(5, 1)]
    public void Bounds_OfAMirrorThatIsRepeated_AreThoseOfItsLastSide(int depth, double minimum)
    {
        var mirror = new Transformation(new(2, 0, 0), Vector.Zero, new(-1, 1, 1));
        var bounds = Fractal.Of(Shapes.Cube().Transform(v => 2 * v)).Repeat([mirror], depth).Bounds;
        AssertNear(new(new(minimum, -1, -1), new(minimum + 2, 1, 1)), bounds, 1e-12);
    }

    [Fact]
    public void Bounds_OfTheInfinite_AreTheLimitOfFiniteDepths() => Seeded.Run(50, random =>
    {
        // Factors are at most 0.7, so that levels beyond 60 are below the tolerance: 0.7⁶⁰ is 5e-10.
        var maps = Enumerable.Range(0, 3).Select(_ => random.Transformation()).ToArray();
        AssertNear(Samples.Repeated(60, maps).Bounds, Samples.Repeated(null, maps).Bounds, 1e-8);
    });

    [Theory]
    [InlineData(1_000)]
    [InlineData(1_000_000)]
    public void Bounds_AtAnyDepth_AreThatOfTheLimit(int depth)
    {
        Transformation[] maps = [Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(3, 0, 0, 0.5)];
        var fractal = Samples.Repeated(depth, maps);
        // It takes milliseconds, as all levels but some hundred are alike.
        var bounds = ProcessorTime.RunWithin(2, () => fractal.Bounds);
        AssertNear(Samples.Repeated(null, maps).Bounds, bounds, 1e-12);
    }

    [Fact]
    public void Bounds_OfAppendixBAtFullDepth_HoldThoseOfDepthTwo()
    {
        // The identity is among the maps, so that each depth has all instances of the depths before.
        AssertContains(Samples.AppendixBAt(6).Bounds, Samples.AppendixBAt(2).Bounds);
    }

    [Fact]
    public void Bounds_OfAnEmptyMesh_AreEmpty() =>
        Assert.True(new Fractal(Samples.Repeated(3, Samples.Move(1, 0, 0)).Description, Mesh.Empty).Bounds.IsEmpty);

    [Fact]
    public void Bounds_OfMapsBeyondADouble_AreNotFiniteAndNotWrong()
    {
        var bounds = Samples.Repeated(2000, Samples.MoveAndScale(1, 0, 0, 2), Samples.MoveAndScale(-1, 0, 0, 2)).Bounds;
        Assert.False(bounds.Minimum.IsFinite() && bounds.Maximum.IsFinite(), bounds.ToString());
    }

    [Fact]
    public void Bounds_OfAFractalThatGrowsAlmostToADoublesLimit_AreThoseOfItsCorners()
    {
        // Along x the farthest corner at depth n is 1 + 2·(that at depth n − 1), and it starts at 2.
        var expected = Enumerable.Range(0, 600).Aggregate(2.0, (x, _) => 1 + (2 * x));
        var bounds = Samples.Repeated(600, Samples.MoveAndScale(1, 0, 0, 2), Samples.MoveAndScale(-1, 0, 0, 2)).Bounds;
        Near.Equal(1, bounds.Maximum.X / expected, 1e-9);
    }

    private static BoundingBox BruteForce(Fractal fractal) => NaiveFractal.Box(
        from map in NaiveFractal.Chains(fractal.Description)
        from vertex in NaiveFractal.Vertices(fractal.BaseMesh)
        select NaiveFractal.Apply(map, vertex));

    private static void AssertContains(BoundingBox outer, BoundingBox inner) => AssertNear(outer, BoundingBox.Union(outer, inner), 1e-9);

    private static void AssertNear(BoundingBox expected, BoundingBox actual, double relativeTolerance, double reach = 0)
    {
        // Coordinates away from the origin are rounded, however small the box is.
        var rounding = 1e-14 * Math.Max(reach, Math.Max(expected.Minimum.MaxAbsComponent(), expected.Maximum.MaxAbsComponent()));
        var tolerance = (relativeTolerance * expected.Diagonal) + rounding;
        Near.Equal(expected.Minimum, actual.Minimum, tolerance);
        Near.Equal(expected.Maximum, actual.Maximum, tolerance);
    }
}
