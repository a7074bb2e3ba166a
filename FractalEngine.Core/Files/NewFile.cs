using System.Text;

namespace FractalEngine.Core.Files;

/// <summary>Writes files under new names. No other file is ever replaced.</summary>
public static class NewFile
{
    /// <summary>Returns the first of the paths stem.ending, stem-2.ending, stem-3.ending … that is free.</summary>
    public static string Propose(string stem, string ending, Func<string, bool> isFree)
    {
        ArgumentNullException.ThrowIfNull(stem);
        ArgumentNullException.ThrowIfNull(ending);
        ArgumentNullException.ThrowIfNull(isFree);
        return Enumerable.Range(1, int.MaxValue)
            .Select(number => number == 1 ? $"{stem}{ending}" : FormattableString.Invariant($"{stem}-{number}{ending}")).First(isFree);
    }

    /// <summary>Requires a path to have one of some endings, a folder that exists, and no file.</summary>
    /// <param name="path">Full path of the file.</param>
    /// <param name="kind">What it will be, with its article.</param>
    /// <param name="endings">The endings, with their dots.</param>
    /// <exception cref="IOException">It has not.</exception>
    public static void Require(string path, string kind, params ReadOnlySpan<string> endings)
    {
        ArgumentNullException.ThrowIfNull(path);
        string[] possible = [.. endings];
        if (!Array.Exists(possible, ending => path.EndsWith(ending, StringComparison.OrdinalIgnoreCase)))
        {
            throw new IOException($"the name of {kind} ends in {string.Join(", ", possible)}");
        }

        if (!Directory.Exists(Path.GetDirectoryName(path)))
        {
            throw new IOException($"the folder {Path.GetDirectoryName(path)} does not exist");
        }

        if (Path.Exists(path))
        {
            throw Taken(path);
        }
    }

    /// <summary>Writes a text into a file.</summary>
    /// <exception cref="IOException">The file exists or can't be written.</exception>
    public static void Write(string path, string text)
    {
        var bytes = Encoding.UTF8.GetBytes(text);
        var written = AtomicFile.WriteWithoutReplacing(path, stream => stream.Write(bytes), out var isCreated);
        if (!isCreated || written != path)
        {
            // Another program has taken the name just now.
            if (isCreated)
            {
                File.Delete(written);
            }

            throw Taken(path);
        }
    }

    private static IOException Taken(string path) => new($"{Path.GetFileName(path)} exists already, and is not replaced");
}
