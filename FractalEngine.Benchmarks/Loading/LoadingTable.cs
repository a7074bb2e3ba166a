using System.Buffers.Text;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Benchmarks.Loading;

/// <summary>
/// How many megabytes of OBJ a second: bytes read, words split, every number read by the framework, the text parsed, and the file loaded
/// with all that a scene needs? And how long do the texts of the assets' fractals and scenes take?
/// </summary>
internal static class LoadingTable
{
    private const long ByteLimit = 1L << 30;

    /// <summary>Writes the file.</summary>
    public static void Write(TableOptions options)
    {
        var table = options.CreateTable("loading.csv", "file", "faces", "bytes", "step", "ms", "megabytes_a_second");
        var folder = Directory.CreateTempSubdirectory("fractalengine");
        try
        {
            foreach (var (name, faces) in MeshSizes(options.IsQuick))
            {
                var file = Path.Combine(folder.FullName, $"{name}.obj");
                var mesh = MeshGenerators.Create(name, 1, faces);
                using (var stream = File.Create(file))
                {
                    ObjWriter.Write(mesh, name, stream);
                }

                AddMesh(table, name, mesh, file, options.Rounds);
            }
        }
        finally
        {
            folder.Delete(recursive: true);
        }

        string[] texts = [.. Directory.GetFiles(Path.Combine(FractalCase.Assets, "fractals"), "*.fdo"),
            .. Directory.GetFiles(Path.Combine(FractalCase.Assets, "scenes"), "*.sdo")];
        foreach (var file in texts.Order(StringComparer.Ordinal))
        {
            var seconds = InterleavedTiming.MeasureBestSeconds([() => AssetLoader.Load(file)], options.Rounds)[0];
            var bytes = new FileInfo(file).Length;
            table.Add(Path.GetFileName(file), null, bytes, "load with all it refers to", Math.Round(1e3 * seconds, 4), null);
        }

        table.Save();
    }

    private static IEnumerable<(string Name, int? Faces)> MeshSizes(bool isQuick) =>
        [("terrain", 10_000), ("tree-stump", null), ("spaceship-interior", null), .. isQuick
        ? Array.Empty<(string, int?)>()
        : [("icosphere", 1_310_720)]];

    private static void AddMesh(CsvTable table, string name, Mesh mesh, string file, int rounds)
    {
        var bytes = File.ReadAllBytes(file);
        var source = SourceText.Decode(bytes, file);
        (string Step, Action Do)[] steps =
        [
            ("read the bytes", () => File.ReadAllBytes(file)),
            ("split into words", () => _sink = CountWords(source.Text)),
            ("split, and read numbers with Utf8Parser", () => _sink = SumNumbers(bytes)),
            ("read and decode", () => SourceText.Read(file, file, ByteLimit)),
            ("parse", () => ObjParser.Parse(source)),
            ("load", () => AssetLoader.Load(file)),
        ];
        var times = InterleavedTiming.MeasureBestSeconds([.. steps.Select(step => step.Do)], rounds);
        foreach (var (step, seconds) in steps.Zip(times))
        {
            table.Add(name, mesh.FaceCount, bytes.Length, step.Step, Math.Round(1e3 * seconds, 4),
                Math.Round(bytes.Length / seconds / 1e6, 1));
        }
    }

    private static double _sink;

    /// <summary>What any parser has to do.</summary>
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

    /// <summary>
    /// The same with the framework's fastest conversion, and nothing kept: about what a parser without checks would take.
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
