using System.Globalization;
using System.Reflection;
using FractalEngine.App.Commands;

namespace FractalEngine.Tests.Support;

/// <summary>
/// Runs command lines of the program in the process of the tests, which takes milliseconds. What reads the standard input, or writes other
/// than text to the standard output, needs <see cref="AppProcess"/>.
/// </summary>
/// <remarks>Its users belong to <see cref="ConsoleTests"/>.</remarks>
internal static class AppInProcess
{
    /// <summary>Runs a command line to its end.</summary>
    /// <param name="folder">The current folder of the command.</param>
    /// <param name="arguments">Arguments as on the command line.</param>
    public static AppResult Run(string folder, params string[] arguments) =>
        Run(folder, () => FractalEngine.App.CommandLine.Run(arguments));

    /// <summary>Runs the benchmarks' program to its end. An exception that it lets through reaches the caller.</summary>
    public static AppResult RunBenchmarks(string folder, params string[] arguments) => Run(
        folder,
        () => (int)typeof(FractalEngine.Benchmarks.Measuring.CommandLineParser).Assembly.EntryPoint!.Invoke(
            null, BindingFlags.DoNotWrapExceptions, null, [arguments], CultureInfo.InvariantCulture)!);

    private static AppResult Run(string folder, Func<int> run)
    {
        string before = Directory.GetCurrentDirectory();
        var (output, error) = (Console.Out, Console.Error);
        using var outputText = new StringWriter(CultureInfo.InvariantCulture);
        using var errorText = new StringWriter(CultureInfo.InvariantCulture);
        Directory.SetCurrentDirectory(folder);
        Console.SetOut(outputText);
        Console.SetError(errorText);
        try
        {
            int exitCode = run();
            return new(exitCode, outputText.ToString(), errorText.ToString());
        }
        finally
        {
            Console.SetOut(output);
            Console.SetError(error);
            Directory.SetCurrentDirectory(before);
            // What a process would forget.
            foreach (var limit in LimitsCommand.All)
            {
                limit.Value = limit.Default;
            }

            var paths = typeof(FractalEngine.App.Shell.InputFiles).GetField("Paths", BindingFlags.NonPublic | BindingFlags.Static)!;
            ((HashSet<string>)paths.GetValue(null)!).Clear();
        }
    }
}
