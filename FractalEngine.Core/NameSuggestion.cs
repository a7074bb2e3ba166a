namespace FractalEngine.Core;

/// <summary>Finds the name that a misspelt one probably means, for messages that ask "did you mean …?".</summary>
public static class NameSuggestion
{
    // Longer names are compared by nobody, and the time grows with the square of the length.
    private const int MaxLength = 64;

    private const int MaxDistance = 3;

    /// <summary>
    /// Finds the candidate with the fewest edits (insertions, deletions, replacements and swaps of neighbours) from a name, ignoring case.
    /// </summary>
    /// <param name="name">The name that is not known.</param>
    /// <param name="candidates">The known names; of several at the same distance the first is taken.</param>
    /// <returns>Null unless a candidate differs by at most one edit in three characters, and by at most three.</returns>
    public static string? Find(string name, IEnumerable<string> candidates)
    {
        ArgumentNullException.ThrowIfNull(name);
        ArgumentNullException.ThrowIfNull(candidates);
        var best = (Name: (string?)null, Distance: int.MaxValue);
        foreach (var candidate in candidates)
        {
            var allowed = Math.Min(Math.Min(name.Length, candidate.Length) / 3, MaxDistance);
            if (name.Length > MaxLength || candidate.Length > MaxLength || Math.Abs(name.Length - candidate.Length) > allowed)
            {
                continue;
            }

            var distance = CountEdits(name.ToUpperInvariant(), candidate.ToUpperInvariant());
            if (distance <= allowed && distance < best.Distance)
            {
                best = (candidate, distance);
            }
        }

        return best.Name;
    }

    /// <summary>Returns the question <c>: did you mean 'name'?</c>, or nothing where no candidate is near.</summary>
    /// <inheritdoc cref="Find"/>
    public static string Ask(string name, IEnumerable<string> candidates) =>
        Find(name, candidates) is { } found ? $": did you mean '{found}'?" : "";

    /// <summary>Computes the optimal string alignment distance.</summary>
    private static int CountEdits(string from, string to)
    {
        var edits = new int[from.Length + 1, to.Length + 1];
        for (var i = 0; i <= from.Length; i++)
        {
            for (var j = 0; j <= to.Length; j++)
            {
                edits[i, j] = Math.Min(i, j) == 0 ? Math.Max(i, j) : Math.Min(
                    Math.Min(edits[i - 1, j], edits[i, j - 1]) + 1,
                    edits[i - 1, j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1));
                if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
                {
                    edits[i, j] = Math.Min(edits[i, j], edits[i - 2, j - 2] + 1);
                }
            }
        }

        return edits[from.Length, to.Length];
    }
}
