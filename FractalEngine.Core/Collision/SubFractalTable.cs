using System.Runtime.InteropServices;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// The sub-fractals of a fractal, one for each number of levels that are left. Deep repetitions share those of one round once their bounds have
/// settled, so the table stays in kilobytes at any depth.
/// </summary>
/// <remarks>
/// The identity is not a copy like the others: where all levels below have it, the base mesh stands at the level itself, and a copy may pass
/// over levels that have it. Each chain of the other maps is then reached in one way, on its earliest levels (docs/colliders.md).
/// </remarks>
internal sealed class SubFractalTable
{
    // More mean that the bounds grow or shrink too slowly to settle.
    private const int MostStates = 4000;

    // Bounds settle when a round changes them by less than this part of their size. They are then widened by ten times as much, and
    // it is verified that what is widened holds everything at any depth.
    private const double Settled = 1e-7;

    // Boxes around boxes grow wherever a map turns. Looking at so many copies of copies keeps that from adding up.
    private const int LookAhead = 96;
    private const int MostCopies = 256;
    private const int MostLookAheadLevels = 8;

    private readonly List<SubFractal> _states = [];
    private readonly List<Region> _regions = [];
    private readonly Dictionary<TransformationSet, CopySet> _sets = [];
    private readonly BoundingBox _base;

    private SubFractalTable(Mesh baseMesh)
    {
        _base = baseMesh.Bounds;
        Append(1, new SubFractal(null, [], [], _base, emitsBase: true));
    }

    /// <summary>The levels of the whole fractal; a huge number where they are infinitely many.</summary>
    public long Levels { get; private set; } = -1;

    /// <summary>True when all maps are multiples of rotations and mirrors, so that distances scale with them.</summary>
    public bool AreSimilar { get; private set; }

    /// <summary>The maps of all levels.</summary>
    public IEnumerable<AffineMap> Maps => _sets.Values.SelectMany(set => set.Maps);

    /// <summary>Bytes of all that is kept.</summary>
    public long StorageBytes => _states.Sum(state => state.StorageBytes) + _sets.Values.Sum(set => set.StorageBytes);

    /// <summary>The table of a fractal in affine composition.</summary>
    /// <exception cref="FractalLimitException">Bounds overflow a double, or don't settle; the message names the level.</exception>
    public static SubFractalTable Of(Fractal fractal)
    {
        var table = new SubFractalTable(fractal.BaseMesh);
        foreach (var step in fractal.Description.Steps.Reverse())
        {
            table.Add(step);
        }

        table.AreSimilar = table._sets.Values.All(set => set.AreSimilar);
        return table;
    }

    /// <summary>The sub-fractal with so many levels left.</summary>
    public SubFractal At(long levels)
    {
        foreach (ref readonly var region in CollectionsMarshal.AsSpan(_regions))
        {
            if (levels < region.First + region.Count)
            {
                var offset = levels - region.First;
                return _states[region.State + (int)(offset < region.Period ? offset : offset % region.Period)];
            }
        }

        throw new ArgumentOutOfRangeException(nameof(levels), levels, "the fractal has fewer levels");
    }

    private void Append(long count, params ReadOnlySpan<SubFractal> states)
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

        _states.AddRange(states);
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

        var state = Make(Levels + 1, floor, period, copySet, At);
        if (!state.Box.IsEmpty && !(state.Box.Minimum.IsFinite() && state.Box.Size.IsFinite()))
        {
            throw new FractalLimitException($"the bounds of the fractal are beyond the range of a double {Levels + 1} levels above its base");
        }

