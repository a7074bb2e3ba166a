namespace FractalEngine.Benchmarks;

/// <summary>How much is measured, and where it goes.</summary>
/// <param name="IsQuick">Fewer points and rounds: all tables in a minute and a half.</param>
/// <param name="Folder">Of the files.</param>
internal sealed record GrowthOptions(bool IsQuick, string Folder)
{
    /// <summary>Of which the best counts.</summary>
    public int Rounds => IsQuick ? 5 : 15;

    /// <summary>A file in the folder.</summary>
    public CsvTable Table(string file, params string[] columns) => new(Path.Combine(Folder, file), IsQuick ? "growth --quick" : "growth", columns);
}
