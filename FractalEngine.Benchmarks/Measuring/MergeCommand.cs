using System.Globalization;
using System.Text;
using FractalEngine.Core.Files;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>
/// Runs the command <c>merge</c>: makes one table of those that several runs of a command have written. Each number is the median of the
/// runs, and one more column says how far they lie apart.
/// </summary>
internal static class MergeCommand
{
    /// <summary>
    /// Name of the last column: the largest of (largest − least) / median of the runs, over the numbers of a row, in percent.
    /// </summary>
    public const string SpreadColumn = "spread_percent";

    private const string Usage = """
        merge [--output FOLDER] RUN ...
          Merges the tables of folders, one for each run of the same command, into one of medians and spreads,
          into docs/benchmarks unless stated.
        """;

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    /// <exception cref="InvalidDataException">The tables of two runs differ in more than their numbers.</exception>
    public static int Run(ReadOnlySpan<string> args)
    {
        var output = CommandLineParser.DefaultFolder;
        List<string> runs = [];
        if (!new CommandLineParser(Usage).Option("--output", folder => output = folder).Names(Directory.Exists, runs).TryParse(args))
        {
            return 2;
        }

        if (runs.Count == 0)
        {
            Console.Error.WriteLine($"error: expected folders of tables\n{Usage}");
            return 2;
        }

        foreach (var file in Directory.GetFiles(runs[0], "*.csv").Select(Path.GetFileName).Order(StringComparer.Ordinal))
        {
            var merged = Merge([.. runs.Select(run => ParsedCsv.Read(Path.Combine(run, file!)))], file!);
            AtomicFile.Write(Path.Combine(output, file!), stream => stream.Write(Encoding.UTF8.GetBytes(merged)));
        }

        return 0;
    }

    /// <summary>Merges tables of several runs into the text of one.</summary>
    /// <param name="runs">The tables, at least one.</param>
    /// <param name="file">Name of the file for error messages.</param>
    /// <exception cref="InvalidDataException">The tables differ in more than their numbers.</exception>
    public static string Merge(ParsedCsv[] runs, string file)
    {
        var first = runs[0];
        if (runs.Any(run => !run.Header.SequenceEqual(first.Header) || run.Rows.Length != first.Rows.Length))
        {
            throw new InvalidDataException($"{file}: the runs have other columns or rows");
        }

        var text = new StringBuilder($"{first.Comments[0]}, medians of {runs.Length} runs\n");
        text.AppendJoin("", first.Comments.Skip(1).Select(comment => comment + "\n"));
        text.AppendJoin(',', first.Header.Append(SpreadColumn).Select(CsvTable.Quote)).Append('\n');
        for (var row = 0; row < first.Rows.Length; row++)
        {
            var spread = 0.0;
            for (var column = 0; column < first.Header.Length; column++)
            {
                string[] fields = [.. runs.Select(run => run.Rows[row][column])];
                if (fields.Any(field => field != fields[0]))
                {
                    var numbers = fields.Select(field => Parse(field, $"{file}, row {row + 1}, {first.Header[column]}")).ToArray();
                    Array.Sort(numbers, fields);
                    var median = (runs.Length - 1) / 2;
                    fields[0] = fields[median];
                    spread = Math.Max(spread, (numbers[^1] - numbers[0]) / Math.Abs(numbers[median]));
                }

                text.Append(CsvTable.Quote(fields[0])).Append(',');
            }

            text.AppendLine(CultureInfo.InvariantCulture, $"{100 * spread:F1}");
        }

        return text.ToString();
    }

    private static double Parse(string field, string place) =>
        double.TryParse(field, NumberStyles.Float, CultureInfo.InvariantCulture, out var number)
            ? number
            : throw new InvalidDataException($"{place}: '{field}' is no number, and differs between the runs");
}
