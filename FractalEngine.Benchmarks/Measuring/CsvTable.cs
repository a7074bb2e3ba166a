using System.Globalization;
using System.Runtime.InteropServices;
using System.Text;
using FractalEngine.Core.Files;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>
/// A table of measurements as a CSV file: comments that say how and on what machine they were made, a header, then rows. The file is
/// written whole or not at all.
/// </summary>
/// <param name="path">Path of the file.</param>
/// <param name="command">Command that makes the table again, after <c>FractalEngine.Benchmarks -- </c>.</param>
/// <param name="columns">Names of the columns, with units where there are any.</param>
internal sealed class CsvTable(string path, string command, params string[] columns)
{
    private readonly StringBuilder _rows = new();

    /// <summary>Name of the graphics driver, written beside the machine. Null where nothing is drawn.</summary>
    public string? GraphicsDriver { get; set; }

    /// <summary>Adds one row of fields.</summary>
    /// <param name="values">
    /// A value for each column. Numbers are written so that they read back to the same bits; null is an empty field.
    /// </param>
    /// <exception cref="ArgumentException">The number of values is not that of the columns.</exception>
    public void Add(params object?[] values)
    {
        if (values.Length != columns.Length)
        {
            throw new ArgumentException($"expected {columns.Length} values, not {values.Length}", nameof(values));
        }

        _rows.AppendJoin(',', values.Select(FormatField)).Append('\n');
    }

    /// <summary>Writes the file, and its folder where that is missing.</summary>
    public void Save()
    {
        var driver = GraphicsDriver is null ? "" : $", {GraphicsDriver}";
        var text = $"# {command}\n# {Machine}{driver}\n{string.Join(',', columns.Select(Quote))}\n{_rows}";
        AtomicFile.Write(path, stream => stream.Write(Encoding.UTF8.GetBytes(text)));
    }

    /// <summary>Description of the machine without any names.</summary>
    private static string Machine => string.Join(
        ", ",
        RuntimeInformation.OSArchitecture,
        $"{Environment.ProcessorCount} cores",
        RuntimeInformation.FrameworkDescription,
        $"commit {Environment.GetEnvironmentVariable("FRACTALENGINE_COMMIT") ?? "unknown"}");

    private static string FormatField(object? value) => value switch
    {
        null => "",
        double number => number.ToString("R", CultureInfo.InvariantCulture),
        IFormattable other => Quote(other.ToString(null, CultureInfo.InvariantCulture)),
        _ => Quote(value.ToString()!),
    };

    /// <summary>Returns a field for a text: in quotes where it would end one.</summary>
    internal static string Quote(string text) =>
        text.AsSpan().IndexOfAny(",\"\r\n") < 0 ? text : $"\"{text.Replace("\"", "\"\"", StringComparison.Ordinal)}\"";
}
