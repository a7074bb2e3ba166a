using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>Runs the command <c>front</c>, whose arguments are names of shapes and options.</summary>
internal static class ParetoFrontCommand
{
    private const string Usage = """
        front [NAME[:NUMBER] ...] [--quick] [--output FOLDER]
          Which collider for which error? Writes front.csv, into docs/benchmarks or, with --quick, out/benchmarks unless stated.
          A number is a fractal's depth or a mesh's faces.
          Fractals of more than 3,000,000 faces have rows without errors, of their own colliders only.
          --quick: smaller shapes and fewer positions.
        """;

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        var isQuick = false;
        string? output = null;
        var names = new List<string>();
        var parser = new CommandLineParser(Usage)
            .Flag("--quick", () => isQuick = true)
            .Option("--output", value => output = value)
            .Names(BenchmarkShape.IsKnown, names);
        if (!parser.TryParse(args))
        {
            return 2;
        }

        var command = string.Join(' ', (string[])["front", .. names, .. isQuick ? ["--quick"] : Array.Empty<string>()]);
        var folder = output ?? CommandLineParser.FolderFor(isQuick);
        var csv = new CsvTable(Path.Combine(folder, "front.csv"), command, ParetoFrontTable.Columns);
        var table = isQuick ? new ParetoFrontTable(400, 10, csv) : new ParetoFrontTable(1000, 20, csv);
        foreach (var name in names.Count > 0 ? [.. names] : isQuick ? BenchmarkShape.Quick : BenchmarkShape.Default)
        {
            Console.WriteLine($"front: {name}");
            table.Add(BenchmarkShape.Create(name));
        }

        csv.Save();
        return 0;
    }
}
