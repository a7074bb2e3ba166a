using System.Collections.Concurrent;
using System.Text;

namespace FractalEngine.Core.Files;

/// <summary>The temporary files of writes that have not ended yet.</summary>
internal static class TemporaryFiles
{
    // The longest name within a folder that nearly all file systems allow.
    private const int MaxNameBytes = 255;

    private static readonly ConcurrentDictionary<string, bool> Unfinished = new();

    /// <summary>Names a file in the folder of a target: as the target, as far as the file system has room, with a number.</summary>
    public static string NameFor(string target)
    {
        var suffix = FormattableString.Invariant($".{Environment.ProcessId}-{Guid.NewGuid():N}.tmp");
        var name = Path.GetFileName(target.AsSpan());
        while (Encoding.UTF8.GetByteCount(name) + suffix.Length > MaxNameBytes)
        {
            name = name[..^(name.Length > 1 && char.IsLowSurrogate(name[^1]) ? 2 : 1)];
        }

        return string.Concat(Path.Join(Path.GetDirectoryName(target.AsSpan()), name), suffix);
    }

    /// <summary>Lists a file, before it is created.</summary>
    public static void Add(string path) => Unfinished[path] = true;

    /// <summary>Deletes a file, unless it was moved, and lists it no longer.</summary>
    public static void Delete(string path)
    {
        File.Delete(path);
        Unfinished.TryRemove(path, out _);
    }

    /// <summary>Deletes the temporary files of all unfinished writes, for a process that ends at once.</summary>
    public static void DeleteUnfinished()
    {
        foreach (var temporary in Unfinished.Keys)
        {
            try
            {
                File.Delete(temporary);
            }
            catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
            {
                // The process is about to end, and can do no more.
            }
        }
    }
}
