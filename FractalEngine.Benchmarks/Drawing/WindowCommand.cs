using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>
/// Runs the command <c>window</c>: what does a window cost in which nothing moves, when it skips frames like the one before and when it
/// draws them?
/// </summary>
internal static class WindowCommand
{
    private const string Usage = """
        window [FILE] [--output FOLDER]
          The share of a core that a still window takes over 5 seconds, of the gallery or of FILE.
          Opens two windows, one after the other, for 15 seconds each.
          --output: also as window.csv.
        """;

    // Enough for loading the file and drawing it, also on a slow machine.
    private static readonly TimeSpan LoadingDuration = TimeSpan.FromSeconds(10);
    private static readonly TimeSpan MeasuredDuration = TimeSpan.FromSeconds(5);

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        string? folder = null;
        var files = new List<string>();
        var parser = new CommandLineParser(Usage)
            .Option("--output", value => folder = value)
            .Names(name => files.Count == 0 && File.Exists(name), files);
        if (!parser.TryParse(args))
        {
            return 2;
        }

        var appFolder = AppContext.BaseDirectory.Replace("FractalEngine.Benchmarks", "FractalEngine.App", StringComparison.Ordinal);
        var program = Path.Combine(appFolder, "FractalEngine.App.dll");
        if (!File.Exists(program))
        {
            Console.Error.WriteLine($"error: {program} is not built: build the solution first");
            return 2;
        }

        var file = files is [var given] ? given : Path.Combine(FractalCase.Assets, "scenes", "gallery.sdo");
        var command = string.Join(' ', ["window", .. files]);
        var csv = folder is null
            ? null
            : new CsvTable(Path.Combine(folder, "window.csv"), command, "scene", "switched_off", "percent_of_a_core");
        // A traced image would take all cores until it is done.
        (string Name, string[] Options)[] cases =
            [("all optimisations", ["--no-trace"]), ("- idle", ["--no-trace", "--without", "idle"])];
        foreach (var (name, options) in cases)
        {
            if (MeasureCoreUsage([program, "view", file, .. options]) is not { } usage)
            {
                Console.Error.WriteLine("error: the window has closed: is there a display?");
                return 3;
            }

            Console.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{name,-20} {100 * usage,8:F2} % of a core"));
            csv?.Add(Path.GetFileNameWithoutExtension(file), options.Length == 1 ? "nothing" : "idle", Math.Round(100 * usage, 3));
        }

        csv?.Save();
        return 0;
    }

    /// <summary>Measures what share of a core a program takes once it has loaded; null where the program ended by itself.</summary>
    private static double? MeasureCoreUsage(string[] arguments)
    {
        var start = new ProcessStartInfo("dotnet", arguments);
        start.Environment.Remove("FRACTALENGINE_NO_WINDOW");
        using var process = Process.Start(start)!;
        try
        {
            if (process.WaitForExit(LoadingDuration))
            {
                return null;
            }

            var timeBefore = process.TotalProcessorTime;
            var watch = Stopwatch.StartNew();
            if (process.WaitForExit(MeasuredDuration))
            {
                return null;
            }

            process.Refresh();
            return (process.TotalProcessorTime - timeBefore) / watch.Elapsed;
        }
        finally
        {
            if (!process.HasExited)
            {
                process.Kill();
                process.WaitForExit();
            }
        }
    }
}
