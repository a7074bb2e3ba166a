using System.Globalization;
using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>Runs the command <c>frames</c>, whose arguments are names of frames and options.</summary>
internal static class FramesCommand
{
    private const string Usage = """
        frames [NAME[:DEPTH]:VIEWPOINT ...] [--rounds N] [--samples N] [--no-truth] [--output FOLDER]
          What a frame of a fractal costs, with culling and with every instance. VIEWPOINT is afar, close or inside.
          --output: also as frames.csv.
        """;

    private static readonly string[] DefaultCases =
    [
        "menger:5:afar", "menger:5:close", "menger:5:inside", "tetrahedron:12:afar", "appendix-b:5:afar", "appendix-b-structure:5:afar",
        "binary-tree:14:afar", "menger:20:afar", "menger:1000000:afar", "infinite-menger:inside",
    ];

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        var rounds = 5;
        var samples = 0;
        var withTruth = true;
        string? folder = null;
        var names = new List<string>();
        var parser = new CommandLineParser($"{Usage}\nNames: {string.Join(' ', FractalCase.Names)}")
            .Count("--rounds", count => rounds = count)
            .Option("--samples", text => int.TryParse(text, NumberStyles.None, CultureInfo.InvariantCulture, out samples))
            .Flag("--no-truth", () => withTruth = false)
            .Option("--output", value => folder = value)
            .Names(IsKnown, names);
        if (!parser.TryParse(args))
        {
            return 2;
        }

        var nameList = string.Concat(names.Select(name => " " + name));
        var truthOption = withTruth ? "" : " --no-truth";
        var command = FormattableString.Invariant($"frames{nameList} --rounds {rounds} --samples {samples}{truthOption}");
        var csv = folder is null ? null : new CsvTable(Path.Combine(folder, "frames.csv"), command, FrameTable.Columns);
        var table = new FrameTable(rounds, samples, withTruth, Console.Out, csv);
        table.Write((names.Count > 0 ? names : [.. DefaultCases]).Select(FrameCase.Parse));
        csv?.Save();
        return 0;
    }

    private static bool IsKnown(string text) =>
        text.LastIndexOf(':') is > 0 and var colon && text[(colon + 1)..] is "afar" or "close" or "inside"
        && FractalCase.IsKnown(text[..colon]);
}
