using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Approximation;

/// <summary>Runs the command <c>approximate</c>, whose arguments are options.</summary>
internal static class ApproximationCommand
{
    private const string WeightsFile = "FractalEngine.Core/Approximation/Damaged/generators.txt";
    private const int DamagedFaces = 3_000;

    private const string Usage = """
        approximate [models] [--quick] [--output FOLDER]
          How often does the search find what made a mesh, how many faces are left, and in what time? The meshes are expanded fractals
          and models that repeat, which it was not written for, see Approximation/Unseen, some of them damaged. Writes to
          docs/benchmarks unless stated: approximation.csv. With 'models', what is found for the fractals of the assets, and how
          close it comes to irregular shapes: approximation-models.csv.
        approximate train [--output FILE]
          Trains the network that ranks the maps of damaged trees, from its seeds, in minutes: the same machine writes the same bytes.
          Writes to FractalEngine.Core/Approximation/Damaged/generators.txt unless stated.
        approximate ranking [--quick] [--output FOLDER]
          How often are all maps of a damaged tree among the first, ranked by votes, a score, neighbours, the network or nothing?
          Writes approximation-ranking.csv.
        approximate samples FOLDER
          Writes models that repeat, or are damaged or irregular, as OBJ files to try it on.
        """;

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        if (args is ["samples", var folder])
        {
            SampleModels.Write(folder);
            return 0;
        }

        if (args is ["train", .. var rest])
        {
            var path = WeightsFile;
            if (!new CommandLineParser(Usage).Option("--output", file => path = file).TryParse(rest))
            {
                return 2;
            }

            RankingTable.Train(path);
            return 0;
        }

        var table = args is ["models" or "ranking", ..] ? args[0] : "";
        if (TableOptions.TryParse($"approximate {table}".Trim(), Usage, table.Length > 0 ? args[1..] : args) is not { } options)
        {
            return 2;
        }

        if (table == "ranking")
        {
            RankingTable.Write(options);
        }
        else if (table == "models")
        {
            ModelTable.Write(options);
        }
        else
        {
            WriteRates(options);
        }

        return 0;
    }

    private static void WriteRates(TableOptions options)
    {

        var table = options.CreateTable(
            "approximation.csv", "kind", "faces", "damage", "cases", "found", "wrong", "median_s", "max_s",
            "median_maps", "median_base_faces", "median_ratio");
        foreach (var faces in options.IsQuick ? new[] { 3_000 } : [3_000, 30_000, 100_000])
        {
            foreach (var kind in Enum.GetValues<FractalKind>())
            {
                var inputs = Enumerable.Range(0, options.IsQuick ? 10 : 20).Select(seed => UnseenFractals.Create(kind, seed, faces));
                AddRow(table, kind.ToString(), faces, Damage.None, inputs);
            }
        }

        var flipped = new Damage(DamageKind.FlippedEdges, 0.5);
        foreach (var (repeats, damage) in options.IsQuick ? new[] { (30, Damage.None) }
            : [(30, Damage.None), (30, flipped), (100, Damage.None), (1000, Damage.None)])
        {
            foreach (var kind in Enum.GetValues<RepeatKind>())
            {
                var inputs = Enumerable.Range(0, options.IsQuick ? 3 : 10).Select(seed => RepeatingModels.Create(kind, seed, repeats));
                AddRow(table, FormattableString.Invariant($"{kind} x {repeats}"), null, damage, inputs);
            }
        }

        foreach (var damaged in Damage.All.Where(damage => damage != Damage.None))
        {
            foreach (var kind in Enum.GetValues<FractalKind>())
            {
                var inputs = Enumerable.Range(0, options.IsQuick ? 2 : 10).Select(seed => UnseenFractals.Create(kind, seed, DamagedFaces));
                AddRow(table, kind.ToString(), DamagedFaces, damaged, inputs.Where(damaged.IsMeaningful));
            }
        }

        table.Save();
    }

    private static void AddRow(CsvTable table, string kind, int? faces, Damage damage, IEnumerable<UnseenInput> inputs)
    {
        var outcomes = new List<SearchOutcome>();
        foreach (var input in inputs)
        {
            outcomes.Add(SearchOutcome.Measure(damage.Apply(input, input.Seed), damage));
            Console.WriteLine($"{kind} {input.Seed} {damage.Name}: {outcomes[^1]}");
        }

        if (outcomes.Count == 0)
        {
            return;
        }

        var found = outcomes.Where(outcome => outcome.IsFound).ToList();
        table.Add(
            kind, faces ?? Median(outcomes, outcome => outcome.ModelFaces), damage.Name, outcomes.Count, found.Count,
            outcomes.Count(outcome => outcome.IsWrong), Median(outcomes, outcome => outcome.Seconds),
            Math.Round(outcomes.Max(outcome => outcome.Seconds), 3), Median(found, outcome => outcome.MapCount),
            Median(found, outcome => outcome.BaseFaces), Median(found, outcome => (double)outcome.ModelFaces / outcome.BaseFaces));
    }

    private static double? Median(List<SearchOutcome> outcomes, Func<SearchOutcome, double> valueOf) => outcomes.Count == 0
        ? null
        : Math.Round(outcomes.Select(valueOf).Order().ElementAt(outcomes.Count / 2), 3);
}
