namespace FractalEngine.Parsing.Assets;

/// <summary>Writes files whole or not at all: into a neighbour first, which then takes the file's place.</summary>
public static class AtomicFile
{
    /// <summary>Creates or replaces a file.</summary>
    /// <param name="path">Where to; a symbolic link is followed, the permissions of a file that exists are kept.</param>
    /// <param name="write">Writes the contents. If it throws, what was there before stays as it was.</param>
    /// <exception cref="IOException">The file can't be written. Its folder is made if there is none.</exception>
    public static void Write(string path, Action<Stream> write)
    {
        var target = new FileInfo(path) is { LinkTarget: not null } link
            ? link.ResolveLinkTarget(returnFinalTarget: true)!.FullName
            : Path.GetFullPath(path);
        if (Directory.Exists(target))
        {
            throw new IOException($"{path} is a directory");
        }

        Directory.CreateDirectory(Path.GetDirectoryName(target)!);
        var temporary = $"{target}.{Environment.ProcessId}-{Guid.NewGuid():N}.tmp";
        try
        {
            using (var stream = new FileStream(temporary, FileMode.CreateNew, FileAccess.Write, FileShare.None, 1 << 16))
            {
                write(stream);
            }

            if (!OperatingSystem.IsWindows() && File.Exists(target))
            {
                File.SetUnixFileMode(temporary, File.GetUnixFileMode(target));
            }

            File.Move(temporary, target, overwrite: true);
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            // The neighbour is nobody's business.
            throw new IOException($"{path} can't be written: {exception.Message.Replace(temporary, target, StringComparison.Ordinal)}",
                exception);
        }
        finally
        {
            File.Delete(temporary);
        }
    }
}
