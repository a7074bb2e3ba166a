using System.Runtime.InteropServices;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Collision;

/// <summary>Builds the sub-fractals of a <see cref="SubFractalTable"/>, from the base mesh upwards.</summary>
/// <remarks>
/// The identity is not a copy like the others: where all levels below have it, the base mesh stands at the level itself, and a copy may pass
/// over levels that have it. Each chain of the other maps is then reached in one way, on its earliest levels (docs/colliders.md).
/// </remarks>
internal sealed class SubFractalBuilder
{
    // More mean that the bounds grow or shrink too slowly to settle.
    private const int MostStates = 4000;

    // A hull that fills its box bounds no better than the box.
    private const double MostOfBox = 0.95;

    private readonly Fractal _fractal;
    private readonly Dictionary<TransformationSet, CopySet> _sets = [];
    private readonly List<SubFractal> _states = [];
    private readonly List<Outline> _outlines = [];
    private readonly List<CopyStep[]> _steps = [];
    private readonly CopyFactory _copies = new();
    private readonly List<StateRegion> _regions = [];

    public SubFractalBuilder(Fractal fractal)
    {
        _fractal = fractal;
        AreSimilar = fractal.Description.Steps.All(IsSimilar);
        var outline = Outline.Of(fractal.BaseMesh);
        Append(1, new Made(new(null, [], [], outline, outline.Box, HullOf(outline), null), outline, []));
    }

    public IReadOnlyList<SubFractal> States => _states;

    public IReadOnlyList<StateRegion> Regions => _regions;

    /// <summary>True when all maps are multiples of rotations and mirrors.</summary>
    public bool AreSimilar { get; }

    /// <summary>Of what has been added.</summary>
    public long Levels { get; private set; } = -1;

    /// <summary>Adds the levels of all steps, the innermost first.</summary>
    public void AddAll()
    {
        foreach (var step in _fractal.Description.Steps.Reverse())
        {
            Add(step);
        }
    }

    private static bool IsSimilar(FractalStep step) => step switch
    {
        Repetition repetition => repetition.Body.All(IsSimilar),
        TransformationSet set => set.Maps.All(map => Similarity.IsSimilar(map.Linear)),
        _ => throw new ArgumentException($"{step.GetType().Name} is no step of a fractal", nameof(step)),
    };

    private int Find(long levels) => StateRegion.Find(CollectionsMarshal.AsSpan(_regions), levels);

    private SubFractal At(long levels) => _states[Find(levels)];

    /// <summary>What holds the sub-fractal with so many levels left.</summary>
    public Outline OutlineAt(long levels) => _outlines[Find(levels)];

    /// <summary>The steps by which it is made of sub-fractals further down, see <see cref="CopyFactory.StepsAt"/>.</summary>
    public CopyStep[] StepsAt(long levels) => _steps[Find(levels)];

    private void Append(long count, params ReadOnlySpan<Made> states)
    {
        // States that don't repeat are joined to the region before, so that most fractals have one or two.
        if (count == states.Length && _regions is [.., var last] && last.Count == last.Period)
        {
            _regions[^1] = last with { Count = last.Count + count, Period = last.Period + states.Length };
        }
        else
        {
            _regions.Add(new(Levels + 1, count, _states.Count, states.Length));
        }

        foreach (var (state, outline, steps) in states)
        {
            _states.Add(state);
            _outlines.Add(outline);
            _steps.Add(steps);
        }

        Levels += count;
    }

    private void Add(FractalStep step)
    {
        var repetition = step as Repetition ?? new([step], 1);
        var isFlat = repetition.Body.All(inner => inner is TransformationSet);
        var floor = Levels;
        var period = isFlat ? repetition.Body.Length : int.MaxValue;
        // Two rounds are written out in any case: copies may pass over a round of levels, and must meet the same sets there.
        var attempt = 2;
        for (var round = 0; round < (repetition.Count ?? int.MaxValue); round++)
        {
            if (isFlat && round >= attempt)
            {
                if (TryRepeat(floor, repetition.Body.Length, (repetition.Count - round) * repetition.LevelsPerRound, Math.Max(1, 0.125 * round)))
                {
                    return;
                }

                attempt = round + 1 + (round / 8);
            }

            foreach (var inner in repetition.Body.Reverse())
            {
                if (inner is TransformationSet set)
                {
                    AddLevel(floor, period, set);
                }
                else
                {
                    Add(inner);
                    floor = Levels;
                }
            }

            floor = isFlat ? floor : Levels;
        }
    }

