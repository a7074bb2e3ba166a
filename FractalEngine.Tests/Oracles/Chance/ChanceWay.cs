namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>The number of a way from the whole to a place.</summary>
/// <param name="Number">Zero for the whole.</param>
internal readonly record struct ChanceWay(ulong Number)
{
    private const ulong Multiplier = 6364136223846793005;

    /// <summary>The way one number further.</summary>
    public ChanceWay To(int number) => new(unchecked((Number * Multiplier) + (ulong)number));

    /// <summary>Finds the alternative that stands at the end of the way.</summary>
    public int Choose(IEnumerable<double> weights, int seed)
    {
        var all = weights.ToArray();
        var total = 0.0;
        foreach (var weight in all)
        {
            total += weight;
        }

        var hash = unchecked(Finish(Number + Finish((ulong)seed)));
        var (sum, last) = (0.0, Array.FindLastIndex(all, static weight => weight > 0));
        for (var i = 0; i < last; i++)
        {
            sum += all[i];
            if (all[i] > 0 && hash < 2 * (UInt128)Math.Floor(Math.Pow(2, 63) * sum / total))
            {
                return i;
            }
        }

        return last;
    }

    /// <summary>The finalizer of SplitMix64.</summary>
    private static ulong Finish(ulong z)
    {
        unchecked
        {
            z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
            z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
            return z ^ (z >> 31);
        }
    }
}
