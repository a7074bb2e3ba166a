namespace FractalEngine.Core.Generation;

/// <summary>
/// A sequence of random numbers that is the same on every machine and in every release: Steele, Lea and Flood's SplitMix64
/// (OOPSLA 2014). <c>System.Random</c> promises neither.
/// </summary>
internal sealed class SplitMix64(ulong seed)
{
    private ulong _state = seed;

    /// <summary>A sequence of its own for one part of a mesh, so that a change in one part leaves the others as they were.</summary>
    public SplitMix64 Fork(ulong stream) => new(Mix(_state ^ Mix(stream)));

    /// <summary>64 random bits.</summary>
    public ulong Next() => Mix(_state += 0x9E3779B97F4A7C15);

    /// <summary>From 0 to 1, 1 excluded, in steps of 2⁻⁵³.</summary>
    public double NextDouble() => (Next() >> 11) * (1.0 / (1UL << 53));

    /// <summary>From one number to another.</summary>
    public double NextInRange(double minimum, double maximum) => minimum + ((maximum - minimum) * NextDouble());

    /// <summary>True with the given probability.</summary>
    public bool Chance(double probability) => NextDouble() < probability;

    /// <summary>The bits of a number mixed so that each depends on all.</summary>
    public static ulong Mix(ulong bits)
    {
        bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9;
        bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EB;
        return bits ^ (bits >> 31);
    }
}
