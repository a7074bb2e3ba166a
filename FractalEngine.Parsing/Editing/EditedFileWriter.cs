using System.Text;
using FractalEngine.Core.Files;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Editing;

/// <summary>Writes texts that were edited in the window into their files.</summary>
public static class EditedFileWriter
{
    /// <summary>Replaces the text of a file, if it is still the one that the edit began with. Its byte order mark stays.</summary>
    /// <param name="path">Full path of the file.</param>
    /// <param name="edited">The edit.</param>
    /// <param name="complete">Changes more in the text with the edit as it will be on the disk; null for nothing.</param>
    /// <exception cref="IOException">The file can't be read or written, is no UTF-8, or was changed in the same lines.</exception>
    public static void Write(string path, EditedFile edited, Func<string, string>? complete = null) => AtomicFile.Update(path, _ =>
    {
        var name = Path.GetFileName(path);
        byte[] bytes;
        string present;
        try
        {
            bytes = SourceText.ReadBytes(path, name, ParsingLimits.DescriptionBytes.Value);
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
        return [.. mark, .. Encoding.UTF8.GetBytes(complete?.Invoke(rebased.Text) ?? rebased.Text)];
    });
}
