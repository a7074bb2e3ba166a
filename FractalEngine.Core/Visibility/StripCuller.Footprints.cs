using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Fractals;

namespace FractalEngine.Core.Visibility;

/// <content>Where sub-fractals appear in the picture.</content>
internal sealed partial class StripCuller
{
    /// <summary>Finds where the copies of a sub-fractal appear, eight at a time, in single precision.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private void ProjectChildren(LodNode node, in SimdAffineMap map, int first)
    {
        var centre = map.Apply(node.Centre);
        var (v1, v2, v3) = (map.V1, map.V2, map.V3);
        var (x1, x2, x3, x0) = (Vector256.Create((float)v1[0]), Vector256.Create((float)v2[0]), Vector256.Create((float)v3[0]),
            Vector256.Create((float)centre[0]));
        var (y1, y2, y3, y0) = (Vector256.Create((float)v1[1]), Vector256.Create((float)v2[1]), Vector256.Create((float)v3[1]),
            Vector256.Create((float)centre[1]));
        var (z1, z2, z3, z0) = (Vector256.Create((float)v1[2]), Vector256.Create((float)v2[2]), Vector256.Create((float)v3[2]),
            Vector256.Create((float)centre[2]));
        var (scaleX, scaleY) = (Vector256.Create((float)_scaleX), Vector256.Create((float)_scaleY));
        var (centreX, centreY) = (Vector256.Create((float)_centreX), Vector256.Create((float)_centreY));
        // What is nearer, compared with where its parent is, is looked at in double precision.
        var distance = Math.Sqrt(Vector256.Dot(centre, centre));
        var minDepthForSingle = Vector256.Create((float)Math.Max(_view.Near, 1e-3 * distance));
        // Squares of large and small coordinates leave the range of single precision.
        var inverseDistance = Vector256.Create(distance > 0 ? (float)(1 / distance) : 1);
        ref var boxes = ref MemoryMarshal.GetArrayDataReference(node.ChildBoxes);
        ref var footprints = ref MemoryMarshal.GetArrayDataReference(_footprints);
        ref var sortKeys = ref MemoryMarshal.GetArrayDataReference(_sortKeys);
        for (var i = 0; i < node.ChildBoxes.Length / LodNode.BoxRows; i += LodNode.Lanes)
        {
            var boxOffset = (nuint)(i * LodNode.BoxRows);
            var (cx, cy, cz) = (Vector256.LoadUnsafe(ref boxes, boxOffset), Vector256.LoadUnsafe(ref boxes, boxOffset + 8),
                Vector256.LoadUnsafe(ref boxes, boxOffset + 16));
            var (hx, hy, hz) = (Vector256.LoadUnsafe(ref boxes, boxOffset + 24), Vector256.LoadUnsafe(ref boxes, boxOffset + 32),
                Vector256.LoadUnsafe(ref boxes, boxOffset + 40));
            var x = x0 + (x1 * cx) + (x2 * cy) + (x3 * cz);
            var y = y0 + (y1 * cx) + (y2 * cy) + (y3 * cz);
            var z = z0 + (z1 * cx) + (z2 * cy) + (z3 * cz);
            var halfX = (Vector256.Abs(x1) * hx) + (Vector256.Abs(x2) * hy) + (Vector256.Abs(x3) * hz);
            var halfY = (Vector256.Abs(y1) * hx) + (Vector256.Abs(y2) * hy) + (Vector256.Abs(y3) * hz);
            var halfZ = (Vector256.Abs(z1) * hx) + (Vector256.Abs(z2) * hy) + (Vector256.Abs(z3) * hz);
            var (zLow, zHigh) = (z - halfZ, z + halfZ);
            var (maxInverseDepth, minInverseDepth, footprintInverseDepth) = (Vector256<float>.One, Vector256<float>.One, -zLow);
            var sortKey = z;
            if (_view.IsPerspective)
            {
                (maxInverseDepth, minInverseDepth) = (Vector256<float>.One / zLow, Vector256<float>.One / zHigh);
                var (keyX, keyY, keyZ) = (x * inverseDistance, y * inverseDistance, z * inverseDistance);
                (footprintInverseDepth, sortKey) = (maxInverseDepth, (keyX * keyX) + (keyY * keyY) + (keyZ * keyZ));
            }

            var (left, right, top, bottom) = (x - halfX, x + halfX, y + halfY, y - halfY);
            left = centreX
                + (scaleX * left * Vector256.ConditionalSelect(Vector256.LessThan(left, Vector256<float>.Zero), maxInverseDepth,
                minInverseDepth));
            right = centreX
                + (scaleX * right * Vector256.ConditionalSelect(Vector256.GreaterThan(right, Vector256<float>.Zero), maxInverseDepth,
                minInverseDepth));
            top = centreY
                - (scaleY * top * Vector256.ConditionalSelect(Vector256.GreaterThan(top, Vector256<float>.Zero), maxInverseDepth,
                minInverseDepth));
            bottom = centreY
                - (scaleY * bottom * Vector256.ConditionalSelect(Vector256.LessThan(bottom, Vector256<float>.Zero), maxInverseDepth,
                minInverseDepth));
            var footprintOffset = (nuint)((first + i) * FootprintRows);
            left.StoreUnsafe(ref footprints, footprintOffset);
            right.StoreUnsafe(ref footprints, footprintOffset + 8);
            top.StoreUnsafe(ref footprints, footprintOffset + 16);
            bottom.StoreUnsafe(ref footprints, footprintOffset + 24);
            footprintInverseDepth.StoreUnsafe(ref footprints, footprintOffset + 32);
            // Not a number for what is too near, and so must be looked at once more.
            Vector256.ConditionalSelect(Vector256.LessThan(zLow, minDepthForSingle), Vector256.Create(float.NaN), zLow)
                .StoreUnsafe(ref footprints, footprintOffset + 40);
            sortKey.StoreUnsafe(ref sortKeys, (nuint)(first + i));
        }
    }

