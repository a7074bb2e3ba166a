using System.Collections.Immutable;
using System.Text;
using FractalEngine.Core;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Wavefront.Writing;
using FractalEngine.Tests.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Wavefront.Writing;

public class ObjMeshWriterTests
{
    private static string Write(Mesh mesh, string name = "")
    {
        using var stream = new MemoryStream();
        ObjMeshWriter.Write(mesh, stream, name);
        return Encoding.UTF8.GetString(stream.ToArray());
    }

    private static void AssertReadsBack(Mesh mesh)
    {
        var parsed = Samples.ParseObj(Write(mesh));
        Assert.Empty(parsed.Warnings);
        Assert.Equal(mesh, parsed.Mesh);
    }

    [Fact]
    public void Write_OfATriangle_IsWhatAPersonWrites() => Assert.Equal("""
        # Mesh count: 1
        v 0 0 0
        v 1 0 0
        v 0 1 0
        f 1 2 3

        """, Write(Samples.Triangle));

    [Fact]
    public void Write_OfEverything_StatesWhatChanges() => Assert.Equal("""
        # Mesh count: 3
        mtllib some materials.mtl
        vt 0 0.5
        v 0 0 0
        v 1 0 0
        v 0 1 -0
        vn 0 0 7
        o thing
        g left hand
        usemtl red
        s 1
        f 1/1/1 2 3//1
        g
        s 0
        f 3 2/1 1
        f 1 1 1

        """.ReplaceLineEndings("\n").Replace("g\ns 0", "g \ns 0", StringComparison.Ordinal), Write(Full()));

    [Fact]
    public void Write_OfEverything_ReadsBackEqual() => AssertReadsBack(Full());

    [Fact]
    public void Write_OfRandomMeshes_ReadsBackEqual() => Seeded.Run(500, random =>
    {
        var vertexCount = random.Next(1, 20);
        var corners = 3 * random.Next(0, 12);
        var mesh = new Mesh(Numbers(random, 3 * vertexCount), Indices(random, corners, 0, vertexCount));
        if (random.Next(2) == 0)
        {
            mesh = mesh.WithColours(Numbers(random, 3 * vertexCount));
        }

        if (corners > 0 && random.Next(2) == 0)
        {
            var count = random.Next(1, 5);
            mesh = mesh.WithTextureCoordinates(Numbers(random, 2 * count), UsedIndices(random, corners, count));
        }

        if (corners > 0 && random.Next(2) == 0)
        {
            var count = random.Next(1, 5);
            mesh = mesh.WithNormals(Numbers(random, 3 * count), UsedIndices(random, corners, count));
        }

        AssertReadsBack(random.Next(2) == 0 ? mesh : mesh.WithGroups([.. Groups(random, corners / 3)], ["a.mtl", "b c.mtl"]));
    });

    [Theory]
    [MemberData(nameof(AssetTests.Meshes), MemberType = typeof(AssetTests))]
    public void Write_OfAnAssetMesh_ReadsBackEqual(string file) =>
        AssertReadsBack(AssetLoader.Load(Repository.Full(file)).Scene.Objects[0].Model.Mesh);

    [Fact]
    public void Write_OfTheEmptyMesh_ReadsBackEqual()
    {
        AssertReadsBack(Mesh.Empty);
        AssertReadsBack(Mesh.Empty.WithGroups([], ["a.mtl"]));
        AssertReadsBack(new([1, 2, 3], []));
    }

