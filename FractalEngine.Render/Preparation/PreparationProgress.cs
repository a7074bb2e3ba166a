namespace FractalEngine.Render.Preparation;

/// <summary>Progress of <see cref="DrawableScene.Prepare"/>.</summary>
/// <param name="FileName">Name of the file that is being prepared.</param>
/// <param name="Fraction">Completed fraction of all models, from 0 to 1.</param>
public readonly record struct PreparationProgress(string FileName, double Fraction);
