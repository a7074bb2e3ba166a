using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>
/// Recursives that call each other and earlier parts, and one of them with so many levels as the whole. A sum is one recursive that calls
/// earlier parts only, with one level.
/// </summary>
/// <remarks>
/// A call may take no level where its target comes earlier in some order of the recursives. So a set of sets, or a sum in a set, is a
/// recursive of its own, instead of all products.
/// </remarks>
public sealed class RecursivePart : FractalPart
{
    /// <summary>Makes a part of recursives.</summary>
    /// <param name="recursives">The recursives, which refer to each other by their indices: at least one.</param>
    /// <param name="root">Index of the recursive that the part is.</param>
    /// <param name="levels">Number of its levels; null for no limit.</param>
    /// <param name="until">
    /// Length in the frame of the fractal; null for none. A call goes on while the base of its recursive, stretched as the maps on the way
    /// do at most, has at least a diagonal of that length.
    /// </param>
    /// <exception cref="ArgumentException">
    /// A call leads to no recursive, or some call each other without end at the same level; or the length is not positive, or some call
    /// each other without getting smaller.
    /// </exception>
    public RecursivePart(ImmutableArray<FractalRecursive> recursives, int root, int? levels, double? until = null)
    {
        ArgumentCheck.Require(!recursives.IsDefaultOrEmpty, "expected at least one recursive", nameof(recursives));
        ArgumentOutOfRangeException.ThrowIfNegative(levels ?? 0, nameof(levels));
        ArgumentOutOfRangeException.ThrowIfNegative(root);
        ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(root, recursives.Length);
        Recursives = recursives;
        Root = root;
        Levels = levels;
        Until = until is null or (> 0 and < double.PositiveInfinity) ? until
            : throw new ArgumentException("expected a positive length", nameof(until));
        RecursiveCall[] calls = [.. recursives.SelectMany(static recursive => recursive.Calls).Where(static call => !call.IsConstant)];
        MaxLevelsLess = calls.Select(static call => call.LevelsLess!.Value).DefaultIfEmpty().Max();
        if (calls.Any(call => (uint)call.Target >= (uint)recursives.Length || call.LevelsLess < 0))
        {
            throw new ArgumentException("expected calls of the given recursives, with no more levels", nameof(recursives));
        }

        if (recursives.Any(static one => one.Choice is { } choice && (choice.Weights.Length != one.Calls.Length
            || !one.Calls.All(static call => call.IsPlain))))
        {
            throw new ArgumentException(
                "expected a weight for each call of a choice, and calls of what stands as it is", nameof(recursives));
        }

        IsFlat = levels == 1 && until is null && recursives.Length == 1 && calls.Length == 0;
        HasChoice = recursives.Any(static recursive => recursive.Choice is not null);
        Order = SortByCalls();
        if (until is not null && RecursiveCycles.FindGrowing(recursives) is not null)
        {
            throw new ArgumentException("expected recursives that get smaller in each cycle of calls", nameof(recursives));
        }
    }

    /// <summary>The recursives, which refer to each other by their indices.</summary>
    public ImmutableArray<FractalRecursive> Recursives { get; }

    /// <summary>Index of the recursive that the part is.</summary>
    public int Root { get; }

    /// <summary>Number of its levels; null for no limit.</summary>
    public int? Levels { get; }

    /// <summary>The length of diagonals at which calls end; null where only <see cref="Levels"/> ends them.</summary>
    public double? Until { get; }

    /// <summary>True where a map has a colour.</summary>
    internal bool HasColours => Recursives.Any(static recursive => recursive.Calls.Any(static call => !call.Colour.IsNone));

    /// <summary>True where places decide what stands there: by chance or by size.</summary>
    internal bool HasPicks => HasChoice || Until is not null;

    /// <summary>The largest <see cref="RecursiveCall.LevelsLess"/> of the calls; 0 without calls.</summary>
    public int MaxLevelsLess { get; }

    /// <summary>Indices of the recursives such that calls that take no level lead to earlier ones.</summary>
    public ImmutableArray<int> Order { get; }

    /// <summary>
    /// The <see cref="RecursiveCall.LevelsLess"/> of all calls where one recursive calls itself, always with as many levels less, and
    /// nothing else but constants; null for others.
    /// </summary>
    public int? LevelsLessOfLinear => Recursives is [{ Choice: null } only] && !HasColours
        && only.Calls.Where(static call => !call.IsConstant).Select(static call => call.LevelsLess).Distinct().ToArray() is [var less]
        ? less
        : null;

    /// <inheritdoc/>
    public override bool IsInfinite => Levels is null && Until is null;

    /// <inheritdoc/>
    public override bool MayHoldInfinite => IsFlat;

    /// <inheritdoc/>
    public override bool HasDepth => !IsFlat;

