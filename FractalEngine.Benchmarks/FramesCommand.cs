using System.Globalization;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks;

/// <summary>The words after <c>frames</c>: pictures and options.</summary>
internal static class FramesCommand
{
    private const string Usage = """
        frames [NAME[:DEPTH]:PLACE ...] [--rounds N] [--samples N] [--no-truth]
          What a picture of a fractal costs, with all that is not seen left out and with every instance. PLACE is afar, close or inside.
        """;

    private static readonly string[] Default =
    [
        "menger:5:afar", "menger:5:close", "menger:5:inside", "tetrahedron:12:afar", "appendix-b:5:afar", "appendix-b-structure:5:afar", "binary-tree:14:afar",
        "menger:20:afar", "menger:1000000:afar", "infinite-menger:inside",
    ];

    public static int Run(ReadOnlySpan<string> args)
    {
        var (rounds, samples, withTruth, names) = (5, 0, true, new List<string>());
        for (var i = 0; i < args.Length; i++)
        {
            switch (args[i])
            {
                case "--rounds" when i + 1 < args.Length && int.TryParse(args[i + 1], NumberStyles.None, CultureInfo.InvariantCulture, out rounds) && rounds > 0:
                case "--samples" when i + 1 < args.Length && int.TryParse(args[i + 1], NumberStyles.None, CultureInfo.InvariantCulture, out samples):
                    i++;
                    break;
                case "--no-truth":
                    withTruth = false;
                    break;
                case { } name when IsCase(name):
                    names.Add(name);
                    break;
                default:
                    Console.Error.WriteLine($"error: unexpected '{args[i]}'\n{Usage}\nNames: {string.Join(' ', FractalCase.Names)}");
                    return 2;
            }
        }

        try
        {
            Write(rounds, samples, withTruth, names);
            return 0;
        }
        catch (GraphicsUnavailableException exception)
        {
            Console.Error.WriteLine($"error: {exception.Message}");
            return 3;
        }
    }

    private static void Write(int rounds, int samples, bool withTruth, List<string> names) =>
        new FrameTable(rounds, samples, withTruth, Console.Out).Write((names.Count > 0 ? names : [.. Default]).Select(FrameCase.Parse));

    private static bool IsCase(string text) => text.Split(':') switch
    {
        [var name, .., "afar" or "close" or "inside"] => FractalCase.Names.Contains(name),
        _ => false,
    };
}
