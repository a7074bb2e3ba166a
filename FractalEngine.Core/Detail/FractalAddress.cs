using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Detail;

/// <summary>
/// Where a camera is in a fractal, at any depth: a sub-fractal near it, by the way that leads there, and its place relative to that. As the camera moves, it is told relative
/// to a sub-fractal further in or further out, so that all numbers stay about 1 and nothing loses precision, however deep it goes.
/// </summary>
/// <remarks>
/// Replaces the paper's m ← m·t (§4.3.2), which keeps one matrix and loses it at about level 50. Memory: 16 bytes a level, at most <see cref="FractalLimits.Depth"/> levels.
/// Lengths are in a unit that changes with the depth; perspective shows the same in any unit.
/// </remarks>
public sealed partial class FractalAddress
{
    // A sub-fractal is entered within this part of its box's diagonal, and left beyond the other: between them nothing changes.
    private const double Entered = 0.5;
    private const double Left = 1.5;

    // Of the distance: smaller parts are as far away as their boxes.
    private const double Fine = 0.1;
    private const int MostParts = 2000;

    // Of the sub-fractal's size: what is nearer than this has parts enough of its own to be told relative to one.
    private const double Small = 0.02;
    private const int Patience = 6;

    // In the present unit: of what is larger nothing is seen that is not seen nearer.
    private const double Outermost = 1e15;

    // Of the determinant, for a largest entry of 1.
    private const double Thinnest = 1e-8;

    private const int ColouredLevels = 64;

    // Of the whole: smaller sub-fractals are below the last place of a coordinate.
    private const double LastPlace = 1e-17;

    // What is near may be part of any of those further out, up to where they are too large to come into it.
    private const int NearAncestors = 30;

    private readonly DetailTable _table;
    private readonly List<int> _path = [];
    private readonly List<long> _levels = [];

    // Of the maps that are not the identity, up to each depth.
    private readonly List<int> _counts = [0];
    private readonly PriorityQueue<(int Up, int Node), double> _open = new();
    private readonly List<(int Parent, int Child, long Levels, AffineMap Map)> _nodes = [];
    private double? _nearest;
    private AffineMap _about;
    private int _moves;

    /// <summary>A camera outside, at the top.</summary>
    /// <param name="table">Of the fractal.</param>
    /// <param name="placement">The object's matrix m, from the fractal's frame to world space.</param>
    /// <param name="camera">Its position in world space.</param>
    public FractalAddress(DetailTable table, AffineMap placement, Vector camera)
    {
        _table = table;
        _about = new(placement.Linear, placement.Translation - camera);
        _levels.Add(table.Levels);
    }

    /// <summary>How many copies lead to the sub-fractal.</summary>
    public int Depth => _path.Count;

    /// <summary>The way there: for each level the number of the copy.</summary>
    public IReadOnlyList<int> Path => _path;

    /// <summary>From the sub-fractal's frame to world axes about the camera, in the present unit.</summary>
    public AffineMap About => _about;

    /// <summary>The natural logarithm of the present unit, in scene units.</summary>
    public double LogUnit { get; private set; }

    /// <summary>Bytes of the path.</summary>
    public long StorageBytes => (sizeof(int) * ((long)_path.Capacity + _counts.Capacity)) + (sizeof(long) * (long)_levels.Capacity);

    private DetailState State => _table.At(_levels[^1]);

    /// <summary>Moves the camera, and tells its place anew.</summary>
    /// <param name="step">World axes, in the present unit; finite.</param>
    public void Move(Vector step)
    {
        _nearest = null;
        _about = _about with { Translation = _about.Translation - step };
        var depth = Depth;
        Settle();
        // To look for what is nearest takes long; it matters only after the camera has come nearer for a while and nothing could be entered.
        _moves = Depth == depth ? _moves + 1 : 0;
        if (_moves == Patience)
        {
            _moves = 0;
            Change();
            Settle();
        }
    }

    /// <summary>What drawing begins with: the sub-fractal itself, and the other parts of those that it is in.</summary>
    /// <param name="ancestors">How many of these at most; what is further out, or 10¹⁵ times as large as the present unit, is not drawn.</param>
    public ImmutableArray<DetailRoot> Roots(int ancestors)
    {
        var roots = ImmutableArray.CreateBuilder<DetailRoot>();
        roots.Add(new(_levels[^1], _about, WayTo(_path.Count)));
        var map = _about;
        for (var i = _path.Count - 1; i >= Math.Max(0, _path.Count - ancestors); i--)
        {
            var state = _table.At(_levels[i]);
            map *= state.Maps[_path[i]].ToMap().Inverse();
            if (!map.IsFinite() || map.Linear.MaximumEntry() > Outermost)
            {
                break;
            }

            var way = WayTo(i);
            for (var child = 0; child < state.Maps.Length; child++)
            {
                if (child != _path[i])
                {
                    roots.Add(new(
                        Below(_levels[i], state.Downs[child]), map * state.Maps[child].ToMap(), way.Then(state.Indices[child], child, state.Maps.Length)));
                }
            }
        }

        // The nearest first: they hide the others.
        return [.. roots.OrderBy(root => _table.At(root.Levels) is { IsEmpty: false } state ? Distance(state.Box.Transform(root.Map), Vector.Zero) : double.PositiveInfinity)];
    }