    /// <summary>Where a copy appears, as <see cref="ProjectChildren"/> has found it.</summary>
    private Footprint ComputeFootprint(int first, int child)
    {
        ref var footprint = ref _footprints[((first + (child / LodNode.Lanes * LodNode.Lanes)) * FootprintRows) + (child % LodNode.Lanes)];
        var depth = Unsafe.Add(ref footprint, 40);
        return float.IsNaN(depth) ? new() { NeedsDouble = true }
            : _settings.FrustumCulling && depth > _view.Far ? Footprint.Outside
            : ComputeFootprint(footprint, Unsafe.Add(ref footprint, 8), Unsafe.Add(ref footprint, 16), Unsafe.Add(ref footprint, 24),
            Unsafe.Add(ref footprint, 32));
    }

    /// <summary>Where a box in view space appears.</summary>
    private Footprint ComputeFootprint(Vector256<double> centre, Vector256<double> halfSize)
    {
        var (low, high) = (centre - halfSize, centre + halfSize);
        var (zLow, zHigh) = (low[2], high[2]);
        if (_settings.FrustumCulling && (zHigh < _view.Near || zLow > _view.Far))
        {
            return Footprint.Outside;
        }

        if (zLow < _view.Near)
        {
            // Projected from as near as anything of it can be; what lies behind the camera, from as far as it is.
            var maxExtent = 2 * Math.Max(halfSize[0] * _scaleX, halfSize[1] * _scaleY);
            var depth = Math.Max(_view.Near, -zHigh);
            return new() { IsOutside = _settings.FrustumCulling && IsOutsideFrustum(centre, halfSize), ProjectedSize = _view.IsPerspective
                ? maxExtent / depth
                : maxExtent, Right = -1 };
        }

        var (maxInverseDepth, minInverseDepth) = _view.IsPerspective ? (1 / zLow, 1 / zHigh) : (1.0, 1.0);
        var left = _centreX + (_scaleX * low[0] * (low[0] < 0 ? maxInverseDepth : minInverseDepth));
        var right = _centreX + (_scaleX * high[0] * (high[0] > 0 ? maxInverseDepth : minInverseDepth));
        var top = _centreY - (_scaleY * high[1] * (high[1] > 0 ? maxInverseDepth : minInverseDepth));
        var bottom = _centreY - (_scaleY * low[1] * (low[1] < 0 ? maxInverseDepth : minInverseDepth));
        return ComputeFootprint((float)left, (float)right, (float)top, (float)bottom,
            (float)(_view.IsPerspective ? maxInverseDepth : -zLow));
    }

