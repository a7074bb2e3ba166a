using System.Security.Cryptography;

namespace FractalEngine.Core.Files;

/// <summary>Writes files completely or not at all: into a temporary file in the same folder, which then replaces the target.</summary>
public static class AtomicFile
{
    // More files of one name in a folder are an accident.
    private const int MaxNumberedNames = 10_000;

    // So many times a file may change while it is being written before the write is given up.
    private const int MaxUpdateAttempts = 20;

    private const int BufferBytes = 1 << 16;

    /// <summary>Creates or replaces a file; its folder is created if it is missing.</summary>
    /// <param name="path">
    /// Path of the file. A symbolic link is followed, and the permissions of an existing file are kept. A device or a pipe is written as
    /// it stands.
    /// </param>
    /// <param name="write">Writes the contents, into a stream that may not seek. If it throws, the previous contents remain.</param>
    /// <exception cref="IOException">The file can't be written.</exception>
    public static void Write(string path, Action<Stream> write) => WriteThen(path, write, static move => move());

    /// <summary>
    /// Replaces a file by what is made of it. Where another program has written it meanwhile, what that has left is changed instead.
    /// </summary>
    /// <param name="path">Path of the file, as <see cref="Write"/> expects it. It may be missing.</param>
    /// <param name="make">Reads the file of this stamp, and returns its new contents; null to leave it as it is.</param>
    /// <exception cref="IOException">The file can't be written, or another program changes it all the time.</exception>
    /// <remarks>
    /// The stamp is compared just before the new file takes its name: what another program writes within the microseconds between is lost.
    /// </remarks>
    public static void Update(string path, Func<FileStamp, byte[]?> make)
    {
        ArgumentNullException.ThrowIfNull(make);
        for (var attempt = 0; attempt < MaxUpdateAttempts; attempt++)
        {
            var stamp = FileStamp.Of(path);
            if (make(stamp) is not { } bytes)
            {
                return;
            }

            var isUnchanged = true;
            WriteThen(path, stream => stream.Write(bytes), move =>
            {
                isUnchanged = FileStamp.Of(path) == stamp;
                if (isUnchanged)
                {
                    move();
                }
            });
            if (isUnchanged)
            {
                return;
            }
        }

        throw new IOException($"{path} can't be written: another program changes it all the time");
    }

    // The last argument calls the one that it is given, which moves the file to its name.
    private static void WriteThen(string path, Action<Stream> write, Action<Action> commit)
    {
        ArgumentException.ThrowIfNullOrEmpty(path);
        ArgumentNullException.ThrowIfNull(write);
        var target = path;
        var temporary = path;
        try
        {
            if (FileTypes.IsSpecial(path))
            {
                using var stream = FileTypes.OpenForWriting(path, BufferBytes);
                write(stream);
                return;
            }

            target = FindTarget(path);
            temporary = TemporaryFiles.NameFor(target);
            WriteTemporary(temporary, target, write, () => commit(() => File.Move(temporary, target, overwrite: true)));
        }
        catch (Exception exception) when (IsSystemError(exception))
        {
            throw WriteError(path, target, temporary, exception);
        }
    }

