using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision;

namespace FractalEngine.Core.Detail;

/// <content>Where sub-fractals appear in the picture.</content>
internal sealed partial class StripSearch
{
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
