namespace FractalEngine.Tests.Support;

/// <summary>Finds real OBJ files by other people, in a folder beside the checkout. They are no part of the project.</summary>
internal static class SharedModels
{
    /// <summary>Path of the nearest <c>shared/models</c> in a folder above the tests, or null where there is none.</summary>
    public static string? Folder { get; } = Ancestors(AppContext.BaseDirectory).Select(folder => Path.Combine(folder, "shared", "models"))
        .FirstOrDefault(folder => File.Exists(Path.Combine(folder, "TABLE.tsv")));

    /// <summary>Reads each file's name, and its numbers of vertices and triangles as an independent script counted them.</summary>
    public static IEnumerable<(string File, int Vertices, int Triangles)> ReadTable() =>
        from line in File.ReadLines(Path.Combine(Folder!, "TABLE.tsv")).Skip(1)
        let cells = line.Split('\t')
        select (cells[0], int.Parse(cells[2], System.Globalization.CultureInfo.InvariantCulture),
        int.Parse(cells[4], System.Globalization.CultureInfo.InvariantCulture));

    private static IEnumerable<string> Ancestors(string folder)
    {
        for (DirectoryInfo? above = new(folder); above is not null; above = above.Parent)
        {
            yield return above.FullName;
        }
    }
}
