using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Trees;

/// <summary>
/// Looks for recursives that call each other. By falling size, each part that known calls do not explain is called by the recursive of a
/// larger part: by which one, and which recursive is called, is tried, first what explains most.
/// </summary>
/// <remarks>
/// The parts of a recursive must all have its calls, but on the last level: a wrong call is soon refuted. Symmetries of a part leave its
/// frame open, so that a call is tried with each of them.
/// </remarks>
/// <param name="scene">Where parts are looked for.</param>
/// <param name="cancellation">Ends the search early.</param>
internal sealed class CallSearch(CallScene scene, CancellationToken cancellation)
{
    private const int MaxRules = 24;
    private const int MaxDiscrepancies = 3;
    private const int MaxChoices = 4;
    private const int MaxLookUps = 1_000_000;

    private bool IsExhausted => scene.LookUps > MaxLookUps;

    /// <summary>Finds recursives that explain all elements of a group exactly, or null.</summary>
    /// <param name="group">The elements.</param>
    /// <param name="parts">Those of one class, which stand at each call.</param>
    /// <param name="cancellation">Ends the search early.</param>
    public static TreeGrammar? Find(ElementGroup group, int[] parts, CancellationToken cancellation)
    {
        var search = new CallSearch(new(group, parts, [AffineMap.Identity]), cancellation);
        return search.Find(search.Describe);
    }

    /// <summary>Finds recursives that make several equal figures of all parts, and returns the parts of the first one, or null.</summary>
    /// <param name="group">All elements.</param>
    /// <param name="parts">Those of one class, which stand at each call.</param>
    /// <param name="roots">Maps that take the largest part to that of each figure, the identity first.</param>
    /// <param name="cancellation">Ends the search early.</param>
    public static int[]? FindFirst(ElementGroup group, int[] parts, IReadOnlyList<AffineMap> roots, CancellationToken cancellation)
    {
        var search = new CallSearch(new(group, parts, roots), cancellation);
        return search.Find(rules => search.Expand(rules, isWhole: true) is { } all && all.Parts.Count == parts.Length
            && new CallSearch(new(group, parts, [AffineMap.Identity]), cancellation).Expand(rules, isWhole: true) is { } first
                ? first.Parts.ConvertAll(part => part.Element).ToArray() : null);
    }

    private T? Find<T>(Func<CallRule[], T?> describe)
        where T : class =>
        Enumerable.Range(0, MaxDiscrepancies + 1).TakeWhile(_ => !IsExhausted)
            .Select(discrepancies => Explain([], discrepancies, describe)).FirstOrDefault(static found => found is not null);

    private CallExpansion? Expand(CallRule[] rules, bool isWhole = false) => CallExpansion.Create(scene, rules, isWhole);

    /// <summary>Completes some calls; of the choices for each, so many in all may be others than the first one.</summary>
    private T? Explain<T>(CallRule[] rules, int discrepancies, Func<CallRule[], T?> describe)
        where T : class
    {
        cancellation.ThrowIfCancellationRequested();
        if (Expand(rules) is not { } expansion)
        {
            return null;
        }

        var index = Array.FindIndex(scene.BySize, part => !expansion.IsExplained[part]);
        if (index < 0 || !scene.IsLarge(scene.BySize[index]))
        {
            return rules.Length > 0 && discrepancies == 0 ? describe(rules) : null;
        }

        if (rules.Length == MaxRules || (rules.Length > 5 && expansion.Parts.Count < 2 * rules.Length))
        {
            return null;
        }

        return Choices(rules, expansion, scene.BySize[index]).Take(discrepancies + 1)
            .Select((choice, place) => Explain(choice, discrepancies - place, describe)).FirstOrDefault(static found => found is not null);
    }

