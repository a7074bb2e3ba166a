using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Benchmarks.Approximation;

public class UnseenShapesTests
{
    private const int Repeats = 32;

    public static TheoryData<int> RepeatKinds => [.. Enum.GetValues<RepeatKind>().Select(kind => (int)kind)];

    public static TheoryData<int> OrganicKinds => [.. Enum.GetValues<OrganicKind>().Select(kind => (int)kind)];

    public static TheoryData<int> BadKinds => [.. Enum.GetValues<BadInputKind>().Select(kind => (int)kind)];

    [Theory]
    [MemberData(nameof(RepeatKinds))]
    public void RepeatingModels_OfAKind_AreOneComponentOfUnits(int kind) => Assert.All(UnseenOracle.Seeds[..3], seed =>
    {
        var input = RepeatingModels.Create((RepeatKind)kind, seed, Repeats);
        Assert.Equal(input.Mesh, RepeatingModels.Create((RepeatKind)kind, seed, Repeats).Mesh);
        Assert.NotEqual(input.Clean, RepeatingModels.Create((RepeatKind)kind, seed + 1, Repeats).Clean);
        Assert.InRange(input.ElementCount, Repeats, int.MaxValue);
        Assert.Equal(input.Clean.FaceCount, input.Elements.Sum(element => element.FaceCount));
        Assert.Equal((RepeatKind)kind == RepeatKind.Links ? input.ElementCount : 1, UnseenOracle.CountComponents(input.Clean));
        Assert.Equal(0, UnseenOracle.CountBadEdges(input.Clean).Doubled);
        Assert.True(MeshTools.SignedVolume(input.Clean) > 0);
        Assert.InRange(MeshTools.SmallestAltitude(input.Clean) / input.SmallestElement, 1e-3, 1);
        Assert.True(Grader.Compare(input.Mesh, input, 0).IsFound);
    });

    [Theory]
    [InlineData(RepeatKind.Stairs)]
    [InlineData(RepeatKind.SpiralStairs)]
    [InlineData(RepeatKind.Bolt)]
    [InlineData(RepeatKind.Gear)]
    [InlineData(RepeatKind.Links)]
    internal void RepeatingModels_AlongAStep_AreThePowersOfIt(RepeatKind kind)
    {
        var input = RepeatingModels.Create(kind, 2, Repeats);
        var step = Assert.Single(input.Generators).Map;
        var positions = Enumerable.Range(0, input.ElementCount)
            .SelectMany(i => MeshTools.Positions(MeshTools.Move(input.Bases[0], step.Power(i)))).ToArray();
        var indices = Enumerable.Range(0, input.ElementCount)
            .SelectMany(i => input.Bases[0].VertexIndices.Select(vertex => (i * input.Bases[0].VertexCount) + vertex)).ToArray();
        Assert.True(Grader.Compare(MeshTools.Create(positions, indices), input, 1e-11 * input.Clean.Bounds.Diagonal).IsFound);
    }

    [Theory]
    [InlineData(RepeatKind.BrickWall)]
    [InlineData(RepeatKind.Grating)]
    [InlineData(RepeatKind.Gear)]
    [InlineData(RepeatKind.Fence)]
    [InlineData(RepeatKind.Links)]
    internal void RepeatingModels_OfSolids_AreClosed(RepeatKind kind) =>
        Assert.Equal((0, 0), UnseenOracle.CountBadEdges(RepeatingModels.Create(kind, 1, Repeats).Clean));

    [Fact]
    public void RepeatingModels_OfFewRepeats_AreRefused() =>
        Assert.Throws<ArgumentOutOfRangeException>(() => RepeatingModels.Create(RepeatKind.Gear, 0, 29));

    [Theory]
    [MemberData(nameof(OrganicKinds))]
    public void OrganicModels_OfAKind_AreConnectedAndAsLargeAsAsked(int kind)
    {
        var input = OrganicModels.Create((OrganicKind)kind, 1, 2000);
        Assert.Equal(input.Mesh, OrganicModels.Create((OrganicKind)kind, 1, 2000).Mesh);
        Assert.NotEqual(input.Clean, OrganicModels.Create((OrganicKind)kind, 2, 2000).Clean);
        Assert.InRange(input.Clean.FaceCount, 1900, 2100);
        Assert.Equal((1, 0), (UnseenOracle.CountComponents(input.Clean), UnseenOracle.CountBadEdges(input.Clean).Doubled));
        Assert.True((OrganicKind)kind == OrganicKind.Terrain || UnseenOracle.CountBadEdges(input.Clean).Border == 0);
        Assert.Equal((1, true), (input.ElementCount, input.Generators.IsEmpty));
        Assert.True(Grader.Compare(input.Mesh, input, 0).IsFound);
    }