    [Fact]
    public void Write_WithAName_NamesFacesWithoutAnObject()
    {
        var parsed = Samples.ParseObj(Write(Samples.Triangle.WithGroups([new(0, 1, "", "g", "", 0)], []), "thing")).Mesh;
        Assert.Equal([new(0, 1, "thing", "g", "", 0)], parsed.Groups.ToArray());
        Assert.StartsWith("# Mesh count: 1\no thing\n", Write(Samples.Triangle, "thing"), StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("two\nlines")]
    [InlineData("two\rlines")]
    [InlineData("with a #comment")]
    [InlineData("with a\t#comment")]
    [InlineData("#comment")]
    [InlineData(" blank")]
    [InlineData("blank\u00A0")]
    [InlineData("joined\\")]
    [InlineData("a\0b")]
    public void Write_OfANameThatWouldNotReadBack_IsRefused(string name)
    {
        Fails("has a line break", Samples.Triangle.WithGroups([new(0, 1, name, "", "", 0)], []));
        Fails("has a line break", Samples.Triangle.WithGroups([new(0, 1, "", name, "", 0)], []));
        Fails("has a line break", Samples.Triangle.WithGroups([new(0, 1, "", "", name, 0)], []));
        Fails("has a line break", Samples.Triangle.WithGroups([], [name]));
        Assert.Throws<FractalEngineException>(() => Write(Samples.Triangle, name));
    }

    [Fact]
    public void Write_OfANameThatUtf8CannotExpress_IsRefused() =>
        Fails("has a line break", Samples.Triangle.WithGroups([new(0, 1, "\uDE00\uD83D", "", "", 0)], []));

    [Theory]
    [InlineData("a b")]
    [InlineData("a#b")]
    [InlineData("größer, 2 \uD83D\uDE00")]
    [InlineData("\\a/b\"'")]
    public void Write_OfUnusualNames_ReadsBackEqual(string name) =>
        AssertReadsBack(Samples.Triangle.WithGroups([new(0, 1, name, name, name, 7)], [name]));

    [Fact]
    public void Write_OfWhatTheFormatCannotHold_IsRefused()
    {
        Fails("a texture coordinate is not finite", Samples.Triangle.WithTextureCoordinates([1, 1.0 / 0], [0, 0, 0]));
        Fails("a component of a colour is not finite", Samples.Triangle.WithColours([0, 0, 0, 0, 0, 0, 0, 0, double.NaN]));
        Fails("a component of a normal is not finite", Samples.Triangle.WithNormals([1, -1.0 / 0, 0], [0, 0, 0]));
        Fails("no face uses the texture coordinates", Samples.Triangle.WithTextureCoordinates([1, 1], [-1, -1, -1]));
        Fails("no face uses the normals", Samples.Triangle.WithNormals([1, 1, 1], [-1, -1, -1]));
        Fails("its groups don't cover all faces", Full().WithGroups([new(0, 2, "", "a", "", 0)], []));
        Fails("its groups are empty, or not in the order of the faces", Full().WithGroups([new(1, 2, "", "a", "", 0)], []));
        Fails("its groups are empty, or not in the order of the faces", Full().WithGroups([new(0, 0, "", "a", "", 0)], []));
        Fails("two neighbouring groups have equal names", Full().WithGroups([new(0, 1, "", "a", "", 0), new(1, 2, "", "a", "", 0)], []));
        Fails("the number of a smoothing group is negative", Samples.Triangle.WithGroups([new(0, 1, "", "", "", -1)], []));
        Fails("the name of a material file is empty", Samples.Triangle.WithGroups([], [""]));
        Fails("a material file is named twice", Samples.Triangle.WithGroups([], ["a.mtl", "a.mtl"]));
    }

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void Write_InAnyCulture_IsTheSameText(string culture) =>
        Assert.Equal(Write(Full()), InCulture.Run(culture, () => Write(Full())));

    private static Mesh Full() => new Mesh([0, 0, 0, 1, 0, 0, 0, 1, -0.0], [0, 1, 2, 2, 1, 0, 0, 0, 0])
        .WithTextureCoordinates([0, 0.5], [0, -1, -1, -1, 0, -1, -1, -1, -1])
        .WithNormals([0, 0, 7], [0, -1, 0, -1, -1, -1, -1, -1, -1])
        .WithGroups([new(0, 1, "thing", "left hand", "red", 1), new(1, 2, "thing", "", "red", 0)], ["some materials.mtl"]);

    private static void Fails(string fault, Mesh mesh)
    {
        using var stream = new MemoryStream();
        var error = Assert.Throws<FractalEngineException>(() => ObjMeshWriter.Write(mesh, stream));
        Assert.StartsWith("the mesh can't be written as an OBJ file: ", error.Message, StringComparison.Ordinal);
        Assert.Contains(fault, error.Message, StringComparison.Ordinal);
        Assert.DoesNotContain(error.Message, char.IsControl);
        Assert.Equal(0, stream.Length);
    }

    private static ImmutableArray<double> Numbers(Random random, int count) =>
    [
        .. Enumerable.Range(0, count).Select(_ => BitConverter.Int64BitsToDouble(random.NextInt64(long.MinValue, long.MaxValue)))
            .Select(number => double.IsFinite(number) ? number : -0.0),
    ];

    private static ImmutableArray<int> Indices(Random random, int count, int min, int max) =>
        [.. Enumerable.Range(0, count).Select(_ => random.Next(min, max))];

    /// <summary>Some corners have no index, but not all: the format can't tell unused elements from missing ones.</summary>
    private static ImmutableArray<int> UsedIndices(Random random, int corners, int count) =>
        Indices(random, corners, -1, count).SetItem(random.Next(corners), 0);

    private static IEnumerable<MeshGroup> Groups(Random random, int faceCount)
    {
        var first = 0;
        while (first < faceCount)
        {
            var count = random.Next(1, faceCount - first + 1);
            // Each group has another name than the one before.
            yield return new(first, count, random.Next(2) == 0 ? "" : "o", $"g{first}", random.Next(2) == 0 ? "m" : "", random.Next(3));
            first += count;
        }
    }
}
