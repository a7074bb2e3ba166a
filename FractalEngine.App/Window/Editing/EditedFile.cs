namespace FractalEngine.App.Window.Editing;

/// <summary>A text file that was edited in the window and not saved.</summary>
/// <param name="SavedText">Text of the file on the disk when the edit began.</param>
/// <param name="Text">The text as it is now.</param>
internal sealed record EditedFile(string SavedText, string Text)
{
    /// <summary>Makes the same changes in another text of the file, line by line.</summary>
    /// <param name="present">Text of the file on the disk now.</param>
    /// <returns>Null where both sides have changed the same lines, or lines were added or removed.</returns>
    public EditedFile? Rebase(string present)
    {
        if (present == SavedText)
        {
            return this;
        }

        var before = SavedText.Split('\n');
        var after = Text.Split('\n');
        var lines = present.Split('\n');
        var rebased = lines.ToArray();
        if (before.Length != after.Length)
        {
            return null;
        }

        for (var i = 0; i < before.Length; i++)
        {
            if (before[i] == after[i] || (lines.Length == after.Length && lines[i] == after[i]))
            {
                // Not changed here, or the same on both sides, as after a save of which the window does not know yet.
                continue;
            }

            // The line may have moved, if there is only one like it: among those on the disk, not those that were changed already.
            var place = i < lines.Length && lines[i] == before[i] ? i : Array.IndexOf(lines, before[i]);
            if (place < 0 || (place != i && Array.LastIndexOf(lines, before[i]) != place))
            {
                return null;
            }

            rebased[place] = after[i];
        }

        return new(present, string.Join('\n', rebased));
    }
}