    /// <param name="floor">The levels below the repetition that the level belongs to.</param>
    /// <param name="period">After so many levels their sets are the same again.</param>
    /// <param name="set">The level's.</param>
    private void AddLevel(long floor, int period, TransformationSet set)
    {
        if (_states.Count > MostStates)
        {
            throw new FractalLimitException(
                $"exact search needs transformations that shrink, or less depth: {Levels} levels above the base the fractal's bounds still change");
        }

        if (!_sets.TryGetValue(set, out var copySet))
        {
            _sets[set] = copySet = new(set);
        }

        var level = Levels + 1;
        var steps = CopyFactory.StepsAt(level, floor, period, copySet, below => At(below).Set!);
        var parts = steps.Select(step => Part.Of(step, level, StepsAt)).Where(part => !OutlineAt(part.Level).Box.IsEmpty).ToArray();
        if (parts.Any(part => !(OutlineAt(part.Level).Image(part.Map, part.Lengthening) is var box && box.Minimum.IsFinite() && box.Size.IsFinite())))
        {
            throw new FractalLimitException($"the bounds of the fractal are beyond the range of a double {level} levels above its base");
        }

        var outline = OutlineOf(parts);
        var copies = _copies.Open(level, steps, StepsAt);
        Append(1, new Made(StateOf(copySet, copies, copies.Select(copy => OutlineAt(copy.LevelsLeft(level))), outline), outline, steps));
    }

    /// <summary>Lets one round, widened a little, stand for all rounds that are left, if it can be shown to hold them.</summary>
    /// <param name="floor">The levels below the repetition.</param>
    /// <param name="period">Levels of a round.</param>
    /// <param name="left">How many levels are left; null for infinitely many.</param>
    /// <param name="patience">See <see cref="SettledRound"/>.</param>
    private bool TryRepeat(long floor, int period, long? left, double patience)
    {
        var round = new SettledRound(Levels, period, OutlineAt, StepsAt, patience);
        if (!round.IsLikely())
        {
            return false;
        }

        // In rounds so far up that their copies are of levels in rounds like the last one, and in those between, the copies must be the same.
        Copy[] CopiesAt(long level) => _copies.Open(
            level,
            CopyFactory.StepsAt(level, floor, period, At(round.Like(level)).Set!, below => At(round.Like(below)).Set!),
            below => StepsAt(round.Like(below)));
        var copies = Enumerable.Range(0, period).Select(i => CopiesAt(round.Above + i)).ToArray();
        for (var level = Levels + 1; level < round.Above; level++)
        {
            if (!CopiesAt(level).SequenceEqual(copies[round.PlaceOf(level)]))
            {
                return false;
            }
        }

        if (round.TryHold(copies) is not { } outlines)
        {
            return false;
        }

        // No search goes down 10¹² levels.
        Append(left ?? (period << 20) * (1L << 20), [.. outlines.Select((outline, i) => new Made(
            StateOf(At(round.First + i).Set!, copies[i], copies[i].Select(copy => round.Below(outlines, copy.LevelsLeft(round.Above + i))), outline),
            outline,
            StepsAt(round.First + i)))]);
        return true;
    }

    /// <summary>The outline of some parts, none of them empty.</summary>
    private Outline OutlineOf(Part[] parts)
    {
        if (parts is [] or [_])
        {
            return parts is [var only] ? Outline.With(OutlineAt(only.Level), only.Map, only.Lengthening) : Outline.Empty;
        }

        var outlines = parts.Select(part => OutlineAt(part.Level)).ToArray();
        var box = parts.Zip(outlines, (part, outline) => outline.Image(part.Map, part.Lengthening)).Aggregate(BoundingBox.Union);
        var corners = outlines.All(outline => outline.Hull is not null)
            ? parts.Zip(outlines).SelectMany(pair => pair.Second.Hull!.Vertices.Select(vertex => pair.First.Map * vertex)).ToArray()
            : null;
        return Outline.With(box, corners, parts.Zip(outlines, (part, outline) => part.Lengthening * outline.Margin).Max());
    }

    private SubFractal StateOf(CopySet set, Copy[] copies, IEnumerable<Outline> below, Outline outline)
    {
        Outline[] parts = [.. below];
        var boxes = copies.Zip(parts, (copy, part) => part.Image(copy.Map, copy.Lengthening)).ToArray();
        return new(set, copies, boxes, outline, _outlines[0].Box, HullOf(outline), parts.Length > 0 ? HullOf(parts[0]) : null);
    }

    private HullBound? HullOf(Outline outline)
    {
        var (x, y, z) = outline.Box.Size;
        return outline.Hull is null || outline.Hull.Volume() > MostOfBox * x * y * z ? null : new(outline.Hull, outline.Box, outline.Margin, withAxes: !AreSimilar);
    }

    private readonly record struct Made(SubFractal State, Outline Outline, CopyStep[] Steps);
}
