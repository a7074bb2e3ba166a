using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks.Loading;

/// <summary>The words after <c>loading</c>: options.</summary>
internal static class LoadingCommand
{
    private const string Usage = """
        loading [--quick] [--output FOLDER]
          What do loading, parsing and expanding cost? loading.csv, expansion.csv and, where there is a display, first-picture.csv, in docs/benchmarks unless stated.
        """;

    public static int Run(ReadOnlySpan<string> args)
    {
        if (TableOptions.TryParse("loading", Usage, args) is not { } options)
        {
            return 2;
        }

        LoadingTable.Write(options);
        ExpansionTable.Write(options);
        try
        {
            FirstFrameTable.Write(options);
        }
        catch (GraphicsUnavailableException exception)
        {
            Console.WriteLine($"first-picture.csv is left out: {exception.Message}");
        }

        return 0;
    }
}
