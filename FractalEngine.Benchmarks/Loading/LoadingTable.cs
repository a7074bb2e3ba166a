using System.Buffers.Text;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Generation;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Wavefront;
using FractalEngine.Parsing.Wavefront.Writing;

namespace FractalEngine.Benchmarks.Loading;

/// <summary>
/// How many megabytes of OBJ a second does the reader take, on one thread and on two, beside the grammar alone, a loop over the framework's
/// numbers that keeps nothing, and a count of lines? And how long do the fractals and scenes of the assets take?
/// </summary>
internal static class LoadingTable
{
    private static double _sink;

    /// <summary>Paths of all fractals and scenes of the assets, ordered.</summary>
    public static IEnumerable<string> AssetFiles => Directory.GetFiles(Path.Combine(FractalCase.Assets, "fractals"), "*.fdo")
        .Concat(Directory.GetFiles(Path.Combine(FractalCase.Assets, "scenes"), "*.sdo")).Order(StringComparer.Ordinal);

    /// <summary>Measures and writes all rows of the table.</summary>
    public static void Write(TableOptions options)
    {
        var table = options.CreateTable("loading.csv", "file", "faces", "bytes", "step", "ms", "megabytes_a_second");
        var folder = Directory.CreateTempSubdirectory("fractalengine");
        try
        {
            var file = Path.Combine(folder.FullName, "sample.obj");
            foreach (var sample in ObjSample.All)
            {
                sample.Write(file, options.IsQuick ? 300 : 800);
                AddMesh(table, sample.Name, file, options.Rounds);
            }

            foreach (var (name, faces) in MeshSizes(options.IsQuick))
            {
                using (var stream = File.Create(file))
                {
                    ObjMeshWriter.Write(MeshGenerators.Create(name, 1, faces), stream, name);
                }

                AddMesh(table, name, file, options.Rounds);
            }
        }
        finally
        {
            folder.Delete(recursive: true);
        }

        foreach (var file in AssetFiles)
        {
            var milliseconds = InterleavedTiming.MeasureBestMilliseconds(() => AssetLoader.Load(file), options.Rounds);
            var bytes = new FileInfo(file).Length;
            table.Add(Path.GetFileName(file), null, bytes, "load with all it refers to", Math.Round(milliseconds, 4), null);
        }

        table.Save();
    }

    /// <summary>Counts the words of a text, which any parser has to find.</summary>
    public static int CountWords(string text)
    {
        var count = 0;
        foreach (var line in text.AsSpan().EnumerateLines())
        {
            foreach (var _ in line.Split(' '))
            {
                count++;
            }
        }

        return count;
    }

    private static IEnumerable<(string Name, int? Faces)> MeshSizes(bool isQuick)
    {
        yield return ("terrain", 10_000);
        yield return ("tree-stump", null);
        yield return ("spaceship-interior", null);
        if (!isQuick)
        {
            yield return ("icosphere", 1_310_720);
        }
    }

    private static void AddMesh(CsvTable table, string name, string file, int rounds)
    {
        var bytes = File.ReadAllBytes(file);
        (string Step, Action Run)[] steps =
        [
            ("count the line feeds", () => _sink = bytes.AsSpan().Count((byte)'\n')),
            ("read numbers with Utf8Parser, keep nothing", () => _sink = SumNumbers(bytes)),
            ("read by the grammar alone", () => ObjParser.Parse(SourceText.Read(file, file, ParsingLimits.ObjBytes.Value))),
            ("read on one thread", () => Read(file, threadCount: 1)),
            ("read on two threads", () => Read(file, threadCount: 2)),
        ];
        var faceCount = MeshFile.Read(file).FaceCount;
        var times = InterleavedTiming.MeasureBestSeconds([.. steps.Select(step => step.Run)], rounds);
        foreach (var ((step, _), seconds) in steps.Zip(times))
        {
            table.Add(name, faceCount, bytes.Length, step, Math.Round(1e3 * seconds, 4), Math.Round(bytes.Length / seconds / 1e6, 1));
        }
    }

    private static void Read(string file, int threadCount)
    {
        using var stream = SourceText.OpenFile(file, file, ParsingLimits.ObjBytes.Value);
        ObjReader.Read(stream, file, threadCount: threadCount);
    }

    /// <summary>
    /// Adds up the numbers of a text by the framework's fastest conversion and keeps nothing, as a parser without any checks would.
    /// </summary>
    private static double SumNumbers(ReadOnlySpan<byte> text)
    {
        var sum = 0.0;
        foreach (var word in text.SplitAny(" \n"u8))
        {
            sum += Utf8Parser.TryParse(text[word], out double number, out _) ? number : 0;
        }

        return sum;
    }
}
