using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation.Building;

/// <summary>
/// A random number generator that gives the same sequence on every machine and in every release: SplitMix64 (Steele, Lea and Flood,
/// OOPSLA 2014).
/// </summary>
/// <remarks><c>System.Random</c> promises neither.</remarks>
/// <param name="seed">Start of the sequence.</param>
internal sealed class SplitMix64(ulong seed)
{
    private ulong _state = seed;

    /// <summary>Creates a generator for one part of a mesh, so that a change in one part leaves the others as they were.</summary>
    /// <param name="stream">Number of the part.</param>
    public SplitMix64 Fork(ulong stream) => new(HashMixing.Mix(_state ^ HashMixing.Mix(stream)));

    /// <summary>Draws 64 random bits.</summary>
    public ulong Next()
    {
        _state += HashMixing.GoldenGamma;
        return HashMixing.Mix(_state);
    }

    /// <summary>Draws a number from 0 to 1, 1 excluded, in steps of 2⁻⁵³.</summary>
    public double NextDouble() => (Next() >> 11) * (1.0 / (1UL << 53));

    /// <summary>Draws a number between two bounds.</summary>
    public double NextInRange(double minimum, double maximum) => minimum + ((maximum - minimum) * NextDouble());

    /// <summary>Draws true with the given probability.</summary>
    public bool Chance(double probability) => NextDouble() < probability;
}
