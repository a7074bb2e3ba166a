using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Detail;

/// <summary>
/// Chooses what is drawn in one strip of a picture: walks the levels of each object from the top, nearest first, and leaves out what lies outside, what is
/// hidden, and what is too small to be told apart.
/// </summary>
internal sealed partial class StripSearch
{
    // A sub-fractal at this depth is drawn as it stands: its levels hardly shrink.
    private const int Deepest = 1000;
    private const int FewChildren = 24;
    private const float SubPixel = 256;
    private const int Finer = 2;

    // Of a whole budget, in one strip.
    private const int NodesPerInstance = 4;
    private const int LeastNodes = 20_000;

    // Left, right, top, bottom, nearness and depth of each copy.
    private const int EdgeRows = 6;

    // Of a pixel: more than what single precision rounds by.
    private const float Widened = 1f / 256;

    // A sub-fractal is drawn as it stands, too, when its copies would be smaller than this part of what counts as small.
    private const double FinestPart = 0.5;

    // Not when it is itself more than so many times what counts as small: copies that are tiny beside what lies between them are no solid.
    private const double Coarsest = 3;

    private readonly CoverageBuffer _coverage = new();
    private float[] _screenX = [];
    private float[] _screenY = [];
    private float[] _nearness = [];
    private float[] _keys = new float[256];
    private float[] _edges = new float[256 * EdgeRows];
    private int[] _order = new int[256];
    private int _top;
    private DetailView _view;
    private DetailSettings _settings = new();
    private DetailObject _object = null!;
    private BaseMesh _mesh = null!;
    private AffineLanes _toWorld;
    private Vector256<double> _origin;
    private float _least;
    private float _most;
    private double _pixelSize;
    private double _scaleX;
    private double _scaleY;
    private double _middleX;
    private double _middleY;
    private int _budget;
    private long _mostNodes;
    private DetailCost _cost;

    /// <summary>The instances found: rows of 3×4 maps from the frame of the drawn mesh to world axes about the camera.</summary>
    public InstanceRows Rows { get; } = new(hasPaths: false);

    /// <summary>Those that reach out of the strip, to which others may come as well, with what tells them apart.</summary>
    public InstanceRows Shared { get; } = new(hasPaths: true);

    /// <summary>What it took.</summary>
    public DetailCost Cost => _cost;

    /// <summary>True when the near plane cuts through an instance of the object that was added last.</summary>
    public bool IsCut { get; private set; }

    /// <summary>True when there was more than the budget.</summary>
    public bool IsOverBudget { get; private set; }

    /// <summary>Begins a picture.</summary>
    /// <param name="view">Of the whole picture.</param>
    /// <param name="settings">What is left out.</param>
    /// <param name="pixelSize">What counts as small.</param>
    /// <param name="budget">More instances are not looked for.</param>
    /// <param name="left">First column of the strip.</param>
    /// <param name="right">One more than the last.</param>
    public void Begin(in DetailView view, DetailSettings settings, double pixelSize, int budget, int left, int right)
    {
        // From here on, pixels are those of the coverage: two by two where pixels have samples.
        var finer = settings.HasSamples ? Finer : 1;
        (_view, _settings, _pixelSize, _budget, _cost, IsOverBudget) = (view, settings, finer * pixelSize, budget, default, false);
        (_scaleX, _scaleY) = (finer * view.PixelsPerUnitX, finer * view.PixelsPerUnitY);
        (_middleX, _middleY) = (finer * 0.5 * view.Width, finer * 0.5 * view.Height);
        _toWorld = new(new AffineMap(view.Axes, Vector.Zero));
        _coverage.Clear(finer * left, finer * right, finer * view.Height, settings.HasSamples);
        (_least, _most) = settings.HasSamples ? (0.25f - Widened, 0.75f + Widened) : (0.5f - Widened, 0.5f + Widened);
        _mostNodes = NodesPerInstance * (long)Math.Max(budget, LeastNodes);
        Rows.Clear();
        Shared.Clear();
    }

    /// <summary>Chooses what is drawn of an object.</summary>
    /// <param name="item">The object; the nearest is asked first.</param>
    public void Add(DetailObject item)
    {
        (_object, _mesh, _origin, _top, IsCut) = (item, item.Table.Base, AffineLanes.Of(item.Origin), 0, false);
        if (_screenX.Length < _mesh.Padded)
        {
            (_screenX, _screenY, _nearness) = (new float[_mesh.Padded], new float[_mesh.Padded], new float[_mesh.Padded]);
        }

        var toView = _view.Axes.Inverse();
        if (item.Roots is not { } roots)
        {
            VisitRoot(item.Table.Levels, new AffineMap(toView * item.Map.Linear, toView * (item.Map.Translation - _view.Position)), new(0, DetailWay.Start));
            return;
        }

        for (var i = 0; i < roots.Length; i++)
        {
            VisitRoot(roots[i].Levels, new AffineMap(toView * roots[i].Map.Linear, toView * roots[i].Map.Translation), new((ulong)(i + 1) << 40, roots[i].Way));
        }
    }

