using System.Globalization;
using System.Text;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Ply;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Geometry;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Ply;

public class PlyReaderTests
{
    private const string Vertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
    private const string Faces = "element face 1\nproperty list uchar int vertex_indices\n";
    private const string Square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

    [Theory]
    [InlineData("4 0 1 2 3\n")]
    [InlineData("4\t0  1\n2 3")]
    [InlineData("4 0 1 2 3\n\n")]
    public void Text_OfAQuadrilateral_IsCutAsInObjFiles(string face) =>
        Assert.Equal(Samples.ParseObj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").Mesh,
            Parse(Text(Vertices + Faces, Square + face)));

    [Theory]
    [InlineData("\n")]
    [InlineData("\r\n")]
    [InlineData("\r")]
    public void Text_WithAnyLineBreaks_IsTheSame(string lineBreak)
    {
        var text = Text("comment Größe\nobj_info none\n" + Vertices + Faces, Square + "3 0 1 2\n");
        Assert.Equal([0, 1, 2], Parse(text.Replace("\n", lineBreak, StringComparison.Ordinal)).VertexIndices.ToArray());
    }

    [Fact]
    public void ConcavePolygon_IsCutAsInObjFiles()
    {
        const string arrow = "0 0 0\n2 1 0\n0 2 0\n1 1 0\n";
        var expected = Samples.ParseObj("v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0\nf 1 2 3 4\n").Mesh;
        Assert.Equal(expected, Parse(Text(Vertices + Faces, arrow + "4 0 1 2 3\n")));
    }

    [Fact]
    public void NormalsAndTextureCoordinates_BelongToTheVertices()
    {
        const string header = "element vertex 3\nproperty uchar red\nproperty float x\nproperty float y\nproperty float z\n"
            + "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n" + Faces;
        var mesh = Parse(Text(header, "255 0 0 0 0 0 1 0 0\n0 1 0 0 0 0 2 1 0\n9 0 1 0 0 1 0 0.5 0.25\n3 0 2 1\n"));
        Assert.Equal([0, 0, 0, 1, 0, 0, 0, 1, 0], mesh.Positions.ToArray());
        Assert.Equal([0, 0, 1, 0, 0, 2, 0, 1, 0], mesh.Normals.ToArray());
        Assert.Equal([0, 0, 1, 0, 0.5, 0.25], mesh.TextureCoordinates.ToArray());
        Assert.Equal([0, 2, 1], mesh.NormalIndices.ToArray());
        Assert.Equal([0, 2, 1], mesh.TextureIndices.ToArray());
    }

