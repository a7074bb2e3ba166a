using System.Numerics;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Fractals;

public class DistinctInstancesTests
{
    /// <summary>What identities repeat is counted once at any depth, without an expansion.</summary>
    [Theory]
    [InlineData(1, 200, 201)]
    [InlineData(1, 1000, 1001)]
    [InlineData(4, 7, 21_845)]
    [InlineData(2, 40, (1L << 41) - 1)]
    public void CountAtMost_OfTurnsAndIdentities_CountsThemOnce(int maps, int depth, long expected)
    {
        Transformation[] set =
        [
            Transformation.Identity,
            .. Enumerable.Range(0, maps).Select(
                static i => new Transformation(new(1, 0.1 * i, 0), new(0, 17 + (31 * i), 5), 0.45 * Vector.One)),
        ];
        var fractal = Fractal.Of(Samples.Tetrahedron).Repeat(set, depth);
        Assert.Equal(expected, DistinctInstances.CountAtMost(fractal, budget: 10));
    }

    [Fact]
    public void CountAtMost_IsBetweenTheDistinctAndAllChains() => Seeded.Run(100, random =>
    {
        var fractal = RandomShapes.Create(random);
        var count = DistinctInstances.CountAtMost(fractal, budget: 0);
        Assert.Equal(fractal.Description.IsInfinite, count is null);
        Assert.True(count is null || (count <= fractal.InstanceCount && !(count < DistinctInstances.Count(fractal))), $"{count}");
    });

    [Fact]
    public void CountAtMost_OfTheInfinite_IsNull() =>
        Assert.Null(DistinctInstances.CountAtMost(Samples.Repeated(null, Samples.Move(1, 0, 0))));

    [Fact]
    public void Count_OfAppendixBAtDepthThree_IsTheEnumeratedOne()
    {
        var fractal = Samples.AppendixBAt(3);
        Assert.Equal((15_625, 13_641), (fractal.InstanceCount, DistinctInstances.Count(fractal)));
    }

    [Fact]
    public void Count_OfAppendixBComponentwiseAtDepthSix_IsExact() =>
        Assert.Equal(19_600, DistinctInstances.Count(Samples.AppendixBAt(6, Composition.Componentwise)));

    [Fact]
    public void Count_BeyondTheBudgetWithoutAProof_IsUnknown() => Assert.Null(DistinctInstances.Count(Samples.AppendixBAt(6)));