    /// <summary>True for a sum: earlier parts, each under a map.</summary>
    public bool IsSum => IsFlat && !HasChoice;

    /// <summary>True for a sum, and for a choice of earlier parts: there is nothing to repeat.</summary>
    public bool IsFlat { get; }

    /// <summary>True where chance decides about the calls of a recursive.</summary>
    public bool HasChoice { get; }

    /// <summary>Number of calls of all recursives, and of themselves, at all levels; null for infinitely many levels.</summary>
    public long? CallCount => IsFlat ? 0 : Levels * Recursives.Sum(static recursive => recursive.Calls.Length + 1L);

    /// <inheritdoc/>
    public override IEnumerable<int> References => Recursives.SelectMany(static recursive => recursive.References);

    /// <inheritdoc/>
    internal override IEnumerable<ImmutableArray<AffineMap>> MapSets =>
        Recursives.Select(static recursive => ImmutableArray.CreateRange(recursive.Calls, static call => call.Map));

    /// <summary>Makes the union of earlier parts, each under a map.</summary>
    /// <param name="terms">At least one constant.</param>
    /// <exception cref="ArgumentException">There is no term.</exception>
    public static RecursivePart Sum(params ImmutableArray<RecursiveCall> terms) => !terms.IsDefaultOrEmpty
        ? new([new(terms[0].Target, terms)], 0, 1)
        : throw new ArgumentException("expected at least one term", nameof(terms));

    /// <summary>Makes one recursive that calls itself and earlier parts.</summary>
    /// <param name="basePart">What it is without levels.</param>
    /// <param name="levels">Number of its levels; null for infinitely many.</param>
    /// <param name="calls">The calls.</param>
    public static RecursivePart Of(int basePart, int? levels, params ImmutableArray<RecursiveCall> calls) =>
        new([new(basePart, calls)], 0, levels);

    /// <inheritdoc/>
    internal override BigInteger? CountInstances(Func<int, BigInteger?> countAt) => Levels is not { } levels
        ? Until is null ? CountInfinite(Root, countAt, []) : null
        : HasChoice
        ? Ascend(countAt, BigInteger.Zero, static (sum, count) => sum + count, (counts, choice, left) =>
            choice.FirstLevels.IsEmpty ? LargestOf(counts, choice) : counts[choice.SelectAt(levels - left)]).ElementAt(levels)[Root]
        : LinearRecurrence.TermAt(
            Ascend(countAt, BigInteger.Zero, static (sum, count) => sum + count).Select(values => values[Root]),
            (Recursives.Length * Math.Max(1, MaxLevelsLess)) + 1, levels);

    /// <summary>The largest count of the alternatives that may stand there; null for infinitely many.</summary>
    private static BigInteger? LargestOf(BigInteger?[] counts, Choice choice)
    {
        var largest = (BigInteger?)BigInteger.Zero;
        for (var i = 0; i < counts.Length && largest is not null; i++)
        {
            largest = choice.Weights[i] == 0 ? largest
                : counts[i] is { } count ? BigInteger.Max(count, largest.Value)
                : null;
        }

        return largest;
    }

    /// <inheritdoc/>
    internal override ScaledCount EstimateInstances(Func<int, ScaledCount> countAt) =>
        Ascend(
            countAt, default, static (sum, count) => sum + count,
            static (counts, _, _) => counts.MaxBy(static count => (count.Scale, count.Mantissa))).ElementAt(Levels ?? 0)[Root];

    /// <summary>Computes a value of each recursive with 0 levels, with 1, and so on without end.</summary>
    /// <param name="valueAt">Gives the value of an earlier part.</param>
    /// <param name="zero">The value of nothing.</param>
    /// <param name="add">Adds a value to a sum.</param>
    /// <param name="choose">
    /// Makes one value of those of the alternatives of a choice that has so many levels left; null to add them as those of sums.
    /// </param>
    /// <returns>The values by recursives; valid until the next are asked for.</returns>
    internal IEnumerable<T[]> Ascend<T>(
        Func<int, T> valueAt, T zero, Func<T, T, T> add, Func<T[], Choice, int, T>? choose = null)
    {
        T[] bases = [.. Recursives.Select(recursive => valueAt(recursive.BasePart))];
        yield return bases;
        var latest = new T[MaxLevelsLess + 1][];
        for (var levels = 1; ; levels++)
        {
            var values = latest[levels % latest.Length] ??= new T[Recursives.Length];
            foreach (var caller in Order)
            {
                var recursive = Recursives[caller];
                values[caller] = recursive.Choice is { } choice && choose is not null
                    ? choose([.. recursive.Calls.Select(call => ValueOf(call, levels))], choice, levels)
                    : recursive.Calls.Aggregate(zero, (sum, call) => add(sum, ValueOf(call, levels)));
            }

            yield return values;
        }

        T ValueOf(RecursiveCall call, int levels) => call.LevelsLess is not { } less ? valueAt(call.Target)
            : less >= levels ? bases[call.Target]
            : latest[(levels - less) % latest.Length][call.Target];
    }

