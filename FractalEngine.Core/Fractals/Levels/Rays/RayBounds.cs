using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Rays;

/// <summary>The bounds of a sub-fractal and of its children, for rays: in single precision, eight at a time.</summary>
/// <remarks>
/// Coordinates are relative to the centre of the sub-fractal's box, in units of half its largest side. The boxes of the children are kept
/// once for each octant of directions, in about the order in which rays of such a direction enter them.
/// <para>
/// No hit is lost by rounding: a ray starts within 4 units of the centre, so that positions are off by less than 2e-6 units along any axis
/// when it crosses a side: 2.4e-7 each by the origin, its product and its sum, 6e-7 by the direction and its inverse, 3e-7 by the result.
/// <see cref="FloatRay.Margin"/> is twice that. Planes add three such products, and are widened by twice the margin.
/// </para>
/// </remarks>
internal sealed class RayBounds
{
    /// <summary>Number of bounds in a vector.</summary>
    public const int LaneCount = 8;

    /// <summary>Most children: a bit of a word for each.</summary>
    public const int MaxChildren = 64;

    private const int OctantCount = 8;

    // Three coordinates of the sides where rays enter a box, then of those where they leave it.
    private const int BoxRows = 6;

    // The normal, then the offset.
    private const int PlaneRows = 4;

    // Slopes of rays nearly in a plane are rounding.
    private const float MinSlope = 1e-7f;

    // As a part of the largest side.
    private const double MinThickness = 1e-9;

    private readonly float[] _rows;
    private readonly ushort _rowCount;
    private readonly ushort _baseIndex;
    private readonly byte[] _order;
    private readonly RayChild[] _children;
    private readonly RayNormals _normals;
    private readonly float[] _planes;

    /// <summary>Prepares the bounds of a sub-fractal.</summary>
    /// <param name="subFractal">The sub-fractal.</param>
    /// <param name="baseBox">The box of the base mesh.</param>
    /// <param name="descendants">The children, or descendants of them; none for the base.</param>
    /// <param name="children">They for rays.</param>
    /// <param name="normals">Directions of planes that bound them.</param>
    /// <param name="single">The bounds with the children themselves; null where these are they.</param>
    /// <param name="minInnerRadius">Radius of the smallest sub-fractal between this one and the children; infinite for none.</param>
    public RayBounds(
        SubFractal subFractal, BoundingBox baseBox, RayDescendant[] descendants, RayChild[] children, RayNormals normals, RayBounds? single,
        double minInnerRadius)
    {
        (SubFractal, IsEmpty) = (subFractal, subFractal.Box.IsEmpty);
        Box = new(subFractal.Box);
        Radius = subFractal.Radius * Box.InverseHalfExtent;
        MinInnerRadius = minInnerRadius;
        Single = single ?? this;
        _children = children;
        _normals = normals;
        _rowCount = (ushort)(BoxRows + normals.Count);
        _baseIndex = (ushort)subFractal.BaseIndex;
        LanesPerOctant = (children.Length + LaneCount - 1) / LaneCount * LaneCount;
        (_rows, _order) = CreateRows(descendants);
        _planes = subFractal.Hull is { } hull ? CreatePlanes(hull, subFractal.Box.Centre, Box.InverseHalfExtent) : [];
        // A flat box stays a little thick, so that the map has an inverse.
        var ownBox = subFractal.Box;
        var thickness = MinThickness * Math.Max(ownBox.Size.MaxAbsComponent(), baseBox.Size.MaxAbsComponent());
        Proxy = new(ProxyMapTo(ownBox, ownBox.Size + (thickness * Vector.One), baseBox));
    }

    /// <summary>The sub-fractal, or the group of children.</summary>
    public SubFractal SubFractal { get; }

    /// <summary>True where there are no faces.</summary>
    public bool IsEmpty { get; }

    /// <summary>The bounds with the children themselves; these where no descendants take their places.</summary>
    public RayBounds Single { get; }

