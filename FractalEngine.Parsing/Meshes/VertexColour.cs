namespace FractalEngine.Parsing.Meshes;

/// <summary>What the numbers behind the position of a vertex mean, for the grammar and its kernel alike.</summary>
internal static class VertexColour
{
    /// <summary>Numbers behind a position that are kept: one more than have a meaning.</summary>
    public const int MaxNumbers = 5;

    /// <summary>The component of vertices without a colour, where others have one: white.</summary>
    public const double Default = 1;

    /// <summary>Returns red, green and blue: three numbers alone, or behind a weight; nothing for any other count.</summary>
    /// <param name="numbers">Numbers behind the position; at most <see cref="MaxNumbers"/> are valid.</param>
    /// <param name="count">How many numbers there were.</param>
    public static ReadOnlySpan<double> Find(ReadOnlySpan<double> numbers, int count) =>
        count is 3 or 4 ? numbers[(count - 3)..count] : [];
}
