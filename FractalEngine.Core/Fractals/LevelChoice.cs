using System.Collections.Immutable;

namespace FractalEngine.Core.Fractals;

/// <summary>Decides which one of the children of a level stands at a place, see <see cref="FractalLevels"/>.</summary>
/// <remarks>
/// By size the first child stands there up to <see cref="MaxSize"/>, and else the second one. By chance it is the first child i whose
/// <see cref="Ends"/> is above the SplitMix64 finalizer of the way plus <see cref="Seed"/>, modulo 2⁶⁴, or else the last one. By level,
/// the number of recursions so far, and then a 0, take the place of the way (<see cref="Descriptions.WrittenWay"/>).
/// </remarks>
public sealed record LevelChoice
{
    /// <summary>Ends of the alternatives' shares of 2⁶⁴; empty where sizes decide.</summary>
    public ImmutableArray<ulong> Ends { get; init; } = [];

    /// <summary>What is added to the number of a way before its bits are mixed.</summary>
    public ulong Seed { get; init; }

    /// <summary>Where levels decide: that of the top, the lowest one, and the levels of one recursion; null elsewhere.</summary>
    public (long Top, long Lowest, int Period)? ByLevel { get; init; }

    /// <summary>
    /// Where the number of recursions so far decides by itself, the first one of each alternative, ascending from 0; empty elsewhere.
    /// </summary>
    public ImmutableArray<int> FirstLevels { get; init; } = [];

    /// <summary>The largest number of a size at which the first child stands there; null where chance decides.</summary>
    public long? MaxSize { get; init; }
}
