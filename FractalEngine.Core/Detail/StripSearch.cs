using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Detail;

/// <summary>
/// Chooses what is drawn in one strip of a picture: walks the levels of each object from the top, nearest first, and leaves out what lies outside, what is
/// hidden, and what is too small to be told apart.
/// </summary>
internal sealed class StripSearch
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

    /// <summary>Finds where the copies of a sub-fractal appear, eight at a time, in single precision.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private void Project(DetailState state, in AffineLanes map, int first)
    {
        var middle = map.Apply(state.Centre);
        var (v1, v2, v3) = (map.V1, map.V2, map.V3);
        var (x1, x2, x3, x0) = (Vector256.Create((float)v1[0]), Vector256.Create((float)v2[0]), Vector256.Create((float)v3[0]), Vector256.Create((float)middle[0]));
        var (y1, y2, y3, y0) = (Vector256.Create((float)v1[1]), Vector256.Create((float)v2[1]), Vector256.Create((float)v3[1]), Vector256.Create((float)middle[1]));
        var (z1, z2, z3, z0) = (Vector256.Create((float)v1[2]), Vector256.Create((float)v2[2]), Vector256.Create((float)v3[2]), Vector256.Create((float)middle[2]));
        var (scaleX, scaleY) = (Vector256.Create((float)_scaleX), Vector256.Create((float)_scaleY));
        var (middleX, middleY) = (Vector256.Create((float)_middleX), Vector256.Create((float)_middleY));
        // What is nearer, compared with where its parent is, is looked at in double precision.
        var distance = Math.Sqrt(Vector256.Dot(middle, middle));
        var sure = Vector256.Create((float)Math.Max(_view.Near, 1e-3 * distance));
        // Squares of large and small coordinates leave the range of single precision.
        var perDistance = Vector256.Create(distance > 0 ? (float)(1 / distance) : 1);
        ref var boxes = ref MemoryMarshal.GetArrayDataReference(state.Boxes);
        ref var edges = ref MemoryMarshal.GetArrayDataReference(_edges);
        ref var keys = ref MemoryMarshal.GetArrayDataReference(_keys);
        for (var i = 0; i < state.Boxes.Length / DetailState.Rows; i += DetailState.Lanes)
        {
            var place = (nuint)(i * DetailState.Rows);
            var (cx, cy, cz) = (Vector256.LoadUnsafe(ref boxes, place), Vector256.LoadUnsafe(ref boxes, place + 8), Vector256.LoadUnsafe(ref boxes, place + 16));
            var (hx, hy, hz) = (Vector256.LoadUnsafe(ref boxes, place + 24), Vector256.LoadUnsafe(ref boxes, place + 32), Vector256.LoadUnsafe(ref boxes, place + 40));
            var x = x0 + (x1 * cx) + (x2 * cy) + (x3 * cz);
            var y = y0 + (y1 * cx) + (y2 * cy) + (y3 * cz);
            var z = z0 + (z1 * cx) + (z2 * cy) + (z3 * cz);
            var halfX = (Vector256.Abs(x1) * hx) + (Vector256.Abs(x2) * hy) + (Vector256.Abs(x3) * hz);
            var halfY = (Vector256.Abs(y1) * hx) + (Vector256.Abs(y2) * hy) + (Vector256.Abs(y3) * hz);
            var halfZ = (Vector256.Abs(z1) * hx) + (Vector256.Abs(z2) * hy) + (Vector256.Abs(z3) * hz);
            var (zLow, zHigh) = (z - halfZ, z + halfZ);
            var (nearest, farthest, nearness) = (Vector256<float>.One, Vector256<float>.One, -zLow);
            var key = z;
            if (_view.IsPerspective)
            {
                (nearest, farthest) = (Vector256<float>.One / zLow, Vector256<float>.One / zHigh);
                var (keyX, keyY, keyZ) = (x * perDistance, y * perDistance, z * perDistance);
                (nearness, key) = (nearest, (keyX * keyX) + (keyY * keyY) + (keyZ * keyZ));
            }

            var (left, right, up, down) = (x - halfX, x + halfX, y + halfY, y - halfY);
            left = middleX + (scaleX * left * Vector256.ConditionalSelect(Vector256.LessThan(left, Vector256<float>.Zero), nearest, farthest));
            right = middleX + (scaleX * right * Vector256.ConditionalSelect(Vector256.GreaterThan(right, Vector256<float>.Zero), nearest, farthest));
            up = middleY - (scaleY * up * Vector256.ConditionalSelect(Vector256.GreaterThan(up, Vector256<float>.Zero), nearest, farthest));
            down = middleY - (scaleY * down * Vector256.ConditionalSelect(Vector256.LessThan(down, Vector256<float>.Zero), nearest, farthest));
            var target = (nuint)((first + i) * EdgeRows);
            left.StoreUnsafe(ref edges, target);
            right.StoreUnsafe(ref edges, target + 8);
            up.StoreUnsafe(ref edges, target + 16);
            down.StoreUnsafe(ref edges, target + 24);
            nearness.StoreUnsafe(ref edges, target + 32);
            // Not a number for what is too near, and so must be looked at once more.
            Vector256.ConditionalSelect(Vector256.LessThan(zLow, sure), Vector256.Create(float.NaN), zLow).StoreUnsafe(ref edges, target + 40);
            key.StoreUnsafe(ref keys, (nuint)(first + i));
        }
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

    /// <summary>Where a copy appears, as <see cref="Project"/> has found it.</summary>
    private Footprint FootprintOf(int first, int child)
    {
        ref var edges = ref _edges[((first + (child / DetailState.Lanes * DetailState.Lanes)) * EdgeRows) + (child % DetailState.Lanes)];
        var depth = Unsafe.Add(ref edges, 40);
        return float.IsNaN(depth) ? new() { IsUnsure = true }
            : _settings.SkipsOutside && depth > _view.Far ? Footprint.Outside
            : FootprintOf(edges, Unsafe.Add(ref edges, 8), Unsafe.Add(ref edges, 16), Unsafe.Add(ref edges, 24), Unsafe.Add(ref edges, 32));
    }

    /// <summary>Where a box in view space appears.</summary>
    private Footprint FootprintOf(Vector256<double> centre, Vector256<double> half)
    {
        var (low, high) = (centre - half, centre + half);
        var (zLow, zHigh) = (low[2], high[2]);
        if (_settings.SkipsOutside && (zHigh < _view.Near || zLow > _view.Far))
        {
            return Footprint.Outside;
        }

        if (zLow < _view.Near)
        {
            // Projected from as near as anything of it can be; what lies behind the camera, from as far as it is.
            var largest = 2 * Math.Max(half[0] * _scaleX, half[1] * _scaleY);
            var depth = Math.Max(_view.Near, -zHigh);
            return new() { IsOutside = _settings.SkipsOutside && IsBesides(centre, half), Size = _view.IsPerspective ? largest / depth : largest, Right = -1 };
        }

        var (nearest, farthest) = _view.IsPerspective ? (1 / zLow, 1 / zHigh) : (1.0, 1.0);
        var left = _middleX + (_scaleX * low[0] * (low[0] < 0 ? nearest : farthest));
        var right = _middleX + (_scaleX * high[0] * (high[0] > 0 ? nearest : farthest));
        var top = _middleY - (_scaleY * high[1] * (high[1] > 0 ? nearest : farthest));
        var bottom = _middleY - (_scaleY * low[1] * (low[1] < 0 ? nearest : farthest));
        return FootprintOf((float)left, (float)right, (float)top, (float)bottom, (float)(_view.IsPerspective ? nearest : -zLow));
    }

    /// <summary>What a rectangle of the picture covers.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private Footprint FootprintOf(float left, float right, float top, float bottom, float nearness)
    {
        if (_settings.SkipsOutside && !(right >= _coverage.Left && left <= _coverage.Right && bottom >= 0 && top <= _coverage.Height))
        {
            return Footprint.Outside;
        }

        // Those whose samples may lie between the edges.
        var (firstX, lastX) = (MathF.Ceiling(left - _most), MathF.Floor(right - _least));
        var (firstY, lastY) = (MathF.Ceiling(top - _most), MathF.Floor(bottom - _least));
        return new()
        {
            IsWhole = true,
            Size = Math.Max(right - left, bottom - top),
            Nearness = nearness,
            IsBetweenPixels = firstX > lastX || firstY > lastY,
            // What ends on the border is found on both sides.
            IsShared = !_settings.SkipsOutside || !(left > _coverage.Left && right < _coverage.Right),
            Left = (int)Math.Max(firstX, _coverage.Left),
            Right = (int)Math.Min(lastX, _coverage.Right - 1),
            Top = (int)Math.Max(firstY, 0),
            Bottom = (int)Math.Min(lastY, _coverage.Height - 1),
        };
    }

    /// <summary>True for a box that lies beyond one of the planes through the eye and the edges of the strip.</summary>
    private bool IsBesides(Vector256<double> centre, Vector256<double> half)
    {
        var (perX, perY) = (1 / _scaleX, 1 / _scaleY);
        var (left, right) = ((_coverage.Left - _middleX) * perX, (_coverage.Right - _middleX) * perX);
        var (up, down) = (_middleY * perY, -_middleY * perY);
        return IsBeyond(-1, left, centre[0], half[0], centre[2], half[2]) || IsBeyond(1, -right, centre[0], half[0], centre[2], half[2])
            || IsBeyond(1, -up, centre[1], half[1], centre[2], half[2]) || IsBeyond(-1, down, centre[1], half[1], centre[2], half[2]);
    }

    /// <summary>True when sign · x + slope · z (or slope alone) is positive everywhere in the box.</summary>
    private bool IsBeyond(double sign, double slope, double x, double halfX, double z, double halfZ) => _view.IsPerspective
        ? (sign * x) + (slope * z) - halfX - (Math.Abs(slope) * halfZ) > 0
        : (sign * x) + slope - halfX > 0;

    private void Emit(DetailState state, in AffineLanes map, in Footprint footprint, Trail path)
    {
        var placed = map;
        if (!state.IsStandInIdentity)
        {
            var standIn = state.StandIn;
            placed = AffineLanes.Compose(in map, in standIn);
        }

        if (_settings.SkipsHidden && footprint.IsWhole && _object.IsOpaque && _mesh.Faces.Length > 0 && !Covers(in placed))
        {
            _cost.Uncovering++;
            return;
        }

        IsCut |= !footprint.IsWhole;
        var rows = footprint.IsShared || !footprint.IsWhole ? Shared : Rows;
        var inWorld = AffineLanes.Compose(in _toWorld, in placed);
        rows.Add(in inWorld, _origin, path.Number);
        if (_object.Gradient != GradientKind.None)
        {
            rows.SetTint(path.Way.Tint(_object.Gradient, _object.Table.Levels));
        }
    }

    /// <summary>Draws the base mesh. True when it is the nearest at the middle of some pixel.</summary>
    private bool Covers(in AffineLanes map)
    {
        var place = map.Apply(AffineLanes.Of(_mesh.Middle));
        var (v1, v2, v3) = (map.V1, map.V2, map.V3);
        var (x1, x2, x3, x) = (Vector256.Create((float)v1[0]), Vector256.Create((float)v2[0]), Vector256.Create((float)v3[0]), Vector256.Create((float)place[0]));
        var (y1, y2, y3, y) = (Vector256.Create((float)v1[1]), Vector256.Create((float)v2[1]), Vector256.Create((float)v3[1]), Vector256.Create((float)place[1]));
        var (z1, z2, z3, z) = (Vector256.Create((float)v1[2]), Vector256.Create((float)v2[2]), Vector256.Create((float)v3[2]), Vector256.Create((float)place[2]));
        ref var meshX = ref MemoryMarshal.GetArrayDataReference(_mesh.X);
        ref var meshY = ref MemoryMarshal.GetArrayDataReference(_mesh.Y);
        ref var meshZ = ref MemoryMarshal.GetArrayDataReference(_mesh.Z);
        ref var screenX = ref MemoryMarshal.GetArrayDataReference(_screenX);
        ref var screenY = ref MemoryMarshal.GetArrayDataReference(_screenY);
        ref var nearness = ref MemoryMarshal.GetArrayDataReference(_nearness);
        var (scaleX, scaleY) = (Vector256.Create((float)(SubPixel * _scaleX)), Vector256.Create((float)(-SubPixel * _scaleY)));
        var (middleX, middleY) = (Vector256.Create((float)(SubPixel * _middleX)), Vector256.Create((float)(SubPixel * _middleY)));
        var perSubPixel = Vector256.Create(1 / SubPixel);
        for (var i = 0; i < _mesh.Padded; i += Vector256<float>.Count)
        {
            var (cornerX, cornerY, cornerZ) = (
                Vector256.LoadUnsafe(ref meshX, (nuint)i), Vector256.LoadUnsafe(ref meshY, (nuint)i), Vector256.LoadUnsafe(ref meshZ, (nuint)i));
            var viewX = x + (x1 * cornerX) + (x2 * cornerY) + (x3 * cornerZ);
            var viewY = y + (y1 * cornerX) + (y2 * cornerY) + (y3 * cornerZ);
            var viewZ = z + (z1 * cornerX) + (z2 * cornerY) + (z3 * cornerZ);
            var near = _view.IsPerspective ? Vector256<float>.One / viewZ : -viewZ;
            if (_view.IsPerspective)
            {
                (viewX, viewY) = (viewX * near, viewY * near);
            }

            // As rasterizers do, on a grid of 1/256 pixel.
            (Vector256.Round(middleX + (scaleX * viewX)) * perSubPixel).StoreUnsafe(ref screenX, (nuint)i);
            (Vector256.Round(middleY + (scaleY * viewY)) * perSubPixel).StoreUnsafe(ref screenY, (nuint)i);
            near.StoreUnsafe(ref nearness, (nuint)i);
        }

        return DrawFaces(Math.Sign(_object.SolidSign) * (IsMirrored(v1, v2, v3) ? -1 : 1));
    }

    private bool DrawFaces(int side)
    {
        var covers = false;
        var faces = _mesh.Faces;
        ref var screenX = ref MemoryMarshal.GetArrayDataReference(_screenX);
        ref var screenY = ref MemoryMarshal.GetArrayDataReference(_screenY);
        for (var i = 0; i + 2 < faces.Length; i += 3)
        {
            var (a, b, c) = (faces[i], faces[i + 1], faces[i + 2]);
            var (ax, ay) = (Unsafe.Add(ref screenX, a), Unsafe.Add(ref screenY, a));
            var (bx, by) = (Unsafe.Add(ref screenX, b), Unsafe.Add(ref screenY, b));
            var (cx, cy) = (Unsafe.Add(ref screenX, c), Unsafe.Add(ref screenY, c));
            // Of a solid only the front is seen: on the screen, y downwards, it is wound clockwise.
            var area = ((bx - ax) * (cy - ay)) - ((by - ay) * (cx - ax));
            if (side == 0 || area * side > 0)
            {
                covers |= _coverage.Draw(ax, ay, _nearness[a], bx, by, _nearness[b], cx, cy, _nearness[c]);
            }
        }

        return covers;
    }

    private static bool IsMirrored(Vector256<double> v1, Vector256<double> v2, Vector256<double> v3) =>
        (v1[0] * ((v2[1] * v3[2]) - (v2[2] * v3[1]))) + (v1[1] * ((v2[2] * v3[0]) - (v2[0] * v3[2]))) + (v1[2] * ((v2[0] * v3[1]) - (v2[1] * v3[0]))) < 0;

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

    /// <summary>Where something appears in the picture.</summary>
    private readonly struct Footprint
    {
        public static Footprint Outside => new() { IsOutside = true };

        /// <summary>Too near for single precision.</summary>
        public bool IsUnsure { get; init; }

        /// <summary>Not in the strip.</summary>
        public bool IsOutside { get; init; }

        /// <summary>All of it is beyond the near plane.</summary>
        public bool IsWhole { get; init; }

        /// <summary>It holds the middle of no pixel.</summary>
        public bool IsBetweenPixels { get; init; }

        /// <summary>It may be seen in other strips as well.</summary>
        public bool IsShared { get; init; }

        /// <summary>Pixels.</summary>
        public double Size { get; init; }

        /// <summary>The largest.</summary>
        public float Nearness { get; init; }

        public int Left { get; init; }

        public int Right { get; init; }

        public int Top { get; init; }

        public int Bottom { get; init; }
    }
}