    /// <summary>What a rectangle of the picture covers.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private Footprint ComputeFootprint(float left, float right, float top, float bottom, float inverseDepth)
    {
        if (_settings.FrustumCulling
            && !(right >= _occlusionBuffer.Left && left <= _occlusionBuffer.Right && bottom >= 0 && top <= _occlusionBuffer.Height))
        {
            return Footprint.Outside;
        }

        // Those whose samples may lie between the edges.
        var (firstX, lastX) = (MathF.Ceiling(left - _maxSampleOffset), MathF.Floor(right - _minSampleOffset));
        var (firstY, lastY) = (MathF.Ceiling(top - _maxSampleOffset), MathF.Floor(bottom - _minSampleOffset));
        return new()
        {
            IsBeyondNearPlane = true,
            ProjectedSize = Math.Max(right - left, bottom - top),
            MaxInverseDepth = inverseDepth,
            CoversNoSample = firstX > lastX || firstY > lastY,
            // What ends on the border is found on both sides.
            IsShared = !_settings.FrustumCulling || !(left > _occlusionBuffer.Left && right < _occlusionBuffer.Right),
            Left = (int)Math.Max(firstX, _occlusionBuffer.Left),
            Right = (int)Math.Min(lastX, _occlusionBuffer.Right - 1),
            Top = (int)Math.Max(firstY, 0),
            Bottom = (int)Math.Min(lastY, _occlusionBuffer.Height - 1),
        };
    }

    /// <summary>True for a box that lies beyond one of the planes through the eye and the edges of the strip.</summary>
    private bool IsOutsideFrustum(Vector256<double> centre, Vector256<double> halfSize)
    {
        var (inverseScaleX, inverseScaleY) = (1 / _scaleX, 1 / _scaleY);
        var (left, right) = ((_occlusionBuffer.Left - _centreX) * inverseScaleX, (_occlusionBuffer.Right - _centreX) * inverseScaleX);
        var (top, bottom) = (_centreY * inverseScaleY, -_centreY * inverseScaleY);
        return IsBoxBeyondPlane(-1, left, centre[0], halfSize[0], centre[2], halfSize[2])
            || IsBoxBeyondPlane(1, -right, centre[0], halfSize[0], centre[2], halfSize[2])
            || IsBoxBeyondPlane(1, -top, centre[1], halfSize[1], centre[2], halfSize[2])
            || IsBoxBeyondPlane(-1, bottom, centre[1], halfSize[1], centre[2], halfSize[2]);
    }

    /// <summary>True when sign · x + slope · z (or slope alone) is positive everywhere in the box.</summary>
    private bool IsBoxBeyondPlane(double sign, double slope, double x, double halfX, double z, double halfZ) => _view.IsPerspective
        ? (sign * x) + (slope * z) - halfX - (Math.Abs(slope) * halfZ) > 0
        : (sign * x) + slope - halfX > 0;

    /// <summary>Where something appears in the picture.</summary>
    private readonly struct Footprint
    {
        public static Footprint Outside => new() { IsOutside = true };

        /// <summary>Too near for single precision.</summary>
        public bool NeedsDouble { get; init; }

        /// <summary>Not in the strip.</summary>
        public bool IsOutside { get; init; }

        /// <summary>All of it is beyond the near plane.</summary>
        public bool IsBeyondNearPlane { get; init; }

        /// <summary>It holds the middle of no pixel.</summary>
        public bool CoversNoSample { get; init; }

        /// <summary>It may be seen in other strips as well.</summary>
        public bool IsShared { get; init; }

        /// <summary>Pixels.</summary>
        public double ProjectedSize { get; init; }

        /// <summary>The largest.</summary>
        public float MaxInverseDepth { get; init; }

        public int Left { get; init; }

        public int Right { get; init; }

        public int Top { get; init; }

        public int Bottom { get; init; }
    }
}
