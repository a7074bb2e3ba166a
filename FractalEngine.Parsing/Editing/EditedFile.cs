namespace FractalEngine.Parsing.Editing;

/// <summary>A text file that was edited in the window and not saved.</summary>
/// <param name="SavedText">Text of the file on the disk when the edit began.</param>
/// <param name="Text">The text as it is now.</param>
public sealed record EditedFile(string SavedText, string Text)
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

            // The line may have moved. Of several alike it is known by its number, if there are as many as before, and else by its place.
            var (earlier, now) = (PlacesOf(before[i], before), PlacesOf(before[i], lines));
            var isInPlace = lines.Length == before.Length ? lines[i] == before[i] : lines.Take(i + 1).SequenceEqual(before.Take(i + 1));
            var place = now.Length == earlier.Length ? now[Array.IndexOf(earlier, i)] : isInPlace ? i : -1;
            if (place < 0)
            {
                return null;
            }

            rebased[place] = after[i];
        }

        return new(present, string.Join('\n', rebased));
    }

    private static int[] PlacesOf(string line, string[] lines) => [.. Enumerable.Range(0, lines.Length).Where(i => lines[i] == line)];
}
