using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>
/// Runs the command <c>window</c>: what does a window cost in which nothing moves, when it skips frames like the one before, and what would
/// it cost to draw them?
/// </summary>
internal static class WindowCommand
{
    private const string Usage = """
        window [FILE] [--output FOLDER]
          The share of a core that a still window takes over 5 seconds, of the gallery or of FILE,
          and what 60 frames a second of it take that are all drawn.
          Opens a window for 15 seconds, then draws without one.
          --output: also as window.csv.
        """;

    // Enough for loading the file and drawing it, also on a slow machine.
    private static readonly TimeSpan LoadingDuration = TimeSpan.FromSeconds(10);
    private static readonly TimeSpan MeasuredDuration = TimeSpan.FromSeconds(5);
    private static readonly TimeSpan FrameTime = TimeSpan.FromSeconds(1 / 60.0);

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
        if (MeasureCoreUsage([program, "view", file, "--no-trace"]) is not { } usage)
        {
            Console.Error.WriteLine("error: the window has closed: is there a display?");
            return 3;
        }

        Write("all optimisations", "nothing", usage);
        Write("- idle", "idle", MeasureDrawing(file));
        csv?.Save();
        return 0;

        void Write(string name, string switchedOff, double share)
        {
            Console.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{name,-20} {100 * share,8:F2} % of a core"));
            csv?.Add(Path.GetFileNameWithoutExtension(file), switchedOff, Math.Round(100 * share, 3));
        }
    }

    /// <summary>Measures what share of a core this process takes while it draws the same frame again, 60 times a second.</summary>
    private static double MeasureDrawing(string file)
    {
        var scene = AssetLoader.Load(file).Scene;
        var settings = new RenderSettings();
        var view = View.Of(scene, FrameCase.Aspect);
        var preparation = new ScenePreparation(scene, settings);
        preparation.PrepareVisible(view, FrameCase.Aspect);
        using var context = new OffscreenContext();
        using var frame = new FrameRenderer(context);
        using var renderer = new SceneRenderer(context, preparation.Scene);
        Draw();
        using var process = Process.GetCurrentProcess();
        var timeBefore = process.TotalProcessorTime;
        var watch = Stopwatch.StartNew();
        for (var drawn = 1; watch.Elapsed < MeasuredDuration; drawn++)
        {
            Draw();
            var wait = (drawn * FrameTime) - watch.Elapsed;
            Thread.Sleep(wait > TimeSpan.Zero ? wait : TimeSpan.Zero);
        }

        process.Refresh();
        return (process.TotalProcessorTime - timeBefore) / watch.Elapsed;

        void Draw()
        {
            frame.Draw(renderer, view, FrameCase.Width, FrameCase.Height, settings);
            frame.Finish();
        }
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
