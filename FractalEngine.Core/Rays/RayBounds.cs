using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>The bounds of a sub-fractal and of its children, for rays: in single precision, eight at a time.</summary>
/// <remarks>Coordinates are relative to the centre of the sub-fractal's box, in units of half its largest side.</remarks>
internal sealed class RayBounds
{
    /// <summary>Number of bounds in a vector.</summary>
    public const int LaneCount = 8;

    // Three coordinates of the centre, then of half the size.
    private const int BoxRows = 6;

    // The normal, then the offset.
    private const int PlaneRows = 4;

    // As a part of the largest side.
    private const double MinThickness = 1e-9;

    // Of a child, in the last bits of a key.
    private const int IndexMask = 63;

    private readonly float[] _boxes;
    private readonly float[] _planes;
    private readonly double[] _inverseNorms;
    private readonly SimdAffineMap _proxyMap;
    private readonly SimdAffineMap _inverseProxyMap;

    /// <summary>Prepares the bounds of a sub-fractal.</summary>
    /// <param name="subFractal">The sub-fractal.</param>
    /// <param name="baseBox">The box of the base mesh.</param>
    public RayBounds(SubFractal subFractal, BoundingBox baseBox)
    {
        SubFractal = subFractal;
        Box = new(subFractal.Box);
        KeyCount = (subFractal.Children.Length + LaneCount - 1) / LaneCount * LaneCount;
        _boxes = CreateBoxes(subFractal, Box.Centre, Box.InverseSize);
        _planes = subFractal.Hull is { } hull ? CreatePlanes(hull, subFractal.Box.Centre, Box.InverseSize) : [];
        // A flat box stays a little thick, so that the map has an inverse.
        var box = subFractal.Box;
        var thickness = MinThickness * Math.Max(box.Size.MaxAbsComponent(), baseBox.Size.MaxAbsComponent()) * Vector.One;
        var proxyMap = BoundingBox.MapBoxToBox(baseBox, new(box.Minimum - thickness, box.Maximum + thickness));
        _proxyMap = new(proxyMap);
        _inverseProxyMap = new(proxyMap.Inverse());
        _inverseNorms = [.. subFractal.Children.Select(
            child => BoundingSphere.OperatorNormBound(child.InverseSimdMap.ToAffineMap().Linear))];
    }

    /// <summary>Number of keys of the children, those of missing children included.</summary>
    public int KeyCount { get; }

    /// <summary>Stretches the base mesh to the box of the sub-fractal, so that it can stand for it.</summary>
    public ref readonly SimdAffineMap ProxyMap => ref _proxyMap;

    /// <summary>The inverse of that.</summary>
    public ref readonly SimdAffineMap InverseProxyMap => ref _inverseProxyMap;

    /// <summary>True where planes bound the sub-fractal better than its box.</summary>
    public bool HasPlanes => _planes.Length > 0;

    /// <summary>Number of bytes of the arrays.</summary>
    public long StorageBytes => (4L * (_boxes.Length + _planes.Length)) + (8L * _inverseNorms.Length) + 160;

    /// <summary>Upper bound of the factor by which the inverse map of a child lengthens vectors.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double InverseNorm(int child) => _inverseNorms[child];

    /// <summary>The sub-fractal.</summary>
    public SubFractal SubFractal { get; }

    /// <summary>The box of the sub-fractal.</summary>
    public RayBox Box { get; }

    /// <summary>Converts a ray of the sub-fractal's frame for the tests below.</summary>
    /// <param name="ray">The ray.</param>
    /// <param name="speed">About the length of its direction.</param>
    /// <param name="inverseSpeed">The inverse of that.</param>
    /// <param name="search">The limit of the search, and its rounding.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public FloatRay ToFloats(in LocalRay ray, double speed, double inverseSpeed, in RaySearch search) =>
        new(in ray, speed, inverseSpeed, Box.Centre, Box.InverseSize, in search);

