using System.Collections.Immutable;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>A recursive: without levels it is its base, with levels the union of what it calls, or one of that by chance.</summary>
/// <param name="BasePart">Index of an earlier part of the graph.</param>
/// <param name="Calls">What it calls. Calls of one recursive are a set, calls of several a sum.</param>
public sealed record FractalRecursive(int BasePart, ImmutableArray<RecursiveCall> Calls)
{
    /// <summary>Decides which one of the calls stands there; null where all do.</summary>
    public Choice? Choice { get; init; }

    /// <summary>
    /// For each call, as paths and chance number it: the term, and the map in it. Calls of one target after each other are one term, which
    /// is a set.
    /// </summary>
    internal IEnumerable<(int Term, int Map)> NumberCalls()
    {
        var (term, map) = (-1, 0);
        for (var i = 0; i < Calls.Length; i++)
        {
            (term, map) = i > 0 && Calls[i].HasTargetOf(Calls[i - 1]) ? (term, map + 1) : (term + 1, 0);
            yield return (term, map);
        }
    }

    /// <summary>Indices of the earlier parts that the recursive is made of.</summary>
    public IEnumerable<int> References =>
        Calls.Where(static call => call.IsConstant).Select(static call => call.Target).Append(BasePart);

    /// <inheritdoc/>
    public bool Equals(FractalRecursive? other) =>
        other is not null && BasePart == other.BasePart && Choice == other.Choice && Calls.AsSpan().SequenceEqual(other.Calls.AsSpan());

    /// <inheritdoc/>
    public override int GetHashCode() => Calls.Aggregate(BasePart, HashCode.Combine);
}
