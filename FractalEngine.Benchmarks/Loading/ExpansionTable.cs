using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Fractals;

namespace FractalEngine.Benchmarks.Loading;

/// <summary>How long does it take to expand a fractal, to all matrices and to all faces, beside copying as many bytes?</summary>
internal static class ExpansionTable
{
    private const long MaxInstances = 4_000_000;
    private const long MaxFaces = 3_000_000;
    private const int BytesPerMap = 12 * sizeof(double);

    /// <summary>Measures and writes all rows of the table.</summary>
    public static void Write(TableOptions options)
    {
        var table = options.CreateTable("expansion.csv", "fractal", "depth", "what", "count", "ms", "million_a_second", "copy_ms");
        (string Name, int MaxDepth)[] cases =
            [("menger", options.IsQuick ? 4 : 5), ("sierpinski", options.IsQuick ? 6 : 7), ("tree", options.IsQuick ? 14 : 18)];
        foreach (var (name, maxDepth) in cases)
        {
            for (var depth = 1; depth <= maxDepth; depth++)
            {
                AddFractal(table, name, depth, FractalCase.Load(name, depth).Fractal, Math.Max(3, options.Rounds / 2));
            }
        }

        table.Save();
    }

    private static void AddFractal(CsvTable table, string name, int depth, Fractal fractal, int rounds)
    {
        if (!(fractal.InstanceCount <= MaxInstances))
        {
            return;
        }

        var instances = (long)fractal.InstanceCount;
        AddRow("instances", instances, () => FractalGenerator.Expand(fractal, MaxInstances), BytesPerMap * instances);
        if (fractal.FaceCount <= MaxFaces)
        {
            var mesh = FractalGenerator.Flatten(fractal, MaxFaces);
            var bytes = (sizeof(double) * (long)mesh.Positions.Length) + (sizeof(int) * (long)mesh.VertexIndices.Length);
            AddRow("faces", mesh.FaceCount, () => FractalGenerator.Flatten(fractal, MaxFaces), bytes);
        }

        void AddRow(string kind, long count, Action expand, long bytes)
        {
            var source = new byte[bytes];
            var times = InterleavedTiming.MeasureBestSeconds([expand, () => source.AsSpan().ToArray()], rounds);
            table.Add(
                name, depth, kind, count, Math.Round(1e3 * times[0], 4), Math.Round(count / times[0] / 1e6, 3),
                Math.Round(1e3 * times[1], 4));
        }
    }
}
