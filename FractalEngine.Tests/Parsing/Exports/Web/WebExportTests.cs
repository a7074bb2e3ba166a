using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Exports.Web;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Exports.Web;

public class WebExportTests
{
    // Relative to a scene of about 1: rounding of a few products.
    private const double Tolerance = 1e-9;

    // Values of numbers have six digits.
    private const double SampleTolerance = 1e-4;

    [Theory]
    [InlineData("assets/fractals/menger.fdo", 2)]
    [InlineData("assets/fractals/tree.fdo", 2)]
    [InlineData("assets/fractals/fern.fdo", 1)]
    [InlineData("assets/examples/tree-08.fdo", 2)]
    [InlineData("assets/fractals/appendix-b.fdo", 2)]
    [InlineData("assets/fractals/infinite-menger.fdo", 2)]
    public void Page_OfAFractal_HasTheInstancesOfItsExpansion(string file, int depth) => RequireExpansion(file, new() { Depth = depth });

    [Theory]
    [InlineData("seed 7", "z 4")]
    [InlineData("seed 7 by level", "z 6")]
    [InlineData("seed 7", "z until 0.5")]
    public void Page_OfWhatPlacesDecide_ChoosesAsTheExpansionDoes(string seed, string result)
    {
        using var folder = new TemporaryFolder();
        folder.Write("cube.obj", SampleFiles.Cube);
        RequireExpansion(folder.Write("chance.fdo", $"""
            {seed}
            x. "cube.obj"
            g. ((0, 1, 0), (0, 60, 9), (0.7))
            s. ((0, 0.7, 0), (0, 0, 40), (0.6))
            z<x>. 3: [g.] x + [s.] x | 1: [g.] x | 1: [s.] x
            <$>. {result}

            """), new());
    }

    [Fact]
    public void Page_OfAFractalWithAGradient_HasItsColours()
    {
        using var folder = new TemporaryFolder();
        var page = PageReader.Of(folder.Write(
            "g.fdo", "gradient height (1, 0, 0) (0, 0, 1)\n<$>. [((1, 2, 0), #, (0.5))^0..3] box\n"), new());
        Assert.Equal([0, 1, 0, 0, 1, 0, 0, 1], PageReader.Numbers(page["objects"][0].GetProperty("stops")));
    }

    /// <summary>The winding says which side of a face is lit, whatever the file's normals say; a mirrored object is told.</summary>
    [Fact]
    public void Page_OfNormalsThatPointInward_TurnsThemOutward()
    {
        using var folder = new TemporaryFolder();
        folder.Write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n");
        var page = PageReader.Of(folder.Write("s.sdo", "o \"a.obj\" #\no \"a.obj\" ((2, 0, 0), #, (-1, 1, 1))\n"), new());
        Assert.Equal([0, 0, 127, 0, 0, 0, 0, 0, 0], PageReader.Numbers(page["meshes"][0].GetProperty("normals")));
        Assert.Equal([false, true], page["objects"].EnumerateArray().Select(static one => one.GetProperty("isMirrored").GetBoolean()));
    }

    /// <summary>What turns some of its instances inside out is drawn from both sides, as a mirrored object is.</summary>
    [Fact]
    public void Page_OfAFractalWithMirrors_SaysThatItIsMirrored()
    {
        using var folder = new TemporaryFolder();
        var page = PageReader.Of(folder.Write("m.fdo", "<$>. [((0, 0, 0), #, #), ((2, 0, 0), #, (-1, 1, 1))] box\n"));
        Assert.True(page["objects"][0].GetProperty("isMirrored").GetBoolean());
    }

    /// <summary>A gradient goes over the whole, also where it has several base meshes.</summary>
    [Fact]
    public void Page_OfSeveralMeshes_HasTheirWholeForEach()
    {
        using var folder = new TemporaryFolder();
        var page = PageReader.Of(folder.Write("w.fdo", "gradient height (1, 0, 0) (0, 0, 1)\n<$>. box + [((0, 3, 0), #, #)] ball\n"));
        // Boxes and balls are 1 wide.
        Assert.All(page["objects"].EnumerateArray(), static one => Assert.Equal(
            [0, 1.5, 0, 1, 4, 1], PageReader.Numbers(one.GetProperty("whole")).Select(static number => Math.Round(number, 9))));
        Assert.Equal(2, page["objects"].GetArrayLength());
    }

    [Fact]
    public void Page_OfMapColours_HasTheLightThatTheyAddAndKeep()
    {
        using var folder = new TemporaryFolder();
        var page = PageReader.Of(folder.Write("c.fdo", "<$>. [#, ((2, 0, 0), #, #) colour (0, 1, 0.5) 0.25] box\n"));
        // 0.5 of sRGB is 0.2140411 of light. A map without a colour keeps all.
        Assert.Equal(
            [0, 0, 0, 1, 0, 0.25, 0.0535103, 0.75],
            PageReader.Numbers(page["fractals"][0].GetProperty("values"))[^8..].Select(static number => Math.Round(number, 7)));
    }

