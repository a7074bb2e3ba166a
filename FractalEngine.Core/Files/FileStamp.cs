namespace FractalEngine.Core.Files;

/// <summary>Tells whether a file may have changed, without reading it: its size and the times of its creation and last change.</summary>
/// <remarks>A class: dictionaries of it share the framework's code, which is compiled ahead of time (decision 13).</remarks>
/// <param name="Length">Size in bytes; −1 for a file that does not exist or can't be examined.</param>
/// <param name="LastWriteTime">Time of the last change, UTC.</param>
/// <param name="CreationTime">Time of the creation where the system keeps it, UTC. It differs for a file that replaced another.</param>
public sealed record FileStamp(long Length, DateTime LastWriteTime, DateTime CreationTime)
{
    /// <summary>The stamp of a missing file.</summary>
    public static FileStamp Missing { get; } = new(-1, default, default);

    /// <summary>True for a file that existed.</summary>
    public bool Exists => Length >= 0;

    /// <summary>Reads the stamp of a file or folder, through symbolic links. That of a folder changes with the names in it.</summary>
    /// <param name="path">Path of a file or folder that may be missing.</param>
    public static FileStamp Of(string path)
    {
        try
        {
            var file = new FileInfo(path);
            if (file.LinkTarget is not null)
            {
                file = file.ResolveLinkTarget(returnFinalTarget: true) as FileInfo ?? file;
            }

            return file.Exists || Directory.Exists(file.FullName)
                ? new(file.Exists ? file.Length : 0, TimeOf(() => file.LastWriteTimeUtc), TimeOf(() => file.CreationTimeUtc))
                : Missing;
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException or ArgumentException)
        {
            // What can't be examined can't be read either. The reader says why.
            return Missing;
        }
    }

    // Some file systems keep times that the framework has no numbers for.
    private static DateTime TimeOf(Func<DateTime> read)
    {
        try
        {
            return read();
        }
        catch (ArgumentOutOfRangeException)
        {
            return default;
        }
    }
}
