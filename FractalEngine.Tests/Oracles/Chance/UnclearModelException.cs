namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>A model that is refused, or whose meaning is left to rounding or not said.</summary>
/// <param name="reason">What it has.</param>
internal sealed class UnclearModelException(string reason) : Exception(reason);
