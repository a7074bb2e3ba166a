using System.Numerics;

namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>Counts the instances that choices allow, by the recurrence of a model in which nothing ends by its size.</summary>
internal sealed class ChanceCounts
{
    private readonly Dictionary<(ChanceGroup, int, int), Range> _recursives = [];

    /// <summary>Counts those of a node; null where something ends by its size.</summary>
    public static Range? Of(ChanceNode node) => node.HasSizes ? null : new ChanceCounts().Count(node, null, 0);

    private Range Count(ChanceNode node, ChanceGroup? group, int depth)
    {
        switch (node)
        {
            case ChanceNode.Base:
                return new(1, 1, 1);
            case ChanceNode.Whole(var inner):
                return Count(inner, group, depth);
            case ChanceNode.Mapped(var maps, var inner):
                return Count(inner, group, depth).Times(maps.Length);
            case ChanceNode.Sum(var terms):
                return terms.Select(term => Count(term, group, depth)).Aggregate(static (a, b) => a + b);
            case ChanceNode.Choice choice:
                var total = choice.Alternatives.Sum(static one => one.Weight);
                var possible = choice.Alternatives.Where(static one => one.Weight > 0)
                    .Select(one => (Part: one.Weight / total, Range: Count(one.Node, group, depth))).ToArray();
                return new(
                    possible.Min(static one => one.Range.Least),
                    possible.Sum(static one => one.Part * one.Range.Expected),
                    possible.Max(static one => one.Range.Most));
            case ChanceNode.Recursive recursive:
                return CountRecursive(recursive.Group, recursive.Index, recursive.Depth);
            case ChanceNode.Call(var index):
                return CountRecursive(group!, index, depth - 1);
            default:
                throw new InvalidOperationException("a node of another kind");
        }
    }

    private Range CountRecursive(ChanceGroup group, int index, int depth)
    {
        if (!_recursives.TryGetValue((group, index, depth), out var range))
        {
            range = depth == 0 ? Count(group.Bases[index], null, 0) : Count(group.Bodies[index], group, depth);
            _recursives[(group, index, depth)] = range;
        }

        return range;
    }

    /// <summary>The fewest, the mean and the most.</summary>
    internal sealed record Range(BigInteger Least, double Expected, BigInteger Most)
    {
        public static Range operator +(Range a, Range b) => new(a.Least + b.Least, a.Expected + b.Expected, a.Most + b.Most);

        public Range Times(int count) => new(count * Least, count * Expected, count * Most);
    }
}
