using System.Text;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Stl;
using FractalEngine.Tests.Geometry;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Stl;

public class StlReaderTests
{
    // Two triangles that share an edge.
    private static readonly float[] Corners = [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0];
    private static readonly double[] Positions = [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0];
    private static readonly int[] Indices = [0, 1, 2, 1, 3, 2];

    [Theory]
    [InlineData("solid a")]
    [InlineData("created by a program")]
    public void Binary_IsReadWhateverItsHeaderSays(string header) => AssertSquare(Parse(Binary(header, 2, Corners)));

    [Fact]
    public void Binary_WithBytesBehindItsTriangles_IsRead() => AssertSquare(Parse([.. Binary("", 2, Corners), 0, 1, 2]));

    [Theory]
    [InlineData("\n")]
    [InlineData("\r\n")]
    [InlineData(" ")]
    public void Text_WithAnyBlanks_IsTheSame(string lineBreak) =>
        AssertSquare(Parse(
            Encoding.UTF8.GetBytes("solid\n" + Text(Corners).Replace("\n", lineBreak, StringComparison.Ordinal) + "endsolid")));

    [Fact]
    public void Solids_AreObjectsWithTheirNames()
    {
        var text = $"solid Größe a\n{Text(Corners)}endsolid Größe a\nSOLID b\n{Text(Corners.AsSpan(9))}ENDSOLID\n";
        var mesh = Parse(Encoding.UTF8.GetBytes(text));
        Assert.Equal([new(0, 2, "Größe a", "", "", 0), new(2, 1, "b", "", "", 0)], mesh.Groups.ToArray());
        Assert.Equal([0, 1, 2, 1, 3, 2, 1, 3, 2], mesh.VertexIndices.ToArray());
    }

    [Theory]
    [InlineData("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n", 4, 12, "unexpected 'x', expected a number", "vertex 0 0 x")]
    [InlineData("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 inf 0\n", 4, 10, "a coordinate is not finite", "vertex 0 inf 0")]
    [InlineData("solid a\nfacet normal 0 0 1\nvertex 0 0 0\n", 3, 1, "unexpected 'vertex', expected 'outer'", "vertex 0 0 0")]
    [InlineData("solid a\nloop\n", 2, 1, "unexpected 'loop', expected 'facet' or 'endsolid'", "loop")]
    [InlineData("solid a\nendsolid a\nmore\n", 3, 1, "unexpected 'more', expected 'solid'", "more")]
    [InlineData("solid a\n", 2, 1, "unexpected end of file, expected 'facet' or 'endsolid'", "")]
    [InlineData("solid a\n\u0001 1", 2, 1, "unexpected character U+0001, expected 'facet' or 'endsolid'", "? 1")]
    public void Text_ThatIsWrong_PointsAtTheFault(string text, int line, int column, string message, string source) => Errors.AssertMessage(
        $"test.stl:{line}:{column}: error: {message}" + (source.Length > 0 ? $"\n  {source}\n  {new string(' ', column - 1)}^" : ""),
        () => StlReader.Read(new("test.stl", Encoding.UTF8.GetBytes(text))));

    [Fact]
    public void Binary_ThatIsWrong_NamesTheByte()
    {
        AssertByteError(0, "the file ends here, expected 'solid' or a header of 84 bytes", []);
        AssertByteError(184, "the file ends here, expected 3 triangles of 50 bytes", Binary("", 3, Corners));
        AssertByteError(184, "the file ends here, expected 4294967295 triangles of 50 bytes", Binary("", uint.MaxValue, Corners));
        AssertByteError(84 + 50 + 12 + 24, "a coordinate is not finite", Binary("", 2, [.. Corners[..17], float.NaN]));
    }

    [Fact]
    public void Vertices_OfBothZeros_AreOne()
    {
        Assert.Equal(4, Parse(Binary("", 2, [.. Corners.Select(number => number == 0 ? -0f : number)])).VertexCount);
        Assert.Equal(4, Parse(Binary("", 2, [-0f, .. Corners[1..]])).VertexCount);
    }

    [Fact]
    public void Read_OfMutatedFiles_EndsInAMeshOrOneProperError()
    {
        byte[][] originals = [Binary("", 2, Corners), Encoding.UTF8.GetBytes($"solid\n{Text(Corners)}endsolid\n")];
        MeshMutation.Check("test.stl", 2000, originals, bytes => StlReader.Read(bytes));
    }

    private static void AssertByteError(int position, string message, byte[] contents) => Errors.AssertMessage(
        $"test.stl:1:1: error: byte {position}: {message}", () => StlReader.Read(new("test.stl", contents)));

    private static void AssertSquare(Mesh mesh)
    {
        Assert.Equal(Positions, mesh.Positions.ToArray());
        Assert.Equal(Indices, mesh.VertexIndices.ToArray());
        Assert.Empty(mesh.Groups);
    }

    private static Mesh Parse(byte[] contents)
    {
        var parsed = StlReader.Read(new("test.stl", contents));
        Assert.Empty(parsed.Warnings);
        Assert.Equal(contents.Length, parsed.ByteCount);
        return parsed.Mesh;
    }

    private static string Text(ReadOnlySpan<float> corners)
    {
        var text = new StringBuilder();
        for (var i = 0; i < corners.Length; i += 3)
        {
            text.Append(i % 9 == 0 ? "facet normal 0 nan 1\nouter loop\n" : "")
                .Append(FormattableString.Invariant($"vertex {corners[i]} {corners[i + 1]:E} {corners[i + 2]:F6}\n"))
                .Append(i % 9 == 6 ? "endloop\nendfacet\n" : "");
        }

        return text.ToString();
    }

    private static byte[] Binary(string header, uint count, float[] corners)
    {
        using var stream = new MemoryStream();
        using var writer = new BinaryWriter(stream);
        writer.Write(Encoding.ASCII.GetBytes(header.PadRight(80)));
        writer.Write(count);
        for (var i = 0; i < corners.Length; i += 9)
        {
            writer.Write(new byte[12]);
            corners.AsSpan(i, 9).ToArray().ToList().ForEach(writer.Write);
            writer.Write((ushort)7);
        }

        return stream.ToArray();
    }
}
