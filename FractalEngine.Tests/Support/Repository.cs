namespace FractalEngine.Tests.Support;

/// <summary>The checkout that the tests were built in.</summary>
internal static class Repository
{
    public static string Root { get; } = FindRoot(new(AppContext.BaseDirectory));

    /// <summary>The full path of a file in it.</summary>
    /// <param name="file">Relative to the root, with slashes.</param>
    public static string Full(string file) => Path.Combine(Root, file);

    private static string FindRoot(DirectoryInfo? folder)
    {
        while (folder is not null && !File.Exists(Path.Combine(folder.FullName, "FractalEngine.sln")))
        {
            folder = folder.Parent;
        }

        return folder?.FullName ?? throw new InvalidOperationException("the tests do not lie below FractalEngine.sln");
    }
}