    [Theory]
    [MemberData(nameof(BadKinds))]
    public void BadInputs_OfAKind_AreTheSameMeshesAgain(int kind)
    {
        var mesh = BadInputs.Create((BadInputKind)kind, 1, 5000);
        Assert.Equal(mesh, BadInputs.Create((BadInputKind)kind, 1, 5000));
        Assert.True((BadInputKind)kind is BadInputKind.Empty or BadInputKind.OnePoint
            || !mesh.Equals(BadInputs.Create((BadInputKind)kind, 2, 5000)));
    }

    [Fact]
    public void BadInputs_AreAsBadAsTheirNames()
    {
        Assert.Equal(0, Make(BadInputKind.Empty).VertexCount);
        Assert.Equal((100, 0), (Make(BadInputKind.NoFaces).VertexCount, Make(BadInputKind.NoFaces).FaceCount));
        Assert.Equal(1, Make(BadInputKind.OneTriangle).FaceCount);
        Assert.Equal(0, Make(BadInputKind.AllDegenerate).SurfaceArea());
        Assert.Equal((5000, 15000), (Make(BadInputKind.SeparateTriangles).FaceCount, Make(BadInputKind.SeparateTriangles).VertexCount));
        Assert.InRange(Make(BadInputKind.FarVertex).Bounds.Diagonal, 0.5e14, 2e14);
        // Twenty times the same vertices, in a random order.
        Assert.All(MeshTools.Positions(Make(BadInputKind.CoincidentDuplicates)).CountBy(position => position),
            position => Assert.Equal(0, position.Value % 20));
        Assert.InRange(MeshTools.SmallestAltitude(Make(BadInputKind.Slivers)), 0, 1e-6);
        var plane = MeshTools.Positions(Make(BadInputKind.OnePlane));
        var normal = Vector.Cross(plane[1] - plane[0], plane[2] - plane[0]).UnitVector();
        // Rounding of the normal of a triangle of size 0.1.
        Assert.All(plane, position => Assert.InRange(Vector.Dot(position, normal), -1e-12, 1e-12));
        // Rounding of points on a line through the origin.
        Assert.InRange(Make(BadInputKind.OneLine).SurfaceArea(), 0, 1e-10);
        Assert.Equal(Vector.Zero, Make(BadInputKind.OnePoint).Bounds.Size);
        Assert.Equal(1e-12, Make(BadInputKind.TinyAndFar).Bounds.Diagonal, 1e-14);
        Assert.Equal(1e140, Make(BadInputKind.Huge).Bounds.Diagonal, 1e130);
        Assert.Equal(BadInputs.DefaultFaces, 1_000_000);

        static Core.Geometry.Mesh Make(BadInputKind kind) => BadInputs.Create(kind, 1, 5000);
    }

    [Fact]
    public void UnseenCases_OfSomeSeeds_AreAllKindsWithAllDamages()
    {
        var cases = UnseenCases.Fractals([1, 2], 500, Damage.All).ToArray();
        Assert.Equal(9 * 2 * Damage.All.Length, cases.Select(unseen => unseen.Name).Distinct().Count());
        Assert.Equal(10 * 2, UnseenCases.Repeating([1, 2], 30, [Damage.None]).Count());
        Assert.Equal(5 * 2, UnseenCases.Organic([1, 2], 500).Count());
        var made = cases[0].Create();
        Assert.Equal(made!.Mesh, cases[0].Create()!.Mesh);
        // Leaves of a few faces are not decimated.
        Assert.Contains(cases, unseen => unseen.Create() is null);
    }

    [Fact]
    public void SeededRandom_OfAPurposeAndASeed_IsAsItWas()
    {
        var random = new SeededRandom("purpose", 1);
        Assert.NotEqual(random.Fraction(), new SeededRandom("purpose", 2).Fraction());
        Assert.NotEqual(new SeededRandom("other", 1).Fraction(), new SeededRandom("purpose", 1).Fraction());
        var numbers = Enumerable.Range(0, 100_000).Select(_ => random.Index(10)).CountBy(number => number).ToArray();
        // Each has 10,000 on average, with a deviation of 95.
        Assert.All(numbers, number => Assert.InRange(number.Value, 9_500, 10_500));
        Assert.Equal(Enumerable.Range(0, 50), random.Permutation(50).Order());
    }
}
