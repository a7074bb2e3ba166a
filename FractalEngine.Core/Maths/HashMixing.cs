namespace FractalEngine.Core.Maths;

/// <summary>Constants and functions that spread the bits of a number over all bits of a hash.</summary>
internal static class HashMixing
{
    /// <summary>2⁶⁴ divided by the golden ratio, made odd: multiples of it are spread evenly over all 64-bit numbers.</summary>
    public const ulong GoldenGamma = 0x9E3779B97F4A7C15;

    /// <summary>Mixes the bits of a number, reversibly, so that each result bit depends on all of them.</summary>
    /// <remarks>The finalizer of SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).</remarks>
    public static ulong Mix(ulong bits)
    {
        bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9;
        bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EB;
        return bits ^ (bits >> 31);
    }
}
