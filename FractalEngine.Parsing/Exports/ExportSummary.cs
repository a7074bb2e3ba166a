using System.Collections.Immutable;

namespace FractalEngine.Parsing.Exports;

/// <summary>What an export has written.</summary>
/// <param name="Contents">What the file holds, such as "12 faces", for the line that a command ends with.</param>
public sealed record ExportSummary(string Contents)
{
    /// <summary>Tells of a number of faces.</summary>
    public static ExportSummary OfFaces(long count) => new(count == 1 ? "1 face" : FormattableString.Invariant($"{count} faces"));

    /// <summary>What the format could not keep, a sentence each, for warnings; empty where it kept all.</summary>
    public ImmutableArray<string> Losses { get; init; } = [];
}
