using System.Globalization;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Scenes;

namespace FractalEngine.Benchmarks;

/// <summary>The words after <c>physics</c>: fractals and options.</summary>
internal static class PhysicsCommand
{
    private const string Usage = """
        physics [NAME[:DEPTH] ...] [--balls N] [--collider NAME] [--rounds N]
          What a step costs while balls fall on a fractal; menger:5 and 1,000 balls unless stated.
        """;

    public static int Run(ReadOnlySpan<string> args)
    {
        var (rounds, balls, collider, names) = (3, 1000, ColliderKind.Exact, new List<string>());
        for (var i = 0; i < args.Length; i++)
        {
            switch (args[i])
            {
                case "--rounds" when i + 1 < args.Length && int.TryParse(args[i + 1], NumberStyles.None, CultureInfo.InvariantCulture, out rounds) && rounds > 0:
                case "--balls" when i + 1 < args.Length && int.TryParse(args[i + 1], NumberStyles.None, CultureInfo.InvariantCulture, out balls) && balls > 0:
                case "--collider" when i + 1 < args.Length && TryParse(args[i + 1], out collider):
                    i++;
                    break;
                case { } name when FractalCase.Names.Contains(name.Split(':')[0]):
                    names.Add(name);
                    break;
                default:
                    Console.Error.WriteLine($"error: unexpected '{args[i]}'\n{Usage}\nNames: {string.Join(' ', FractalCase.Names)}");
                    return 2;
            }
        }

        var table = new PhysicsTable(rounds, Console.Out);
        foreach (var name in names.Count > 0 ? names : ["menger:5"])
        {
            table.Write(FractalCase.Parse(name), balls, collider);
        }

        return 0;
    }

    private static bool TryParse(string text, out ColliderKind collider)
    {
        collider = Enum.GetValues<ColliderKind>().FirstOrDefault(kind => SceneParser.NameOf(kind) == text);
        return SceneParser.NameOf(collider) == text;
    }
}