    /// <summary>
    /// Creates or replaces two files that belong together: both or neither. Both are written before the first takes its name.
    /// </summary>
    /// <param name="companion">Path of the file that takes its name first, as <see cref="Write"/> expects it; no device or pipe.</param>
    /// <param name="writeCompanion">Writes its contents. If it throws, both files remain as they were.</param>
    /// <param name="path">Path of the file that refers to the other one; no device or pipe.</param>
    /// <param name="write">Writes its contents, before the other file's. If it throws, both files remain as they were.</param>
    /// <exception cref="IOException">A file can't be written. Then neither has changed.</exception>
    /// <remarks>A process that is killed between the two renames leaves the new companion beside the old file.</remarks>
    public static void WritePair(string companion, Action<Stream> writeCompanion, string path, Action<Stream> write)
    {
        ArgumentException.ThrowIfNullOrEmpty(companion);
        ArgumentNullException.ThrowIfNull(writeCompanion);
        WriteThen(path, stream =>
        {
            if (stream is not FileStream { CanSeek: true } || FileTypes.IsSpecial(companion))
            {
                throw new IOException("a device or a pipe has no companion");
            }

            write(stream);
        }, move =>
        {
            var target = FindTarget(companion);
            var temporary = TemporaryFiles.NameFor(target);
            try
            {
                WriteTemporary(temporary, target, writeCompanion, () => FileExchange.Run(temporary, target, move));
            }
            catch (Exception exception) when (IsSystemError(exception))
            {
                throw WriteError(companion, target, temporary, exception);
            }
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
    public static string WriteWithoutReplacing(string path, Action<Stream> write, out bool isCreated)
    {
        ArgumentException.ThrowIfNullOrEmpty(path);
        ArgumentNullException.ThrowIfNull(write);
        var target = Path.GetFullPath(path);
        var temporary = TemporaryFiles.NameFor(target);
        var result = target;
        var wasMoved = false;
        try
        {
            WriteTemporary(temporary, target, write, () =>
            {
                result = FindNameFor(temporary, target, out var exists);
                if (!exists)
                {
                    File.Move(temporary, result, overwrite: false);
                    wasMoved = true;
                }
            });
        }
        catch (Exception exception) when (IsSystemError(exception))
        {
            throw WriteError(path, target, temporary, exception);
        }

        isCreated = wasMoved;
        return result;
    }

    /// <summary>Deletes the temporary files of all unfinished writes, for a process that ends at once.</summary>
    public static void DeleteUnfinished() => TemporaryFiles.DeleteUnfinished();

    /// <summary>Follows a symbolic link to what is to be replaced.</summary>
    private static string FindTarget(string path)
    {
        var target = new FileInfo(path) is { LinkTarget: not null } link
            ? link.ResolveLinkTarget(returnFinalTarget: true)!.FullName
            : Path.GetFullPath(path);
        return Directory.Exists(target) ? throw new IOException("it is a directory") : target;
    }

    private static bool IsSystemError(Exception exception) =>
        exception is IOException or UnauthorizedAccessException || IsTooLarge(exception);

    /// <summary>Tells whether a file is larger than the system allows, which the runtime reports as it does a wrong argument.</summary>
    private static bool IsTooLarge(Exception exception) =>
        exception is ArgumentOutOfRangeException && exception.StackTrace?.Contains(nameof(RandomAccess), StringComparison.Ordinal) == true;

    /// <summary>Describes an error for the user, who knows nothing of the temporary file.</summary>
    private static IOException WriteError(string path, string target, string temporary, Exception exception)
    {
        var reason = FindFileAmongFolders(target) is { } file
            ? $"{file} is a file, not a directory"
            : IsTooLarge(exception) ? "it is larger than the system allows"
            : exception.Message.Replace(temporary, target, StringComparison.Ordinal);
        // The system's message may end in the path, which stands at the beginning.
        var suffix = $" : '{Path.GetFullPath(target)}'";
        reason = reason.EndsWith(suffix, StringComparison.Ordinal) ? reason[..^suffix.Length] : reason;
        return new IOException($"{path} can't be written: {reason}", exception);
    }

    /// <summary>Finds a file where the path needs a folder; null if there is none.</summary>
    private static string? FindFileAmongFolders(string path)
    {
        var folder = Path.GetDirectoryName(path);
        while (!string.IsNullOrEmpty(folder) && !Path.Exists(folder))
        {
            folder = Path.GetDirectoryName(folder);
        }

        return File.Exists(folder) ? folder : null;
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
        return SHA256.HashData(stream1).AsSpan().SequenceEqual(SHA256.HashData(stream2));
    }

    /// <summary>Writes a temporary file with the permissions of its target, and deletes it unless the last action moves it.</summary>
    private static void WriteTemporary(string temporary, string target, Action<Stream> write, Action commit)
    {
        Directory.CreateDirectory(Path.GetDirectoryName(target)!);
        var options = new FileStreamOptions
        {
            Mode = FileMode.CreateNew, Access = FileAccess.Write, Share = FileShare.None, BufferSize = BufferBytes,
        };
        var mode = !OperatingSystem.IsWindows() && File.Exists(target) ? File.GetUnixFileMode(target) : (UnixFileMode?)null;
        if (!OperatingSystem.IsWindows() && mode is not null)
        {
            // What only the owner may read is never readable for others, not even meanwhile.
            options.UnixCreateMode = mode;
        }

        TemporaryFiles.Add(temporary);
        try
        {
            using (var stream = new FileStream(temporary, options))
            {
                write(stream);
            }

            if (!OperatingSystem.IsWindows() && mode is { } kept)
            {
                File.SetUnixFileMode(temporary, kept);
            }

            commit();
        }
        finally
        {
            TemporaryFiles.Delete(temporary);
        }
    }
}
