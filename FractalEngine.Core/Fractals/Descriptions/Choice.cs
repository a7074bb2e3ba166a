using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>What decides by chance, or by the level, which call of a recursive stands there: the others are left out.</summary>
/// <remarks>
/// Chance decides at each place anew, by a 64-bit hash of the seed and the way to the place, which is compared with the weights in
/// integers. So the same file is the same fractal on every machine, and nothing is kept.
/// </remarks>
public sealed record Choice
{
    /// <summary>Most alternatives of one choice: searches keep one bit of a word for each.</summary>
    public const int MaxAlternatives = 64;

    /// <summary>Largest seed that files and options may state.</summary>
    public const int MaxSeed = 999_999_999;

    private readonly ulong[] _ends;
    private readonly ulong _start;
    private readonly int _last;

    /// <summary>Makes a choice by weights.</summary>
    /// <param name="weights">For each call how often it stands there, relative to the others: not negative, and not all 0.</param>
    /// <param name="seed">Another seed is another fractal of the same kind.</param>
    /// <param name="isByLevel">True where all places with as many calls above them have the same alternative.</param>
    /// <exception cref="ArgumentException">A weight is negative or not finite, all are 0, or there are more than 64.</exception>
    public Choice(ImmutableArray<double> weights, int seed, bool isByLevel = false)
    {
        ArgumentCheck.Require(
            !weights.IsDefaultOrEmpty && weights.Length <= MaxAlternatives
                && weights.All(static weight => weight >= 0) && weights.Sum() is > 0 and < double.PositiveInfinity,
            $"expected 1 to {MaxAlternatives} weights that are not negative, and at least one above 0", nameof(weights));

        Weights = weights;
        Seed = seed;
        IsByLevel = isByLevel;
        _start = HashMixing.Mix((ulong)(uint)seed);
        _ends = new ulong[weights.Length];
        var (sum, total) = (0.0, weights.Sum());
        _last = weights.Length - 1;
        while (weights[_last] == 0)
        {
            _last--;
        }

        for (var i = 0; i < weights.Length; i++)
        {
            sum += weights[i];
            // A double has no more than 53 bits, so that nothing is lost.
            _ends[i] = i >= _last ? ulong.MaxValue : (ulong)Math.Floor(Math.ScaleB(sum / total, 63)) << 1;
        }
    }

    /// <summary>For each call how often it stands there, relative to the others.</summary>
    public ImmutableArray<double> Weights { get; }

    /// <summary>Another seed is another fractal of the same kind.</summary>
    public int Seed { get; }

    /// <summary>True where all places with as many calls above them have the same alternative.</summary>
    public bool IsByLevel { get; }

    /// <summary>Ends of the alternatives' shares of 2⁶⁴ hashes.</summary>
    internal ImmutableArray<ulong> Ends => [.. _ends];

    /// <summary>What is added to the number of a way before its bits are mixed.</summary>
    internal ulong Start => _start;

    /// <summary>
    /// Where levels decide, the first level of each alternative: 0 for the outermost one of the recursive, and ascending. Empty where
    /// chance decides.
    /// </summary>
    public ImmutableArray<int> FirstLevels { get; private init; } = [];

    /// <summary>Makes a choice by levels alone, without chance.</summary>
    /// <param name="firstLevels">The first level of each alternative, ascending from 0. The last one stands at all further levels.</param>
    /// <exception cref="ArgumentException">They don't ascend from 0, or there are more than 64.</exception>
    public static Choice OfLevels(ImmutableArray<int> firstLevels)
    {
        ArgumentCheck.Require(
            !firstLevels.IsDefaultOrEmpty && firstLevels[0] == 0
                && firstLevels.Zip(firstLevels.Skip(1)).All(static pair => pair.First < pair.Second),
            "expected levels that ascend from 0", nameof(firstLevels));
        return new([.. firstLevels.Select(static _ => 1.0)], 0, isByLevel: true) { FirstLevels = firstLevels };
    }

    /// <summary>Makes the same choice with another seed, where it is one by chance.</summary>
    public Choice WithSeed(int seed) => FirstLevels.IsEmpty ? new(Weights, seed, IsByLevel) : this;

    /// <summary>How many of 2⁶⁴ hashes make an alternative stand there.</summary>
    internal BigInteger ProbabilityOf(int index) => EndOf(index) - (index > 0 ? EndOf(index - 1) : 0);

    /// <summary>Finds which alternative stands at a place.</summary>
    /// <param name="way">The number of the way to the place, see <see cref="WrittenWay"/>.</param>
    /// <remarks>
    /// With the finalizer of SplitMix64, m, it is the first alternative i for which m(way + m(seed)) is below 2⁶⁴ times the sum of the
    /// weights up to i, by that of all, rounded down to an even number.
    /// </remarks>
    public int Select(ulong way)
    {
        var hash = HashMixing.Mix(way + _start);
        var i = 0;
        while (hash >= _ends[i] && i < _last)
        {
            i++;
        }

        return i;
    }

    /// <summary>Finds which alternative stands at a level, for a choice by levels.</summary>
    /// <param name="level">From 0, the outermost one of the recursive.</param>
    public int SelectAt(long level)
    {
        if (FirstLevels.IsEmpty)
        {
            return Select(WrittenWay.Of(level, 0).After(0));
        }

        // Searches ask at each place, and allocate nothing.
        var last = FirstLevels.Length - 1;
        while (FirstLevels[last] > level)
        {
            last--;
        }

        return last;
    }

    private BigInteger EndOf(int index) => index >= _last ? BigInteger.One << 64 : _ends[index];

    /// <inheritdoc/>
    public bool Equals(Choice? other) => other is not null && Seed == other.Seed && IsByLevel == other.IsByLevel
        && Weights.AsSpan().SequenceEqual(other.Weights.AsSpan()) && FirstLevels.AsSpan().SequenceEqual(other.FirstLevels.AsSpan());

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Seed, Weights.Length, Weights[0]);
}
