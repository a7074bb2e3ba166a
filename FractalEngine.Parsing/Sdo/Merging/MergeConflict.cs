namespace FractalEngine.Parsing.Sdo.Merging;

/// <summary>A declaration of a scene that both sides have changed.</summary>
/// <param name="Mine">Its line on the side that saves; null where that side has removed it.</param>
/// <param name="Theirs">Its line in the file; null where it was removed from the file.</param>
public sealed record MergeConflict(string? Mine, string? Theirs);
