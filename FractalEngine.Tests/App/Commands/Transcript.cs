using System.CommandLine;
using System.Diagnostics;
using System.Globalization;
using System.Text;
using System.Text.RegularExpressions;
using FractalEngine.App.Commands;
using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Recorded;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>
/// Runs command lines in a folder of their own and in the process of the tests, and notes what a user sees: the exit code, both streams
/// and the files that are written. Times and paths are masked.
/// </summary>
/// <remarks>Its users belong to <see cref="ConsoleTests"/>, unless they only run lines of the shell.</remarks>
internal sealed partial class Transcript : IDisposable
{
    private const int MaxLine = 280;
    private const int ShownLines = 4;

    private readonly TemporaryFolder _folder = new();
    private readonly Dictionary<string, DateTime> _known = [];

    private readonly int _maxLines;

    /// <summary>Begins in an empty folder.</summary>
    /// <param name="maxLines">Number of lines of a text that are all kept.</param>
    public Transcript(int maxLines = 14) => _maxLines = maxLines;

    /// <summary>All lines so far.</summary>
    public List<string> Lines { get; } = [];

    /// <summary>The folder of the commands.</summary>
    public TemporaryFolder Folder => _folder;

    public void Dispose() => _folder.Dispose();

    /// <summary>Runs one command line after the other.</summary>
    /// <param name="commandLines">Arguments, separated by blanks; quotes hold blanks together.</param>
    public void Run(params string[] commandLines)
    {
        FindChanged();
        foreach (string commandLine in commandLines)
        {
            string[] arguments = [.. Words().Matches(commandLine).Select(match => match.Value.Replace("\"", "", StringComparison.Ordinal))];
            Note($"$ {commandLine}", AppInProcess.Run(_folder.Path, arguments));
        }
    }

    /// <summary>Runs a line of the shell, in which <c>$APP</c> is the program.</summary>
    public void RunShell(string line)
    {
        FindChanged();
        string program = $"dotnet exec {Path.ChangeExtension(typeof(InfoCommand).Assembly.Location, ".dll")}";
        var start = new ProcessStartInfo("sh", ["-c", line.Replace("$APP", program, StringComparison.Ordinal)])
        {
            WorkingDirectory = _folder.Path,
            RedirectStandardOutput = true,
            RedirectStandardError = true,
        };
        using var process = Process.Start(start)!;
        var output = process.StandardOutput.ReadToEndAsync();
        var error = process.StandardError.ReadToEndAsync();
        Assert.True(process.WaitForExit(Polling.Deadline), $"{line} did not end");
        Note($"$ {line}", new(process.ExitCode, output.GetAwaiter().GetResult(), error.GetAwaiter().GetResult()));
    }

    /// <summary>Notes what a command has done.</summary>
    public void Note(string head, AppResult result)
    {
        Lines.Add($"{head}  → {result.ExitCode}");
        Add("", result.Output);
        Add("! ", result.Error);
        foreach (string file in FindChanged())
        {
            Add($"{file}: ", Describe(file));
        }
    }

    /// <summary>Adds a text line by line. Of a long one the beginning is kept, with the sums of all numbers.</summary>
    private void Add(string prefix, string text)
    {
        string[] lines = Mask(text).TrimEnd('\n').Split('\n');
        if (lines is [""])
        {
            return;
        }

        foreach (string line in lines.Take(lines.Length > _maxLines ? ShownLines : _maxLines))
        {
            Lines.AddRange((line.Length == 0 ? [[]] : line.Chunk(MaxLine)).Select((part,
                i) => (i > 0 ? $"{prefix}… " : prefix) + new string(part)));
        }

        if (lines.Length > _maxLines)
        {
            string all = string.Join('\n', lines);
            double[] numbers = [.. Numbers().Matches(all).Select(match => double.Parse(match.Value, CultureInfo.InvariantCulture))];
            string words = Numbers().Replace(all, "");
            int hash = words.Aggregate(17, (sum, letter) => unchecked((sum * 31) + letter));
            Lines.Add(string.Create(
                CultureInfo.InvariantCulture, $"{prefix}… {lines.Length} lines, {Description.OfNumbers(numbers)}, words {hash:x8}"));
        }
    }

    private string[] FindChanged()
    {
        string[] changed =
        [
            .. Directory.EnumerateFiles(_folder.Path, "*", SearchOption.AllDirectories)
                .Where(file => _known.GetValueOrDefault(file) != File.GetLastWriteTimeUtc(file)).Order(StringComparer.Ordinal),
        ];
        foreach (string file in changed)
        {
            _known[file] = File.GetLastWriteTimeUtc(file);
        }

        return [.. changed.Select(file => Path.GetRelativePath(_folder.Path, file))];
    }

    private string Describe(string file)
    {
        byte[] bytes = File.ReadAllBytes(_folder[file]);
        if (Path.GetExtension(file) is ".png" or ".apng")
        {
            var image = ImageFile.Load(_folder[file]);
            string chunks = string.Join(' ', Enumerable.Range(0, bytes.Length - 3).Select(i => Encoding.Latin1.GetString(bytes, i, 4))
                .Where(name => name is "acTL" or "fcTL" or "fdAT" or "IDAT"));
            return $"{image.Width}×{image.Height} {chunks} {Means(image)}";
        }

        return Encoding.UTF8.GetString(bytes);
    }

    // The sum of the four channels, with a weight for the place.
    private static string Means(PixelImage image) => string.Join(' ', Enumerable.Range(0, 4).Select(channel => RecordedText.Text(
        Enumerable.Range(0, image.Pixels.Length / 4).Average(i => (1 + (i % 7)) * (double)image.Pixels[(4 * i) + channel]))));

    private string Mask(string text)
    {
        text = text.Replace(_folder.Path, "<folder>", StringComparison.Ordinal).Replace(Repository.Root, "<root>",
            StringComparison.Ordinal);
        text = text.Replace($"  {RootCommand.ExecutableName} ", "  <program> ", StringComparison.Ordinal);
        text = Guids().Replace(text, "<guid>");
        return Times().Replace(text, match => match.Groups[1].Value + "#" + match.Groups[3].Value);
    }

    [GeneratedRegex("""(?:[^\s"]|"[^"]*")+""")]
    private static partial Regex Words();

    [GeneratedRegex(@"-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?")]
    private static partial Regex Numbers();

    [GeneratedRegex(@"\b[0-9a-f]{32}\b")]
    private static partial Regex Guids();

    // Times, and what another machine rounds differently.
    [GeneratedRegex(
        @"((?:^|[ \n])(?:load|prepare|write|draw|trace|denoise|generate|build|step|queries|rays) |(?<=\nstate )|loadMilliseconds"":? *"
        + @"|loadMilliseconds +|prepareMilliseconds""?:? +(?=\d)|, (?=\d+\.\d s))([\d.,a-f]+)( ms| a second| s|)")]
    private static partial Regex Times();
}
