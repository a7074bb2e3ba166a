using System.Buffers.Binary;
using System.IO.Compression;
using System.Text;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Mtl;
using FractalEngine.Parsing.Ply;
using FractalEngine.Parsing.Stl;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Wavefront;
using FractalEngine.Tests.Geometry;
using FractalEngine.Tests.Recorded;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Meshes;

/// <summary>Compares what the readers make of meshes and materials, right and faulty, with what is recorded.</summary>
[Collection(ConsoleTests.Name)]
public sealed class RecordedMeshTests : IDisposable
{
    private const string Ply = """
        ply
        format ascii 1.0
        comment a b
        element vertex 4
        property float x
        property double y
        property float z
        property uchar red
        property ushort green
        property float blue
        property float s
        property float t
        property list uchar int other
        element face 2
        property list uchar int vertex_indices
        property int flags
        element edge 1
        property int a
        element more 1
        property short b
        end_header
        0 0 0 255 65535 1 0 0 0
        1 0 0 0 0 0.5 nan 1 1 7
        1 1 0 51 13107 0.25 0.5 0.75 2 1 2
        0 1 0 0 0 0 1 0 0
        4 0 1 2 3 5
        2 0 1 5
        9
        7

        """;

    private const string Stl = "solid a b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
        + "facet\nouter loop\nvertex 1 0 0\nvertex 1 1e0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\nsolid\nendsolid\n";

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Meshes_WithEverySmallFault_AreAsRecorded()
    {
        Sweep("obj-faults.txt", MeshTexts.Objs, static text => ObjParser.Parse(new("t.obj", text)));
        Sweep("ply-faults.txt", [Ply], static text => PlyReader.Read(new MeshBytes("t.ply", Encoding.UTF8.GetBytes(text))));
        Sweep("stl-faults.txt", [Stl], static text => StlReader.Read(new MeshBytes("t.stl", Encoding.UTF8.GetBytes(text))));
    }

    [Fact]
    public void Readers_OfObjsWithEverySmallFault_AgreeWithTheGrammar()
    {
        var sweep = new FaultSweep();
        foreach (string text in MeshTexts.Objs)
        {
            sweep.Run(text, static variant => (ObjOutcome.AssertSame(Encoding.UTF8.GetBytes(variant)), []));
        }
    }

    [Fact]
    public void Materials_WithEverySmallFault_AreAsRecorded()
    {
        var sweep = new FaultSweep();
        foreach (string text in MeshTexts.Mtls)
        {
            sweep.Run(text, static variant =>
            {
                var parsed = MtlParser.Parse(new("t.mtl", variant));
                return ((parsed.Materials, Offsets(static material => material.Texture),
                    Offsets(static material => material.OpacityTexture), Offsets(static material => material.BumpTexture),
                    Offsets(static material => material.NormalTexture)), parsed.Warnings);

                Dictionary<string, int> Offsets(Func<Material, MaterialTexture?> textureOf) => parsed.Materials.Values
                    .Where(material => textureOf(material) is not null)
                    .ToDictionary(static material => material.Name, material => parsed.TextureNameOffsets[textureOf(material)!]);
            });
        }

        var ends = ((int[])[1, 2, 99, 100, 101]).Select(count => string.Concat(Enumerable.Repeat("newmtl a\nKd x\n", count)))
            .Select(text => MtlParser.Parse(new("t.mtl", text + "newmtl z\n")))
            .Select(parsed => $"{parsed.Materials.Count} "
                + $"{string.Join(' ', parsed.Warnings.Select(warning => warning.ToString().Split('\n')[0]))}");
        RecordedText.Check("mtl-faults.txt", sweep.Lines().Concat(ends));
    }

    [Fact]
    public void Ply_OfEveryTypeAndOrder_IsAsRecorded()
    {
        string[] types = ["char", "uchar", "short", "ushort", "int", "uint", "float", "double", "int8", "uint8", "int16", "uint16",
            "int32", "uint32", "float32", "float64"];
        string[][] names =
        [
            ["x", "y", "z", "nx", "ny", "nz", "u", "v", "red", "green", "blue"],
            ["x", "y", "z", "normal_x", "normal_y", "normal_z", "s", "t", "r", "g", "b"],
            ["x", "y", "z", "texture_u", "texture_v", "diffuse_red", "diffuse_green", "diffuse_blue"],
            ["z", "x", "y", "texture_s", "texture_t", "alpha"], ["x", "y", "z", "nx", "ny", "u", "red", "green"],
        ];
        var lines = new List<string>();
        foreach (string[] properties in names)
        {
            foreach (string type in types)
            {
                foreach (bool isBig in (bool[])[false, true])
                {
                    byte[] bytes = BinaryPly(type, isBig, properties);
                    var parsed = PlyReader.Read(new MeshBytes("t.ply", bytes));
                    lines.Add($"{type} {isBig} {string.Join(' ', properties)}: {MeshTexts.Sums(parsed.Mesh)}");
                    Assert.Throws<SourceException>(() => PlyReader.Read(new MeshBytes("t.ply", bytes.AsSpan(0, bytes.Length - 1))));
                }
            }
        }

        RecordedText.Check("ply-types.txt", lines.Distinct());
    }

