using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Wavefront;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Wavefront;

public class ObjParserTests
{
    private const string Square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    private const string Attributes = Square + "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nvn 0 0 2\n";

    private static Mesh Parse(string text)
    {
        var file = Samples.ParseObj(text);
        Assert.Empty(file.Warnings);
        return file.Mesh;
    }

    [Fact]
    public void Vertices_EndInOneFlatArray() => Assert.Equal([1, 2, 3, 4, 5, 6], Parse("v 1 2 3\nv 4 5 6").Positions.ToArray());

    [Theory]
    [InlineData("v 1 2 3 1.0")]
    [InlineData("v 1 2 3 0.1 0.2 0.3")]
    [InlineData("v 1 2 3 1.0 0.1 0.2 0.3")]
    [InlineData("v 1 2 3 0.1 0.2 0.3 0.4")]
    [InlineData("  v   1\t2 3  ")]
    [InlineData("v 1.0e0 +2 3.")]
    [InlineData("v 1 2 3 nan nan nan")]
    [InlineData("v 1 2 3 1.0 -nan(ind) 0 NaN # colour")]
    [InlineData("v 1 2 3 inf -INF +Infinity\\\n 1")]
    [InlineData("v 1 2 3 # trailing")]
    [InlineData("v 1 2 3#trailing")]
    [InlineData("v 1 \\\n 2 \\\n3")]
    [InlineData("v 1 \\\r\n 2 3")]
    public void Vertex_WithWeightColourBlanksOrComment_IsItsPosition(string line) =>
        Assert.Equal(new(1, 2, 3), Parse(line + "\n").Vertex(0));

    [Theory]
    [InlineData("f 1 2 3", new int[0], new int[0])]
    [InlineData("f 1/1 2/2 3/3", new[] { 0, 1, 2 }, new int[0])]
    [InlineData("f 1//1 2//2 3//1", new int[0], new[] { 0, 1, 0 })]
    [InlineData("f 1/1/1 2/2/1 3/3/2", new[] { 0, 1, 2 }, new[] { 0, 0, 1 })]
    [InlineData("f -4 -3 -2", new int[0], new int[0])]
    [InlineData("f -4/-3/-2 -3/-2/-1 -2/-1/-2", new[] { 0, 1, 2 }, new[] { 0, 1, 0 })]
    [InlineData("f 1/-3 -3//2 3/3/-2", new[] { 0, -1, 2 }, new[] { -1, 1, 0 })]
    [InlineData("f 1// 2// 3//", new int[0], new int[0])]
    [InlineData("f 1/ 2/2/ 3//#none", new[] { -1, 1, -1 }, new int[0])]
    [InlineData("f 1//2 2// 3/3/\\\n", new[] { -1, -1, 2 }, new[] { 1, -1, -1 })]
    public void Face_InEveryIndexForm_IsRead(string line, int[] textures, int[] normals)
    {
        var mesh = Parse(Attributes + line);
        Assert.Equal([0, 1, 2], mesh.VertexIndices.ToArray());
        Assert.Equal(textures, mesh.TextureIndices.ToArray());
        Assert.Equal(normals, mesh.NormalIndices.ToArray());
    }

    [Theory]
    [InlineData("f\n", 0, "")]
    [InlineData("f 1\n", 1, "")]
    [InlineData("f 1/1 -1//1 # two\n", 2, "")]
    [InlineData("f 1 2\nf\nf 1\n", 2, " (3 such faces in all)")]
    public void Face_OfFewerThanThreeCorners_IsSkippedWithOneWarning(string lines, int cornerCount, string total)
    {
        var file = Samples.ParseObj($"{Attributes}{lines}f 1 2 3\n");
        Assert.Equal([0, 1, 2], file.Mesh.VertexIndices.ToArray());
        var firstLine = lines[..lines.IndexOf('\n', StringComparison.Ordinal)];
        Assert.Equal(
            $"test.obj:10:1: warning: a face needs at least three corners, this one has {cornerCount}: skipped{total}\n  {firstLine}\n  ^",
            Assert.Single(file.Warnings).ToString());
    }

