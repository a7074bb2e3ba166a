using System.IO.Compression;
using System.Text;
using FractalEngine.Core.Generation;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Wavefront;
using FractalEngine.Parsing.Wavefront.Writing;
using FractalEngine.Tests.Parsing.Meshes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Wavefront;

/// <summary>The reader of files against the grammar. What the language is, the tests of the grammar tell, which run both too.</summary>
public sealed class ObjReaderTests : IDisposable
{
    private const string Square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    private readonly TemporaryFolder _folder = new();

    private static string[] AssetFiles { get; } = Directory.GetFiles(Repository.Full("assets"), "*.obj", SearchOption.AllDirectories);

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Read_OfEveryAsset_IsWhatTheGrammarReads() =>
        Assert.All(AssetFiles, path => Assert.True(ObjOutcome.AssertSame(File.ReadAllBytes(path))));

    [Fact]
    public void Read_OfMutatedFiles_IsWhatTheGrammarReads() => CheckMutated(3_000);

    [Fact]
    [Trait("Category", "Soak")]
    public void Read_OfAHundredThousandMutatedFiles_IsWhatTheGrammarReads() => CheckMutated(100_000);

    private static void CheckMutated(int cases)
    {
        byte[][] originals = [.. AssetFiles.Select(File.ReadAllBytes)];
        var meshCount = 0;
        Parallel.For(1, cases + 1, seed => Seeded.RunOne(seed, random =>
        {
            var original = seed % 2 == 0 ? ObjMutation.CreateFile(random) : originals[random.Next(originals.Length)];
            if (ObjOutcome.AssertSame(ObjMutation.Mutate(original, random)))
            {
                Interlocked.Increment(ref meshCount);
            }
        }));
        // Both outcomes are frequent.
        Assert.InRange(meshCount, cases / 10, cases * 9 / 10);
    }

    [Theory]
    [InlineData("f 1 2 3\n")]
    [InlineData("f -4 -3 -2\n")]
    [InlineData("f 1 2 3 4\n")]
    [InlineData("f 1/1 2/2 3/3\nf 1 2 3\nf 1//1 2//1 3//1 4//1\n")]
    [InlineData("f 1 2 3\nf 1/-1/-1 2/-2/-1 3//-1 4/1\n")]
    [InlineData("usemtl a\nf 1 2 3\nusemtl b\ng x\nf 1 2 3 4\ns 1\no y\n")]
    [InlineData("v 1 2 3 # comment\nv 1 2 3 .5 .5 .5\r\nv 1 2 \\\n3\nunknown line \nvtx 1 2 \nvnx 1 2 3 \nvx 1\nfx 1 2 3\nl 1 2\rp 1\n\n")]
    public void Read_OfBlockBorders_AtAnyPlace_ChangesNothing(string lines)
    {
        var random = new Random(1);
        var text = new StringBuilder(Square + "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n");
        while (text.Length < 3 * ObjOutcome.SmallBlock)
        {
            text.Append(lines).Append("v 1.25 -2.5 3\n", 0, random.Next(2) * 14).Append('#', random.Next(3)).Append('\n');
        }

        Assert.True(ObjOutcome.AssertSame(Encoding.UTF8.GetBytes(text.ToString())));
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(5)]
    public void Read_OnAnyNumberOfThreads_GivesTheSame(int threadCount)
    {
        using var stream = new MemoryStream();
        ObjMeshWriter.Write(Shapes.Sphere(4), stream, "sphere");
        var bytes = stream.ToArray();
        Assert.Equal(ObjOutcome.OfReader(bytes), ObjOutcome.OfReader(bytes, ObjOutcome.SmallBlock, threadCount));
    }

    [Fact]
    public void Read_OfAFaultInALaterBlock_PointsAtIt()
    {
        var text = string.Concat(Enumerable.Repeat("v 1 2 3\n", 10_000));
        Errors.AssertMessage("test.obj:10001:7: error: vertex 10001 of 10000 so far: it is beyond the last\n  f 1 2 10001\n        ^",
            () => Read(text + "f 1 2 10001\nf 1 2 10002\nv x\n"));
    }

    [Fact]
    public void Read_OfAFaultAndANulBehindIt_NamesTheNul() => Errors.AssertMessage(
        "test.obj:2003:3: error: the file is binary (it has a NUL byte), expected UTF-8 text",
        () => Read("v x\n" + string.Concat(Enumerable.Repeat("v 1 2 3\n", 2000)) + "\r#\n# \0\0\n" + Square));

    [Fact]
    public void Read_OfNulsInManyBlocks_NamesTheFirst() => Errors.AssertMessage(
        "test.obj:2:1: error: the file is binary (it has a NUL byte), expected UTF-8 text",
        () => Read("v 1 2 3\n" + string.Concat(Enumerable.Repeat("\0\n", 5000))));

