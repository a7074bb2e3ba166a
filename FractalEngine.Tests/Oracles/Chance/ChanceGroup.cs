using System.Collections.Immutable;

namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>Recursives that are declared together.</summary>
/// <param name="Bases">What each is at depth 0.</param>
/// <param name="Bodies">What each is otherwise, with calls.</param>
/// <param name="Diagonals">The diagonals of the boxes of the bases.</param>
internal sealed record ChanceGroup(
    ImmutableArray<ChanceNode> Bases, ImmutableArray<ChanceNode> Bodies, ImmutableArray<double> Diagonals)
{
    /// <summary>Whether the only body is sets on its own base.</summary>
    public bool IsSets => Bodies is [var body] && IsSetsOnCall(body);

    public bool IsPlain => Bases.All(static node => node.IsPlain) && Bodies.All(HasOnlyCalls);

    public bool HasSizes => Bases.Concat(Bodies).Any(static node => node.HasSizes);

    private static bool IsSetsOnCall(ChanceNode node) =>
        node is ChanceNode.Call || (node is ChanceNode.Mapped mapped && IsSetsOnCall(mapped.Inner))
        || (node is ChanceNode.Whole whole && IsSetsOnCall(whole.Inner));

    private static bool HasOnlyCalls(ChanceNode node) => node switch
    {
        ChanceNode.Call => true,
        ChanceNode.Whole whole => HasOnlyCalls(whole.Inner),
        ChanceNode.Mapped mapped => HasOnlyCalls(mapped.Inner),
        ChanceNode.Sum sum => sum.Terms.All(HasOnlyCalls),
        _ => node.IsPlain,
    };
}