    /// <summary>The camera's place in world space, as far as a double can tell it.</summary>
    /// <param name="placement">The object's matrix m.</param>
    public Vector WorldPosition(AffineMap placement)
    {
        var (map, depth, least) = (placement, 0, LastPlace * _table.At(_table.Levels).Box.Transform(placement).Diagonal);
        for (; depth < Depth && _table.At(_levels[depth]).Box.Transform(map).Diagonal > least; depth++)
        {
            map *= _table.At(_levels[depth]).Maps[_path[depth]].ToMap();
        }

        return map * (depth == Depth ? _about.Inverse() * Vector.Zero : _table.At(_levels[depth]).Box.Centre);
    }

    /// <summary>How far away the farthest drawn part can be, in the present unit.</summary>
    public double FarthestDistance(ImmutableArray<DetailRoot> roots) => roots.Max(root =>
        _table.At(root.Levels) is { IsEmpty: false, Box: var box } && box.Transform(root.Map) is var image ? image.Centre.Length() + image.Diagonal : 0);

    /// <summary>What leads to the sub-fractal that so many copies of the path lead to.</summary>
    private DetailWay WayTo(int depth)
    {
        // Further down the weights are below the last place of a colour.
        var way = DetailWay.Start;
        for (var i = 0; i < Math.Min(depth, ColouredLevels); i++)
        {
            var state = _table.At(_levels[i]);
            way = way.Then(state.Indices[_path[i]], _path[i], state.Maps.Length);
        }

        return way with { Count = _counts[depth] };
    }

    private static long Below(long levels, long down) => down < 0 ? ~down : levels - down;

    /// <summary>The distance of the camera from a box.</summary>
    private static double Distance(BoundingBox box, Vector camera) => Math.Sqrt(box.DistanceSquared(camera));

    private void Settle()
    {
        while (TryLeave() || TryEnter())
        {
        }
    }

    private bool TryLeave()
    {
        if (_path.Count == 0 || !(Distance(State.Box, _about.Inverse() * Vector.Zero) > Left * State.Box.Diagonal))
        {
            return false;
        }

        Leave();
        return true;
    }

    private bool TryEnter()
    {
        var (state, camera) = (State, _about.Inverse() * Vector.Zero);
        var (nearest, least) = (-1, double.PositiveInfinity);
        for (var child = 0; child < state.Maps.Length && _path.Count < FractalLimits.Depth; child++)
        {
            var below = _table.At(Below(_levels[^1], state.Downs[child]));
            if (below.Maps.Length > 0)
            {
                // In the copy's own frame, by its own size.
                var distance = Distance(below.Box, state.Maps[child].ToMap().Inverse() * camera) / below.Box.Diagonal;
                (nearest, least) = distance < least ? (child, distance) : (nearest, least);
            }
        }

        return least <= Entered && TryEnter(nearest);
    }

    private bool TryEnter(int child)
    {
        var state = State;
        if (_path.Count >= FractalLimits.Depth || IsTooThin(_about.Linear * state.Maps[child].ToMap().Linear))
        {
            return false;
        }

        _levels.Add(Below(_levels[^1], state.Downs[child]));
        _path.Add(child);
        _counts.Add(_counts[^1] + (state.Indices[child] < 0 ? 0 : 1));
        Rebase(_about * state.Maps[child].ToMap());
        return true;
    }

    private void Leave()
    {
        var copy = _path[^1];
        _path.RemoveAt(_path.Count - 1);
        _levels.RemoveAt(_levels.Count - 1);
        _counts.RemoveAt(_counts.Count - 1);
        Rebase(_about * State.Maps[copy].ToMap().Inverse());
    }

    /// <summary>
    /// True for a frame so skewed that places in it can't be told. Maps that stretch one direction more than another come there after some ten levels of more than
    /// double precision can tell from outside.
    /// </summary>
    private static bool IsTooThin(Matrix linear)
    {
        var largest = linear.MaximumEntry();
        return !(Math.Abs((linear / largest).Determinant()) > Thinnest);
    }

    /// <summary>Chooses the unit so that the sub-fractal's frame has it.</summary>
    private void Rebase(AffineMap about)
    {
        var scale = Math.Cbrt(Math.Abs(about.Linear.Determinant()));
        if (Depth == 0)
        {
            // Outside, lengths are in scene units again.
            scale = Math.Exp(-LogUnit);
        }

        _about = new(about.Linear / scale, about.Translation / scale);
        LogUnit += Math.Log(scale);
        if (Depth == 0)
        {
            LogUnit = 0;
        }
    }
}
