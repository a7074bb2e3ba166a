using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>
/// <c>window [FILE]</c>: what a window costs in which nothing moves, with pictures left out that are like the one before, and without.
/// </summary>
internal static class WindowCommand
{
    private const string Usage = """
        window [FILE] [--output FOLDER]
          The share of a core that a still window takes over 5 seconds, of the gallery or of FILE. Opens two windows, one after the other, for 15 seconds each. --output: also as window.csv.
        """;

    // Until the file is loaded and drawn, also on a slow machine.
    private static readonly TimeSpan LoadingDuration = TimeSpan.FromSeconds(10);
    private static readonly TimeSpan MeasuredDuration = TimeSpan.FromSeconds(5);

    public static int Run(ReadOnlySpan<string> args)
    {
        var program =
            Path.Combine(AppContext.BaseDirectory.Replace("FractalEngine.Benchmarks", "FractalEngine.App", StringComparison.Ordinal),
            "FractalEngine.App.dll");
        var (folder, files) = ((string?)null, new List<string>());
        if (!new CommandLineParser(Usage).Option("--output", value => folder = value)
            .Names(name => files.Count == 0 && File.Exists(name), files)
            .TryParse(args))
        {
            return 2;
        }

        if (!File.Exists(program))
        {
            Console.Error.WriteLine($"error: {program} is not built: build the solution first");
            return 2;
        }

        var file = files is [var given] ? given : Path.Combine(FractalCase.Assets, "scenes", "gallery.sdo");
        var csv = folder is null
            ? null
            : new CsvTable(Path.Combine(folder, "window.csv"), string.Join(' ', ["window", .. files]), "scene", "switched_off",
            "percent_of_a_core");
        foreach (var (name, options) in ((string, string[])[])[("everything skipped", []), ("- still", ["--without", "still"])])
        {
            if (MeasureCoreUsage([program, "view", file, .. options]) is not { } usage)
            {
                Console.Error.WriteLine("error: the window has closed: is there a display?");
                return 3;
            }

            Console.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{name,-20} {100 * usage,8:F2} % of a core"));
            csv?.Add(Path.GetFileNameWithoutExtension(file), options is [] ? "nothing" : "still", Math.Round(100 * usage, 3));
        }

        csv?.Save();
        return 0;
    }

    /// <summary>Null where the program ended by itself.</summary>
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

            var (before, watch) = (process.TotalProcessorTime, Stopwatch.StartNew());
            if (process.WaitForExit(MeasuredDuration))
            {
                return null;
            }

            process.Refresh();
            return (process.TotalProcessorTime - before) / watch.Elapsed;
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