        Append(1, state);
    }

    /// <summary>Lets one round, widened a little, stand for all rounds that are left, if it can be shown to hold them.</summary>
    /// <param name="floor">The levels below the repetition.</param>
    /// <param name="period">Levels of a round.</param>
    /// <param name="left">How many levels are left; null for infinitely many.</param>
    private bool TryRepeat(long floor, int period, long? left)
    {
        var top = Levels;
        for (var level = top - period + 1; level <= top; level++)
        {
            if (Differs(At(level).Box, At(level - period).Box))
            {
                return false;
            }
        }

        SubFractal Below(long level) => At(level <= top ? level : top - period + 1 + ((level - top - 1) % period));
        var widened = Enumerable.Range(1, period).Select(i => WithBox(At(top - period + i), Widen(At(top - period + i).Box))).ToArray();
        SubFractal Assumed(long level) => level <= top - period ? At(level) : widened[(level - (top - period + 1)) % period];

        // If everything below one round up is held by the widened boxes, then, by induction, so it is at every depth.
        var round = new SubFractal[period];
        for (var i = 0; i < period; i++)
        {
            var level = top + period + 1 + i;
            var made = Make(level, floor, period, Below(level).Set!, Assumed);
            if (!Contains(widened[i].Box, made.Box) || !Contains(widened[i].Box, At(top - period + 1 + i).Box))
            {
                return false;
            }

            round[i] = WithBox(made, widened[i].Box);
        }

        // No search goes down 10¹² levels.
        Append(left ?? (period << 20) * (1L << 20), round);
        return true;
    }

    private static SubFractal WithBox(SubFractal state, BoundingBox box) => new(
        state.Set, state.Copies, [.. Enumerable.Range(0, state.Copies.Length).Select(state.BoxOf)], box, state.EmitsBase);

    private static BoundingBox Widen(BoundingBox box)
    {
        var margin = 10 * Settled * box.Diagonal * Vector.One;
        return new(box.Minimum - margin, box.Maximum + margin);
    }

    private static bool Contains(BoundingBox outer, BoundingBox inner) => BoundingBox.Union(outer, inner) == outer;

    private static bool Differs(BoundingBox box1, BoundingBox box2) => !(Math.Max(
        (box1.Minimum - box2.Minimum).MaximumComponent(), (box1.Maximum - box2.Maximum).MaximumComponent()) <= Settled * box1.Diagonal);

    /// <summary>The sub-fractal that has a set on top of what is below.</summary>
    private SubFractal Make(long level, long floor, int period, CopySet set, Func<long, SubFractal> below)
    {
        var copies = CopiesAt(level, floor, period, set, below);
        var emitsBase = copies.Count > 0 && copies[^1].PassesRepetition && floor == 0;
        if (emitsBase)
        {
            copies.RemoveAt(copies.Count - 1);
        }

        var boxes = new BoundingBox[copies.Count];
        var box = emitsBase ? _base : BoundingBox.Empty;
        for (var i = 0; i < boxes.Length; i++)
        {
            boxes[i] = BoxAround(copies[i].Map, copies[i].LevelsLeft(level), below);
            box = BoundingBox.Union(box, boxes[i]);
        }

        return new(set, [.. copies], boxes, box, emitsBase);
    }

    /// <summary>
    /// The copies of a level: its own maps, then, where its identity lets it be passed over, those that the next levels of the same
    /// repetition add, and last what is below the repetition, if all of it can be passed over.
    /// </summary>
    private static List<Copy> CopiesAt(long level, long floor, int period, CopySet set, Func<long, SubFractal> below)
    {
        var copies = new List<Copy>();
        var offered = new HashSet<AffineMap>();
        for (var (current, down) = (set, 1L); ; down++)
        {
            AddCopies(copies, offered, current, down);
            if (current.IdentityIndex < 0)
            {
                return copies;
            }

            // All sets of the repetition have been seen, and all have the identity.
            if (level - down == floor || down == period)
            {
                copies.Add(Copy.Past(floor));
                return copies;
            }

            if (copies.Count > MostCopies)
            {
                // Short lists matter more than the last duplicate: the rest is left to the next level, as it stands.
                copies.Add(new(CopySet.Identity, 0, down));
                return copies;
            }

            current = below(level - down).Set!;
        }
    }

    private static void AddCopies(List<Copy> copies, HashSet<AffineMap> offered, CopySet set, long down)
    {
        var here = new HashSet<AffineMap>();
        for (var i = 0; i < set.Maps.Length; i++)
        {
            // What a level above offers is found there, provided that this level could be passed over instead.
            var isNew = offered.Add(set.Maps[i]) || set.IdentityIndex < 0;
            if (set.Maps[i] != AffineMap.Identity && here.Add(set.Maps[i]) && isNew)
            {
                copies.Add(new(set, i, down));
            }
        }
    }

    /// <summary>A box around the image of a sub-fractal, by its copies and theirs down to some number of them.</summary>
    private BoundingBox BoxAround(AffineMap map, long levels, Func<long, SubFractal> below)
    {
        var open = new List<(AffineMap Map, long Levels)> { (map, levels) };
        var box = BoundingBox.Empty;
        for (var depth = 0; depth < MostLookAheadLevels; depth++)
        {
            var (next, emitted) = (new List<(AffineMap Map, long Levels)>(), box);
            foreach (var (outer, left) in open)
            {
                var state = below(left);
                emitted = state.EmitsBase ? BoundingBox.Union(emitted, _base.Transform(outer)) : emitted;
                next.AddRange(state.Copies.Select(copy => (outer * copy.Map, copy.LevelsLeft(left))));
            }

            if (next.Count > LookAhead)
            {
                break;
            }

            (open, box) = (next, emitted);
        }

        return open.Aggregate(box, (all, item) => BoundingBox.Union(all, below(item.Levels).Box.Transform(item.Map)));
    }

    /// <summary>Levels from <paramref name="First"/> on, whose states repeat with a period.</summary>
    private readonly record struct Region(long First, long Count, int State, int Period);
}
