using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks.Approximation;

public class UnseenFractalsTests
{
    private const int Target = 1500;

    public static TheoryData<int> Kinds => [.. Enum.GetValues<FractalKind>().Select(kind => (int)kind)];

    public static TheoryData<int> Bases => [.. Enum.GetValues<BaseKind>().Select(kind => (int)kind)];

    [Theory]
    [MemberData(nameof(Kinds))]
    public void Create_OfOneSeed_IsTheSameInAnyCultureAndOrder(int kind)
    {
        var first = UnseenFractals.Create((FractalKind)kind, 3, Target);
        UnseenFractals.Create((FractalKind)kind, 4, Target);
        var again = InCulture.Run("de-DE", () => UnseenFractals.Create((FractalKind)kind, 3, Target));
        Assert.Equal((first.Clean, first.Mesh, first.Description), (again.Clean, again.Mesh, again.Description));
        Assert.Equal(first.Generators.AsEnumerable(), again.Generators);
        Assert.NotEqual(first.Clean, UnseenFractals.Create((FractalKind)kind, 4, Target).Clean);
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void Create_OfAKind_HasElementsThatAreImagesOfBasesAndNearTheTarget(int kind) => Assert.All(UnseenOracle.Seeds, seed =>
    {
        var input = UnseenFractals.Create((FractalKind)kind, seed, Target);
        Assert.InRange(input.Clean.FaceCount, Target / 1.7, Target * 1.7);
        Assert.InRange(input.ElementCount, 12, int.MaxValue);
        // 2 to 8 maps a set, of which there are two at most, or a row, circle or helix for each of three products.
        Assert.InRange(input.Generators.Length, 1, 8);
        var (faces, vertices) = (0, 0);
        foreach (var element in input.Elements)
        {
            Assert.Equal((faces, input.Bases[element.Base].FaceCount), (element.FirstFace, element.FaceCount));
            var corners = UnseenOracle.VerticesOf(input, element);
            // Vertices are welded within an element, and no two elements share one.
            Assert.Equal(input.Bases[element.Base].VertexCount, corners.Length);
            Assert.Equal(vertices, corners.Min());
            (faces, vertices) = (faces + element.FaceCount, vertices + corners.Length);
        }

        Assert.Equal((input.Clean.FaceCount, input.Clean.VertexCount), (faces, vertices));
        Assert.InRange(input.SmallestElement / input.Clean.Bounds.Diagonal, 0.0003, 1);
    });

    [Theory]
    [InlineData(FractalKind.TreeWithIdentity)]
    [InlineData(FractalKind.Leaves)]
    [InlineData(FractalKind.SkewedTree)]
    [InlineData(FractalKind.SkewedLeaves)]
    internal void Create_OfWords_HasAnElementForEachThatDoesNotCoincide(FractalKind kind) => Assert.All(UnseenOracle.Seeds, seed =>
    {
        var input = UnseenFractals.Create(kind, seed, Target);
        var least = kind is FractalKind.Leaves or FractalKind.SkewedLeaves ? input.Depth : 0;
        var words = Enumerable.Range(least, input.Depth + 1 - least).Sum(length => (int)Math.Pow(input.Generators.Length, length));
        Assert.Equal(words * input.Bases.Length, input.ElementCount + input.CoincidentElements);
        // Generators and bases make the model: products of up to nine maps in another frame, with roundings of these.
        var expansion = UnseenOracle.ExpandWords(input, least, input.Depth);
        Assert.True(Grader.Compare(expansion, input, 1e-11 * input.Clean.Bounds.Diagonal).IsFound);
    });

    [Fact]
    public void Create_WhereWordsCoincide_KeepsOneOfThem()
    {
        // Cells of a grid that overlap.
        var inputs = Enumerable.Range(0, 20).Select(seed => UnseenFractals.Create(FractalKind.EqualMaps, seed, 600))
            .Where(input => input.CoincidentElements > 0).ToArray();
        Assert.NotEmpty(inputs);
        Assert.All(inputs, input =>
        {
            var tolerance = 1e-9 * input.Clean.Bounds.Diagonal;
            var corners = input.Elements
                .Select(element => UnseenOracle.VerticesOf(input, element).Select(input.Clean.Vertex).ToArray()).ToArray();
            for (var i = 0; i < corners.Length; i++)
            {
                Assert.DoesNotContain(corners[(i + 1)..], other => corners[i].Length == other.Length
                    && other.All(position => corners[i].Any(corner => (corner - position).Length() <= tolerance)));
            }
        });
    }

    [Fact]
    public void Create_OfEqualMaps_HasMapsThatDifferByTranslations() => Assert.All(UnseenOracle.Seeds, seed =>
    {
        var maps = UnseenFractals.Create(FractalKind.EqualMaps, seed, Target).Generators.Select(generator => generator.Map).ToArray();
        // The frame of the model turns all of them by the same matrices: rounding of two products.
        Assert.All(maps, map => Assert.InRange(
            MapDrawer.Difference(map with { Translation = Vector.Zero }, maps[0] with { Translation = Vector.Zero }), 0, 1e-14));
    });

    [Fact]
    public void Create_OfSkewedKinds_HasMapsThatAreNoSimilarities() => Assert.All(
        UnseenOracle.Seeds,
        seed => Assert.Contains(UnseenFractals.Create(FractalKind.SkewedTree, seed, Target).Generators, generator =>
        {
            var (x, y, z) = generator.Map.Linear;
            return Math.Abs(x.Length() - y.Length()) > 1e-9 || Math.Abs(x.Length() - z.Length()) > 1e-9
                || Math.Abs(Vector.Dot(x, y)) > 1e-9 || generator.Map.Linear.Determinant() < 0;
        }));

    [Fact]
    public void Create_OfAllSeeds_HasAllBases()
    {
        var names = Enumerable.Range(0, UnseenBases.Kinds.Length)
            .Select(seed => UnseenFractals.Create(FractalKind.Leaves, seed, 3100).Description.Split(", on ")[1].Split(';')[0]);
        Assert.Equal(UnseenBases.Kinds.Select(kind => kind.ToString()).Order(StringComparer.Ordinal),
            names.Distinct().Order(StringComparer.Ordinal));
    }

    [Theory]
    [MemberData(nameof(Bases))]
    public void Bases_OfAKind_AreConnectedAndHaveNoFlatFaces(int kind) => Assert.All(UnseenOracle.Seeds, seed =>
    {
        var parts = UnseenBases.Create((BaseKind)kind, new("bases", seed));
        Assert.Equal((BaseKind)kind switch { BaseKind.TwoParts => 2, BaseKind.ThreeParts => 3, _ => 1 }, parts.Length);
        var isOpen = (BaseKind)kind is BaseKind.Dome or BaseKind.Gutter or BaseKind.Leaf or BaseKind.Plate or BaseKind.Triangle;
        Assert.All(parts, part =>
        {
            var (border, doubled) = UnseenOracle.CountBadEdges(part);
            Assert.Equal((1, 0, isOpen), (UnseenOracle.CountComponents(part), doubled, border > 0));
            Assert.InRange(MeshTools.SmallestAltitude(part) / part.Bounds.Diagonal, 0.01, 1);
            Assert.True(isOpen || MeshTools.SignedVolume(part) > 0);
        });
    });

    [Fact]
    public void Create_OfFewFaces_IsRefused() =>
        Assert.Throws<ArgumentOutOfRangeException>(() => UnseenFractals.Create(FractalKind.Leaves, 0, 99));
}
