using System.Diagnostics;
using System.Reflection;
using System.Text.RegularExpressions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Documentation;

/// <summary>
/// Types every command of the program that the README and the pages of docs show, page by page, in their order: films of two frames,
/// and traces of four samples.
/// </summary>
public sealed partial class DocumentedCommandsTests : IDisposable
{
    // What takes hours, or needs what only its reader has. Other tests run such commands on small things.
    private static readonly string[] NotRun =
        ["--only ", "nave.png --join", "frames.png --join", "mine.fdo", "name.fdo", "out/spot.obj", "export tree.fdo", " tree.fdo"];

    private readonly TemporaryFolder _folder = new();

    public static TheoryData<string> Pages => new(
        Directory.EnumerateFiles(Repository.Full("docs"), "*.md").Append(Repository.Full("README.md"))
            .Where(static page => CommandsOf(page).Count > 0).Select(static page => Path.GetRelativePath(Repository.Root, page)).Order());

    public void Dispose() => _folder.Dispose();

    [SkippableTheory]
    [Trait("Category", "Soak")]
    [MemberData(nameof(Pages))]
    public void Commands_OfAPage_DoWhatItSays(string page)
    {
        Elsewhere.SkipOnWindows("there is no bash");
        Display.Require();
        foreach (var name in (string[])["assets", "samples"])
        {
            Directory.CreateSymbolicLink(_folder[name], Repository.Full(name));
        }

        _folder.Write("run.sh", $"""
            exec dotnet exec '{Path.ChangeExtension(Assembly.Load("FractalEngine.App").Location, ".dll")}' "$@"
            """);
        var failures = CommandsOf(Repository.Full(page)).Select(Run).Where(static failure => failure is not null);
        Assert.Empty(failures);
    }

    /// <summary>Lists the commands of fences, and those in the text that are whole: capital letters stand for something else.</summary>
    private static List<string> CommandsOf(string page)
    {
        var text = File.ReadAllText(page).ReplaceLineEndings("\n").Replace("\\\n", " ", StringComparison.Ordinal);
        return [.. Command().Matches(text).Select(static match => match.Groups[1].Value.Trim())
            .Where(static command => !Placeholder().IsMatch(command) && !Array.Exists(NotRun, command.Contains)).Distinct()];
    }

    /// <summary>Runs a command without a window; says what is wrong, or null.</summary>
    private string? Run(string command)
    {
        var line = SampleCount().Replace(command.Replace("./run.sh", "bash run.sh", StringComparison.Ordinal), "--trace 4");
        line = line.Contains(" animate ", StringComparison.Ordinal) ? $"{FrameCount().Replace(line, "")} --frames 2" : line;
        using var process = Process.Start(new ProcessStartInfo("bash", ["-c", line])
        {
            WorkingDirectory = _folder.Path, RedirectStandardOutput = true, RedirectStandardError = true,
            Environment = { ["FRACTALENGINE_NO_WINDOW"] = "1" },
        })!;
        var output = process.StandardOutput.ReadToEndAsync();
        var error = process.StandardError.ReadToEnd();
        process.WaitForExit();
        return process.ExitCode != 0 ? $"{command}: exit code {process.ExitCode}: {error}"
            : Output().Match(command) is { Success: true } match && !File.Exists(_folder[match.Groups[1].Value]) ? $"{command}: no file"
            : output.Result.Length + error.Length == 0 ? $"{command}: said nothing"
            : null;
    }

    [GeneratedRegex(@"(?:^|`)(\./run\.sh[^`\n#]*)", RegexOptions.Multiline)]
    private static partial Regex Command();

    // Also the names of two commands alone.
    [GeneratedRegex(@"\b[A-Z]{2,}|\bX\.|\bY\.|…|\[|(render|sky|--no-sun)$")]
    private static partial Regex Placeholder();

    [GeneratedRegex(@" --frames \d+")]
    private static partial Regex FrameCount();

    [GeneratedRegex(@"--trace \d+")]
    private static partial Regex SampleCount();

    [GeneratedRegex(@"--output ([\w./]+\.\w+)")]
    private static partial Regex Output();
}
