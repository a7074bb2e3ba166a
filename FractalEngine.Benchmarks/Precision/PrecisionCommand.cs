using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Precision;

/// <summary>Runs the command <c>precision</c>, whose arguments are options.</summary>
internal static class PrecisionCommand
{
    private const string Usage = """
        precision [--quick] [--output FOLDER]
          Float or double? Time and error of the same kernels in both: float-double.csv, in docs/benchmarks unless stated.
        """;

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        if (TableOptions.TryParse("precision", Usage, args) is not { } options)
        {
            return 2;
        }

        FloatVersusDouble.Write(options);
        return 0;
    }
}