    /// <summary>All ways to explain a part by one more call, first those that explain most, and with fewest levels.</summary>
    private List<CallRule[]> Choices(CallRule[] rules, CallExpansion expansion, int next)
    {
        var choices = new List<(CallRule[] Rules, int Count, int Depth)>();
        var place = scene.FramesOf(next).FirstOrDefault(AffineMap.Identity);
        var seen = new HashSet<(int, int)>();
        foreach (var parent in expansion.Parts)
        {
            if (IsExhausted || !scene.Group.Set.IsSmaller(next, parent.Element))
            {
                continue;
            }

            var call = new CallRule(parent.Recursive, parent.Frame.Inverse() * place, NextRecursive(rules));
            var first = expansion.Parts.First(part => part.Recursive == parent.Recursive);
            var image = scene.Image(first.Frame * call.Map);
            if (image < 0 || expansion.IsExplained[image] || !seen.Add((parent.Recursive, image)))
            {
                continue;
            }

            foreach (var extended in Extend(rules, expansion, call))
            {
                if (Expand(extended) is { } found && found.IsExplained[next])
                {
                    choices.Add((extended, found.Parts.Count, found.Depth));
                }
            }
        }

        return [.. choices.OrderByDescending(choice => choice.Count).ThenBy(choice => choice.Depth)
            .Select(choice => choice.Rules).Take(MaxDiscrepancies + 1)];
    }

    private static int NextRecursive(CallRule[] rules) => rules.Length == 0 ? 1 : rules.Max(rule => rule.Called) + 1;

    /// <summary>Adds a call that calls a new recursive, or any of the known ones that it may call.</summary>
    private IEnumerable<CallRule[]> Extend(CallRule[] rules, CallExpansion expansion, CallRule call)
    {
        // Calls that lead to the caller may have to be turned for its new call.
        var turned = (CallRule[])[.. rules, call];
        for (var index = 0; index < rules.Length; index++)
        {
            if (rules[index].Called == call.Caller && FirstOf(expansion, index) is { } part
                && !scene.HasCalls(turned, call.Caller, part.Frame))
            {
                if (Symmetry(turned, call.Caller, part.Frame) is not { } symmetry)
                {
                    yield break;
                }

                turned[index] = turned[index] with { Map = turned[index].Map * symmetry };
            }
        }

        var first = expansion.Parts.First(part => part.Recursive == call.Caller);
        foreach (var called in turned.Select(rule => rule.Caller).Distinct().Order())
        {
            foreach (var symmetry in scene.Symmetries.Where(symmetry => scene.HasCalls(turned, called, first.Frame * call.Map * symmetry))
                .Take(MaxChoices))
            {
                var closed = (CallRule[])turned.Clone();
                closed[^1] = new(call.Caller, call.Map * symmetry, called);
                yield return Close(closed, expansion);
            }
        }

        yield return Close(turned, expansion);
    }

    /// <summary>Lets calls of recursives that call nothing yet call others, where all calls of these are there.</summary>
    private CallRule[] Close(CallRule[] rules, CallExpansion expansion)
    {
        var callers = rules.Select(rule => rule.Caller).Distinct().Order().ToArray();
        for (var index = 0; index < rules.Length - 1; index++)
        {
            if (callers.Contains(rules[index].Called) || FirstOf(expansion, index) is not { } part)
            {
                continue;
            }

            foreach (var called in callers)
            {
                if (Symmetry(rules, called, part.Frame) is { } symmetry)
                {
                    rules[index] = new(rules[index].Caller, rules[index].Map * symmetry, called);
                    break;
                }
            }
        }

        return rules;
    }

    private static CallPart? FirstOf(CallExpansion expansion, int rule) =>
        expansion.Parts.FindIndex(part => part.Rule == rule) is var index && index >= 0 ? expansion.Parts[index] : null;

    private AffineMap? Symmetry(CallRule[] rules, int called, AffineMap frame)
    {
        foreach (var symmetry in scene.Symmetries)
        {
            if (scene.HasCalls(rules, called, frame * symmetry))
            {
                return symmetry;
            }
        }

        return null;
    }

    private TreeGrammar? Describe(CallRule[] found)
    {
        if (Expand(found, isWhole: true) is not { } expansion)
        {
            return null;
        }

        var rules = CallEnds.Align(scene, expansion, found);
        var follows = new bool[rules.Length + 1, rules.Length];
        for (var last = 0; last <= rules.Length; last++)
        {
            for (var rule = 0; rule < rules.Length; rule++)
            {
                follows[last, rule] = rules[rule].Caller == (last == rules.Length ? 0 : rules[last].Called);
            }
        }

        return new TreeLevels(scene.Group, scene.Root, [.. rules.Select(rule => rule.Map)], follows).Describe();
    }
}