    /// <summary>Looks at a part that drawing begins with.</summary>
    private void VisitRoot(long levels, AffineMap toView, Trail path)
    {
        var (state, map) = (_object.Table.At(levels), new AffineLanes(toView));
        // Of a picture of less than eight columns some strips have none.
        if (!state.IsEmpty && _coverage.Left < _coverage.Right)
        {
            var footprint = FootprintOf(map.Apply(state.Centre), map.HalfSizeOf(state.HalfSize));
            _cost.Nodes++;
            Visit(state, levels, in map, 0, path, in footprint);
        }
    }

    /// <summary>Looks at a sub-fractal whose place in the picture is known.</summary>
    private void Visit(DetailState state, long levels, in AffineLanes map, int depth, Trail path, in Footprint footprint)
    {
        if (!IsSeen(in footprint))
        {
            return;
        }

        VisitSeen(state, levels, in map, depth, path, in footprint);
    }

    private void VisitSeen(DetailState state, long levels, in AffineLanes map, int depth, Trail path, in Footprint footprint)
    {
        if (IsOver())
        {
            return;
        }

        if (state.Maps.Length == 0)
        {
            Emit(state, in map, in footprint, path);
        }
        else if (!(footprint.Size > _pixelSize) || (footprint.Size <= Coarsest * _pixelSize && footprint.Size * state.Ratio <= FinestPart * _pixelSize) || depth >= Deepest)
        {
            _cost.StandIns++;
            Emit(state, in map, in footprint, path);
        }
        else
        {
            VisitChildren(state, levels, in map, depth, path);
        }
    }

    private bool IsOver() => IsOverBudget |= _cost.Nodes > _mostNodes || Rows.Count + Shared.Count > _budget;

    private bool IsSeen(in Footprint footprint)
    {
        if (footprint.IsOutside)
        {
            _cost.Outside++;
            return false;
        }

        if (!_settings.SkipsHidden || !footprint.IsWhole)
        {
            return true;
        }

        if (footprint.IsBetweenPixels)
        {
            _cost.Uncovering++;
            return false;
        }

        if (_coverage.IsHidden(footprint.Left, footprint.Top, footprint.Right, footprint.Bottom, footprint.Nearness))
        {
            _cost.Hidden++;
            return false;
        }

        return true;
    }

    private void VisitChildren(DetailState state, long levels, in AffineLanes map, int depth, Trail path)
    {
        var (count, first) = (state.Maps.Length, _top);
        _top += (count + DetailState.Lanes - 1) / DetailState.Lanes * DetailState.Lanes;
        if (_top > _order.Length)
        {
            Array.Resize(ref _order, 2 * _top);
            Array.Resize(ref _keys, 2 * _top);
            Array.Resize(ref _edges, 2 * _top * EdgeRows);
        }

        _cost.Nodes += count;
        Project(state, in map, first);
        Sort(_keys.AsSpan(first, count), _order.AsSpan(first, count));
        for (var i = first; i < first + count; i++)
        {
            var child = _order[i];
            var footprint = FootprintOf(first, child);
            if (!footprint.IsUnsure && !IsSeen(in footprint))
            {
                continue;
            }

            var down = state.Downs[child];
            var below = down < 0 ? ~down : levels - down;
            var childState = _object.Table.At(below);
            var childMap = AffineLanes.Compose(in map, in state.Maps[child]);
            var childDepth = depth + 1;
            var childPath = path.Then(child, depth, state.Indices[child], count, _object.Gradient);
            while (childState.Maps.Length == 1 && childDepth < Deepest)
            {
                // Nothing to choose: the same seen more closely.
                childMap = AffineLanes.Compose(in childMap, in childState.Maps[0]);
                childPath = childPath.Then(0, childDepth, childState.Indices[0], 1, _object.Gradient);
                below = childState.Downs[0] < 0 ? ~childState.Downs[0] : below - childState.Downs[0];
                childState = _object.Table.At(below);
                childDepth++;
            }

            if (footprint.IsUnsure)
            {
                footprint = FootprintOf(childMap.Apply(childState.Centre), childMap.HalfSizeOf(childState.HalfSize));
                Visit(childState, below, in childMap, childDepth, childPath, in footprint);
            }
            else
            {
                VisitSeen(childState, below, in childMap, childDepth, childPath, in footprint);
            }
        }

        _top = first;
    }

    /// <summary>The nearest first.</summary>
    private static void Sort(Span<float> keys, Span<int> order)
    {
        if (keys.Length > FewChildren)
        {
            for (var i = 0; i < order.Length; i++)
            {
                order[i] = i;
            }

            keys.Sort(order);
            return;
        }

        for (var i = 0; i < keys.Length; i++)
        {
            var (key, place) = (keys[i], i);
            for (; place > 0 && keys[place - 1] > key; place--)
            {
                (keys[place], order[place]) = (keys[place - 1], order[place - 1]);
            }

            (keys[place], order[place]) = (key, i);
        }
    }

    /// <summary>The way to a sub-fractal.</summary>
    /// <param name="Number">What tells it apart from others.</param>
    /// <param name="Way">What its colour follows from; not kept where it has none of its own.</param>
    private readonly record struct Trail(ulong Number, DetailWay Way)
    {
        /// <summary>One copy further.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Trail Then(int child, int depth, int index, int count, GradientKind gradient) => new(
            ((Number ^ (ulong)(child + 1)) * 0x9E3779B97F4A7C15UL) + (ulong)depth, gradient == GradientKind.None ? Way : Way.Then(index, child, count));
    }
}
