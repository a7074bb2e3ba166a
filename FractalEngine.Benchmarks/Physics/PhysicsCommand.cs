using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;

namespace FractalEngine.Benchmarks.Physics;

/// <summary>Runs the command <c>physics</c>, whose arguments are names of fractals and options.</summary>
internal static class PhysicsCommand
{
    private const string Heaps = "heaps";
    private const string Movers = "movers";

    private const string Usage = """
        physics [NAME[:DEPTH] ...] [--balls N] [--collider NAME] [--rounds N] [--output FOLDER]
        physics heaps|movers [--rounds N] [--output FOLDER]
          What a step costs while balls fall on a fractal; menger:5 and 1,000 balls unless stated. heaps: how heaps of balls come to
          rest in a box and on a floor. movers: what a plate, a lift and a belt do to balls. Without names all are measured.
          --output: also as physics.csv, physics-heaps.csv and physics-movers.csv.
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
            .Names(name => name is Heaps or Movers || FractalCase.IsKnown(name), names);
        if (!parser.TryParse(args))
        {
            return 2;
        }

        var nameList = string.Concat(names.Select(name => " " + name));
        var colliderName = ColliderNames.Of(collider);
        var command = FormattableString.Invariant($"physics{nameList} --balls {bodyCount} --collider {colliderName} --rounds {rounds}");
        var csv = folder is null ? null : new CsvTable(Path.Combine(folder, "physics.csv"), command, PhysicsTable.Columns);
        var table = new PhysicsTable(rounds, Console.Out, csv);
        var fractals = names.Count > 0 ? names.FindAll(static name => name is not (Heaps or Movers)) : ["menger:5"];
        foreach (var name in fractals)
        {
            table.Write(FractalCase.Parse(name), bodyCount, collider);
        }

        if (fractals.Count > 0)
        {
            csv?.Save();
        }

        if (names.Count == 0 || names.Contains(Heaps))
        {
            WriteHeaps(rounds, folder);
        }

        if (names.Count == 0 || names.Contains(Movers))
        {
            WriteMovers(folder);
        }

        return 0;
    }

    private static void WriteHeaps(int rounds, string? folder)
    {
        var command = FormattableString.Invariant($"physics heaps --rounds {rounds}");
        var csv = folder is null ? null : new CsvTable(Path.Combine(folder, "physics-heaps.csv"), command, HeapTable.Columns);
        var table = new HeapTable(rounds, Console.Out, csv);
        table.Write(1000, friction: 0, isOpen: false, seconds: 10);
        table.Write(1000, friction: 0.5, isOpen: false, seconds: 10);
        table.Write(1000, friction: 0.5, isOpen: true, seconds: 10);
        table.Write(10_000, friction: 0.5, isOpen: false, seconds: 3);
        csv?.Save();
    }

    private static void WriteMovers(string? folder)
    {
        var csv = folder is null ? null : new CsvTable(Path.Combine(folder, "physics-movers.csv"), "physics movers", MoverTable.Columns);
        new MoverTable(Console.Out, csv).Write();
        csv?.Save();
    }

    private static bool TryParse(string text, out ColliderKind collider)
    {
        collider = Enum.GetValues<ColliderKind>().FirstOrDefault(kind => ColliderNames.Of(kind) == text);
        return ColliderNames.Of(collider) == text;
    }
}
