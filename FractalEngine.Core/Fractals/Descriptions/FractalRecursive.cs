using System.Collections.Immutable;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>A recursive: without levels it is its base, with levels the union of what it calls.</summary>
/// <param name="BasePart">Index of an earlier part of the graph.</param>
/// <param name="Calls">What it calls. Calls of one recursive are a set, calls of several a sum.</param>
public sealed record FractalRecursive(int BasePart, ImmutableArray<RecursiveCall> Calls)
{
    /// <summary>Indices of the earlier parts that the recursive is made of.</summary>
    public IEnumerable<int> References =>
        Calls.Where(static call => call.IsConstant).Select(static call => call.Target).Append(BasePart);

    /// <inheritdoc/>
    public bool Equals(FractalRecursive? other) =>
        other is not null && BasePart == other.BasePart && Calls.AsSpan().SequenceEqual(other.Calls.AsSpan());

    /// <inheritdoc/>
    public override int GetHashCode() => Calls.Aggregate(BasePart, HashCode.Combine);
}
