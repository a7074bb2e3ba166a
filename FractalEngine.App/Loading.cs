using FractalEngine.Parsing.Assets;
using Spectre.Console;

namespace FractalEngine.App;

/// <summary>Loads files for the commands: warnings on stderr, and a bar there when it takes long and somebody watches.</summary>
internal static class Loading
{
    // Shorter loads show nothing: a bar that flickers up tells less than none.
    private static readonly TimeSpan Patience = TimeSpan.FromSeconds(0.5);

    /// <summary>Loads a file and all that it refers to.</summary>
    public static LoadedFile Load(string path, LoadOptions options)
    {
        var file = Console.IsErrorRedirected ? AssetLoader.Load(path, options) : LoadWithBar(path, options);
        foreach (var warning in file.Warnings)
        {
            Console.Error.WriteLine(warning);
        }

        return file;
    }

    private static LoadedFile LoadWithBar(string path, LoadOptions options)
    {
        var progress = new LatestProgress();
        var load = Task.Run(() => AssetLoader.Load(path, options, progress));
        if (Task.WaitAny([load], Patience) < 0)
        {
            ShowBar(load, progress);
        }

        return load.GetAwaiter().GetResult();
    }

    private static void ShowBar(Task load, LatestProgress progress)
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