    /// <summary>Tells whether a ray may hit the solid that the planes bound.</summary>
    public bool MayHitPlanes(in FloatRay ray)
    {
        var (ox, oy, oz) = (Vector256.Create(ray.Origin[0]), Vector256.Create(ray.Origin[1]), Vector256.Create(ray.Origin[2]));
        var (dx, dy, dz) = (Vector256.Create(ray.Direction[0]), Vector256.Create(ray.Direction[1]), Vector256.Create(ray.Direction[2]));
        var widening = Vector256.Create(2 * ray.Widening);
        var near = Vector256<float>.Zero;
        var far = Vector256.Create(ray.Limit);
        var minSlope = Vector256.Create(1e-7f);
        ref var row = ref MemoryMarshal.GetArrayDataReference(_planes);
        for (var i = 0; i < _planes.Length; i += PlaneRows * LaneCount)
        {
            var (nx, ny, nz) = (Row(ref row, 0), Row(ref row, 1), Row(ref row, 2));
            var height = Row(ref row, 3) + widening - ((nx * ox) + (ny * oy) + (nz * oz));
            var slope = (nx * dx) + (ny * dy) + (nz * dz);
            // Rays nearly in a plane pass it nowhere within the solid, as far as rounding tells.
            var isParallel = Vector256.LessThan(Vector256.Abs(slope), minSlope);
            if ((Vector256.LessThan(height, Vector256<float>.Zero) & isParallel).ExtractMostSignificantBits() != 0)
            {
                return false;
            }

            var crossing = height / slope;
            var isEntry = Vector256.LessThan(slope, Vector256<float>.Zero);
            near = Vector256.MaxNative(near, Vector256.ConditionalSelect(isEntry & ~isParallel, crossing, near));
            far = Vector256.MinNative(far, Vector256.ConditionalSelect(isEntry | isParallel, far, crossing));
            row = ref Unsafe.Add(ref row, PlaneRows * LaneCount);
        }

        return HorizontalMax(near) <= -HorizontalMax(-far);
    }

    /// <summary>Computes a key for each child: where the ray enters its box at the soonest, with the child's index in the last bits.</summary>
    /// <param name="ray">The ray.</param>
    /// <param name="keys">The first of <see cref="KeyCount"/> keys; infinite for children that the ray misses.</param>
    public void FillKeys(in FloatRay ray, ref float keys)
    {
        var (ox, oy, oz) = (Vector256.Create(ray.Origin[0]), Vector256.Create(ray.Origin[1]), Vector256.Create(ray.Origin[2]));
        var (ix, iy, iz) = (
            Vector256.Create(ray.InverseDirection[0]), Vector256.Create(ray.InverseDirection[1]), Vector256.Create(ray.InverseDirection[2]));
        var (ax, ay, az) = (Vector256.Abs(ix), Vector256.Abs(iy), Vector256.Abs(iz));
        var widening = Vector256.Create(ray.Widening);
        var limit = Vector256.Create(ray.Limit);
        var indices = Vector256.Create(0, 1, 2, 3, 4, 5, 6, 7);
        ref var row = ref MemoryMarshal.GetArrayDataReference(_boxes);
        for (nuint first = 0; first < (nuint)KeyCount; first += LaneCount)
        {
            var (x, y, z) = ((Row(ref row, 0) - ox) * ix, (Row(ref row, 1) - oy) * iy, (Row(ref row, 2) - oz) * iz);
            var halfX = (Row(ref row, 3) + widening) * ax;
            var halfY = (Row(ref row, 4) + widening) * ay;
            var halfZ = (Row(ref row, 5) + widening) * az;
            var near = Vector256.MaxNative(
                Vector256.MaxNative(x - halfX, y - halfY), Vector256.MaxNative(z - halfZ, Vector256<float>.Zero));
            var far = Vector256.MinNative(Vector256.MinNative(x + halfX, y + halfY), Vector256.MinNative(z + halfZ, limit));
            var values = ((near.AsInt32() & Vector256.Create(~IndexMask)) | indices).AsSingle();
            values = Vector256.ConditionalSelect(
                Vector256.LessThanOrEqual(near, far), values, Vector256.Create(float.PositiveInfinity));
            values.StoreUnsafe(ref keys, first);
            indices += Vector256.Create(LaneCount);
            row = ref Unsafe.Add(ref row, BoxRows * LaneCount);
        }
    }