    [Fact]
    public void Flatten_ToAsManyFacesAsAllowed_WritesThem()
    {
        var fractal = Fractal.Of(new Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2])).Apply([Samples.Move(1, 0, 0), Samples.Move(0, 5, 0)]);
        Assert.Equal(2, FractalGenerator.Flatten(fractal, 2).FaceCount);
        Assert.Throws<FractalLimitException>(() => FractalGenerator.Flatten(fractal, 1));
    }

    [Theory]
    [InlineData(1e3)]
    [InlineData(1e15)]
    [InlineData(1e100)]
    public void Instances_OfAMeshWithAFarVertexThatNoFaceUses_AreToldApart(double far)
    {
        var mesh = new Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0, far, 0, 0], [0, 1, 2]);
        var fractal = Fractal.Of(mesh).Apply([Transformation.Identity, Transformation.At(new(0.3, 0, 0))]);
        Assert.Equal(2, DistinctInstances.Count(fractal));
        Assert.Equal(2, FractalGenerator.Flatten(fractal, 100).FaceCount);
        Assert.Equal(2, Collider.For(fractal).FindAllWithin(Vector.Zero, 10, 100).Length);
    }

    [Fact]
    public void Count_OfTheInfinite_IsUnknown() =>
        Assert.Null(DistinctInstances.Count(
            Samples.Repeated(null, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(5, 0, 0, 0.5))));

    [Fact]
    public void Count_OfInstancesSideBySide_IsProvedAtAnyDepth()
    {
        var cube = new Mesh([0, 0, 0, 1, 1, 1, 0, 1, 0], [0, 1, 2]);
        var maps = Enumerable.Range(0, 8).Select(i => Samples.MoveAndScale((i & 1) / 2.0, (i / 2 & 1) / 2.0, i / 4 / 2.0, 0.25));
        var fractal = new Fractal(Samples.Repeated(100, [.. maps]).Description, cube);
        Assert.True(DistinctInstances.AreProvedDistinct(fractal));
        Assert.Equal(BigInteger.Pow(8, 100), DistinctInstances.Count(fractal));
    }

    [Fact]
    public void AreProvedDistinct_WithTheIdentityInTheSet_ProvesNothing() =>
        Assert.False(DistinctInstances.AreProvedDistinct(Samples.Repeated(3, Transformation.Identity, Samples.Move(1, 0, 0))));

    [Fact]
    public void Count_OfASmallFractal_IsTheNaiveNumber() => Seeded.Run(200, random =>
    {
        var fractal = RandomFractals.CreateAny(random);
        var expected = NaiveFractal.Distinct(NaiveFractal.Chains(fractal.Description), 1e-12).Count;
        Assert.Equal(expected, DistinctInstances.Count(fractal));
        Assert.True(!DistinctInstances.AreProvedDistinct(fractal) || fractal.InstanceCount == expected, "a false proof");
    });

    // Some of these have equal or overlapping children, so that nothing can be proved.
    [Fact]
    public void AreProvedDistinct_OfRandomQuarterTurns_IsNeverWrong() => Seeded.RunMost(500, random =>
    {
        var set = Enumerable.Range(0, random.Next(1, 5)).Select(_ => new Transformation(
            new(random.Next(-2, 3), random.Next(-2, 3), random.Next(-2, 3)),
            new(90 * random.Next(4), 90 * random.Next(4), 0),
            (random.Next(2) == 0 ? 0.5 : -0.5) * Vector.One));
        var fractal = Samples.Repeated(random.Next(1, 4), [.. set]);
        var expected = NaiveFractal.Distinct(NaiveFractal.Chains(fractal.Description), 1e-9).Count;
        var isProved = DistinctInstances.AreProvedDistinct(fractal);
        Assert.True(!isProved || fractal.InstanceCount == expected, $"{fractal.InstanceCount} chains, {expected} distinct");
        return isProved;
    }, minShare: 0.6);

    [Fact]
    public void Count_OfOneInstance_IsOne() => Assert.Equal(1, DistinctInstances.Count(Samples.Repeated(0, Samples.Move(1, 0, 0))));

    [Fact]
    public void Count_OfAMillionIdentities_IsOne() =>
        Assert.Equal(1, DistinctInstances.Count(Samples.Repeated(1_000_000, Transformation.Identity, Transformation.Identity)));

    [Fact]
    public void Count_OfAStaircase_IsOneMoreThanItsSteps()
    {
        // 2⁴⁸ chains, which differ only by how often they go up.
        var staircase = Samples.Repeated(48, Transformation.Identity, Samples.Move(0.3, 1, 0));
        Assert.Equal(BigInteger.Pow(2, 48), staircase.InstanceCount);
        Assert.Equal(49, DistinctInstances.Count(staircase));
        Assert.Equal(49, FractalGenerator.ExpandDistinct(staircase, 1000).Length);
    }

    [Fact]
    [Trait("Category", "Soak")]
    public void Count_OfALongStaircase_EndsAtTheLimitOfProducts() =>
        Assert.Null(DistinctInstances.Count(Samples.Repeated(1_000_000, Transformation.Identity, Samples.Move(0.3, 1, 0))));

    [Fact]
    public void ExpandDistinct_BeyondTheLimitOfDistinctInstances_NamesTheLimit()
    {
        var staircase = Samples.Repeated(48, Transformation.Identity, Samples.Move(0.3, 1, 0));
        Assert.Equal(49, FractalGenerator.ExpandDistinct(staircase, 49).Length);
        var error = Assert.Throws<FractalLimitException>(() => FractalGenerator.ExpandDistinct(staircase, 48));
        Assert.Contains("more than the limit of 48", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void TryExpandLevels_OfASmallFractal_EqualsTheExpansionOfAllChainsToTheBit() => Seeded.Run(100, CheckLevels);

    [Fact]
    [Trait("Category", "Soak")]
    public void TryExpandLevels_OfManySmallFractals_EqualsTheExpansionOfAllChainsToTheBit() => Seeded.Run(3000, CheckLevels);

    private static void CheckLevels(Random random)
    {
        // One in two with maps that commute, so that many chains are equal up to rounding.
        var fractal = random.Next(2) == 0
            ? RandomFractals.CreateAny(random)
            : Samples.Repeated(random.Next(1, 7), [.. Enumerable.Range(0, random.Next(1, 4)).Select(_ => RandomMove())]);
        var expected = FractalGenerator.Expand(fractal, 1_000_000);
        Assert.Equal([.. expected], FractalGenerator.TryExpandLevels(fractal, 1_000_000, long.MaxValue)!.Value.ToArray());
        NaiveFractal.AssertSameMaps(
            NaiveFractal.Distinct(NaiveFractal.Chains(fractal.Description), 1e-12),
            FractalGenerator.TryExpandLevels(fractal, expected.Length, long.MaxValue)!.Value, 1e-12);
        Assert.Null(FractalGenerator.TryExpandLevels(fractal, expected.Length - 1, long.MaxValue));

        Transformation RandomMove() => Samples.Move(0.1 * random.Next(-3, 4), 0.7 * random.Next(2), 0);
    }

    // Among images that touch, overlap a little or entirely, or are flat. Most sets of many have two that overlap.
    [Fact]
    public void HasDisjointImages_OfAnySet_IsTheVerdictOfAllPairs() => Seeded.Run(3000, random =>
    {
        var box = new BoundingBox(
            random.Vector(1),
            random.Next(4) == 0 ? new(1.5, 1.5, random.Next(2)) : new(random.Between(1, 2), random.Between(1, 2), random.Between(1, 2)));
        box = random.Next(4) == 0 ? box with { Maximum = box.Maximum with { Z = box.Minimum.Z } } : box;
        var cells = Enumerable.Range(0, 512).OrderBy(_ => random.Next()).Take(random.Next(1, 60)).ToArray();
        var isLattice = random.Next(4) > 0;
        var set = new TransformationSet([.. cells.Select(cell => new Transformation(
            isLattice
                ? new Vector(cell & 7, (cell >> 3) & 7, cell >> 6).Stretch(box.Size + ((random.Next(20) == 0 ? 1e-9 : 0) * random.Vector()))
                : random.Vector(20),
            random.Next(2) == 0 ? Vector.Zero : new(90 * random.Next(4), 90 * random.Next(4), 0),
            random.Between(0.2, 1) * (random.Next(8) == 0 ? new Vector(1, -1, 0) : Vector.One)))]);
        var thinnest = random.Next(2) == 0 ? Vector.Zero : random.Vector().Absolute().Stretch(box.Size);
        var images = set.Maps.Select(box.Transform).ToArray();
        // Boxes of size 1e-9 and more, around coordinates up to 32: rounding is far below 1e-11, and nothing overlaps by 1e-12 to 1e-10.
        var expected = Enumerable.Range(0, images.Length).All(i => Enumerable.Range(0, i).All(j => AreApart(images[i], images[j])));
        Assert.Equal(expected, DistinctInstances.HasDisjointImages(set, box, thinnest));

        bool AreApart(BoundingBox box1, BoundingBox box2)
        {
            var overlap = Vector.Min(box1.Maximum, box2.Maximum) - Vector.Max(box1.Minimum, box2.Minimum);
            return IsApart(overlap.X, thinnest.X) || IsApart(overlap.Y, thinnest.Y) || IsApart(overlap.Z, thinnest.Z);
        }

        static bool IsApart(double overlap, double thickness) => overlap < (thickness > 1e-11 ? 1e-11 : -1e-11);
    });

    // Each was once proved distinct: what is made twice lies where two images touch, or in an overlap that was taken for rounding.
    [Theory]
    [InlineData(0, 1)]
    [InlineData(1e-10, 1)]
    [InlineData(1e-15, 1)]
    [InlineData(0, 0.5)]
    [InlineData(1e-12, 0.5)]
    public void Count_OfMapsThatCommute_CountsWhatTheyMakeTwiceOnce(double thickness, double scale)
    {
        var mesh = Samples.Tetrahedron.Transform(v => v.Stretch(new(1, 1, thickness)));
        var up = Samples.MoveAndScale(0, 0, 1, scale);
        var fractal = new Fractal(
            new([
                TransformationSet.Of([Transformation.Identity, up, Samples.Move(7, 0, 0)]),
                TransformationSet.Of([up, Transformation.Identity]),
            ]),
            mesh);
        Assert.Equal(5, DistinctInstances.Count(fractal));
        Assert.Equal(5, FractalGenerator.Expand(fractal, 100).Length);
        var hits = new ExactFractalCollider(fractal).FindAllWithin(Vector.Zero, 100, 100);
        Assert.Equal(5 * mesh.FaceCount, hits.Length);
    }

    // A lost decimal point: one of many maps throws far away. What is near must stay, and be told apart in time.
    [Theory]
    [InlineData(1e6)]
    [InlineData(1e9)]
    [InlineData(1e14)]
    public void Expand_BesideAnOutlier_KeepsAllThatIsNear(double far)
    {
        var maps = Enumerable.Range(0, 20).Select(i => Samples.MoveAndScale(i % 3, i / 3 % 3, i / 9, 0.3))
            .Append(Samples.MoveAndScale(far, 0, 0, 0.3)).ToArray();
        var fractal = new Fractal(Samples.Repeated(3, maps).Description, Samples.Tetrahedron);
        var chains = NaiveFractal.Chains(fractal.Description);
        var near = chains.Count(chain => Math.Abs(chain[0][3]) < 100);
        var instances = FractalGenerator.Expand(fractal, 100_000);
        Assert.Equal(20 * 20 * 20, near);
        Assert.Equal(near, instances.Distinct().Count(map => Math.Abs(map.Translation.X) < 100));
        // Far away, what differs by less than some last places of the coordinates is the same.
        Assert.True(far > 1e13 || instances.Length == chains.Count, $"{instances.Length} of {chains.Count}");
        var position = new Vector(1.3, 0.4, 0.7);
        Assert.Equal(
            new ExactFractalCollider(fractal).FindClosest(position).Distance,
            new SimpleCollider(FractalGenerator.Flatten(fractal, 1_000_000)).FindClosest(position).Distance,
            1e-12);
    }

    [Fact]
    public void Count_BesideAnOutlierAtDepthForty_EndsSoon()
    {
        var maps = Enumerable.Range(0, 20).Select(i => Samples.MoveAndScale(i % 3, i / 3 % 3, i / 9, 1 / 3.0))
            .Append(Samples.MoveAndScale(1e9, 0, 0, 1 / 3.0)).ToArray();
        Assert.Null(ProcessorTime.RunWithin(20, () => DistinctInstances.Count(Samples.Repeated(40, maps))));
    }

    // All chains, compared pair by pair, by where they take the vertices. Some twenty roundings are far below the tolerance, and distinct
    // images differ by .0125 at 4e11, or by more than a hundredth near the origin.
    [Fact]
    public void Expand_OfAnyFractal_HasEachImageOnce() => Seeded.Run(150, random =>
    {
        var isLattice = random.Next(2) == 0;
        var maps = Enumerable.Range(0, random.Next(2, 5)).Select(_ => isLattice
            ? Samples.MoveAndScale(
                0.1 * random.Next(-3, 4), 0.7 * random.Next(2), random.Next(6) == 0 ? 1e11 : 0, random.Next(3) == 0 ? 0.5 : 1)
            : random.Next(5) == 0 ? Transformation.Identity : random.Transformation()).ToArray();
        var mesh = Samples.Tetrahedron.Transform(v => v.Stretch(new(1, random.Next(2), 1)) + (random.Next(3) * 500 * Vector.I));
        var fractal = new Fractal(Samples.Repeated(random.Next(1, 5), maps).Description, mesh);
        var corners = NaiveFractal.Vertices(mesh).ToArray();
        var images = NaiveFractal.Chains(fractal.Description)
            .Select(chain => corners.Select(corner => NaiveFractal.Apply(chain, corner)).ToArray()).ToList();
        var distinct = new List<Vector[]>();
        foreach (var image in images)
        {
            var magnitude = image.Max(corner => corner.MaxAbsComponent());
            var tolerance = 5e-15 * (1 + magnitude);
            if (!distinct.Any(other => image.Zip(other).All(pair => (pair.First - pair.Second).MaxAbsComponent() <= tolerance)))
            {
                distinct.Add(image);
            }
        }

        Assert.Equal(distinct.Count, FractalGenerator.Expand(fractal, 1_000_000).Length);
    });

    [Fact]
    public void Count_OfManyMaps_ComparesFewPairs()
    {
        // Cubes of a lattice that touch. To compare all pairs would take half a minute.
        const int Count = 60_000;
        var cube = new Mesh([0, 0, 0, 1, 1, 1, 0, 1, 0], [0, 1, 2]);
        var maps = Enumerable.Range(0, Count)
            .Select(i => Samples.MoveAndScale(i % 64 / 64.0, i / 64 % 64 / 64.0, i / 4096 / 64.0, 1 / 64.0));
        var fractal = new Fractal(Samples.Repeated(1, [.. maps]).Description, cube);
        Assert.True(DistinctInstances.AreProvedDistinct(fractal));
        Assert.Equal(Count, DistinctInstances.Count(fractal));
    }
}