    [Fact]
    public void BinaryFiles_ThatAreCutOrWrong_AreAsRecorded()
    {
        byte[] ply = BinaryPly("float", false, ["x", "y", "z"]);
        byte[] stl = new byte[84 + 100];
        stl[80] = 2;
        Random random = new(5);
        for (int i = 84; i < stl.Length; i += 4)
        {
            BinaryPrimitives.WriteSingleLittleEndian(stl.AsSpan(i), random.Next(9));
        }

        byte[] solid = [.. stl];
        "solid "u8.CopyTo(solid);
        byte[] infinite = [.. stl];
        BinaryPrimitives.WriteSingleLittleEndian(infinite.AsSpan(84 + 50 + 12), float.PositiveInfinity);
        byte[] many = [.. ply[..^17], 200, 1, 2, 3];
        (string Name, byte[] Bytes)[] files =
        [
            ("whole.ply", ply), ("cut.ply", ply[..^5]), ("cut2.ply", ply[..^30]), ("head.ply", ply[..20]), ("none.ply", []),
            ("many.ply", many), ("whole.stl", stl), ("cut.stl", stl[..^1]), ("short.stl", stl[..83]), ("none.stl", []),
            ("solid.stl", solid), ("solidcut.stl", solid[..^1]), ("infinite.stl", infinite), ("more.stl", [.. stl, 1]),
        ];
        RecordedText.Check("binary-meshes.txt", files.Select(file =>
            $"{file.Name}: {Outcome(() => MeshReader.Read(Write(file.Name, file.Bytes), file.Name))}"));
    }

    [Fact]
    public void Texts_InEveryEncoding_AreAsRecorded()
    {
        const string text = "# ä\no höhe\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        byte[] utf8 = Encoding.UTF8.GetBytes(text);
        byte[] compressed;
        using (var stream = new MemoryStream())
        {
            using (var gzip = new GZipStream(stream, CompressionMode.Compress))
            {
                gzip.Write(utf8);
            }

            compressed = stream.ToArray();
        }

        (string Name, byte[] Bytes)[] files =
        [
            ("utf8.obj", utf8), ("mark.obj", [.. Encoding.UTF8.Preamble, .. utf8]), ("latin1.obj", Encoding.Latin1.GetBytes(text)),
            ("utf16.obj", [.. Encoding.Unicode.Preamble, .. Encoding.Unicode.GetBytes(text)]),
            ("big.obj", [.. Encoding.BigEndianUnicode.Preamble, .. Encoding.BigEndianUnicode.GetBytes(text)]),
            ("nul.obj", [.. utf8, 0, 10]), ("nulmark.obj", [.. Encoding.UTF8.Preamble, 0]), ("good.obj.gz", compressed),
            ("cut.obj.gz", compressed[..^1]), ("short.obj.gz", compressed[..17]), ("plain.obj.gz", utf8),
            ("wrong.obj.gz", [.. compressed[..^8], 1, .. compressed[^7..]]), ("size.obj.gz", [.. compressed[..^4], 255, 255, 255, 0]),
            ("double.obj.gz", [.. compressed, .. compressed]),
            ("empty.obj", []), ("line.obj", "\n"u8.ToArray()), ("odd.obj", [0xFF, 0xFE, 0x61]), ("lone.fdo", [0xFF, 0xFE, 0, 0xD8]),
            ("latin1.fdo", Encoding.Latin1.GetBytes("# ä\n<$>. \"a.obj\"")),
            ("mark.sdo", [.. Encoding.UTF8.Preamble, .. "fog 1"u8]), ("nul.sdo", "fog 1\n a\0"u8.ToArray()),
        ];
        var lines = files.Select(file => $"{file.Name}: " + (file.Name.Contains(".obj", StringComparison.Ordinal)
            ? Outcome(() => MeshReader.Read(Write(file.Name, file.Bytes), file.Name))
            : Outcome(() => SourceText.Read(Write(file.Name, file.Bytes), file.Name, 1000, file.Name == "latin1.fdo")))).ToList();
        foreach (int bytes in (int[])[56, utf8.Length, utf8.Length - 1])
        {
            ParsingLimits.ObjBytes.Value = bytes;
            string plain = Outcome(() => MeshReader.Read(_folder["utf8.obj"], "utf8.obj"));
            lines.Add($"obj-bytes={bytes} {plain} {Outcome(() => MeshReader.Read(_folder["good.obj.gz"], "good.obj.gz"))}");
            ParsingLimits.ObjBytes.Value = ParsingLimits.ObjBytes.Default;
        }

        lines.Add(Outcome(() => SourceText.Read(_folder["missing"], "missing", 10)));
        lines.Add(Outcome(() => SourceText.Read(_folder.Path, "folder", 10)));
        lines.Add(Outcome(() => SourceText.Read(_folder["mark.sdo"], "mark.sdo", 7)));
        RecordedText.Check("encodings.txt", lines);
    }

