namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>What a search in a damaged mesh may assume and spend.</summary>
/// <param name="Noise">How far vertices may be from where they belong, scene units; null to estimate it from the mesh.</param>
/// <param name="Seed">Chooses the samples that hypotheses are tested on first.</param>
/// <param name="Effort">Budget of hypotheses; 1 is enough for a thousand elements.</param>
public sealed record DamagedSearchSettings(double? Noise = null, int Seed = 0, double Effort = 1);
