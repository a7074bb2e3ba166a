using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Fractals;

namespace FractalEngine.Benchmarks.Loading;

/// <summary>How long does it take to write a fractal out: all matrices, then all faces, beside copying as many bytes?</summary>
internal static class ExpansionTable
{
    private const long MostInstances = 4_000_000;
    private const long MostFaces = 3_000_000;
    private const int BytesOfMap = 12 * sizeof(double);

    /// <summary>Writes the file.</summary>
    public static void Write(TableOptions options)
    {
        var table = options.Table("expansion.csv", "fractal", "depth", "what", "count", "ms", "million_a_second", "copy_ms");
        foreach (var (name, deepest) in ((string, int)[])[("menger", options.IsQuick ? 4 : 5), ("sierpinski", options.IsQuick ? 6 : 7),
            ("tree", options.IsQuick ? 14 : 18)])
        {
            for (var depth = 1; depth <= deepest; depth++)
            {
                Add(table, name, depth, FractalCase.Load(name, depth).Fractal, Math.Max(3, options.Rounds / 2));
            }
        }

        table.Save();
    }

    private static void Add(CsvTable table, string name, int depth, Fractal fractal, int rounds)
    {
        if (!(fractal.InstanceCount <= MostInstances))
        {
            return;
        }

        var instances = (long)fractal.InstanceCount;
        AddRow("instances", instances, () => FractalGenerator.Expand(fractal, MostInstances), BytesOfMap * instances);
        if (fractal.FaceCount <= MostFaces)
        {
            var mesh = FractalGenerator.Flatten(fractal, MostFaces);
            AddRow("faces", mesh.FaceCount, () => FractalGenerator.Flatten(fractal, MostFaces),
                (sizeof(double) * (long)mesh.Positions.Length) + (sizeof(int) * (long)mesh.VertexIndices.Length));
        }

        void AddRow(string what, long count, Action expand, long bytes)
        {
            var source = new byte[bytes];
            var times = TakeTurns.Best([expand, () => source.AsSpan().ToArray()], rounds);
            table.Add(name, depth, what, count, Math.Round(1e3 * times[0], 4), Math.Round(count / times[0] / 1e6, 3),
                Math.Round(1e3 * times[1], 4));
        }
    }
}
