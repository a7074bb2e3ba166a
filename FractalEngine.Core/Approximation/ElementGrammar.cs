using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Approximation.Grammars.Factors;
using FractalEngine.Core.Approximation.Grammars.Trees;

namespace FractalEngine.Core.Approximation;

/// <summary>What makes all elements of a set: factors, and a tree or a list of elements that these are applied to.</summary>
/// <param name="Set">The elements.</param>
/// <param name="Factors">The factors, outermost first; possibly none.</param>
/// <param name="Rest">The elements that the factors are applied to.</param>
/// <param name="Tree">What makes these; null for nothing.</param>
internal sealed record ElementGrammar(ElementSet Set, List<MapFactor> Factors, int[] Rest, TreeGrammar? Tree)
{
    /// <summary>Finds what makes all elements, or null.</summary>
    /// <param name="set">The elements.</param>
    /// <param name="cancellation">Ends the search early.</param>
    public static ElementGrammar? Find(ElementSet set, CancellationToken cancellation)
    {
        var factors = new List<MapFactor>();
        var rest = Enumerable.Range(0, set.Count).ToArray();
        var reference = FactorCandidates.ChooseReference(set, rest);
        var tree = TreeSearch.Find(set, rest, isFull: true, cancellation);
        while (tree is null && rest.Length > 1 && FactorSearch.Find(set, rest, reference, cancellation) is { } factor)
        {
            factors.Add(factor);
            rest = factor.Remainder;
            tree = TreeSearch.Find(set, rest, isFull: true, cancellation);
        }

        for (var index = 0; tree is null && index < factors.Count && set is ExactElements exact; index++)
        {
            if (ClusterTree.Find(exact, factors[index], cancellation) is var (clusters, found))
            {
                return new(clusters, factors[..index], [.. Enumerable.Range(0, clusters.Count)], found);
            }
        }

        if (tree is null && rest.Length > 2)
        {
            tree = TreeSearch.Find(set, rest, isFull: false, cancellation);
        }

        return factors.Count > 0 || tree is not null ? new(set, factors, rest, tree) : null;
    }
}
