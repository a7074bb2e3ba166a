using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>Says which copies sub-fractals are made of, so that no instance is reached in two ways, and makes each copy once.</summary>
internal sealed class CopyFactory
{
    private const int MostSteps = 256;

    // A sub-fractal is opened over several levels at once, as long as its copies are no more than these: to look at some
    // more boxes, four at a time, costs less than to go down one level after another.
    private const int MostTogether = 32;
    private const int MostToBeEven = 48;


    /// <summary>Copies are of sub-fractals at most so many rounds further down.</summary>
    public const int MostLevelsTogether = 16;

    private readonly Dictionary<CopyStep[], Copy> _copies = new(new SequenceComparer());

    /// <summary>
    /// The steps of a level: its own maps, then, where its identity lets it be passed over, those that the next levels of the same
    /// repetition add, and last what is below the repetition, if all of it can be passed over.
    /// </summary>
    /// <param name="level">Levels left.</param>
    /// <param name="floor">The levels below the repetition that the level belongs to.</param>
    /// <param name="period">After so many levels their sets are the same again.</param>
    /// <param name="set">The level's.</param>
    /// <param name="setAt">The sets of the levels below.</param>
    public static CopyStep[] StepsAt(long level, long floor, int period, CopySet set, Func<long, CopySet> setAt)
    {
        var steps = new List<CopyStep>();
        var offered = new HashSet<AffineMap>();
        for (var (current, down) = (set, 1L); ; down++)
        {
            AddSteps(steps, offered, current, down);
            if (current.IdentityIndex < 0)
            {
                return [.. steps];
            }

            // All sets of the repetition have been seen, and all have the identity.
            if (level - down == floor || down == period)
            {
                return [.. steps, CopyStep.Past(floor)];
            }

            if (steps.Count > MostSteps)
            {
                // Short lists matter more than the last duplicate: the rest is left to the next level, as it stands.
                return [.. steps, new(CopySet.Identity, 0, down)];
            }

            current = setAt(level - down);
        }
    }

    /// <summary>The copies of a level: its steps, followed by the steps of what they lead to, as long as they are few.</summary>
    /// <param name="level">Levels left.</param>
    /// <param name="steps">Of the level.</param>
    /// <param name="stepsAt">Of the levels below; none of the base.</param>
    public Copy[] Open(long level, CopyStep[] steps, Func<long, CopyStep[]> stepsAt)
    {
        List<(CopyStep[] Steps, long Below)> chains = [.. steps.Select(step => ((CopyStep[])[step], step.LevelsLeft(level)))];
        var (best, isBestEven) = (chains, IsEven(chains));
        for (var opened = 1; opened < MostLevelsTogether; opened++)
        {
            // The largest first, so that all come to be of the same level, and few levels are ever looked at.
            var top = chains.Select(chain => chain.Below).DefaultIfEmpty().Max();
            var next = top == 0 ? [] : stepsAt(top);
            if (top == 0 || chains.Sum(chain => chain.Below == top ? next.Length : 1) > MostToBeEven)
            {
                break;
            }

            chains = [.. chains.SelectMany(chain => chain.Below < top
                ? [chain]
                : next.Select(step => ((CopyStep[])[.. chain.Steps, step], step.LevelsLeft(top))))];
            var isEven = IsEven(chains);
            if (chains.Count <= MostTogether ? isEven || !isBestEven : isEven && !isBestEven)
            {
                (best, isBestEven) = (chains, isEven);
            }
        }

        return [.. best.Select(chain => CopyOf(chain.Steps))];
    }

    /// <summary>True when all that is not the base is of the same level.</summary>
    private static bool IsEven(List<(CopyStep[] Steps, long Below)> chains) =>
        chains.Where(chain => chain.Below > 0).Select(chain => chain.Below).Distinct().Count() <= 1;

    private static void AddSteps(List<CopyStep> steps, HashSet<AffineMap> offered, CopySet set, long down)
    {
        var here = new HashSet<AffineMap>();
        for (var i = 0; i < set.Maps.Length; i++)
        {
            // What a level above offers is found there, provided that this level could be passed over instead.
            var isNew = offered.Add(set.Maps[i]) || set.IdentityIndex < 0;
            if (set.Maps[i] != AffineMap.Identity && here.Add(set.Maps[i]) && isNew)
            {
                steps.Add(new(set, i, down));
            }
        }
    }

    private Copy CopyOf(CopyStep[] steps)
    {
        if (!_copies.TryGetValue(steps, out var copy))
        {
            _copies[steps] = copy = new(steps);
        }

        return copy;
    }

    private sealed class SequenceComparer : IEqualityComparer<CopyStep[]>
    {
        public bool Equals(CopyStep[]? steps1, CopyStep[]? steps2) => steps1.AsSpan().SequenceEqual(steps2);

        public int GetHashCode(CopyStep[] steps) => steps.Aggregate(0, HashCode.Combine);
    }
}
