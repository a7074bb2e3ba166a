using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Graphs;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>Finds how many rounds recursives go on that end by their size: as long as their largest place does.</summary>
/// <remarks>Sizes are those of <see cref="StretchSize"/>, where a larger number is a smaller size, and no more than bounds.</remarks>
internal sealed class EndingRounds
{
    private readonly int _firstPart;

    // By parts: the number of the largest size at which one stands in the whole.
    private readonly double[] _largest;

    /// <summary>Finds how large the parts of a graph stand in it.</summary>
    public EndingRounds(FractalGraph graph)
    {
        _firstPart = graph.BaseMeshes.Length;
        _largest = new double[_firstPart + graph.Parts.Length];
        Array.Fill(_largest, double.PositiveInfinity);
        _largest[^1] = 0;
        var endsBySize = new bool[_largest.Length];
        foreach (var (i, part) in graph.Parts.Index())
        {
            endsBySize[_firstPart + i] = part is RecursivePart { Until: not null } || part.References.Any(index => endsBySize[index]);
        }

        for (var i = _largest.Length - 1; i >= _firstPart; i--)
        {
            if (endsBySize[i])
            {
                Descend(graph.Parts[i - _firstPart], _largest[i]);
            }
        }
    }

    /// <summary>Counts the rounds that a part may need, and one more.</summary>
    /// <param name="index">Index of the part among all, base meshes included.</param>
    /// <param name="part">The part.</param>
    /// <param name="limits">For each recursive the largest number of a size at which it goes on.</param>
    /// <param name="max">Most rounds that are worth while.</param>
    /// <returns>The number of rounds; null for more.</returns>
    public int? CountOf(int index, RecursivePart part, ImmutableArray<long> limits, int max)
    {
        var calls = CallsOf(part);
        var waiting = Enumerable.Range(0, part.MaxLevelsLess + 1).Select(_ => Smallest(part)).ToArray();
        waiting[0][part.Root] = _largest[index];
        var last = -1;
        for (var round = 0; round - last <= waiting.Length; round++)
        {
            if (round > max)
            {
                return null;
            }

            var sizes = waiting[round % waiting.Length];
            foreach (var caller in part.Order.Reverse().Where(caller => sizes[caller] <= limits[caller]))
            {
                last = round;
                foreach (var (call, size) in calls[caller])
                {
                    var reached = waiting[(round + call.LevelsLess!.Value) % waiting.Length];
                    reached[call.Target] = Math.Min(reached[call.Target], sizes[caller] + size);
                }
            }

            Array.Fill(sizes, double.PositiveInfinity);
        }

        // One more than those that go on, and one for rounding.
        return last + 2;
    }

    private static double[] Smallest(RecursivePart part) =>
        [.. Enumerable.Repeat(double.PositiveInfinity, part.Recursives.Length)];

    private static (RecursiveCall Call, double Size)[][] CallsOf(RecursivePart part) =>
        [.. part.Recursives.Select(static recursive => recursive.Calls.Where(static call => !call.IsConstant)
            .Select(static call => (call, (double)StretchSize.Of(call.Map.Linear))).ToArray())];

    private void Descend(FractalPart part, double size)
    {
        if (part is SteppedPart stepped)
        {
            Reach(stepped.Inner, size + stepped.Steps.Sum(LargestOf));
        }
        else if (part is RecursivePart recursives)
        {
            var sizes = SizesIn(recursives, size);
            foreach (var (caller, recursive) in recursives.Recursives.Index())
            {
                Reach(recursive.BasePart, sizes[caller]);
                foreach (var call in recursive.Calls.Where(static call => call.IsConstant))
                {
                    Reach(call.Target, sizes[caller] + StretchSize.Of(call.Map.Linear));
                }
            }
        }
    }

    private void Reach(int part, double size) => _largest[part] = Math.Min(_largest[part], size);

    /// <summary>The largest sizes of the recursives of a part, at any of its levels.</summary>
    private static double[] SizesIn(RecursivePart part, double size)
    {
        var calls = CallsOf(part);
        var sizes = Smallest(part);
        sizes[part.Root] = size;
        for (var round = 0; round <= part.Recursives.Length; round++)
        {
            var grows = false;
            for (var caller = 0; caller < calls.Length; caller++)
            {
                foreach (var (call, less) in calls[caller])
                {
                    grows |= sizes[caller] + less < sizes[call.Target];
                    sizes[call.Target] = Math.Min(sizes[call.Target], sizes[caller] + less);
                }
            }

            if (!grows)
            {
                return sizes;
            }
        }

        // It grows with each round. A round has at most one call of each recursive that takes no level.
        var mostCalls = (part.Levels ?? double.PositiveInfinity) * (part.Recursives.Length + 1);
        Array.Fill(sizes, size + (mostCalls * calls.SelectMany(static one => one).Min(static call => call.Size)));
        return sizes;
    }

    /// <summary>The number of the largest size that a step makes of one.</summary>
    private static double LargestOf(FractalStep step) => step switch
    {
        TransformationSet { Maps.IsEmpty: true } => 0,
        TransformationSet set => set.IsPlacement ? 0 : set.Maps.Min(static map => StretchSize.Of(map.Linear)),
        Repetition { Count: 0 } => 0,
        Repetition repetition when repetition.Round.Sum(LargestOf) is var once =>
            repetition.Count is { } count ? count * once : once < 0 ? double.NegativeInfinity : 0,
        _ => 0,
    };
}