    /// <summary>Number of lanes of an octant, those of missing children included.</summary>
    public int LanesPerOctant { get; }

    /// <summary>True where a base mesh stands, which a ray tests instead of children.</summary>
    public bool IsBase => LanesPerOctant == 0;

    /// <summary>Half the diagonal of a box around the sub-fractal and the base mesh.</summary>
    public double Radius { get; }

    /// <summary>Radius of the smallest sub-fractal between this one and its children; infinite where there is none.</summary>
    public double MinInnerRadius { get; }

    /// <summary>The base mesh, stretched to the box of the sub-fractal, so that it can stand for it.</summary>
    public RayProxy Proxy { get; }

    /// <summary>Index of the base mesh that the sub-fractal is, or that can stand for it, see <see cref="SubFractal.BaseIndex"/>.</summary>
    public int BaseIndex => _baseIndex;

    /// <summary>True where planes bound the sub-fractal better than its box.</summary>
    public bool HasPlanes => _planes.Length > 0;

    /// <summary>Number of bytes of the arrays.</summary>
    public long StorageBytes => (4L * (_rows.Length + _planes.Length)) + _order.Length
        + (_children.Length * (long)Unsafe.SizeOf<RayChild>()) + 400 + (Single == this ? 0 : Single.StorageBytes)
        + _children.Sum(child => child.Group?.StorageBytes ?? 0);

    /// <summary>The box of the sub-fractal.</summary>
    public RayBox Box { get; }

