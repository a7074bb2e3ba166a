using System.Diagnostics;
using System.Globalization;

namespace FractalEngine.App.Shell.Reports;

/// <summary>Tells on stderr what a command has written, and with <c>--verbose</c> how long each part took.</summary>
internal sealed class WrittenReport(bool isQuiet, bool isVerbose)
{
    private readonly Stopwatch _clock = Stopwatch.StartNew();

    public bool IsQuiet => isQuiet;

    public T Measure<T>(string part, Func<T> work)
    {
        var clock = Stopwatch.StartNew();
        var value = work();
        if (isVerbose)
        {
            Write($"{part} {clock.Elapsed.TotalMilliseconds:F3} ms");
        }

        return value;
    }

    /// <inheritdoc cref="Measure{T}"/>
    public void Measure(string part, Action work) => Measure(part, () =>
    {
        work();
        return true;
    });

    /// <summary>Tells on a terminal, or where much is told, what is done at the moment.</summary>
    public void Progress(string text)
    {
        if (isVerbose || !(isQuiet || Console.IsErrorRedirected))
        {
            Write($"{text}");
        }
    }

    /// <summary>Tells what was written: path, contents, size and the time since the command began.</summary>
    /// <param name="path">Path of the output; '-' is the standard output.</param>
    /// <param name="contents">What it holds, such as the number of faces.</param>
    public void Written(string path, string contents)
    {
        if (!isQuiet)
        {
            var size = path != StandardInput.Name && File.Exists(path) ? $", {FormatBytes(SizeOf(path))}" : "";
            var name = path == StandardInput.Name ? "the standard output" : path;
            Write($"wrote {name}: {contents}{size}, {_clock.Elapsed.TotalSeconds:F1} s");
        }
    }

    /// <summary>Returns the size of a file, not that of a link to it.</summary>
    private static long SizeOf(string path) =>
        new FileInfo(File.ResolveLinkTarget(Path.GetFullPath(path), returnFinalTarget: true)?.FullName ?? path).Length;

    private static string FormatBytes(long bytes) => bytes switch
    {
        < 1000 => string.Create(CultureInfo.InvariantCulture, $"{bytes} bytes"),
        < 1_000_000 => string.Create(CultureInfo.InvariantCulture, $"{bytes / 1e3:F1} kB"),
        _ => string.Create(CultureInfo.InvariantCulture, $"{bytes / 1e6:F1} MB"),
    };

    private static void Write(FormattableString line) =>
        Console.Error.WriteLine(Core.DisplayText.Escape(FormattableString.Invariant(line)));
}
