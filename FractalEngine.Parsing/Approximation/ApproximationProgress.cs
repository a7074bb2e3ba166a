namespace FractalEngine.Parsing.Approximation;

/// <summary>What a search for a fractal does at the moment.</summary>
/// <param name="Stage">What is looked for, as the object of a sentence.</param>
/// <param name="Best">The best that was found and measured; null for nothing yet.</param>
public sealed record ApproximationProgress(string Stage, ApproximationResult? Best);
