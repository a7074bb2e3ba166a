using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>Runs the command <c>growth</c>, whose arguments are names of tables and options.</summary>
internal static class GrowthCommand
{
    private const string Usage = """
        growth [TABLE ...] [--quick] [--output FOLDER]
          How does cost grow? Writes a file for each table, or the named ones, to docs/benchmarks unless stated.
        """;

    private static readonly Dictionary<string, Action<TableOptions>> Tables = new()
    {
        ["growth-depth"] = GrowthByDepth.Write,
        ["growth-million"] = DeepPercentiles.Write,
        ["growth-bodies"] = GrowthByBodies.Write,
        ["growth-maps"] = GrowthByMaps.Write,
        ["growth-wide"] = GrowthByWidth.Write,
        ["growth-faces"] = GrowthByFaces.Write,
        ["growth-objects"] = GrowthByObjects.Write,
        ["drawing"] = DrawingGrowth.Write,
    };

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        var isQuick = false;
        string? output = null;
        var names = new List<string>();
        var parser = new CommandLineParser($"{Usage}\nTables: {string.Join(' ', Tables.Keys)}")
            .Flag("--quick", () => isQuick = true)
            .Option("--output", folder => output = folder)
            .Names(Tables.ContainsKey, names);
        if (!parser.TryParse(args))
        {
            return 2;
        }

        var options = new TableOptions("growth", isQuick, output ?? CommandLineParser.FolderFor(isQuick));
        foreach (var (name, write) in Tables.Where(table => names.Count == 0 || names.Contains(table.Key)))
        {
            var watch = Stopwatch.StartNew();
            write(options);
            Console.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{name,-16} {watch.Elapsed.TotalSeconds,6:F1} s"));
        }

        return 0;
    }
}
