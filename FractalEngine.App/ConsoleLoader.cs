using FractalEngine.Parsing.Assets;
using Spectre.Console;

namespace FractalEngine.App;

/// <summary>Loads files for the commands: warnings on stderr, and a bar there when it takes long and somebody watches.</summary>
internal static class ConsoleLoader
{
    // Shorter loads show nothing: a bar that flickers up tells less than none.
    private static readonly TimeSpan ProgressBarDelay = TimeSpan.FromSeconds(0.5);

    /// <summary>Loads a file and all that it refers to.</summary>
    public static LoadedFile Load(string path, LoadOptions options)
    {
        var file = Console.IsErrorRedirected ? AssetLoader.Load(path, options) : LoadWithProgressBar(path, options);
        foreach (var warning in file.Warnings)
        {
            Console.Error.WriteLine(warning);
        }

        return file;
    }

    private static LoadedFile LoadWithProgressBar(string path, LoadOptions options)
    {
        var progress = new ThrottledProgress();
        var load = Task.Run(() => AssetLoader.Load(path, options, progress));
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