    /// <summary>The child in a lane.</summary>
    /// <param name="octant">Octant of the ray's direction.</param>
    /// <param name="lane">Number of the lane.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public ref readonly RayChild Child(int octant, int lane) => ref Unsafe.Add(
        ref MemoryMarshal.GetArrayDataReference(_children),
        (nint)Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_order), (nint)(uint)((octant * LanesPerOctant) + lane)));

    /// <summary>Tells whether a ray may hit the solid that the planes bound.</summary>
    /// <param name="ray">The ray in these units.</param>
    /// <param name="widening">What bounds are widened by on all sides.</param>
    /// <param name="limit">Largest parameter.</param>
    public bool MayHitPlanes(in RayFrame ray, float widening, float limit)
    {
        var origin = ray.FloatOrigin;
        var direction = ray.FloatDirection;
        var (ox, oy, oz) = (Vector256.Create(origin[0]), Vector256.Create(origin[1]), Vector256.Create(origin[2]));
        var (dx, dy, dz) = (Vector256.Create(direction[0]), Vector256.Create(direction[1]), Vector256.Create(direction[2]));
        var margin = Vector256.Create(2 * widening);
        var near = Vector256<float>.Zero;
        var far = Vector256.Create(limit);
        var minSlope = Vector256.Create(MinSlope);
        ref var row = ref MemoryMarshal.GetArrayDataReference(_planes);
        for (var i = 0; i < _planes.Length; i += PlaneRows * LaneCount)
        {
            var (nx, ny, nz) = (Row(ref row, 0), Row(ref row, 1), Row(ref row, 2));
            var height = Row(ref row, 3) + margin - ((nx * ox) + (ny * oy) + (nz * oz));
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

    /// <summary>Finds the children whose bounds a ray may hit.</summary>
    /// <param name="ray">The ray in these units.</param>
    /// <param name="widening">What bounds are widened by on all sides.</param>
    /// <param name="limit">Largest parameter.</param>
    /// <param name="entries">The first of <see cref="LanesPerOctant"/> values: where the ray enters each box at the soonest.</param>
    /// <returns>A bit for each lane of the ray's octant.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public ulong FindHits(in RayFrame ray, float widening, float limit, ref float entries) => _normals.Count == 0
        ? FindHits(in ray, widening, limit, ref entries, 0)
        : FindHitsWithPlanes(in ray, widening, limit, ref entries);

    [MethodImpl(MethodImplOptions.NoInlining)]
    private ulong FindHitsWithPlanes(in RayFrame ray, float widening, float limit, ref float entries) =>
        FindHits(in ray, widening, limit, ref entries, _normals.Count);

    [SkipLocalsInit]
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private ulong FindHits(in RayFrame ray, float widening, float limit, ref float entries, int planeCount)
    {
        var origin = ray.FloatOrigin;
        var inverse = ray.InverseDirection;
        var margin = Vector128.Abs(inverse) * Vector128.Create(widening);
        var nearShift = Vector128.FusedMultiplyAdd(-origin, inverse, -margin);
        var farShift = Vector128.FusedMultiplyAdd(-origin, inverse, margin);
        var (ix, iy, iz) = (Vector256.Create(inverse[0]), Vector256.Create(inverse[1]), Vector256.Create(inverse[2]));
        var (nearX, nearY, nearZ) = (Vector256.Create(nearShift[0]), Vector256.Create(nearShift[1]), Vector256.Create(nearShift[2]));
        var (farX, farY, farZ) = (Vector256.Create(farShift[0]), Vector256.Create(farShift[1]), Vector256.Create(farShift[2]));
        Unsafe.SkipInit(out PlaneCrossings crossings);
        if (planeCount > 0)
        {
            crossings.Set(_normals, origin, ray.FloatDirection, widening);
        }

        var last = Vector256.Create(limit);
        ref var row = ref Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_rows), (nint)(uint)(ray.Octant * LanesPerOctant * _rowCount));
        var hits = 0ul;
        var lanes = LanesPerOctant;
        for (var first = 0; first < lanes; first += LaneCount)
        {
            var near = Vector256.MaxNative(
                Vector256.MaxNative(
                    Vector256.FusedMultiplyAdd(Row(ref row, 0), ix, nearX), Vector256.FusedMultiplyAdd(Row(ref row, 1), iy, nearY)),
                Vector256.MaxNative(Vector256.FusedMultiplyAdd(Row(ref row, 2), iz, nearZ), Vector256<float>.Zero));
            var far = Vector256.MinNative(
                Vector256.MinNative(
                    Vector256.FusedMultiplyAdd(Row(ref row, 3), ix, farX), Vector256.FusedMultiplyAdd(Row(ref row, 4), iy, farY)),
                Vector256.MinNative(Vector256.FusedMultiplyAdd(Row(ref row, 5), iz, farZ), last));
            near.StoreUnsafe(ref entries, (nuint)first);
            row = ref Unsafe.Add(ref row, BoxRows * LaneCount);
            for (var plane = 0; plane < planeCount; plane++)
            {
                crossings.Clip(plane, Row(ref row, 0), ref near, ref far);
                row = ref Unsafe.Add(ref row, LaneCount);
            }

            hits |= (ulong)Vector256.LessThanOrEqual(near, far).ExtractMostSignificantBits() << first;
        }

        return hits;
    }

    /// <summary>Lays the bounds of children out for each octant, a vector of lanes a row.</summary>
    private (float[] Rows, byte[] Order) CreateRows(RayDescendant[] descendants)
    {
        var boxes = descendants.Select(descendant => descendant.Box.Transform(Box.ToUnits)).ToArray();
        var rows = new float[OctantCount * LanesPerOctant * _rowCount];
        var order = new byte[OctantCount * LanesPerOctant];
        Span<double> values = stackalloc double[_rowCount];
        for (var octant = 0; octant < OctantCount; octant++)
        {
            var signs = new Vector((octant & 1) == 0 ? 1 : -1, (octant & 2) == 0 ? 1 : -1, (octant & 4) == 0 ? 1 : -1);
            int[] sorted = [.. Enumerable.Range(0, boxes.Length).OrderBy(i => Vector.Dot(boxes[i].Centre, signs))];
            for (var lane = 0; lane < LanesPerOctant; lane++)
            {
                values.Clear();
                // Nothing enters a box that ends before it begins.
                var near = double.PositiveInfinity * signs;
                var far = -near;
                if (lane < sorted.Length)
                {
                    var descendant = descendants[sorted[lane]];
                    order[(octant * LanesPerOctant) + lane] = (byte)sorted[lane];
                    var (centre, halfSize) = (boxes[sorted[lane]].Centre, 0.5 * boxes[sorted[lane]].Size);
                    near = centre - halfSize.Stretch(signs);
                    far = centre + halfSize.Stretch(signs);
                    for (var plane = 0; plane < _normals.Count; plane++)
                    {
                        var offset = descendant.Target.SupportBound(descendant.Map, _normals[plane])
                            - Vector.Dot(_normals[plane], SimdAffineMap.ToVector(Box.Centre));
                        values[BoxRows + plane] = offset * Box.InverseHalfExtent;
                    }
                }

                (values[0], values[1], values[2]) = near;
                (values[3], values[4], values[5]) = far;
                var group = (octant * LanesPerOctant) + (lane / LaneCount * LaneCount);
                for (var row = 0; row < _rowCount; row++)
                {
                    rows[(group * _rowCount) + (row * LaneCount) + (lane % LaneCount)] = (float)values[row];
                }
            }
        }

        return (rows, order);
    }

    /// <summary>Computes the scale and translation from the box of the base mesh to another of a given size.</summary>
    private static AffineMap ProxyMapTo(BoundingBox box, Vector size, BoundingBox baseBox)
    {
        var (x, y, z) = baseBox.Size;
        var scale = new Vector(x > 0 ? size.X / x : 1, y > 0 ? size.Y / y : 1, z > 0 ? size.Z / z : 1);
        return new(Matrix.Diagonal(scale), box.Centre - baseBox.Centre.Stretch(scale));
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
        return float.MaxNative(half[0], half[1]);
    }

    /// <summary>Where a ray crosses planes of common directions, as functions of their offsets.</summary>
    [InlineArray(4 * LaneCount)]
    private struct PlaneCrossings
    {
        private float _first;

        /// <summary>Prepares the directions for a ray.</summary>
        public void Set(RayNormals normals, Vector128<float> origin, Vector128<float> direction, float widening)
        {
            var slope = (normals.X * Vector256.Create(direction[0])) + (normals.Y * Vector256.Create(direction[1]))
                + (normals.Z * Vector256.Create(direction[2]));
            var originHeight = (normals.X * Vector256.Create(origin[0])) + (normals.Y * Vector256.Create(origin[1]))
                + (normals.Z * Vector256.Create(origin[2]));
            var inverse = Vector256<float>.One / slope;
            var shift = (Vector256.Create(2 * widening) - originHeight) * inverse;
            var isEntry = Vector256.LessThan(slope, Vector256.Create(-MinSlope));
            var isExit = Vector256.GreaterThan(slope, Vector256.Create(MinSlope));
            ref var first = ref _first;
            (isEntry & inverse).StoreUnsafe(ref first);
            Vector256.ConditionalSelect(isEntry, shift, Vector256.Create(float.NegativeInfinity)).StoreUnsafe(ref first, LaneCount);
            (isExit & inverse).StoreUnsafe(ref first, 2 * LaneCount);
            Vector256.ConditionalSelect(isExit, shift, Vector256.Create(float.PositiveInfinity)).StoreUnsafe(ref first, 3 * LaneCount);
        }

        /// <summary>Clips the parts of a ray within eight bounds at eight parallel planes.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly void Clip(int plane, Vector256<float> offsets, ref Vector256<float> near, ref Vector256<float> far)
        {
            ref var factors = ref Unsafe.Add(ref Unsafe.AsRef(in _first), plane);
            near = Vector256.MaxNative(near, Vector256.FusedMultiplyAdd(
                offsets, Vector256.Create(factors), Vector256.Create(Unsafe.Add(ref factors, LaneCount))));
            far = Vector256.MinNative(far, Vector256.FusedMultiplyAdd(
                offsets, Vector256.Create(Unsafe.Add(ref factors, 2 * LaneCount)),
                Vector256.Create(Unsafe.Add(ref factors, 3 * LaneCount))));
        }
    }
}