    [Fact]
    public void Page_OfTexturesAndLights_HasTheirNumbers()
    {
        using var folder = new TemporaryFolder();
        File.Copy(Repository.Full("assets/models/crate.png"), folder["tiles.png"]);
        folder.Write("m.mtl", "newmtl A\nmap_Kd -s 2 3 -o 0.25 0.5 -clamp on tiles.png\n");
        folder.Write(
            "a.obj", "mtllib m.mtl\nusemtl A\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 4 -1\nvt 6 -1\nvt 5 7\nf 1/1 2/2 3/3\n");
        var page = PageReader.Of(folder.Write("s.sdo", """
            sky (0, 0, 1) (0, 1, 0) (1, 0, 0)
            fog 0.5
            light spot (1, 2, 3) (0, -1, 0) 60 (1, 1, 1) 1 10
            light point (1, 2, 3) (1, 1, 1) 1 7
            o "a.obj" #
            """));
        var mesh = page["meshes"][0];
        var box = PageReader.Numbers(mesh.GetProperty("textureBox"));
        var steps = PageReader.Numbers(mesh.GetProperty("texture"));
        var (u, v) = (0.0, 0.0);
        foreach (var (i, expected) in new (double U, double V)[] { (4, -1), (6, -1), (5, 7) }.Index())
        {
            (u, v) = (u + steps[2 * i], v + steps[(2 * i) + 1]);
            // Half a step of 65,535.
            Near.Equal(expected.U, box[0] + (u * box[2]), 2 / 65535.0);
            Near.Equal(expected.V, box[1] + (v * box[3]), 8 / 65535.0);
        }

        var material = page["materials"][0];
        Assert.Equal([2, 3, 0.25, 0.5], PageReader.Numbers(material.GetProperty("place")));
        Assert.True(material.GetProperty("clamp").GetBoolean());
        Assert.Equal([0, 1, 0], PageReader.Numbers(page["fog"]));
        var above = PageReader.Numbers(page["ambient"].GetProperty("above"));
        var below = PageReader.Numbers(page["ambient"].GetProperty("below"));
        Assert.True(above[2] > above[0] && below[0] > below[2], "blue from above, red from below");
        var lights = page["lights"];
        var cone = PageReader.Numbers(lights[0].GetProperty("cone"));
        // The light ends at half the angle, and is full up to nine tenths of that.
        Near.Equal(Math.Cos(Math.PI / 6), cone[0], 1e-12);
        Near.Equal(Math.Cos(0.9 * Math.PI / 6), cone[1], 1e-12);
        Assert.Equal((10, 7), (lights[0].GetProperty("range").GetDouble(), lights[1].GetProperty("range").GetDouble()));
    }

    /// <summary>Ends of sliders whose distance is no number make a number that is none, and no page without end.</summary>
    [Theory]
    [InlineData("1.7e308")]
    [InlineData("0.5 from -1e308 to 1e308")]
    public void Page_OfANumberOfAllSizes_HasNoSliderForIt(string number)
    {
        using var folder = new TemporaryFolder();
        var path = folder.Write("a.fdo", $"a = {number}\nb = 0.5\n<$>. [((b, 0, 0), #, #)] box\n");
        using var stream = new MemoryStream();
        var summary = new WebExport().Write(AssetLoader.Load(path).Scene, new(), stream);
        Assert.Equal(
            "the number 'a' is no slider, since its fractal can't be made at each value: it would go from end to end of all numbers",
            Assert.Single(summary.Losses));
        Assert.Contains("1 slider", summary.Contents, StringComparison.Ordinal);
    }

    [Fact]
    public void Page_OfAChoiceByLevel_ChoosesAsTheExpansionDoes()
    {
        using var folder = new TemporaryFolder();
        folder.Write("cube.obj", SampleFiles.Cube);
        RequireExpansion(folder.Write("levels.fdo", """
            x. "cube.obj"
            g. ((0, 1, 0), (0, 60, 9), (0.7))
            s. ((0, 0.7, 0), (0, 0, 40), (0.6))
            z<x>. level 0..1: [g.] x + [s.] x | 2: [g.] x | 3..: [s.] x
            <$>. z 6

            """), new());
    }

    [Fact]
    public void Page_OfANumber_HasTheFractalAtEachValue()
    {
        var path = Repository.Full("assets/fractals/fern.fdo");
        var page = PageReader.Of(path, new() { Depth = 1 });
        var numbers = page["numbers"].EnumerateArray().ToArray();
        Assert.NotEmpty(numbers);
        foreach (var number in numbers)
        {
            var range = PageReader.Numbers(number.GetProperty("range"));
            var value = range[1] + (3 / (range[3] - 1) * (range[2] - range[1]));
            var options = new LoadOptions
            {
                Depth = 1,
                Values = ImmutableDictionary<string, double>.Empty.Add(number.GetProperty("name").GetString()!, value),
            };
            RequireSame(FractalsOf(path, options)[0].Expand(1_000), page.Expand(number, 3), SampleTolerance);
        }
    }