    /// <summary>Takes the child that the ray enters first.</summary>
    /// <param name="keys">The first key; that of the child becomes infinite.</param>
    /// <param name="count">Number of keys.</param>
    /// <param name="limit">Keys beyond it are not taken.</param>
    /// <param name="child">Index of the child; undefined where there is none.</param>
    /// <param name="entry">Where the ray enters its box at the soonest.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static bool TryTake(ref float keys, int count, float limit, out int child, out float entry)
    {
        var smallest = Vector256.LoadUnsafe(ref keys);
        for (nuint first = LaneCount; first < (nuint)count; first += LaneCount)
        {
            smallest = Vector256.MinNative(smallest, Vector256.LoadUnsafe(ref keys, first));
        }

        var half = Vector128.MinNative(smallest.GetLower(), smallest.GetUpper());
        half = Vector128.MinNative(half, Vector128.Shuffle(half, Vector128.Create(2, 3, 0, 1)));
        half = Vector128.MinNative(half, Vector128.Shuffle(half, Vector128.Create(1, 0, 3, 2)));
        var value = half[0];
        var bits = BitConverter.SingleToInt32Bits(value);
        child = bits & IndexMask;
        entry = BitConverter.Int32BitsToSingle(bits & ~IndexMask);
        if (!(value <= limit) || float.IsPositiveInfinity(value))
        {
            return false;
        }

        Unsafe.Add(ref keys, child) = float.PositiveInfinity;
        return true;
    }

    private static float[] CreateBoxes(SubFractal subFractal, Vector256<double> centre, double inverseSize)
    {
        var count = subFractal.Children.Length;
        var groups = (count + LaneCount - 1) / LaneCount;
        var rows = new float[groups * BoxRows * LaneCount];
        for (var i = 0; i < groups * LaneCount; i++)
        {
            for (var row = 0; row < BoxRows; row++)
            {
                // Nothing enters a box of negative size.
                var value = i >= count || subFractal.IsChildEmpty(i) ? (row < 3 ? 0 : double.NegativeInfinity)
                    : subFractal.ChildBounds[(row * subFractal.PaddedCount) + i] - (row < 3 ? centre[row] : 0);
                rows[(((i / LaneCount * BoxRows) + row) * LaneCount) + (i % LaneCount)] = (float)(value * inverseSize);
            }
        }

        return rows;
    }

    private static float[] CreatePlanes(HullBound hull, Vector centre, double inverseSize)
    {
        var planes = hull.Planes;
        var groups = (planes.Count + LaneCount - 1) / LaneCount;
        var rows = new float[groups * PlaneRows * LaneCount];
        for (var i = 0; i < groups * LaneCount; i++)
        {
            // The last plane fills the lanes that are left over.
            var (normal, offset, _) = planes[Math.Min(i, planes.Count - 1)];
            ReadOnlySpan<double> values = [normal.X, normal.Y, normal.Z, (offset - Vector.Dot(normal, centre)) * inverseSize];
            for (var row = 0; row < PlaneRows; row++)
            {
                rows[(((i / LaneCount * PlaneRows) + row) * LaneCount) + (i % LaneCount)] = (float)values[row];
            }
        }

        return rows;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<float> Row(ref float rows, int row) => Vector256.LoadUnsafe(ref rows, (nuint)(row * LaneCount));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static float HorizontalMax(Vector256<float> v)
    {
        var half = Vector128.MaxNative(v.GetLower(), v.GetUpper());
        half = Vector128.MaxNative(half, Vector128.Shuffle(half, Vector128.Create(2, 3, 0, 1)));
        return Math.Max(half[0], half[1]);
    }
}
