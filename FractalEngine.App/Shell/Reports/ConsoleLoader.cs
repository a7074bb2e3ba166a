using FractalEngine.Core;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;
using Spectre.Console;

namespace FractalEngine.App.Shell.Reports;

/// <summary>Loads files for the commands, with warnings on stderr and a progress bar on a terminal.</summary>
internal static class ConsoleLoader
{
    // A bar that only flickers up would tell less than none.
    private static readonly TimeSpan ProgressBarDelay = TimeSpan.FromSeconds(0.5);

    /// <summary>Loads a file with all files that it refers to. The path <c>-</c> stands for the standard input.</summary>
    /// <param name="path">Path of the file.</param>
    /// <param name="options">Options for loading.</param>
    /// <param name="isTraced">Whether nothing but traced images is made of it.</param>
    /// <exception cref="SourceException">A file is missing or faulty.</exception>
    public static LoadedFile Load(string path, LoadOptions options, bool isTraced = false)
    {
        options = StandardInput.AddTo(options, path);
        var cache = new AssetCache();
        var file = Console.IsErrorRedirected ? AssetLoader.Load(path, options, null, cache) : LoadWithProgressBar(path, options, cache);
        InputFiles.Add(cache);
        if (options.Composition is not null && !file.Scene.Models.Any(static model => model is FractalModel))
        {
            throw new UsageException($"{path} has no fractal, so --composition has no effect");
        }

        if (options.Seed is not null && !isTraced
            && !file.Scene.Models.Any(static model => model is FractalModel { Fractal.Description.HasChance: true }))
        {
            throw new UsageException($"nothing in {path} is by chance, so --seed has no effect");
        }

        if (file.Kind == FileKind.Scene && (options.Handedness is not null || options.Placement != Transformation.Identity))
        {
            throw new UsageException($"{path} is a scene: --from-handed, --from-up and --from-unit are for a mesh or fractal");
        }

        var numbers = file.Scene.Models.OfType<FractalModel>().SelectMany(static model => model.NumberNames);
        if (options.Values.Keys.FirstOrDefault(name => !numbers.Contains(name)) is { } unknown)
        {
            throw new UsageException($"--set: no fractal of {path} declares a number '{unknown}'{NameSuggestion.Ask(unknown, numbers)}");
        }

        foreach (var warning in file.Warnings)
        {
            Console.Error.WriteLine(warning);
        }

        return file;
    }

    private static LoadedFile LoadWithProgressBar(string path, LoadOptions options, AssetCache cache)
    {
        var progress = new ThrottledProgress();
        var load = Task.Run(() => AssetLoader.Load(path, options, progress, cache));
        if (Task.WaitAny([load], ProgressBarDelay) < 0)
        {
            ShowProgressBar(load, progress);
        }

        return load.GetAwaiter().GetResult();
    }

    private static void ShowProgressBar(Task load, ThrottledProgress progress)
    {
        var console = AnsiConsole.Create(new() { Out = new AnsiConsoleOutput(Console.Error) });
        console.Progress().AutoClear(true).Start(context =>
        {
            var bar = context.AddTask("Loading", maxValue: 1);
            do
            {
                var (file, fraction) = progress.Latest;
                bar.Description = Markup.Escape($"loading {file}".TrimEnd());
                bar.Value = fraction;
            }
            while (Task.WaitAny([load], TimeSpan.FromMilliseconds(50)) < 0);
        });
    }
}
