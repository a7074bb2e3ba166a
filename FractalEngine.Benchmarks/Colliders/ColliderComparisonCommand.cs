using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>The words after <c>table</c>: names of fractals, each with a depth after a colon if wanted, and options.</summary>
internal static class ColliderComparisonCommand
{
    private const string Usage = """
        table [NAME[:DEPTH] ...] [--queries N] [--rounds N]
          What the colliders of fractals cost and how wrong they are, for all fractals of the assets or the named ones.
        """;

    // Depths of other fractals stand in their files.
    private static readonly string[] DefaultFractals =
    [
        "sierpinski:8", "sierpinski:20", "tetrahedron:8", "tetrahedron:20", "menger:4", "menger:12", "appendix-b:3", "appendix-b:5",
        "appendix-b",
        "appendix-b-structure", "diamond", "diamond:10", "fern", "fern:10", "googol", "infinite-menger", "romanesco", "romanesco:8",
        "shell", "snowflake", "snowflake:20",
        "terrain", "terrain:20", "tree", "tree:8", "tree:20", "tree-leaves", "tree-leaves:20", "three-branches:8", "three-branches:20",
        "four-fronds:6", "four-fronds:10",
    ];

    public static int Run(ReadOnlySpan<string> args)
    {
        var (queries, rounds, names) = (2000, 7, new List<string>());
        var words = new CommandLineParser($"{Usage}\nNames: {string.Join(' ', FractalCase.Names)}")
            .Count("--queries", count => queries = count).Count("--rounds", count => rounds = count).Names(FractalCase.IsKnown, names);
        if (!words.TryParse(args))
        {
            return 2;
        }

        new ColliderComparisonTable(queries, rounds,
            Console.Out).Write((names.Count > 0 ? names : [.. DefaultFractals]).Select(FractalCase.Parse));
        return 0;
    }
}
