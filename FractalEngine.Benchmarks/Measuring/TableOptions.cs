namespace FractalEngine.Benchmarks.Measuring;

/// <summary>Options of a command that writes tables.</summary>
/// <param name="Command">Name of the command.</param>
/// <param name="IsQuick">True for fewer points and rounds.</param>
/// <param name="Folder">Folder of the tables: unless stated, that of the repository's for whole measurements only.</param>
internal sealed record TableOptions(string Command, bool IsQuick, string Folder)
{
    /// <summary>Number of rounds, the best of which counts.</summary>
    public int Rounds => IsQuick ? 5 : 15;

    /// <summary>Creates a table for a file in the folder.</summary>
    public CsvTable CreateTable(string file, params string[] columns) =>
        new(Path.Combine(Folder, file), IsQuick ? $"{Command} --quick" : Command, columns);

    /// <summary>Parses <c>--quick</c> and <c>--output FOLDER</c>, or returns null where there are other words.</summary>
    public static TableOptions? TryParse(string command, string usage, ReadOnlySpan<string> args)
    {
        var isQuick = false;
        string? output = null;
        return new CommandLineParser(usage)
            .Flag("--quick", () => isQuick = true)
            .Option("--output", folder => output = folder)
            .TryParse(args)
            ? new(command, isQuick, output ?? CommandLineParser.FolderFor(isQuick))
            : null;
    }
}
