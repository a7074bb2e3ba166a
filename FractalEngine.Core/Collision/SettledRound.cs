using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Collision;

/// <summary>
/// Shows that the last round of a repetition, widened a little, holds all rounds above it, however many. If all that a round above is made of is
/// held by the widened one, provided that what is below is, then, by induction, so it is at every depth.
/// </summary>
/// <param name="top">Its uppermost level.</param>
/// <param name="period">Its number of levels.</param>
/// <param name="outlineAt">Of all levels up to the top.</param>
/// <param name="stepsAt">Of all levels up to the top.</param>
/// <param name="patience">
/// From 1 upwards: what may change, as a multiple of the usual. Which corners a hull keeps may change a little from round to round without end.
/// </param>
internal sealed class SettledRound(long top, int period, Func<long, Outline> outlineAt, Func<long, CopyStep[]> stepsAt, double patience)
{
    // Bounds settle when a round changes them by less than this part of their size, or of the margin by which they are too large anyway. They are
    // then widened by ten times as much as they changed, or by what rounding may change.
    private const double Settled = 1e-7;
    private const double SettledOfMargin = 0.05;
    private const double Widening = 10;
    private const double Rounding = 1e-14;

    // Where margins had to grow, boxes may need more.
    private const double WideningStep = 8;
    private const double MostWidening = 0.2;

    private const int MostAttempts = 300;

    /// <summary>Its lowest level.</summary>
    public long First { get; } = top - period + 1;

    /// <summary>The lowest level of a round so far up that all its copies are of levels in rounds like this one.</summary>
    public long Above { get; } = top + 1 + (CopyFactory.MostLevelsTogether * (long)period);

    /// <summary>False where the bounds of the last two rounds differ too much.</summary>
    public bool IsLikely() => Difference() <= Threshold();

    /// <summary>The place of a level in its round, 0 the lowest.</summary>
    public int PlaceOf(long level) => (int)((((level - First) % period) + period) % period);

    /// <summary>The level itself or, for one above the round, that in the round which is like it.</summary>
    public long Like(long level) => level <= top ? level : First + PlaceOf(level);

    /// <summary>The outline of any level: those of the rounds above are the same.</summary>
    public Outline Below(Outline[] outlines, long level) => level < First ? outlineAt(level) : outlines[PlaceOf(level)];

    /// <summary>Outlines that hold this round and all rounds above it; null where none are found.</summary>
    /// <param name="copies">Of a round above, by their places.</param>
    public Outline[]? TryHold(Copy[][] copies)
    {
        // Copies in the first rounds above are of levels below this one; what is said of it must hold for those as well.
        var held = Enumerable.Range(0, period).Select(i => new HashSet<long> { First + i }).ToArray();
        for (var level = top + 1; level < Above; level++)
        {
            foreach (var below in copies[PlaceOf(level)].Where(copy => copy.Down >= 0).Select(copy => copy.LevelsLeft(level)).Where(below => below < First))
            {
                held[PlaceOf(below)].Add(below);
            }
        }

        if (!held.Select((levels, i) => levels.Max(level => Change(outlineAt(level).Box, outlineAt(First + i).Box))).All(change => change <= Threshold()))
        {
            return null;
        }

        var hulls = WithMargins([.. Enumerable.Range(0, period).Select(i => outlineAt(First + i))], held);
        for (var widening = Math.Max(Widening * Difference(), Rounding); widening < MostWidening; widening *= WideningStep)
        {
            Outline[] outlines = [.. hulls.Select((outline, i) => outline with { Box = Widened(held[i].Select(level => outlineAt(level).Box), widening) })];
            if (Enumerable.Range(0, period).All(i => HoldsCopies(outlines, i)))
            {
                return outlines;
            }
        }

        return null;
    }

    private static BoundingBox Widened(IEnumerable<BoundingBox> boxes, double part) =>
        boxes.Aggregate(BoundingBox.Union) switch { var box => Outline.Widened(box, (part * box.Diagonal) + (Rounding * Magnitude(box))) };

    /// <summary>By which part of its size a box changes, rounding left out: what shrinks to a point does no more.</summary>
    private static double Change(BoundingBox box1, BoundingBox box2)
    {
        var change = Math.Max((box1.Minimum - box2.Minimum).MaximumComponent(), (box1.Maximum - box2.Maximum).MaximumComponent());
        return box1 == box2 || change <= Rounding * Magnitude(box1) ? 0 : change / box1.Diagonal;
    }

    private static double Magnitude(BoundingBox box) =>
        box.IsEmpty ? 0 : Math.Max(box.Minimum.MaximumComponent(), box.Maximum.MaximumComponent());

    private static Outline[] WithoutHulls(Outline[] outlines) => [.. outlines.Select(outline => outline with { Hull = null, Margin = 0 })];

    private double Threshold() => Math.Max(
        Settled, Math.Min(1, patience * SettledOfMargin) * Enumerable.Range(0, period).Select(i => outlineAt(First + i)).Min(outline => outline.Margin / outline.Box.Diagonal));

    private double Difference() => Enumerable.Range(0, period).Max(i => Change(outlineAt(First + i).Box, outlineAt(First + i - period).Box));

    private bool HoldsCopies(Outline[] outlines, int place)
    {
        var outer = outlines[place].Box;
        return stepsAt(First + place).Select(step => Part.Of(step, Above + place, level => stepsAt(Like(level))))
            .Select(part => Below(outlines, part.Level).Image(part.Map, part.Lengthening)).All(box => BoundingBox.Union(outer, box) == outer);
    }

    /// <summary>Gives the hulls margins by which they hold the rounds above as well; takes the hulls away where there are none.</summary>
    private Outline[] WithMargins(Outline[] outlines, HashSet<long>[] held)
    {
        var parts = Enumerable.Range(0, period)
            .SelectMany(i => stepsAt(First + i).Select(step => (Place: i, Part: Part.Of(step, Above + i, level => stepsAt(Like(level)))))).ToArray();
        var below = parts.Where(item => item.Part.Level < First).Select(item => item.Part.Level).Concat(held.SelectMany(levels => levels)).Select(outlineAt);
        if (outlines.Any(outline => outline.Hull is null) || below.Any(outline => outline.Hull is null && !outline.Box.IsEmpty))
        {
            return WithoutHulls(outlines);
        }

        // A margin holds if it is no less than what corners miss by, and a part's margin on top of that.
        var margins = held.Select((levels, i) => levels.Select(outlineAt).Where(outline => outline.Hull is not null)
            .Max(outline => outline.Margin + Miss(outlines[i], outline.Hull!.Vertices))).ToArray();
        var missed = parts.Select(item => Below(outlines, item.Part.Level).Hull is { } hull
            ? Miss(outlines[item.Place], hull.Vertices.Select(vertex => item.Part.Map * vertex))
            : double.NegativeInfinity).ToArray();
        for (var attempt = 0; attempt < MostAttempts; attempt++)
        {
            var holds = true;
            for (var i = 0; i < parts.Length; i++)
            {
                var (place, part) = parts[i];
                var needed = missed[i] + (part.Lengthening * (part.Level < First ? outlineAt(part.Level).Margin : margins[PlaceOf(part.Level)]));
                holds &= needed <= margins[place];
                // A little more than needed, so that it ends.
                margins[place] = Math.Max(margins[place], needed * (1 + Settled));
            }

            if (holds)
            {
                return [.. outlines.Select((outline, i) => outline with { Margin = margins[i] })];
            }
        }

        return WithoutHulls(outlines);
    }

    private static double Miss(Outline outer, IEnumerable<Maths.Vector> points) => points.Max(outer.Hull!.DistanceBound);
}
