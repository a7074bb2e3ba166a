using System.Collections.Immutable;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Editing;

/// <summary>All text files that were edited in the window and not saved. Immutable, so that an undo returns to it.</summary>
public sealed class FileEdits : IEquatable<FileEdits>
{
    private FileEdits(ImmutableSortedDictionary<string, EditedFile> files)
    {
        Files = files;
        Texts = files.ToImmutableDictionary(static pair => pair.Key, static pair => pair.Value.Text);
    }

    /// <summary>The state of a window whose texts are all as they are on the disk.</summary>
    public static FileEdits None { get; } = new(ImmutableSortedDictionary.Create<string, EditedFile>(StringComparer.Ordinal));

    /// <summary>The edited files by their full paths.</summary>
    public ImmutableSortedDictionary<string, EditedFile> Files { get; }

    /// <summary>The present texts by the full paths of their files.</summary>
    public ImmutableDictionary<string, string> Texts { get; }

    /// <summary>True where no file is edited.</summary>
    public bool IsEmpty => Files.IsEmpty;

    /// <summary>Returns the present text of a file: as it was edited, or as it is on the disk.</summary>
    /// <exception cref="SourceException">The file can't be read.</exception>
    public string TextOf(string path) => Files.TryGetValue(path, out var edited) ? edited.Text : ReadText(path);

    /// <summary>Makes the edits with another text of a file. A text that equals that on the disk is no edit.</summary>
    /// <exception cref="SourceException">The file can't be read.</exception>
    public FileEdits With(string path, string text)
    {
        var saved = Files.TryGetValue(path, out var edited) ? edited.SavedText : ReadText(path);
        return saved == text ? Without(path) : new(Files.SetItem(path, new(saved, text)));
    }

    /// <summary>Makes the edits without those of a file.</summary>
    public FileEdits Without(string path) => Files.ContainsKey(path) ? new(Files.Remove(path)) : this;

    /// <summary>Makes the edits with another state of one file.</summary>
    /// <param name="path">Full path of the file.</param>
    /// <param name="other">Edits of which that of the file is taken over, or that it has none.</param>
    public FileEdits WithEditOf(string path, FileEdits other) =>
        other.Files.TryGetValue(path, out var edited) ? new(Files.SetItem(path, edited)) : Without(path);

    /// <summary>Makes the edits with the same texts, after a file was saved.</summary>
    /// <param name="path">Full path of the file.</param>
    /// <param name="before">Text of the file before it was saved.</param>
    /// <param name="after">Text of the file now.</param>
    /// <param name="carry">Makes in a text what the save has changed beside the edits; null for nothing.</param>
    public FileEdits AfterSave(string path, string before, string after, Func<string, string>? carry = null)
    {
        var text = Files.TryGetValue(path, out var edited) ? edited.Text : before;
        text = carry?.Invoke(text) ?? text;
        return text == after ? Without(path) : new(Files.SetItem(path, new(after, text)));
    }

    /// <summary>Makes the edits of a file with what a save has changed beside them, in the saved and in the edited text.</summary>
    /// <param name="path">Full path of the file.</param>
    /// <param name="carry">Makes the change of the save in a text.</param>
    public FileEdits Carry(string path, Func<string, string> carry) => !Files.TryGetValue(path, out var edited) ? this
        : new(Files.SetItem(path, new(carry(edited.SavedText), carry(edited.Text))));

    /// <summary>Makes the same edits in the files as they are on the disk now.</summary>
    /// <param name="report">Told about edits that are lost, since another program has changed the same lines.</param>
    public FileEdits Rebase(Action<string> report)
    {
        var edits = this;
        foreach (var (path, edited) in Files)
        {
            try
            {
                var rebased = edited.Rebase(ReadText(path));
                if (rebased is null)
                {
                    var name = Path.GetFileName(path);
                    report($"{name} was changed elsewhere in the same place: that is shown, and the edits here are dropped");
                }

                edits = rebased is null || rebased.Text == rebased.SavedText ? edits.Without(path)
                    : rebased == edited ? edits : new(edits.Files.SetItem(path, rebased));
            }
            catch (SourceException)
            {
                // A file that is missing for a moment is being replaced.
            }
        }

        return edits;
    }

    /// <inheritdoc/>
    public bool Equals(FileEdits? other) => other is not null && (ReferenceEquals(this, other) || Files.SequenceEqual(other.Files));

    /// <inheritdoc/>
    public override bool Equals(object? obj) => Equals(obj as FileEdits);

    /// <inheritdoc/>
    public override int GetHashCode() => Files.Count;

    private static string ReadText(string path) =>
        SourceText.Read(path, Path.GetFileName(path), ParsingLimits.DescriptionBytes.Value, acceptLatin1: true).Text;
}
