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

    // Bounds settle when a round changes them by less than this part of their size. They are then widened by ten times as much as they
    // changed, and it is verified that what is widened holds everything at any depth.
    private const double Settled = 1e-7;
    private const double Widening = 10;
    private const double Rounding = 1e-14;

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
        var outline = Outline.Of(fractal.BaseMesh);
        Append(1, new Made(new(null, [], [], outline, outline.Box, HullOf(outline), null), outline, []));
    }

    public IReadOnlyList<SubFractal> States => _states;

    public IReadOnlyList<StateRegion> Regions => _regions;

    public IEnumerable<CopySet> Sets => _sets.Values;

    public IReadOnlyCollection<Copy> Copies => _copies.Copies;

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

    private int Find(long levels) => StateRegion.Find(CollectionsMarshal.AsSpan(_regions), levels);

    private SubFractal At(long levels) => _states[Find(levels)];

    private Outline OutlineAt(long levels) => _outlines[Find(levels)];

    private CopyStep[] StepsAt(long levels) => _steps[Find(levels)];

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
        for (var round = 0; round < (repetition.Count ?? int.MaxValue); round++)
        {
            // Two rounds are written out in any case: copies may pass over a round of levels, and must meet the same sets there.
            if (round >= 2 && isFlat && TryRepeat(floor, repetition.Body.Length, (repetition.Count - round) * repetition.LevelsPerRound))
            {
                return;
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
        var parts = steps.Select(step => (Step: step, Below: OutlineAt(step.LevelsLeft(level)))).Where(part => !part.Below.Box.IsEmpty).ToArray();
        if (parts.Select(part => part.Below.Image(part.Step.Map, part.Step.Lengthening)).Any(box => !(box.Minimum.IsFinite() && box.Size.IsFinite())))
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
    private bool TryRepeat(long floor, int period, long? left)
    {
        var (top, first) = (Levels, Levels - period + 1);
        var change = 0.0;
        for (var level = first; level <= top; level++)
        {
            change = Math.Max(change, Change(OutlineAt(level).Box, OutlineAt(level - period).Box));
        }

        if (!(change <= Settled))
        {
            return false;
        }

        // In rounds so far up that their copies are of levels in rounds like the last one, and in those between, the copies must be the same.
        long Seen(long level) => level <= top ? level : first + ((level - first) % period);
        Copy[] CopiesAt(long level) => _copies.Open(
            level,
            CopyFactory.StepsAt(level, floor, period, At(Seen(level)).Set!, below => At(Seen(below)).Set!),
            below => StepsAt(Seen(below)));
        var above = top + 1 + (CopyFactory.MostLevelsTogether * period);
        var copies = Enumerable.Range(0, period).Select(i => CopiesAt(above + i)).ToArray();
        for (var level = top + 1; level < above; level++)
        {
            if (!CopiesAt(level).SequenceEqual(copies[(level - top - 1) % period]))
            {
                return false;
            }
        }

        // The assumption: the last round, widened. If all that a round above is made of is held by the widened one, provided that what is below is,
        // then, by induction, so it is at every depth.
        int InRound(long level) => level < first ? -1 : (int)((level - first) % period);
        var widening = Math.Max(Widening * change, Rounding);
        var assumed = Enumerable.Range(0, period).Select(i => OutlineAt(first + i))
            .Select(outline => outline with { Box = Outline.Widened(outline.Box, widening * outline.Box.Diagonal) }).ToArray();
        assumed = WithMargins(assumed, InRound, above);
        var round = new Made[period];
        for (var i = 0; i < period; i++)
        {
            Outline Below(long level) => InRound(level) is >= 0 and var j ? assumed[j] : OutlineAt(level);
            var steps = StepsAt(first + i);
            if (!steps.Select(step => Below(step.LevelsLeft(above + i)).Image(step.Map, step.Lengthening)).Append(OutlineAt(first + i).Box).All(box => Contains(assumed[i].Box, box)))
            {
                return false;
            }

            round[i] = new(StateOf(At(first + i).Set!, copies[i], copies[i].Select(copy => Below(copy.LevelsLeft(above + i))), assumed[i]), assumed[i], steps);
        }

        // No search goes down 10¹² levels.
        Append(left ?? (period << 20) * (1L << 20), round);
        return true;
    }

    /// <summary>Margins by which the hulls hold the rounds above as well; no hulls where there are none.</summary>
    private Outline[] WithMargins(Outline[] assumed, Func<long, int> inRound, long above)
    {
        const int most = 300;
        if (assumed.Any(outline => outline.Hull is null))
        {
            return [.. assumed.Select(outline => outline with { Hull = null, Margin = 0 })];
        }

        // A margin holds if it is no less than what corners miss by, and a copy's margin on top of that.
        var margins = assumed.Select(outline => outline.Margin).ToArray();
        var missed = new double[assumed.Length];
        for (var attempt = 0; attempt < most; attempt++)
        {
            var holds = true;
            for (var i = 0; i < assumed.Length; i++)
            {
                var needed = margins[i];
                foreach (var step in StepsAt(Levels - assumed.Length + 1 + i))
                {
                    var below = step.LevelsLeft(above + i);
                    var j = inRound(below);
                    var outline = j >= 0 ? assumed[j] : OutlineAt(below);
                    if (outline.Hull is null)
                    {
                        continue;
                    }

                    if (attempt == 0)
                    {
                        missed[i] = Math.Max(missed[i], outline.Hull.Vertices.Max(vertex => assumed[i].Hull!.DistanceBound(step.Map * vertex)));
                    }

                    needed = Math.Max(needed, missed[i] + (step.Lengthening * (j >= 0 ? margins[j] : outline.Margin)));
                }

                holds &= needed <= margins[i];
                // A little more than needed, so that it ends.
                margins[i] = needed > margins[i] ? needed * (1 + Settled) : margins[i];
            }

            if (holds)
            {
                return [.. assumed.Select((outline, i) => outline with { Margin = margins[i] })];
            }
        }

        return [.. assumed.Select(outline => outline with { Hull = null, Margin = 0 })];
    }

    private static bool Contains(BoundingBox outer, BoundingBox inner) => BoundingBox.Union(outer, inner) == outer;

    /// <summary>By which part of its size a box changes.</summary>
    private static double Change(BoundingBox box1, BoundingBox box2) => box1 == box2 ? 0
        : Math.Max((box1.Minimum - box2.Minimum).MaximumComponent(), (box1.Maximum - box2.Maximum).MaximumComponent()) / box1.Diagonal;

    /// <summary>The outline of what some steps lead to, none of it empty.</summary>
    private static Outline OutlineOf((CopyStep Step, Outline Below)[] parts)
    {
        if (parts.Length == 0)
        {
            return Outline.Empty;
        }

        var box = parts.Aggregate(BoundingBox.Empty, (sum, part) => BoundingBox.Union(sum, part.Below.Image(part.Step.Map, part.Step.Lengthening)));
        var corners = parts.All(part => part.Below.Hull is not null)
            ? parts.SelectMany(part => part.Below.Hull!.Vertices.Select(vertex => part.Step.Map * vertex)).ToArray()
            : null;
        return Outline.With(box, corners, parts.Max(part => part.Step.Lengthening * part.Below.Margin));
    }

    private SubFractal StateOf(CopySet set, Copy[] copies, IEnumerable<Outline> below, Outline outline)
    {
        Outline[] parts = [.. below];
        var boxes = copies.Zip(parts, (copy, part) => part.Image(copy.Map, copy.Lengthening)).ToArray();
        return new(set, copies, boxes, outline, _outlines[0].Box, HullOf(outline), parts.Length > 0 ? HullOf(parts[0]) : null);
    }

    private static HullBound? HullOf(Outline outline)
    {
        var (x, y, z) = outline.Box.Size;
        return outline.Hull is null || outline.Hull.Volume() > MostOfBox * x * y * z ? null : new(outline.Hull, outline.Box, outline.Margin, withAxes: true);
    }

    private readonly record struct Made(SubFractal State, Outline Outline, CopyStep[] Steps);
}
