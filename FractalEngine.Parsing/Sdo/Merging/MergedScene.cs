using System.Collections.Immutable;

namespace FractalEngine.Parsing.Sdo.Merging;

/// <summary>The result of a merge, see <see cref="SceneMerge"/>.</summary>
/// <param name="Text">Text of the file with all changes that do not conflict.</param>
/// <param name="Conflicts">Declarations that both sides have changed, and whose lines are still those of the file.</param>
public sealed record MergedScene(string Text, ImmutableArray<MergeConflict> Conflicts);
