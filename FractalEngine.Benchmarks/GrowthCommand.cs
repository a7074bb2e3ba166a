using System.Diagnostics;
using System.Globalization;

namespace FractalEngine.Benchmarks;

/// <summary>The words after <c>growth</c>: tables and options.</summary>
internal static class GrowthCommand
{
    private const string Usage = """
        growth [TABLE ...] [--quick] [--output FOLDER]
          How does cost grow? Writes a file for each table, or the named ones, to docs/benchmarks unless stated.
        """;

    private static readonly Dictionary<string, Action<GrowthOptions>> Tables = new()
    {
        ["growth-depth"] = GrowthByDepth.Write,
        ["growth-bodies"] = GrowthByBodies.Write,
        ["growth-maps"] = GrowthByMaps.Write,
        ["growth-faces"] = GrowthByFaces.Write,
        ["float-double"] = FloatAndDouble.Write,
        ["drawing"] = DrawingGrowth.Write,
    };

    public static int Run(ReadOnlySpan<string> args)
    {
        var (options, names) = (new GrowthOptions(false, DefaultFolder), new List<string>());
        for (var i = 0; i < args.Length; i++)
        {
            switch (args[i])
            {
                case "--quick":
                    options = options with { IsQuick = true };
                    break;
                case "--output" when i + 1 < args.Length:
                    options = options with { Folder = args[++i] };
                    break;
                case { } name when Tables.ContainsKey(name):
                    names.Add(name);
                    break;
                default:
                    Console.Error.WriteLine($"error: unexpected '{args[i]}'\n{Usage}\nTables: {string.Join(' ', Tables.Keys)}");
                    return 2;
            }
        }

        foreach (var (name, write) in Tables.Where(table => names.Count == 0 || names.Contains(table.Key)))
        {
            var watch = Stopwatch.StartNew();
            write(options);
            Console.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{name,-16} {watch.Elapsed.TotalSeconds,6:F1} s"));
        }

        return 0;
    }

    /// <summary>Where measurements are kept.</summary>
    internal static string DefaultFolder => Path.Combine(Path.GetDirectoryName(FractalCase.Assets)!, "docs", "benchmarks");
}
