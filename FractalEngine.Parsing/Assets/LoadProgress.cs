namespace FractalEngine.Parsing.Assets;

/// <summary>How far the loading of a file has come.</summary>
/// <param name="File">As messages name it.</param>
/// <param name="Fraction">From 0 to 1, of this file.</param>
public readonly record struct LoadProgress(string File, double Fraction);
