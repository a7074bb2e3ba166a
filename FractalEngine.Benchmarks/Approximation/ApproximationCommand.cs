using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Approximation;

/// <summary>Runs the command <c>approximate</c>, whose arguments are options.</summary>
internal static class ApproximationCommand
{
    private const int DamagedFaces = 3_000;

    private const string Usage = """
        approximate [--quick] [--output FOLDER]
          How often does the search find what made a mesh, and in what time? The meshes are expanded fractals that it was not written
          for, see Approximation/Unseen, whole ones and damaged ones. Writes to docs/benchmarks unless stated: approximation.csv.
        """;

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        if (TableOptions.TryParse("approximate", Usage, args) is not { } options)
        {
            return 2;
        }

        var table = options.CreateTable(
            "approximation.csv", "kind", "faces", "damage", "cases", "found", "wrong", "median_s", "max_s",
            "median_maps", "median_base_faces");
        foreach (var faces in options.IsQuick ? new[] { 3_000 } : [3_000, 30_000, 100_000])
        {
            foreach (var kind in Enum.GetValues<FractalKind>())
            {
                AddRow(table, kind, faces, Damage.None, options.IsQuick ? 10 : 20);
            }
        }

        foreach (var damage in Damage.All.Where(damage => damage != Damage.None))
        {
            foreach (var kind in Enum.GetValues<FractalKind>())
            {
                AddRow(table, kind, DamagedFaces, damage, options.IsQuick ? 2 : 10);
            }
        }

        table.Save();
        return 0;
    }

    private static void AddRow(CsvTable table, FractalKind kind, int faces, Damage damage, int count)
    {
        var outcomes = new List<SearchOutcome>();
        for (var seed = 0; seed < count; seed++)
        {
            var input = UnseenFractals.Create(kind, seed, faces);
            if (damage.IsMeaningful(input))
            {
                outcomes.Add(SearchOutcome.Measure(damage.Apply(input, seed), damage));
                Console.WriteLine($"{kind} {seed} {damage.Name}: {outcomes[^1]}");
            }
        }

        if (outcomes.Count == 0)
        {
            return;
        }

        var found = outcomes.Where(outcome => outcome.IsFound).ToList();
        table.Add(
            kind, faces, damage.Name, outcomes.Count, found.Count, outcomes.Count(outcome => outcome.IsWrong),
            Median(outcomes, outcome => outcome.Seconds), Math.Round(outcomes.Max(outcome => outcome.Seconds), 3),
            Median(found, outcome => outcome.MapCount), Median(found, outcome => outcome.BaseFaces));
    }

    private static double? Median(List<SearchOutcome> outcomes, Func<SearchOutcome, double> valueOf) => outcomes.Count == 0
        ? null
        : Math.Round(outcomes.Select(valueOf).Order().ElementAt(outcomes.Count / 2), 3);
}