    /// <summary>A file that a program has reserved and not written yet is zeros without a line break.</summary>
    [Fact]
    public void Read_OfNulsWithoutALineBreak_NamesTheFirstAndTakesLittleMemory()
    {
        byte[] bytes = [.. "v 1 2 3\nv 1"u8, .. new byte[64 << 20]];
        Allocation.RunWithin(8 << 20, () =>
        {
            using var stream = new MemoryStream(bytes);
            Errors.AssertMessage("test.obj:2:4: error: the file is binary (it has a NUL byte), expected UTF-8 text",
                () => ObjReader.Read(stream, "test.obj", threadCount: 1));
            return true;
        });
    }

    [Fact]
    public void Read_OfLatin1BehindAName_ReadsTheNameAsLatin1()
    {
        byte[] bytes = [.. "o gr\u00FC\u00DFe\n"u8, .. ManyVertices, .. "f 1 2 3\n# "u8, 0xFC];
        Assert.True(ObjOutcome.AssertSame(bytes));
        Assert.Equal("gr\u00C3\u00BC\u00C3\u009Fe", ObjOutcome.OfReader(bytes, ObjOutcome.SmallBlock).Mesh!.Groups.Single().ObjectName);
    }

    [Fact]
    public void Read_OfAFaultBeforeLatin1_ShowsItsLineAsLatin1()
    {
        byte[] bytes = [.. "v 1 2 gr\u00FCn\n"u8, .. ManyVertices, .. "# "u8, 0xFC];
        Assert.False(ObjOutcome.AssertSame(bytes));
        Assert.Contains("gr\u00C3\u00BCn", ObjOutcome.OfReader(bytes, ObjOutcome.SmallBlock).Messages, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("\\\n")]
    [InlineData("\\\r\n")]
    [InlineData("\\\r")]
    public void Read_OfALineLongerThanABlock_JoinsIt(string lineBreak)
    {
        var face = "f" + string.Concat(Enumerable.Range(0, 2000).Select(i => $" {1 + (i % 4)}{(i % 3 == 0 ? " " + lineBreak : "")}"));
        Assert.True(ObjOutcome.AssertSame(Encoding.UTF8.GetBytes($"{Square}{face}\n{Square}f 5 6 7\n")));
    }

    [Fact]
    public void Read_OfAByteOrderMark_IgnoresIt() =>
        Assert.Equal(1, ObjReader.Read(_folder.Write("a.obj", "\uFEFFv 1 2 3"), "a").Mesh.VertexCount);

    [Theory]
    [InlineData(Square + "o gr\u00FC\u00DFe \u4E00\r\nf 1 2 3 4\n", true)]
    [InlineData(Square + "# \u4E00\nf 1 2 \u4E00 5\n", false)]
    [InlineData("\uFEFF" + Square, false)]
    [InlineData(Square + "\n#\0", false)]
    [InlineData("", false)]
    public void Read_OfUtf16_IsWhatTheGrammarReads(string text, bool isMesh)
    {
        foreach (var encoding in new[] { Encoding.Unicode, Encoding.BigEndianUnicode })
        {
            byte[] bytes = [.. encoding.GetPreamble(), .. encoding.GetBytes(text)];
            Assert.Equal(isMesh, ObjOutcome.AssertSame(bytes));
            // A half of a character at the end.
            ObjOutcome.AssertSame([.. bytes, (byte)'\n']);
        }
    }

    [Fact]
    public void Read_OfUtf16_IsWhatUtf8Gives()
    {
        byte[] utf16 = [0xFF, 0xFE, .. Encoding.Unicode.GetBytes(Square + "g \u4E00\nf 1 2 3 4\n")];
        Assert.Equal(ObjOutcome.OfReader(Encoding.UTF8.GetBytes(Square + "g \u4E00\nf 1 2 3 4\n")).Mesh, ObjOutcome.OfReader(utf16).Mesh);
    }

    [Fact]
    public void Read_OfACompressedFile_IsWhatItsContentsGive()
    {
        var text = string.Concat(Enumerable.Repeat(Square + "f -4 -3 -2 -1\n", 10_000));
        var parsed = ObjReader.Read(Compress("a.obj.gz", text), "a");
        Assert.Equal(ObjReader.Read(_folder.Write("a.obj", text), "a").Mesh, parsed.Mesh);
        Assert.Equal(new FileInfo(_folder["a.obj.gz"]).Length, parsed.ByteCount);
    }

    [Fact]
    public void Read_OfAFaultInACompressedFile_PointsAtIt() => Errors.AssertMessage(
        "a:5:7: error: vertex 9 of 4 so far: it is beyond the last\n  f 1 2 9\n        ^",
        () => ObjReader.Read(Compress("a.OBJ.GZ", Square + "f 1 2 9\n"), "a"));

    [Fact]
    public void Read_OfADamagedCompressedFile_SaysSo()
    {
        var bytes = File.ReadAllBytes(Compress("a.obj.gz", string.Concat(Enumerable.Range(0, 5000).Select(i => $"v {i} 2 3\n"))));
        byte[][] damaged = [[], [.. "v 1 2 3\nv 1 2 3\nv 1 2 3\n"u8], bytes[..^1], bytes[..^9], bytes[..(bytes.Length / 2)],
            [.. bytes[..100], (byte)(bytes[100] ^ 1), .. bytes[101..]], [.. bytes[..^6], (byte)(bytes[^6] ^ 1), .. bytes[^5..]]];
        Assert.All(damaged, contents =>
        {
            File.WriteAllBytes(_folder["b.obj.gz"], contents);
            Errors.AssertMessage("b:1:1: error: the file is damaged or not compressed by gzip",
                () => ObjReader.Read(_folder["b.obj.gz"], "b"));
        });
    }

    [Fact]
    public void Decompress_BeyondTheLimit_NamesIt()
    {
        using var file = File.OpenRead(Compress("a.obj.gz", new string('#', 100_001)));
        var error = Errors.ThrownBy(() => CompressedFile.Decompress(file, "a", 100_000));
        Assert.Equal("a:1:1: error: the file has more than the limit of 100000 bytes when decompressed", error.Message);
        Assert.True(error.Diagnostic.IsLimitExceeded);
        file.Position = 0;
        Assert.Equal(100_001, CompressedFile.Decompress(file, "a", 100_001).Length);
    }

    [Fact]
    public void Decompress_OfALargeFile_AllocatesItsSizeOrNothing()
    {
        const int size = 20_000_000;
        using var file = File.OpenRead(Compress("a.obj.gz", new string('#', size)));
        var before = GC.GetAllocatedBytesForCurrentThread();
        Errors.ThrownBy(() => CompressedFile.Decompress(file, "a", size - 1));
        // A buffer, and a message.
        Assert.InRange(GC.GetAllocatedBytesForCurrentThread() - before, 0, 200_000);
        before = GC.GetAllocatedBytesForCurrentThread();
        CompressedFile.Decompress(file, "a", size);
        Assert.InRange(GC.GetAllocatedBytesForCurrentThread() - before, size, size + 200_000);
    }

    private string Compress(string name, string text)
    {
        using var stream = new GZipStream(File.Create(_folder[name]), CompressionLevel.Fastest);
        stream.Write(Encoding.UTF8.GetBytes(text));
        return _folder[name];
    }

    [Fact]
    public void Read_OfAFileThatShrinksMeanwhile_SaysThatItCannotBeRead() => Assert.StartsWith(
        "test.obj:1:1: error: the file can't be read: ",
        Errors.MessageOf(() => ObjReader.Read(new ShrinkingStream(Encoding.UTF8.GetBytes(Square)), "test.obj")), StringComparison.Ordinal);

    [Fact]
    public void Read_BeyondTheLimit_NamesIt()
    {
        using (var file = File.Create(_folder["a.obj"]))
        {
            file.SetLength(ParsingLimits.ObjBytes.Value + 1);
        }

        var limit = ParsingLimits.ObjBytes.Value;
        Errors.AssertMessage($"a:1:1: error: the file has {limit + 1} bytes, more than the limit of {limit}",
            () => ObjReader.Read(_folder["a.obj"], "a"));
    }

    [Fact]
    public void Progress_NeverRunsBackwards()
    {
        List<double> reports = [];
        // Latin-1 at the end makes the reader begin again.
        byte[] bytes = [.. Encoding.UTF8.GetBytes(string.Concat(Enumerable.Repeat("v 1 2 3\n", 600_000))), (byte)'#', 0xFC];
        ObjReader.Read(new MemoryStream(bytes), "test.obj", new Recorder(reports), threadCount: 2);
        Assert.Equal(reports.Order(), reports);
        Assert.Equal(1, reports[^1]);
        Assert.All(reports, report => Assert.InRange(report, 0, 1));
    }

    [Fact]
    public void Read_OfAMillionVertices_TakesTwiceTheMemoryOfItsArrays()
    {
        var bytes = Encoding.UTF8.GetBytes(string.Concat(Enumerable.Repeat("v 1.25 -2.5 3.75\n", 1_000_000)));
        // Twice 24 MB, and the buffers of one block.
        Assert.Equal(1_000_000, Allocation.RunWithin(
            55_000_000, () => ObjReader.Read(new MemoryStream(bytes), "test.obj", threadCount: 1).Mesh.VertexCount));
    }

    private static byte[] ManyVertices => Encoding.UTF8.GetBytes(string.Concat(Enumerable.Repeat(Square, 200)));

    private static ParsedObj Read(string text) =>
        ObjReader.Read(new MemoryStream(Encoding.UTF8.GetBytes(text)), "test.obj", null, ObjOutcome.SmallBlock, threadCount: 2);

    private sealed class ShrinkingStream(byte[] bytes) : MemoryStream(bytes)
    {
        public override long Length => base.Length + 100;
    }

    private sealed class Recorder(List<double> reports) : IProgress<double>
    {
        public void Report(double value) => reports.Add(value);
    }
}
