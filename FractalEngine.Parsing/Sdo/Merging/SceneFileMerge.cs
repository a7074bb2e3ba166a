using System.Text;
using FractalEngine.Core.Files;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Sdo.Merging;

/// <summary>Writes changes of a scene into its file as it is on the disk, see <see cref="SceneMerge"/>.</summary>
public static class SceneFileMerge
{
    /// <summary>Merges the changes from one text to another into a file. Nothing is written where a conflict is left to decide.</summary>
    /// <param name="path">Path of the scene. A missing file is written with the changed text; its folder must exist.</param>
    /// <param name="original">Text that both sides began with.</param>
    /// <param name="mine">The original with the changes of the side that saves.</param>
    /// <param name="preference">Which side wins where both have changed the same declaration.</param>
    /// <returns>The text that the file has now, and the conflicts for which nothing was written.</returns>
    /// <exception cref="IOException">The file can't be read or written, or its folder is missing. It is unchanged then.</exception>
    /// <remarks>
    /// The file is replaced whole, and only if it is still the one that was merged, see <see cref="AtomicFile.Update"/>. Its encoding
    /// stays: UTF-8 with or without a byte order mark, UTF-16, or bytes that are no text at all.
    /// </remarks>
    public static MergedScene Write(string path, string original, string mine, MergePreference preference = MergePreference.None)
    {
        MergedScene? result = null;
        AtomicFile.Update(path, stamp =>
        {
            if (Path.GetDirectoryName(Path.GetFullPath(path)) is { } folder && !Directory.Exists(folder))
            {
                throw new IOException($"{path} can't be written: the folder {folder} is gone");
            }

            var before = stamp.Exists ? ReadBytes(path) : null;
            var encoding = before is null ? Encoding.UTF8 : EncodingOf(before);
            var merged = before is null ? new(mine, []) : SceneMerge.Merge(original, mine, encoding.GetString(before), preference);
            var after = encoding.GetBytes(merged.Text);
            result = merged with { Text = before is null ? mine : DecodeForReaders(after, path) };
            return merged.Conflicts.Length > 0 || (before is not null && before.AsSpan().SequenceEqual(after)) ? null : after;
        });
        return result!;
    }

    private static byte[] ReadBytes(string path)
    {
        try
        {
            return SourceText.ReadBytes(path, path, ParsingLimits.DescriptionBytes.Value);
        }
        catch (SourceException exception)
        {
            throw new IOException($"{path} can't be saved: {exception.Diagnostic.Message}", exception);
        }
    }

    /// <summary>
    /// UTF-16 is what its byte order mark says. All others are read byte by byte: what the window writes is ASCII in all of them, and
    /// every other byte comes back as it was.
    /// </summary>
    private static Encoding EncodingOf(byte[] bytes) => Utf16Text.FindEncoding(bytes) ?? Encoding.Latin1;

    /// <summary>Decodes the text as the parser would see it; a file that is no text stays as its bytes.</summary>
    private static string DecodeForReaders(byte[] bytes, string path)
    {
        try
        {
            return SourceText.Decode(bytes, path, acceptLatin1: true).Text;
        }
        catch (SourceException)
        {
            return Encoding.Latin1.GetString(bytes);
        }
    }
}
