using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Scenes;

namespace FractalEngine.Benchmarks.Physics;

/// <summary>Runs the command <c>physics</c>, whose arguments are names of fractals and options.</summary>
internal static class PhysicsCommand
{
    private const string Usage = """
        physics [NAME[:DEPTH] ...] [--balls N] [--collider NAME] [--rounds N] [--output FOLDER]
          What a step costs while balls fall on a fractal; menger:5 and 1,000 balls unless stated.
          --output: also as physics.csv.
        """;

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        var rounds = 3;
        var bodyCount = 1000;
        var collider = ColliderKind.Exact;
        string? folder = null;
        var names = new List<string>();
        var parser = new CommandLineParser($"{Usage}\nNames: {string.Join(' ', FractalCase.Names)}")
            .Count("--rounds", count => rounds = count)
            .Count("--balls", count => bodyCount = count)
            .Option("--collider", text => TryParse(text, out collider))
            .Option("--output", value => folder = value)
            .Names(FractalCase.IsKnown, names);
        if (!parser.TryParse(args))
        {
            return 2;
        }

        var nameList = string.Concat(names.Select(name => " " + name));
        var colliderName = SceneParser.GetColliderName(collider);
        var command = FormattableString.Invariant($"physics{nameList} --balls {bodyCount} --collider {colliderName} --rounds {rounds}");
        var csv = folder is null ? null : new CsvTable(Path.Combine(folder, "physics.csv"), command, PhysicsTable.Columns);
        var table = new PhysicsTable(rounds, Console.Out, csv);
        foreach (var name in names.Count > 0 ? names : ["menger:5"])
        {
            table.Write(FractalCase.Parse(name), bodyCount, collider);
        }

        csv?.Save();
        return 0;
    }

    private static bool TryParse(string text, out ColliderKind collider)
    {
        collider = Enum.GetValues<ColliderKind>().FirstOrDefault(kind => SceneParser.GetColliderName(kind) == text);
        return SceneParser.GetColliderName(collider) == text;
    }
}