    [Theory]
    [InlineData("v 0 0 0\nv 1 0 0\n", new double[0])]
    [InlineData("v 0 0 0 0.5\n", new double[0])] // a weight
    [InlineData("v 0 0 0 0.5 0.5\nv 0 0 0 1 2 3 4 5\nv 0 0 0 1 2 3 4 5 6\n", new double[0])] // of no known meaning
    [InlineData("v 0 0 0 0.25 0.5 1\n", new[] { 0.25, 0.5, 1 })]
    [InlineData("v 0 0 0 7 .25 0.5 1 # with a weight\r\n", new[] { 0.25, 0.5, 1 })]
    [InlineData("v 0 0 0\nv 0 0 0 0.25 0.5 0\nv 0 0 0\nv 0 0 0 1\n", new[] { 1, 1, 1, 0.25, 0.5, 0, 1, 1, 1, 1, 1, 1 })]
    [InlineData("v 0 0 0 \\\n 0.25 0.5 1\n", new[] { 0.25, 0.5, 1 })]
    public void Colours_OfVertices_AreKeptAndWhiteWhereMissing(string lines, double[] colours) =>
        Assert.Equal(colours, Parse(lines).Colours);

    [Fact]
    public void Colours_OfOneBlockOfMany_AreThoseOfItsVertices()
    {
        var plain = string.Concat(Enumerable.Repeat("v 1 2 3\n", 1000));
        var colours = Parse(plain + "v 1 2 3 0 0.5 0\n" + plain).Colours;
        Assert.Equal((6003, 0, 0.5, 0), (colours.Length, colours[3000], colours[3001], colours[3002]));
        Assert.Equal(6000, colours.Count(component => component == 1));
    }

    [Fact]
    public void NegativeNumbers_CountBackFromTheirOwnLine() =>
        Assert.Equal([0, 1, 2, 1, 2, 3], Parse("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf -3 -2 -1").VertexIndices.ToArray());

    [Fact]
    public void TextureCoordinates_WithOneOrThreeComponents_KeepTwo() =>
        Assert.Equal([0.5, 0, 0.25, 0.75], Parse(Square + "vt 0.5\nvt 0.25 0.75 0.1\nf 1/1 2/2 3/1").TextureCoordinates.ToArray());

    [Fact]
    public void AttributesOfSomeFacesOnly_AreMinusOneElsewhere()
    {
        var mesh = Parse(Attributes + "f 1 2 3\nf 1/1/1 3/2/1 4/3/1\nf 1 2 4");
        Assert.Equal([-1, -1, -1, 0, 1, 2, -1, -1, -1], mesh.TextureIndices.ToArray());
        Assert.Equal([-1, -1, -1, 0, 0, 0, -1, -1, -1], mesh.NormalIndices.ToArray());
    }

    [Fact]
    public void Polygon_OfNCorners_IsNMinusTwoTriangles()
    {
        var circle =
            string.Concat(Enumerable.Range(0, 100)
            .Select(i => FormattableString.Invariant($"v {Math.Cos(i * Math.PI / 50)} {Math.Sin(i * Math.PI / 50)} 0\n")));
        Assert.Equal(98, Parse(circle + "f " + string.Join(' ', Enumerable.Range(1, 100))).FaceCount);
    }

    [Theory]
    [InlineData("f 1 2 3 4")]
    [InlineData("f 2 3 4 1")]
    [InlineData("f 3 4 1 2")]
    [InlineData("f 4 1 2 3")]
    public void Quad_ThatIsConcave_IsCutInside(string face)
    {
        // An arrow head with its notch at vertex 4; a fan from the wrong corner would cover the notch.
        var mesh = Parse("v 0 0 0\nv 4 2 0\nv 0 4 0\nv 1 2 0\n" + face);
        // Half of 4 × 4, less half of 4 × 1.
        Assert.Equal(6, Enumerable.Range(0, 2).Sum(i => mesh.Face(i) switch { var (a, b, c) => Vector.Cross(b - a, c - a).Length() / 2 }),
            1e-12);
    }

