namespace FractalEngine.Parsing.Assets;

/// <summary>Reports the progress of loading one file.</summary>
/// <param name="File">Name of the file in messages.</param>
/// <param name="Fraction">Part of this file that is read, from 0 to 1.</param>
public readonly record struct LoadProgress(string File, double Fraction);