    [Fact]
    public void Polygons_AtTheirLimit_AreAsRecorded()
    {
        ParsingLimits.PolygonCorners.Value = 4;
        try
        {
            const string four = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0.5 0\nf 1 2 3 4\n";
            string five = four.Replace("3 4", "3 4 5", StringComparison.Ordinal);
            byte[] ply = Encoding.UTF8.GetBytes(Ply.Replace("2 0 1 5", "5 0 1 2 3 1 5", StringComparison.Ordinal));
            RecordedText.Check("polygons.txt",
            [
                Outcome(() => ObjParser.Parse(new("t.obj", four))), Outcome(() => ObjParser.Parse(new("t.obj", five))),
                Outcome(() => ObjReader.Read(new MemoryStream(Encoding.UTF8.GetBytes(five)), "t.obj")),
                Outcome(() => PlyReader.Read(new MeshBytes("t.ply", ply))),
            ]);
        }
        finally
        {
            ParsingLimits.PolygonCorners.Value = ParsingLimits.PolygonCorners.Default;
        }
    }

    [Fact]
    public void Progress_OfALongText_IsReportedEveryMebibyte()
    {
        const string line = "v 0.12345678 1 2\n";
        string text = "v 0 0 0\n" + string.Concat(Enumerable.Repeat(line, 260_000)) + "f 1 2 3\n";
        List<double> grammar = [], reader = [];
        ObjParser.Parse(new("t.obj", text), new Reports(grammar));
        ObjReader.Read(new MemoryStream(Encoding.UTF8.GetBytes(text)), "t.obj", new Reports(reader), threadCount: 1);
        RecordedText.Check("progress.txt", ((List<double>[])[grammar, reader]).Select(reports => string.Join(' ',
            reports.Select(RecordedText.Text))));
    }

    private string Outcome(Func<object> read) => MeshTexts.Outcome(_folder.Path, read);

    private string Write(string name, byte[] bytes)
    {
        File.WriteAllBytes(_folder[name], bytes);
        return _folder[name];
    }

    private static void Sweep(string file, string[] texts, Func<string, ParsedObj> parse)
    {
        var sweep = new FaultSweep();
        foreach (string text in texts)
        {
            sweep.Run(text, variant =>
            {
                var parsed = parse(variant);
                return ($"{MeshTexts.Sums(parsed.Mesh)} {parsed.ByteCount} "
                    + $"{Description.Of(parsed.MaterialLibraryPositions.Select(position => position.Offset))} "
                    + Description.Of(parsed.MaterialPositions.ToDictionary(pair => pair.Key, pair => pair.Value.Offset)), parsed.Warnings);
            });
        }

        RecordedText.Check(file, sweep.Lines());
    }

    private static byte[] BinaryPly(string type, bool isBig, string[] properties)
    {
        string header = $"ply\nformat binary_{(isBig ? "big" : "little")}_endian 1.0\nelement vertex "
            + $"4\n{string.Concat(properties.Select(name => $"property {type} {name}\n"))}"
            + $"element face 1\nproperty list {(type is "float" or "double" or "float32" or "float64" ? "uchar" : type)} int "
                + $"vertex_index\nend_header\n";
        var bytes = new List<byte>(Encoding.ASCII.GetBytes(header));
        int[] corners = [0, 0, 0, 3, 1, 0, 2, 4, 1, 1, 3, 2];
        for (int vertex = 0; vertex < 4; vertex++)
        {
            for (int property = 0; property < properties.Length; property++)
            {
                bytes.AddRange(Number(type, property < 3 ? corners[(3 * vertex) + property] : (7 * vertex) + (3 * property), isBig));
            }
        }

        bytes.AddRange(Number(type is "float" or "double" or "float32" or "float64" ? "uchar" : type, 4, isBig));
        foreach (int corner in (int[])[0, 1, 2, 3])
        {
            bytes.AddRange(Number("int", corner, isBig));
        }

        return [.. bytes];
    }

    private static byte[] Number(string type, int value, bool isBig)
    {
        byte[] bytes = type switch
        {
            "char" or "uchar" or "int8" or "uint8" => [(byte)value],
            "short" or "ushort" or "int16" or "uint16" => BitConverter.GetBytes((short)value),
            "int" or "uint" or "int32" or "uint32" => BitConverter.GetBytes(value),
            "float" or "float32" => BitConverter.GetBytes((float)value),
            _ => BitConverter.GetBytes((double)value),
        };
        return isBig ? [.. bytes.Reverse()] : bytes;
    }

    private sealed class Reports(List<double> values) : IProgress<double>
    {
        public void Report(double value) => values.Add(value);
    }
}