    [Fact]
    public void Polygon_WithAttributes_KeepsThemAtItsCorners()
    {
        var mesh = Parse(Square + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4");
        Assert.Equal(mesh.VertexIndices.ToArray(), mesh.TextureIndices.ToArray());
    }

    [Fact]
    public void Names_OfObjectsGroupsAndMaterials_AreRecorded()
    {
        var mesh =
            Parse("mtllib a b.mtl\nmtllib c.mtl\n" + Square
                + "o thing one\ng left wing\nusemtl red paint\ns 1\nf 1 2 3\nf 1 3 4\ns off\nusemtl blue\nf 1 2 4 # four");
        Assert.Equal(["a b.mtl", "c.mtl"], mesh.MaterialLibraries.ToArray());
        Assert.Equal(
            [new MeshGroup(0, 2, "thing one", "left wing", "red paint", 1), new MeshGroup(2, 1, "thing one", "left wing", "blue", 0)],
            mesh.Groups.ToArray());
    }

    [Fact]
    public void LinesAndPoints_AreSkippedSilently() => Assert.Equal(0, Parse(Square + "l 1 2 3\nl 1/1 2/2\np 1 2\n").FaceCount);

    [Fact]
    public void UnknownKeywords_GiveExactlyOneWarning()
    {
        var file = Samples.ParseObj(Square + "curv 0 1 1 2\nvp 1 2\nshadow_obj x.obj\ncurv 1 2\n");
        Assert.Equal("""
            test.obj:5:1: warning: unknown keyword 'curv' skipped (4 lines with unknown keywords in all)
              curv 0 1 1 2
              ^
            """.ReplaceLineEndings("\n"), Assert.Single(file.Warnings).ToString());
    }

    [Theory]
    [InlineData("\n")]
    [InlineData("\r\n")]
    [InlineData("\r")]
    public void LineBreaks_OfAllSystems_AreTheSame(string lineBreak)
    {
        var text = "# comment\no x # trailing\n" + Square + "\n\ns 1\nf 1 2 \\\n3\nunknown 1\nf 1 3 4";
        var (expected, actual) = (Samples.ParseObj(text), Samples.ParseObj(text.Replace("\n", lineBreak, StringComparison.Ordinal)));
        Assert.Equal(expected.Mesh.Positions.ToArray(), actual.Mesh.Positions.ToArray());
        Assert.Equal([0, 1, 2, 0, 2, 3], actual.Mesh.VertexIndices.ToArray());
        Assert.Equal(expected.Mesh.Groups.ToArray(), actual.Mesh.Groups.ToArray());
        Assert.Single(actual.Warnings);
    }

    [Fact]
    public void ByteOrderMark_IsIgnored() => Assert.Equal(
        1, ObjParser.Parse(SourceText.Decode([0xEF, 0xBB, 0xBF, .. "v 1 2 3"u8], "test.obj")).Mesh.VertexCount);

    [Theory]
    [InlineData("v 1 2 3")]
    [InlineData("v 1 2 3\n")]
    [InlineData("\n\n# a\n  # b\nv 1 2 3\n\n\n")]
    public void File_OfVerticesOnly_IsAnEmptyMesh(string text) => Assert.Equal((1, 0), (Parse(text).VertexCount, Parse(text).FaceCount));

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void Parse_InAnyCulture_ReadsPointsAndSigns(string culture) =>
        Assert.Equal(new(0.5, -1.25, 1e-7), InCulture.Run(culture, () => Parse("v 0.5 -1.25 1e-7\nv 0 0 0\nv 1 0 0\nf -3 -2 -1\n"))
        .Vertex(0));

    [Fact]
    public void Progress_NeverRunsBackwards()
    {
        List<double> reports = [];
        ObjParser.Parse(new("test.obj", string.Concat(Enumerable.Repeat("v 1 2 3\n", 300_000))), new Recorder(reports));
        Assert.Equal(reports.Order(), reports);
        Assert.NotEmpty(reports);
        Assert.All(reports, report => Assert.InRange(report, 0, 1));
    }

    [Fact]
    public void Parse_OfAMillionVertices_TakesNoQuadraticTimeOrMemory()
    {
        var text = string.Concat(Enumerable.Repeat("v 1.25 -2.5 3.75\n", 1_000_000));
        // It takes a fraction of a second. A vertex has three doubles, which are copied when the list grows.
        Assert.Equal(1_000_000, ProcessorTime.RunWithin(5, () => Allocation.RunWithin(
            150_000_000, () => ObjParser.Parse(new("test.obj", text)).Mesh.VertexCount)));
    }

    private sealed class Recorder(List<double> reports) : IProgress<double>
    {
        public void Report(double value) => reports.Add(value);
    }
}
