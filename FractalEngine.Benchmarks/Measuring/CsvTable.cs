using System.Globalization;
using System.Runtime.InteropServices;
using System.Text;
using FractalEngine.Parsing.Assets;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>
/// A table of measurements as a file: comments that say how and on what they were made, a header, then rows. Written whole or not at all.
/// </summary>
/// <param name="path">The file.</param>
/// <param name="command">What makes it again, after <c>FractalEngine.Benchmarks -- </c>.</param>
/// <param name="columns">Names, with units where there are any.</param>
internal sealed class CsvTable(string path, string command, params string[] columns)
{
    private readonly StringBuilder _rows = new();

    /// <summary>Of what draws, if something does: stands beside the machine.</summary>
    public string? GraphicsDriver { get; set; }

    /// <summary>Adds a row.</summary>
    /// <param name="values">
    /// As many as columns. Numbers are written so that they read back to the same bits; null is an empty field.
    /// </param>
    public void Add(params object?[] values)
    {
        if (values.Length != columns.Length)
        {
            throw new ArgumentException($"expected {columns.Length} values, not {values.Length}", nameof(values));
        }

        _rows.AppendJoin(',', values.Select(FormatField)).Append('\n');
    }

    /// <summary>Writes the file.</summary>
    public void Save() => AtomicFile.Write(path, stream => stream.Write(
        Encoding.UTF8.GetBytes(
            $"# {command}\n# {Machine}{(GraphicsDriver is null ? "" : $", {GraphicsDriver}")}\n{string.Join(',', columns.Select(Quote))}\n{_rows}")));

    /// <summary>The machine, in words: no names.</summary>
    private static string Machine =>
        $"{RuntimeInformation.OSArchitecture}, {Environment.ProcessorCount} cores, {RuntimeInformation.FrameworkDescription}, commit {Environment.GetEnvironmentVariable("FRACTALENGINE_COMMIT") ?? "unknown"}";

    private static string FormatField(object? value) => value switch
    {
        null => "",
        double number => number.ToString("R", CultureInfo.InvariantCulture),
        IFormattable other => Quote(other.ToString(null, CultureInfo.InvariantCulture)),
        _ => Quote(value.ToString()!),
    };

    private static string Quote(string text) =>
        text.AsSpan().IndexOfAny(",\"\r\n") < 0 ? text : $"\"{text.Replace("\"", "\"\"", StringComparison.Ordinal)}\"";
}
