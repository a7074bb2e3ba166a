namespace FractalEngine.Parsing.Assets;

/// <summary>Writes files completely or not at all: into a temporary file in the same folder, which then replaces the target.</summary>
public static class AtomicFile
{
    // More files of one name in a folder are an accident.
    private const int MaxNumberedNames = 10_000;

    /// <summary>Creates or replaces a file; its folder is created if it is missing.</summary>
    /// <param name="path">
    /// Path of the file. A symbolic link is followed, and the permissions of an existing file are kept.
    /// </param>
    /// <param name="write">Writes the contents. If it throws, the previous contents remain.</param>
    /// <exception cref="IOException">The file can't be written.</exception>
    public static void Write(string path, Action<Stream> write)
    {
        var target = new FileInfo(path) is { LinkTarget: not null } link
            ? link.ResolveLinkTarget(returnFinalTarget: true)!.FullName
            : Path.GetFullPath(path);
        if (Directory.Exists(target))
        {
            throw new IOException($"{path} is a directory");
        }

        WriteTemporary(path, target, write, temporary =>
        {
            if (!OperatingSystem.IsWindows() && File.Exists(target))
            {
                File.SetUnixFileMode(temporary, File.GetUnixFileMode(target));
            }

            File.Move(temporary, target, overwrite: true);
        });
    }

    /// <summary>
    /// Creates a file without ever replacing another one. A file with equal contents is used as it is; if the name is taken by another
    /// file, <c>NAME-2.EXT</c>, <c>NAME-3.EXT</c> and so on are tried.
    /// </summary>
    /// <param name="path">Path of the file; its folder is created if it is missing.</param>
    /// <param name="write">Writes the contents. If it throws, no file is left behind.</param>
    /// <param name="isCreated">False if a file with equal contents existed.</param>
    /// <returns>Full path of the file with these contents.</returns>
    /// <exception cref="IOException">The file can't be written.</exception>
    internal static string WriteNew(string path, Action<Stream> write, out bool isCreated)
    {
        var result = Path.GetFullPath(path);
        var wasMoved = false;
        WriteTemporary(path, result, write, temporary =>
        {
            result = FindNameFor(temporary, result, out var exists);
            if (!exists)
            {
                File.Move(temporary, result, overwrite: false);
                wasMoved = true;
            }
        });
        isCreated = wasMoved;
        return result;
    }

    /// <summary>Finds the first name that is free, or taken by a file with the same contents.</summary>
    private static string FindNameFor(string contents, string path, out bool exists)
    {
        var stem = Path.Combine(Path.GetDirectoryName(path)!, Path.GetFileNameWithoutExtension(path));
        for (var number = 1; number <= MaxNumberedNames; number++)
        {
            var candidate = number == 1 ? path : FormattableString.Invariant($"{stem}-{number}{Path.GetExtension(path)}");
            exists = Path.Exists(candidate) || new FileInfo(candidate).LinkTarget is not null;
            if (!exists || IsFileWithContents(contents, candidate))
            {
                return candidate;
            }
        }

        throw new IOException("all names that could be used instead are taken");
    }

    private static bool IsFileWithContents(string contents, string candidate)
    {
        if (!File.Exists(candidate) || new FileInfo(contents).Length != new FileInfo(candidate).Length)
        {
            return false;
        }

        try
        {
            return HaveEqualContents(contents, candidate);
        }
        catch (UnauthorizedAccessException)
        {
            // A file that can't be read might be different, so it is not used.
            return false;
        }
    }

    private static bool HaveEqualContents(string file1, string file2)
    {
        using var stream1 = File.OpenRead(file1);
        using var stream2 = File.OpenRead(file2);
        var buffer1 = new byte[1 << 16];
        var buffer2 = new byte[1 << 16];
        int count;
        do
        {
            count = stream1.ReadAtLeast(buffer1, buffer1.Length, throwOnEndOfStream: false);
            if (stream2.ReadAtLeast(buffer2, buffer2.Length, throwOnEndOfStream: false) != count
                || !buffer1.AsSpan(0, count).SequenceEqual(buffer2.AsSpan(0, count)))
            {
                return false;
            }
        }
        while (count > 0);
        return true;
    }

    private static void WriteTemporary(string path, string target, Action<Stream> write, Action<string> commit)
    {
        var temporary = $"{target}.{Environment.ProcessId}-{Guid.NewGuid():N}.tmp";
        try
        {
            Directory.CreateDirectory(Path.GetDirectoryName(target)!);
            try
            {
                using (var stream = new FileStream(temporary, FileMode.CreateNew, FileAccess.Write, FileShare.None, 1 << 16))
                {
                    write(stream);
                }

                commit(temporary);
            }
            finally
            {
                File.Delete(temporary);
            }
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            // The user knows nothing of the temporary file.
            throw new IOException($"{path} can't be written: {exception.Message.Replace(temporary, target, StringComparison.Ordinal)}",
                exception);
        }
    }
}
