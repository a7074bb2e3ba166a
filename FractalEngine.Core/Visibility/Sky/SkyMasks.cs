using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Sky;

/// <summary>
/// In which directions the sky is free past the siblings of each child of a node: for each cell of a grid over the child's box one mask for
/// each side that a surface there may face.
/// </summary>
/// <remarks>
/// A ray leaves a leaf freely exactly when it misses the siblings at every level. So the mask of a leaf is the product, bit by bit, of one
/// mask for each level above it.
/// </remarks>
/// <param name="masks">Masks by child, cell and side, in directions of the node's frame; null where siblings hide nothing.</param>
/// <param name="children">The other data of each child.</param>
/// <param name="isSpread">Whether cells along a surface are spread, see <see cref="GridSize"/>; otherwise all are thirds.</param>
internal sealed class SkyMasks(ulong[][]? masks, SkyMasks.Child[] children, bool isSpread = true)
{
    /// <summary>
    /// Cells of a grid along each axis. Along a surface, their middles are evenly spread from one end of the box to the other, so that
    /// neighbours agree at their common end. Across it, and along it where that tells more, there are thin ones at both ends, for surfaces
    /// in a side of the box, and thirds.
    /// </summary>
    public const int GridSize = 5;

    /// <summary>Number of cells of a whole grid.</summary>
    public const int CellCount = GridSize * GridSize * GridSize;

    /// <summary>Number of masks of a child.</summary>
    public const int MaskCount = CellCount * AmbientCube.Count;

    // Thickness of the outermost cells, by the size of the box.
    private const double ThinCell = 0.01;

    private static readonly Vector256<double> Half = Vector256.Create(0.5);
    private static readonly Vector256<double> LastCell = Vector256.Create(GridSize - 1.0);
    private static readonly Vector256<double> LastThird = Vector256.Create(GridSize - 3.0);
    private static readonly Vector256<double> FirstThinEnd = Vector256.Create(ThinCell);
    private static readonly Vector256<double> LastThinStart = Vector256.Create(1 - ThinCell);

    // For each axis, all bits of its lane.
    private static readonly Vector256<double>[] AcrossAxis =
        [.. Enumerable.Range(0, 3).Select(static axis => Vector256<long>.Zero.WithElement(axis, -1).AsDouble())];

    private readonly ulong[][]? _masks = masks;

    /// <summary>Whether siblings hide anything.</summary>
    public bool HideAnything => _masks is not null;

    /// <summary>Size of the tables in bytes.</summary>
    public int ByteCount =>
        (_masks?.Sum(static masks => sizeof(ulong) * masks.Length) ?? 0) + children.Sum(static child => child.Rotation?.ByteCount ?? 0);

    /// <summary>Returns what is left when siblings are taken to hide nothing: how frames are turned.</summary>
    public SkyMasks WithoutMasks() => new(null, children);

    /// <summary>Maps what sides see from a child's frame to the node's; their points stay in the child's.</summary>
    /// <param name="child">Index of the child that the sides are part of.</param>
    /// <param name="dither">Where the middle between cells is taken to be: from −½ to ½ cells along each axis.</param>
    /// <param name="visibilities">What they see.</param>
    public void Apply(int child, Vector256<double> dither, Span<SideVisibility> visibilities)
    {
        ref readonly var data = ref children[child];
        var masks = _masks?[child];
        var rotation = data.Rotation;
        foreach (ref var visibility in visibilities)
        {
            if (rotation is not null && visibility.Mask != ulong.MaxValue)
            {
                visibility.Mask = rotation.Apply(visibility.Mask);
            }

            if (masks is not null)
            {
                var side = visibility.IsTurned ? AmbientCube.Of(visibility.Normal) : visibility.Side;
                visibility.Mask &= masks[PlaceOf(in data, visibility.Point, side, isSpread ? dither : null)];
            }

        }

        if (data.NormalMap is { } normalMap)
        {
            foreach (ref var visibility in visibilities)
            {
                visibility.Normal = normalMap.ApplyLinear(visibility.Normal);
                visibility.IsTurned = true;
            }
        }
    }

    /// <summary>Finds the mask of the cell that is closest to a point of a surface.</summary>
    /// <param name="child">The child.</param>
    /// <param name="point">In the child's frame: x, y, z, 0.</param>
    /// <param name="side">Index of the side that the surface faces.</param>
    /// <param name="dither">As for <see cref="Apply"/>; null where all cells are thirds.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static int PlaceOf(in Child child, Vector256<double> point, int side, Vector256<double>? dither)
    {
        var place = (point - child.Origin) * child.Scale;
        // Thirds are the cells 1 to 3; thin cells lie before and after them.
        var third = Vector256.Floor(Vector256.Min(Vector256.Max(place * (GridSize - 2), Vector256<double>.Zero), LastThird));
        var isInside = Vector256.GreaterThanOrEqual(place, FirstThinEnd) & Vector256<double>.One;
        var isAfter = Vector256.GreaterThan(place, LastThinStart) & Vector256<double>.One;
        var cell = third + isInside + isAfter;
        if (dither is { } offset)
        {
            var along = Vector256.Floor(Vector256.Min(Vector256.Max((place * LastCell) + Half + offset, Vector256<double>.Zero), LastCell));
            cell = Vector256.ConditionalSelect(AcrossAxis[side < 3 ? side : side - 3], cell, along);
        }

        return ((int)cell[0] + (GridSize * ((int)cell[1] + (GridSize * (int)cell[2])))) * AmbientCube.Count + side;
    }

    /// <summary>Computes the squared distance of two cells, in cells.</summary>
    public static int SquaredDistance(int cell1, int cell2)
    {
        var x = (cell1 % GridSize) - (cell2 % GridSize);
        var y = (cell1 / GridSize % GridSize) - (cell2 / GridSize % GridSize);
        var z = (cell1 / (GridSize * GridSize)) - (cell2 / (GridSize * GridSize));
        return (x * x) + (y * y) + (z * z);
    }

    /// <summary>How a child lies in its node.</summary>
    internal readonly struct Child
    {
        /// <summary>Divides a child's box evenly, and notes how its frame is turned.</summary>
        /// <param name="box">Box in the child's frame.</param>
        /// <param name="linear">Linear part of the map to the node's frame.</param>
        /// <param name="rotation">
        /// From directions of the node's frame to those of the frame in which masks are known next below; null where they are parallel.
        /// </param>
        public Child(BoundingBox box, Matrix linear, SkyMaskRotation? rotation)
        {
            var (x, y, z) = box.Size;
            Origin = SimdAffineMap.ToVector256(box.Minimum);
            Scale = Vector256.Create(x > 0 ? 1 / x : 0, y > 0 ? 1 / y : 0, z > 0 ? 1 / z : 0, 0);
            Rotation = rotation;
            // The inverse transpose keeps normals upright. Their length does not matter, but must not overflow.
            var cofactors = linear.Inverse().Transpose();
            NormalMap = SkyDirections.AreParallel(linear)
                ? null
                : new SimdAffineMap(new(cofactors / cofactors.MaxAbsEntry(), Vector.Zero));
        }

        /// <summary>Corner of the first cell: x, y, z, 0.</summary>
        public Vector256<double> Origin { get; }

        /// <summary>One by the size of the box: x, y, z, 0.</summary>
        public Vector256<double> Scale { get; }

        /// <summary>Directions of the frame below; null where it is parallel.</summary>
        public SkyMaskRotation? Rotation { get; }

        /// <summary>Map of normals to the node's frame; null where the frames are parallel.</summary>
        public SimdAffineMap? NormalMap { get; }
    }
}
