namespace FractalEngine.Benchmarks.Measuring;

/// <summary>How much a command measures, and where its tables go.</summary>
/// <param name="Command">Its name.</param>
/// <param name="IsQuick">Fewer points and rounds.</param>
/// <param name="Folder">Of the files.</param>
internal sealed record TableOptions(string Command, bool IsQuick, string Folder)
{
    /// <summary>Of which the best counts.</summary>
    public int Rounds => IsQuick ? 5 : 15;

    /// <summary>A file in the folder.</summary>
    public CsvTable CreateTable(string file, params string[] columns) =>
        new(Path.Combine(Folder, file), IsQuick ? $"{Command} --quick" : Command, columns);

    /// <summary>Reads <c>--quick</c> and <c>--output FOLDER</c>; null where other words stand there.</summary>
    public static TableOptions? TryParse(string command, string usage, ReadOnlySpan<string> args)
    {
        var options = new TableOptions(command, false, CommandLineParser.DefaultFolder);
        return new CommandLineParser(usage)
            .Flag("--quick", () => options = options with { IsQuick = true })
            .Option("--output", folder => options = options with { Folder = folder })
            .TryParse(args) ? options : null;
    }
}