    /// <inheritdoc/>
    internal override long? CountLevels(Func<int, long?> levelsAt)
    {
        if (Levels is not { } levels || References.Any(part => levelsAt(part) is null))
        {
            return null;
        }

        // A term of a sum is no level of its own where it stands as it is. There may be none.
        return IsFlat
            ? Recursives[0].Calls.Max(call => levelsAt(call.Target) + (call.Map == AffineMap.Identity ? 0 : 1)) ?? 0
            : Ascend(part => levelsAt(part)!.Value, 0, static (longest, count) => Math.Max(longest, count + 1)).ElementAt(levels)[Root];
    }

    /// <inheritdoc/>
    internal override FractalPart WithDepth(int depth) => new RecursivePart(Recursives, Root, depth, Until);

    /// <inheritdoc/>
    internal override FractalPart WithMaxDepth(int depth) => IsFlat || Levels <= depth ? this : WithDepth(depth);

    /// <summary>Makes the same part with another seed for all choices.</summary>
    internal RecursivePart WithSeed(int seed) => !HasChoice ? this : new(
        ImmutableArray.CreateRange(Recursives, recursive => recursive with { Choice = recursive.Choice?.WithSeed(seed) }),
        Root, Levels, Until);

    /// <inheritdoc/>
    internal override FractalPart WithReferences(Func<int, int> indexOf) => new RecursivePart(
        [.. Recursives.Select(recursive => recursive with
        {
            BasePart = indexOf(recursive.BasePart),
            Calls = [.. recursive.Calls.Select(call => call.IsConstant ? call with { Target = indexOf(call.Target) } : call)],
        })],
        Root, Levels, Until);

    /// <summary>Tells whether the other part has the same recursives, perhaps with another root or so many levels.</summary>
    public bool HasRecursivesOf(RecursivePart other)
    {
        ArgumentNullException.ThrowIfNull(other);
        return Recursives.AsSpan().SequenceEqual(other.Recursives.AsSpan());
    }

    /// <inheritdoc/>
    public override bool Equals(FractalPart? other) =>
        other is RecursivePart part && Root == part.Root && Levels == part.Levels && Until == part.Until && HasRecursivesOf(part);

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Root, Levels, Until, Recursives.Length, Recursives[0]);

    /// <summary>Counts the chains of infinitely many levels: what a cycle of calls leads to, it does so without end.</summary>
    private BigInteger? CountInfinite(int recursive, Func<int, BigInteger?> countAt, Dictionary<int, BigInteger?> known)
    {
        if (known.TryGetValue(recursive, out var count))
        {
            return count;
        }

        var reached = new HashSet<int>();
        var open = new Stack<int>([recursive]);
        while (open.TryPop(out var caller))
        {
            foreach (var call in Recursives[caller].Calls.Where(call => !call.IsConstant && reached.Add(call.Target)))
            {
                open.Push(call.Target);
            }
        }

        return known[recursive] = !reached.Contains(recursive)
            ? Recursives[recursive].Calls
                .Select(call => call.IsConstant ? countAt(call.Target) : CountInfinite(call.Target, countAt, known))
                .Aggregate((BigInteger?)BigInteger.Zero, static (sum, term) => sum + term)
            : reached.SelectMany(index => Recursives[index].References).All(part => countAt(part) is { IsZero: true })
                ? BigInteger.Zero
                : null;
    }

    private ImmutableArray<int> SortByCalls()
    {
        var order = ImmutableArray.CreateBuilder<int>(Recursives.Length);
        var begun = new HashSet<int>();
        var ended = new HashSet<int>();
        // Those made of others come behind these mostly, so that no long chain is visited at once.
        for (var i = 0; i < Recursives.Length; i++)
        {
            if (Recursives[i].Calls.All(call => call.LevelsLess != 0 || ended.Contains(call.Target)))
            {
                Visit(i);
            }
        }

        for (var i = 0; i < Recursives.Length; i++)
        {
            Visit(i);
        }

        return order.MoveToImmutable();

        void Visit(int recursive)
        {
            if (begun.Add(recursive))
            {
                foreach (var call in Recursives[recursive].Calls.Where(static call => call.LevelsLess == 0))
                {
                    Visit(call.Target);
                }

                order.Add(recursive);
                ended.Add(recursive);
            }
            else if (!ended.Contains(recursive))
            {
                throw new ArgumentException("expected no cycle of calls that take no level", nameof(recursive));
            }
        }
    }
}
