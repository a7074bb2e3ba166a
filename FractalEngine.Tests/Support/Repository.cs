namespace FractalEngine.Tests.Support;

/// <summary>Finds files of the checkout in which the tests were built.</summary>
internal static class Repository
{
    public static string Root { get; } = FindRoot(new(AppContext.BaseDirectory));

    /// <summary>Returns the full path of a file.</summary>
    /// <param name="file">Path relative to the root, with slashes.</param>
    public static string Full(string file) => Path.Combine(Root, file);

    private static string FindRoot(DirectoryInfo? folder)
    {
        while (folder is not null && !File.Exists(Path.Combine(folder.FullName, "FractalEngine.sln")))
        {
            folder = folder.Parent;
        }

        return folder?.FullName ?? throw new InvalidOperationException("expected FractalEngine.sln in a folder above the tests");
    }
}
