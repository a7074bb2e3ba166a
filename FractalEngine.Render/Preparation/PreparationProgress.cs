namespace FractalEngine.Render.Preparation;

/// <summary>How far <see cref="DrawableScene.Prepare"/> has come.</summary>
/// <param name="FileName">Name of the file that is being prepared.</param>
/// <param name="Fraction">Completed fraction of all models, from 0 to 1.</param>
public readonly record struct PreparationProgress(string FileName, double Fraction);
