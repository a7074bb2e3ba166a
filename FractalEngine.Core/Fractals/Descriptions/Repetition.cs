using System.Collections.Immutable;
using System.Numerics;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>A sequence of steps applied over and over: what <c>z 6</c> means for the steps that z adds to its base.</summary>
public sealed class Repetition : FractalStep
{
    /// <summary>Repeats the steps of one round.</summary>
    /// <param name="round">Outermost first: at least one step, each with finitely many levels.</param>
    /// <param name="count">Not negative; null for the infinite fractal.</param>
    /// <exception cref="ArgumentException">The round is empty or infinite itself.</exception>
    public Repetition(ImmutableArray<FractalStep> round, int? count)
    {
        if (round.IsDefaultOrEmpty || round.Any(step => step.LevelCount is null))
        {
            throw new ArgumentException("expected at least one step, and only finite ones", nameof(round));
        }

        if (count < 0)
        {
            throw new ArgumentOutOfRangeException(nameof(count), "expected a number that is not negative");
        }

        Round = round;
        LevelsPerRound = FractalSteps.LevelCount(round)!.Value;
        // A round without levels adds nothing, however often.
        Count = LevelsPerRound == 0 ? 0 : count;
        NestingDepth = 1 + round.Max(step => step.NestingDepth);
    }

    /// <summary>The steps of one round, outermost first.</summary>
    public ImmutableArray<FractalStep> Round { get; }

    /// <summary>Number of rounds; null for infinitely many. 0 for rounds without levels.</summary>
    public int? Count { get; }

    /// <summary>Number of sets that one round passes through.</summary>
    public long LevelsPerRound { get; }

    /// <inheritdoc/>
    /// <remarks>A number beyond that of a <see cref="long"/> is its maximum.</remarks>
    public override long? LevelCount =>
        Count is { } count ? (long)Int128.Min(long.MaxValue, (Int128)count * LevelsPerRound) : null;

    /// <inheritdoc/>
    public override int NestingDepth { get; }

    /// <inheritdoc/>
    /// <remarks>Exact at any size: a million rounds of 25 maps give a number of 1.4 million digits in about a second.</remarks>
    public override BigInteger? InstanceCount => (Count, FractalSteps.InstanceCount(Round)!.Value) switch
    {
        (0, _) => BigInteger.One,
        (_, var perRound) when perRound.IsZero => perRound,
        (null, _) => null,
        ({ } count, var perRound) => BigInteger.Pow(perRound, count),
    };

    /// <inheritdoc/>
    internal override IEnumerable<TransformationSet> Sets => Round.SelectMany(static step => step.Sets);

    /// <inheritdoc/>
    public override TransformationSet LevelAt(long level) => FractalSteps.LevelAt(Round, level % LevelsPerRound);

    /// <summary>Makes the same round repeated another number of times.</summary>
    public Repetition WithCount(int? count) => new(Round, count);

    /// <inheritdoc/>
    internal override BigInteger CountUpTo(long limit)
    {
        var perRound = FractalSteps.CountUpTo(Round, limit);
        if (perRound <= 1)
        {
            return Count == 0 ? BigInteger.One : perRound;
        }

        var product = BigInteger.One;
        for (var round = 0; product <= limit && !(round >= Count); round++)
        {
            product *= perRound;
        }

        return product;
    }

    /// <inheritdoc/>
    public override bool Equals(FractalStep? other) =>
        other is Repetition repetition && Count == repetition.Count && Round.AsSpan().SequenceEqual(repetition.Round.AsSpan());

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Count, HashOf(Round));
}
