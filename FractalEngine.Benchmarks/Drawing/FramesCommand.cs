using System.Globalization;
using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>The words after <c>frames</c>: pictures and options.</summary>
internal static class FramesCommand
{
    private const string Usage = """
        frames [NAME[:DEPTH]:PLACE ...] [--rounds N] [--samples N] [--no-truth] [--output FOLDER]
          What a picture of a fractal costs, with all that is not seen left out and with every instance. PLACE is afar, close or inside.
          --output: also as frames.csv.
        """;

    private static readonly string[] DefaultCases =
    [
        "menger:5:afar", "menger:5:close", "menger:5:inside", "tetrahedron:12:afar", "appendix-b:5:afar", "appendix-b-structure:5:afar",
        "binary-tree:14:afar",
        "menger:20:afar", "menger:1000000:afar", "infinite-menger:inside",
    ];

    public static int Run(ReadOnlySpan<string> args)
    {
        var (rounds, samples, withTruth, folder, names) = (5, 0, true, (string?)null, new List<string>());
        var words = new CommandLineParser($"{Usage}\nNames: {string.Join(' ', FractalCase.Names)}")
            .Count("--rounds", count => rounds = count)
            .Option("--samples", text => int.TryParse(text, NumberStyles.None, CultureInfo.InvariantCulture, out samples))
            .Flag("--no-truth", () => withTruth = false).Option("--output", value => folder = value).Names(IsKnown, names);
        if (!words.TryParse(args))
        {
            return 2;
        }

        var command =
            FormattableString.Invariant(
                $"frames {string.Join(' ', names)} --rounds {rounds} --samples {samples}{(withTruth ? "" : " --no-truth")}")
                .Replace("  ", " ", StringComparison.Ordinal);
        var csv = folder is null ? null : new CsvTable(Path.Combine(folder, "frames.csv"), command, FrameTable.Columns);
        new FrameTable(rounds, samples, withTruth, Console.Out,
            csv).Write((names.Count > 0 ? names : [.. DefaultCases]).Select(FrameCase.Parse));
        csv?.Save();
        return 0;
    }

    private static bool IsKnown(string text) =>
        text.LastIndexOf(':') is > 0 and var colon && text[(colon + 1)..] is "afar" or "close" or "inside"
        && FractalCase.IsKnown(text[..colon]);
}
