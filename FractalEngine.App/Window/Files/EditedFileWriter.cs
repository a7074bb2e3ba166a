using System.Text;
using FractalEngine.Core.Files;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App.Window.Files;

/// <summary>Writes texts that were edited in the window into their files.</summary>
internal static class EditedFileWriter
{
    // So many times the file may change while it is being written before the write is given up.
    private const int MaxAttempts = 20;

    /// <summary>Replaces the text of a file, if it is still the one that the edit began with. Its byte order mark stays.</summary>
    /// <param name="path">Full path of the file.</param>
    /// <param name="edited">The edit.</param>
    /// <param name="complete">Changes more in the text with the edit as it will be on the disk; null for nothing.</param>
    /// <exception cref="IOException">The file can't be read or written, is no UTF-8, or was changed in the same lines.</exception>
    public static void Write(string path, EditedFile edited, Func<string, string>? complete = null)
    {
        for (var attempt = 1; !TryWrite(path, edited, complete); attempt++)
        {
            if (attempt == MaxAttempts)
            {
                throw new IOException($"{Path.GetFileName(path)} can't be saved: another program changes it all the time");
            }
        }
    }

    /// <summary>Returns false where another program has written the file in between, which must not be replaced.</summary>
    private static bool TryWrite(string path, EditedFile edited, Func<string, string>? complete)
    {
        var name = Path.GetFileName(path);
        var stamp = FileStamp.Of(path);
        byte[] bytes;
        string present;
        try
        {
            bytes = SourceText.ReadBytes(path, name, ParsingLimits.MaxDescriptionBytes);
            present = SourceText.Decode(bytes, name).Text;
        }
        catch (SourceException exception)
        {
            throw new IOException($"{name} can't be saved: {exception.Diagnostic.Message}", exception);
        }

        var mark = bytes.AsSpan().StartsWith(Encoding.UTF8.Preamble) ? Encoding.UTF8.Preamble.ToArray() : [];

        if (!bytes.AsSpan(mark.Length).SequenceEqual(Encoding.UTF8.GetBytes(present)))
        {
            throw new IOException($"{name} can't be saved here, since it is no UTF-8: save it in an editor");
        }

        var rebased = edited.Rebase(present)
            ?? throw new IOException($"{name} was changed elsewhere in the same place, so it was not saved");
        var text = complete?.Invoke(rebased.Text) ?? rebased.Text;
        var isUnchanged = false;
        AtomicFile.WriteIf(
            path,
            stream =>
            {
                stream.Write(mark);
                stream.Write(Encoding.UTF8.GetBytes(text));
            },
            () => isUnchanged = FileStamp.Of(path) == stamp);
        return isUnchanged;
    }
}
