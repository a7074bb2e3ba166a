namespace FractalEngine.Tests.Support;

/// <summary>What this process holds of the system, as far as Linux tells.</summary>
internal static class OpenFiles
{
    /// <summary>Lists the paths of open files; none on other systems.</summary>
    public static string[] List() => !OperatingSystem.IsLinux() ? [] :
    [
        .. Directory.GetFiles("/proc/self/fd").Select(static handle => new FileInfo(handle).LinkTarget).OfType<string>(),
    ];

    /// <summary>Counts the threads of a name, up to 15 letters; 0 on other systems.</summary>
    public static int CountThreads(string name) => !OperatingSystem.IsLinux() ? 0
        : Directory.GetDirectories("/proc/self/task").Count(thread => NameOf(thread) == name);

    private static string? NameOf(string thread)
    {
        try
        {
            return File.ReadAllText(Path.Combine(thread, "comm")).Trim();
        }
        catch (IOException)
        {
            // It has ended meanwhile.
            return null;
        }
    }
}
