using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks.Loading;

/// <summary>Runs the command <c>loading</c>, whose arguments are options.</summary>
internal static class LoadingCommand
{
    private const string Usage = """
        loading [--quick] [--output FOLDER]
          What do loading, parsing and expanding cost? Writes to docs/benchmarks unless stated:
          loading.csv, expansion.csv and, where there is a display, first-frame.csv.
        """;

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
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
            Console.WriteLine($"first-frame.csv is skipped: {exception.Message}");
        }

        return 0;
    }
}