    [Theory]
    [InlineData("assets/fractals/menger.fdo", 60_000)]
    [InlineData("assets/scenes/gallery.sdo", 200_000)]
    public void Page_OfASample_IsSmall(string file, int maxBytes) =>
        Assert.InRange(PageReader.Export(Repository.Full(file)).Length, 1, maxBytes);

    [Fact]
    public void Page_WrittenTwice_HasTheSameBytesAndNoAddress()
    {
        var path = Repository.Full("assets/scenes/textured.sdo");
        var page = PageReader.Of(path);
        Assert.Equal(PageReader.Export(path), PageReader.Export(path));
        Assert.DoesNotContain("http", page.Text, StringComparison.OrdinalIgnoreCase);
        Assert.DoesNotContain("://", page.Text, StringComparison.Ordinal);
        Assert.DoesNotContain("src=", page.Text, StringComparison.Ordinal);
        Assert.DoesNotContain("href=", page.Text, StringComparison.Ordinal);
        Assert.True(page["textures"].GetArrayLength() > 0);
        var bytes = page["textures"].EnumerateArray().Select(static one => one.GetBytesFromBase64()).ToArray();
        Assert.All(bytes, image => Assert.Contains(
            Directory.GetFiles(Repository.Full("assets"), "*", SearchOption.AllDirectories),
            file => new FileInfo(file).Length == image.Length && File.ReadAllBytes(file).SequenceEqual(image)));
    }

    [Fact]
    public void Page_OfAMesh_HasItsVerticesToAPartOfItsBox()
    {
        var path = Repository.Full("assets/models/branch.obj");
        var mesh = AssetLoader.Load(path).Scene.Objects[0].Model.Mesh;
        var written = PageReader.Of(path)["meshes"][0];
        var box = PageReader.Numbers(written.GetProperty("box"));
        var differences = PageReader.Numbers(written.GetProperty("positions"));
        var indices = PageReader.Numbers(written.GetProperty("batches")[0].GetProperty("indices"));
        Assert.Equal(mesh.VertexIndices.Length, indices.Length);
        var index = 0;
        for (var corner = 0; corner < indices.Length; corner++)
        {
            index += (int)indices[corner];
            var vertex = mesh.Vertex(mesh.VertexIndices[corner]);
            double[] expected = [vertex.X, vertex.Y, vertex.Z];
            for (var axis = 0; axis < 3; axis++)
            {
                var steps = Enumerable.Range(0, index + 1).Sum(i => differences[(3 * i) + axis]);
                // Half a step, and rounding.
                Assert.InRange(box[axis] + (steps * box[3 + axis]) - expected[axis], -0.501 * box[3 + axis], 0.501 * box[3 + axis]);
            }
        }
    }

    [Fact]
    public void Write_BeyondTheFaces_ThrowsAndWritesNothing()
    {
        var scene = AssetLoader.Load(Repository.Full("assets/fractals/menger.fdo")).Scene;
        using var stream = new MemoryStream();
        var exception = Assert.Throws<FractalLimitException>(() => new WebExport().Write(scene, new() { MaxFaces = 11 }, stream));
        Assert.Equal("the base meshes have 12 faces, more than the limit of 11", exception.Message);
        Assert.Equal(0, stream.Length);
    }

    [Fact]
    public void Write_WhatThePageCannotShow_TellsOfIt()
    {
        var scene = AssetLoader.Load(Repository.Full("assets/scenes/textured.sdo")).Scene;
        var summary = new WebExport().Write(scene, new(), new MemoryStream());
        Assert.Contains("surfaces of materials are matt in the page: nothing is mirrored", summary.Losses);
    }

    private static Fractal[] FractalsOf(string path, LoadOptions options) =>
    [
        .. AssetLoader.Load(path, options).Scene.ByParts().Models.OfType<FractalModel>().Select(static model => model.Fractal),
    ];

    private static void RequireExpansion(string file, LoadOptions options)
    {
        var path = Repository.Full(file);
        var page = PageReader.Of(path, options);
        var fractals = FractalsOf(path, options);
        Assert.NotEmpty(fractals);
        for (var i = 0; i < fractals.Length; i++)
        {
            RequireSame(fractals[i].ExpandDistinct(5_000), page.Expand(i), Tolerance);
        }
    }

    private static void RequireSame(ImmutableArray<AffineMap> expected, List<double[][]> actual, double tolerance)
    {
        Assert.Equal(expected.Length, actual.Count);
        Assert.All(expected, map => Assert.Contains(actual, other => Differences(map, other).All(one => Math.Abs(one) < tolerance)));
    }

    private static IEnumerable<double> Differences(AffineMap map, double[][] rows)
    {
        Vector[] columns = [map.Linear.V1, map.Linear.V2, map.Linear.V3, map.Translation];
        return columns.SelectMany((column, i) => new[] { column.X - rows[0][i], column.Y - rows[1][i], column.Z - rows[2][i] });
    }
}
