namespace FractalEngine.Render.Preparation;

/// <summary>How far <see cref="DrawableScene.Prepare"/> has come.</summary>
/// <param name="FileName">The name of the file at work.</param>
/// <param name="Fraction">Of the whole, from 0 to 1.</param>
public readonly record struct PreparationProgress(string FileName, double Fraction);