    [Theory]
    [InlineData("uchar", "255 0 51", "0 255 0", "0 0 255", 0.2)]
    [InlineData("ushort", "65535 0 13107", "0 65535 0", "0 0 65535", 0.2)]
    [InlineData("float", "1 0 0.2", "0 1 0", "0 0 1", 0.2)]
    public void Colours_OfVertices_CountFromZeroToOne(string type, string first, string second, string third, double blue)
    {
        var header = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            + $"property {type} red\nproperty {type} green\nproperty {type} blue\n" + Faces;
        var mesh = Parse(Text(header, $"0 0 0 {first}\n1 0 0 {second}\n0 1 0 {third}\n3 0 1 2\n"));
        double[] expected = [1, 0, blue, 0, 1, 0, 0, 0, 1];
        Assert.Equal(expected, mesh.Colours);
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Binary_OfAllTypes_HasTheirValues(bool isBigEndian)
    {
        const string header = "element vertex 3\nproperty int8 x\nproperty short y\nproperty double z\nproperty uint32 flags\n"
            + "property list uint8 float weights\nelement edge 1\nproperty ushort vertex1\n"
            + "element face 1\nproperty uchar red\nproperty list int16 uint vertex_index\n";
        var data = new BinaryData(isBigEndian);
        foreach (var (x, y, z) in new[] { (-1, -300, 0.1), (2, 301, 1e-3), (3, 4, -1e200) })
        {
            data.Byte((byte)(sbyte)x).Short((short)y).Double(z).Int(-1).Byte(2).Int(1).Int(2);
        }

        data.Short(9).Byte(255).Short(3).Int(2).Int(1).Int(0);
        var mesh = Parse(data.After(header));
        Assert.Equal([-1, -300, 0.1, 2, 301, 1e-3, 3, 4, -1e200], mesh.Positions.ToArray());
        Assert.Equal([2, 1, 0], mesh.VertexIndices.ToArray());
    }

    [Theory]
    [InlineData("2 0 1\n", "test.ply:1:1: warning: a face needs at least three corners: skipped (1 such faces in all)")]
    [InlineData("0\n", "test.ply:1:1: warning: a face needs at least three corners: skipped (1 such faces in all)")]
    public void Face_OfFewerThanThreeCorners_IsSkippedWithOneWarning(string face, string warning)
    {
        var parsed = PlyReader.Read(Bytes(Text(Vertices + Faces, Square + face)));
        Assert.Equal((0, warning), (parsed.Mesh.FaceCount, Assert.Single(parsed.Warnings).ToString()));
    }

    [Fact]
    public void UnknownElement_IsSkippedWithAWarning()
    {
        var parsed = PlyReader.Read(Bytes(Text(
            Vertices + "element tristrips 1\nproperty list int int indices\nelement edge 1\nproperty int a\n" + Faces,
            Square + "4 0 1 2 -1\n7\n3 0 1 2\n")));
        Assert.Equal(1, parsed.Mesh.FaceCount);
        Assert.Equal("test.ply:7:9: warning: element 'tristrips' skipped\n  element tristrips 1\n          ^",
            Assert.Single(parsed.Warnings).ToString());
    }

    [Fact]
    public void Elements_WithoutProperties_TakeNoTime()
    {
        // A pass over two thousand million elements would take seconds, and this takes less than a hundredth of one.
        var parsed = ProcessorTime.RunWithin(
            1, () => PlyReader.Read(Bytes(Text(Vertices + "element face 0\nelement nothing 2147483647\n", Square))));
        Assert.Equal((4, 0), (parsed.Mesh.Positions.Length / 3, parsed.Mesh.FaceCount));
    }

    [Fact]
    public void UndefinedNormal_CountsAsZero()
    {
        const string header = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
            + "property float ny\nproperty float nz\nproperty float quality\n";
        var parsed = PlyReader.Read(Bytes(Text(header, "1 2 3 nan -nan 0 inf\n")));
        Assert.Contains("2 such numbers", Assert.Single(parsed.Warnings).Message, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("", "test.ply:1:1: error: unexpected end of file, expected 'ply'")]
    [InlineData("plx\n", "test.ply:1:1: error: unexpected 'plx', expected 'ply'\n  plx\n  ^")]
    [InlineData("ply\nformat ascii 2.0\n", "test.ply:2:14: error: unexpected '2.0', expected '1.0'\n  format ascii 2.0\n               ^")]
    [InlineData("ply\nformat text 1.0\n",
        "test.ply:2:8: error: unexpected 'text', expected 'ascii', 'binary_little_endian' or 'binary_big_endian'\n"
        + "  format text 1.0\n         ^")]
    [InlineData("ply\nproperty float x\n", "test.ply:2:1: error: no element is declared above\n  property float x\n  ^")]
    [InlineData("ply\nelement vertex -1\n",
        "test.ply:2:16: error: unexpected '-1', expected the number of elements\n  element vertex -1\n                 ^")]
    [InlineData("ply\nelement vertex 4294967296\n",
        "test.ply:2:16: error: 4294967296 is more than the limit of 2147483647\n  element vertex 4294967296\n                 ^")]
    [InlineData("ply\nelement vertex 1\nproperty real x\n",
        "test.ply:3:10: error: unexpected 'real', expected a type such as 'float' or 'uchar'\n  property real x\n           ^")]
    [InlineData("ply\nend_header\n", "test.ply:2:1: error: the header has no line 'format'\n  end_header\n  ^")]
    [InlineData("ply\nformat ascii 1.0\nend_header\n", "test.ply:1:1: error: the header declares no element 'vertex'\n  ply\n  ^")]
    [InlineData("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1",
        "test.ply:3:9: error: the vertices have no property 'y'\n  element vertex 1\n          ^")]
    [InlineData("ply\nelement vertex 1\nelement face 1\nelement vertex 1\n",
        "test.ply:4:9: error: element 'vertex' is declared above\n  element vertex 1\n          ^")]
    [InlineData("ply\nformat ascii 1.0\nelement vertex 0\nproperty int x\nproperty int y\nproperty int z\n"
        + "element face 2147483647\nend_header\n",
        "test.ply:7:9: error: the faces have no list 'vertex_indices'\n  element face 2147483647\n          ^")]
    [InlineData("ply\nformat ascii 1.0\nelement vertex 0\nproperty int x\nproperty int y\nproperty int z\n"
        + "element face 1\nproperty int vertex_indices\nend_header\n1",
        "test.ply:7:9: error: the faces have no list 'vertex_indices'\n  element face 1\n          ^")]
    public void Header_ThatIsWrong_PointsAtTheFault(string text, string message) =>
        Errors.AssertMessage(message, () => PlyReader.Read(Bytes(text)));

    [Theory]
    [InlineData("0 0 0\n1 0 0\n1 x 0\n0 1 0\n3 0 1 2\n", 12, 3, "unexpected 'x', expected a number", "1 x 0")]
    [InlineData("0 0 0\n1 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", 12, 3, "a coordinate is not finite", "1 nan 0")]
    [InlineData("0 0 0\n1 0 0\n1 1e999 0\n0 1 0\n3 0 1 2\n", 12, 3, "the number 1e999 is beyond the range of a double", "1 1e999 0")]
    [InlineData(Square + "3 0 1 4\n", 14, 7, "vertex 4 of 4: numbers start at 0", "3 0 1 4")]
    [InlineData(Square + "3 0 -1 4\n", 14, 5, "vertex -1 of 4: numbers start at 0", "3 0 -1 4")]
    [InlineData(Square + "3 0 0.5 4\n", 14, 5, "vertex 0.5 of 4: numbers start at 0", "3 0 0.5 4")]
    [InlineData(Square + "-3 0 1 2\n", 14, 1, "-3 is not the length of a list", "-3 0 1 2")]
    [InlineData(Square + "3 0 1\n", 15, 1, "unexpected end of file, expected a number", "")]
    public void Text_ThatIsWrong_PointsAtTheFault(string data, int line, int column, string message, string source) => Errors.AssertMessage(
        $"test.ply:{line}:{column}: error: {message}" + (source.Length > 0 ? $"\n  {source}\n  {new string(' ', column - 1)}^" : ""),
        () => PlyReader.Read(Bytes(Text(Vertices + Faces, data))));

    [Fact]
    public void Binary_ThatIsWrong_NamesTheByte()
    {
        var data = new BinaryData(false);
        foreach (var number in new[] { 0, 0, 0, 1f, 0, 0, 1, 1, 0, 0, 1, 0 })
        {
            data.Int(BitConverter.SingleToInt32Bits(number));
        }

        var length = data.After(Vertices + Faces).Length;
        Errors.AssertMessage($"test.ply:1:1: error: byte {length + 5}: vertex 4 of 4: numbers start at 0",
            () => PlyReader.Read(new("test.ply", data.Byte(3).Int(0).Int(4).Int(2).After(Vertices + Faces))));
        Errors.AssertMessage($"test.ply:1:1: error: byte {length + 1}: the file ends here, expected a number",
            () => PlyReader.Read(new("test.ply", data.After(Vertices + Faces).AsSpan(0, length + 3))));
    }

    [Fact]
    public void Counts_BeyondTheFile_AreRefusedBeforeMemoryIsTaken()
    {
        var text = Text("element vertex 2000000000\nproperty float x\nproperty float y\nproperty float z\n", "1 2 3\n");
        var message = Allocation.RunWithin(100_000, () => Errors.MessageOf(() => PlyReader.Read(Bytes(text))));
        Assert.Equal("test.ply:3:9: error: the file ends before 2000000000 elements 'vertex': 6 bytes are left\n"
            + "  element vertex 2000000000\n          ^", message);
    }

    [Fact]
    public void Polygon_BeyondTheLimit_NamesIt()
    {
        var corners = (int)ParsingLimits.PolygonCorners.Value + 1;
        var face = corners.ToString(CultureInfo.InvariantCulture) + string.Concat(Enumerable.Repeat(" 0", corners));
        var error = Errors.ThrownBy(() => PlyReader.Read(Bytes(Text(
            Vertices + "element face 1\nproperty list int int vertex_indices\n", Square + face))));
        Assert.True(error.Diagnostic.IsLimitExceeded);
    }

    [Fact]
    public void Read_OfMutatedFiles_EndsInAMeshOrOneProperError()
    {
        var data = new BinaryData(true);
        for (var i = 0; i < 12; i++)
        {
            data.Int(BitConverter.SingleToInt32Bits(i % 5));
        }

        byte[][] originals = [Encoding.UTF8.GetBytes(Text(Vertices + Faces, Square + "4 0 1 2 3\n")),
            data.Byte(4).Int(0).Int(1).Int(2).Int(3).After(Vertices + Faces)];
        MeshMutation.Check("test.ply", 3000, originals, bytes => PlyReader.Read(bytes));
    }

    private static string Text(string elements, string data) => $"ply\nformat ascii 1.0\n{elements}end_header\n{data}";

    private static MeshBytes Bytes(string text) => new("test.ply", Encoding.UTF8.GetBytes(text));

    private static Mesh Parse(string text) => Parse(Encoding.UTF8.GetBytes(text));

    private static Mesh Parse(byte[] contents)
    {
        var parsed = PlyReader.Read(new("test.ply", contents));
        Assert.Empty(parsed.Warnings);
        Assert.Equal(contents.Length, parsed.ByteCount);
        return parsed.Mesh;
    }

    private sealed class BinaryData(bool isBigEndian)
    {
        private readonly List<byte> _bytes = [];

        public BinaryData Byte(byte value) => Add([value]);

        public BinaryData Short(short value) => AddNumber(BitConverter.GetBytes(value));

        public BinaryData Int(int value) => AddNumber(BitConverter.GetBytes(value));

        public BinaryData Double(double value) => AddNumber(BitConverter.GetBytes(value));

        public byte[] After(string elements) =>
        [
            .. Encoding.UTF8.GetBytes($"ply\nformat binary_{(isBigEndian ? "big" : "little")}_endian 1.0\n{elements}end_header\n"),
            .. _bytes,
        ];

        private BinaryData AddNumber(byte[] bytes)
        {
            if (isBigEndian == BitConverter.IsLittleEndian)
            {
                Array.Reverse(bytes);
            }

            return Add(bytes);
        }

        private BinaryData Add(byte[] bytes)
        {
            _bytes.AddRange(bytes);
            return this;
        }
    }
}
