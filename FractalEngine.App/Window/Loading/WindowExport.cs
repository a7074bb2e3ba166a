using System.Collections.Immutable;
using System.CommandLine;
using FractalEngine.App.Jobs;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.Input;
using FractalEngine.Core.Files;

namespace FractalEngine.App.Window.Loading;

/// <summary>Writes what is on the screen for other programs, as the command <c>export</c> does.</summary>
/// <param name="loader">Owns the document.</param>
/// <param name="prompts">Asks for a name.</param>
/// <param name="report">Shows a message.</param>
/// <param name="wake">Lets the window look at the export, from any thread.</param>
internal sealed class WindowExport(DocumentLoader loader, PromptHost prompts, Action<string> report, Action wake)
    : WindowJob("Export", report, wake)
{
    /// <summary>Asks for a name and begins to write, or ends an export that runs.</summary>
    public void Toggle()
    {
        if (!Stop())
        {
            var stem = PathText.Shorten(Path.ChangeExtension(loader.Document!.File.Path, null));
            prompts.Open(new TextPrompt("Export what is shown; options may follow, such as --height 80mm", stem, TryStart, Suggest));
        }
    }

    /// <summary>Suggests a name for each format.</summary>
    private static ImmutableArray<string> Suggest(string text)
    {
        var stem = text[..^Path.GetExtension(text).Length];
        return
        [
            .. ExportJob.Endings.Select(ending => stem + ending)
                .Where(name => name.Length > text.Length && name.StartsWith(text, StringComparison.OrdinalIgnoreCase)),
        ];
    }

    /// <summary>Returns why a name or an option is refused; null where the export has begun.</summary>
    private string? TryStart(string text)
    {
        var nameLength = $"{text} --".IndexOf(" --", StringComparison.Ordinal);
        var (path, options, command) = (PathText.Expand(text[..nameLength]), new ExportOptions(), new Command("export"));
        options.AddTo(command);
        var parsed = command.Parse(text[nameLength..], new() { ResponseFileTokenReplacer = null });
        if (parsed.Errors is [var error, ..])
        {
            return error.Message;
        }

        try
        {
            NewFile.Require(path, "an export", [.. ExportJob.Endings]);
            path = PathText.Shorten(path);
            var (document, export, settings) = (loader.Document!, options.JobOf(parsed, path), options.SettingsOf(parsed));
            var scene = document.GetShownScene(export.IsStaged);
            settings = settings with { Progress = this, Load = loader.Options with { EditedTexts = document.Edits.Texts } };
            Start($"writing {path}", stop =>
            {
                var summary = export.Run(scene, settings with { Cancellation = stop }, static (_, work) => work());
                return () => Tell(string.Join('\n', [$"saved {path}: {summary.Contents}", .. summary.Losses]));
            });
            return null;
        }
        catch (Exception exception) when (exception is IOException or UsageException)
        {
            return exception.Message;
        }
    }
}
