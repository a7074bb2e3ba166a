using System.Globalization;
using System.Text;
using FractalEngine.Core.Files;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>
/// Runs the command <c>merge</c>: makes one table of those that several runs of a command have written. Each number is the median of the
/// runs, and a column behind all others says how far they lie apart, for each column in which runs differ.
/// </summary>
internal static class MergeCommand
{
    /// <summary>End of the names of columns with (largest − least) / median of another column's numbers in all runs, in percent.</summary>
    public const string SpreadColumnEnd = "_spread_percent";

    private const string Usage = """
        merge [--output FOLDER] RUN ...
          Merges the tables of folders, one for each run of the same command, into one of medians and spreads,
          into docs/benchmarks unless stated. Writes the median and the largest spread of each column to stdout.
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
            PrintSpreads(ParsedCsv.Parse(merged), file!);
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

        var text = new StringBuilder($"{first.Comments[0]} (medians of {runs.Length} runs)\n");
        text.AppendJoin("", first.Comments.Skip(1).Select(comment => comment + "\n"));
        int[] columns = [.. Enumerable.Range(0, first.Header.Length)
            .Where(column => runs.Any(run => !run.Rows.Select(row => row[column]).SequenceEqual(first.Rows.Select(row => row[column]))))];
        AppendLine(text, first.Header.Concat(columns.Select(column => first.Header[column] + SpreadColumnEnd)));
        for (var row = 0; row < first.Rows.Length; row++)
        {
            var fields = (string[])first.Rows[row].Clone();
            var spreads = new List<string>();
            foreach (var column in columns)
            {
                string[] all = [.. runs.Select(run => run.Rows[row][column])];
                if (all.All(field => field == ""))
                {
                    spreads.Add("");
                    continue;
                }

                var numbers = all.Select(field => Parse(field, $"{file}, row {row + 1}, {first.Header[column]}")).ToArray();
                Array.Sort(numbers, all);
                var median = (runs.Length - 1) / 2;
                fields[column] = all[median];
                // Where the median is rounded to zero, as times of a sleeping heap are, the largest stands for it.
                var size = Math.Abs(numbers[median] == 0 ? numbers[^1] : numbers[median]);
                var spread = numbers[^1] == numbers[0] ? 0 : 100 * (numbers[^1] - numbers[0]) / size;
                spreads.Add(spread.ToString("F1", CultureInfo.InvariantCulture));
            }

            AppendLine(text, fields.Concat(spreads));
        }

        return text.ToString();
    }

    private static void PrintSpreads(ParsedCsv table, string file)
    {
        foreach (var column in table.Header.Where(column => column.EndsWith(SpreadColumnEnd, StringComparison.Ordinal)))
        {
            var spreads = table.Column(column).Where(field => field != "").Select(ParsedCsv.ParseNumber).Order().ToArray();
            Console.WriteLine(FormattableString.Invariant($"{file},{column},{spreads[spreads.Length / 2]},{spreads[^1]}"));
        }
    }

    private static void AppendLine(StringBuilder text, IEnumerable<string> fields) =>
        text.AppendJoin(',', fields.Select(CsvTable.Quote)).Append('\n');

    private static double Parse(string field, string place) =>
        double.TryParse(field, NumberStyles.Float, CultureInfo.InvariantCulture, out var number)
            ? number
            : throw new InvalidDataException($"{place}: '{field}' is no number, and differs between the runs");
}
