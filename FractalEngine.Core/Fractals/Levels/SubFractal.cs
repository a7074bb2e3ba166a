using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>
/// A state of a fractal, which is a recursive with a certain number of remaining levels, in its own frame: its children or its base mesh,
/// and its bounds.
/// </summary>
/// <param name="set">The set of the level; null for the base.</param>
/// <param name="children">The children; none for the base.</param>
/// <param name="childBoxes">Boxes around the children.</param>
/// <param name="childHull">The hull of the sub-fractal that the first child is an instance of, in the frame of that one.</param>
/// <param name="box">A box around the sub-fractal.</param>
/// <param name="baseBox">
/// The box of the base mesh; for a group, one around its parent and that mesh, so that it never counts as a point.
/// </param>
/// <param name="hull">A hull around the sub-fractal; null where it bounds no better than the box.</param>
/// <param name="solid">A convex solid around the sub-fractal; null where it is empty, and for groups.</param>
/// <param name="clusters">Boxes that bound better than one; null where they don't.</param>
/// <param name="hasOnlySimilarities">True when all maps of the fractal are similarities: only then floats are searched.</param>
/// <param name="baseIndex">Index of the base mesh, see <see cref="BaseIndex"/>.</param>
internal sealed class SubFractal(
    MapSet? set, ChildInstance[] children, ReadOnlySpan<BoundingBox> childBoxes, HullBound? childHull, BoundingBox box, BoundingBox baseBox,
    HullBound? hull, ConvexSolid? solid, ClusterBounds? clusters, bool hasOnlySimilarities, int baseIndex)
{
    /// <summary>Maximum number of children without groups; searches keep one bit of a word for each.</summary>
    public const int MaxUngroupedChildren = 64;

    // A box for each child.
    private const int ValuesPerChild = 6;

    private static readonly Vector FarAwayPoint = 1e300 * Vector.One;

    private readonly Vector256<double> _halfSize = SimdAffineMap.ToVector256((0.5 + RoundingErrors.MappedPoint) * box.Size);

    // So small that it takes no place of its own: queries read most of the fields.
    private readonly ushort _baseIndex = checked((ushort)baseIndex);

    // That of a group is created at its first use, twice at worst and with the same result: wide sets have thousands.
    private ConvexSolid? _solid = solid;

    /// <summary>The set of this level; null for the base.</summary>
    public MapSet? Set { get; } = set;

    /// <summary>The children; none for the base.</summary>
    public ChildInstance[] Children { get; } = children;

    /// <summary>
    /// Index of the base mesh that the sub-fractal is where it has no children. Otherwise that of the mesh that replaces it where it is
    /// smaller than the precision of a search.
    /// </summary>
    public int BaseIndex => _baseIndex;

    /// <summary>Number of child boxes including padding, which is far from everything.</summary>
    public int PaddedCount { get; } = VectorX4.PaddedCount(children.Length);

    /// <summary>Boxes around the children, [6 × <see cref="PaddedCount"/>]: x, y, z of the centres, then of half the sizes.</summary>
    public double[] ChildBounds { get; } = CreateChildBounds(childBoxes, VectorX4.PaddedCount(children.Length));

    /// <summary>Bounds of all children together; null where they are not instances of one sub-fractal without rotation.</summary>
    public UnrotatedChildBounds? UnrotatedBounds { get; } = children.Length > 0
        ? UnrotatedChildBounds.CreateOrNull(childHull, children, VectorX4.PaddedCount(children.Length))
        : null;

    /// <summary>False where each child's box is that of its sub-fractal, moved and scaled.</summary>
    public bool HasRotatedChildren { get; } = !UnrotatedChildBounds.HasNoRotation(children);

    /// <summary>The children in single precision; null where that would not bound them well.</summary>
    public ChildBoundsX8? ChildBoundsX8 { get; } = hasOnlySimilarities && clusters is null
        ? ChildBoundsX8.CreateOrNull(children, childBoxes, childHull, BoundingBox.Union(box, baseBox))
        : null;

    /// <summary>
    /// The bounds in single precision; null for groups, which no child is an instance of, and where not all maps of the fractal are
    /// similarities.
    /// </summary>
    public FloatBound? Floats { get; } = !hasOnlySimilarities || (solid is null && !box.IsEmpty) ? null
        : hull is null ? new(box, [], [], 0)
        : new(box, hull.Planes, hull.CopyVertices(), hull.Margin);

    /// <summary>A box around the sub-fractal, in its frame.</summary>
    public BoundingBox Box { get; } = box;

    /// <summary>Centre of the box: x, y, z, 0.</summary>
    public Vector256<double> Centre { get; } = SimdAffineMap.ToVector256(box.Centre);

    /// <summary>A hull around the sub-fractal; null where it is no better than the box.</summary>
    public HullBound? Hull { get; } = hull;

    /// <summary>A convex solid around the sub-fractal, for exact distances; null where the sub-fractal is empty.</summary>
    public ConvexSolid? Solid => _solid ?? (Box.IsEmpty ? null : _solid = ConvexSolid.FromBox(Box));

    /// <summary>Boxes that bound the sub-fractal better than one; null where they don't.</summary>
    public ClusterBounds? Clusters { get; } = clusters;

    /// <summary>Square of half the diagonal of a box around the sub-fractal and the base mesh.</summary>
    public double RadiusSquared { get; } = 0.25 * BoundingBox.Union(box, baseBox).Size.LengthSquared();

    /// <summary>Half the diagonal of a box around the sub-fractal and the base mesh.</summary>
    public double Radius => Math.Sqrt(RadiusSquared);

    /// <summary>Number of bytes of the arrays.</summary>
    public long StorageBytes => Children.Sum(child => child.Group?.StorageBytes ?? 0)
        + (sizeof(double) * ChildBounds.Length) + (UnrotatedBounds?.StorageBytes ?? 0) + (Children.Length * 24) + (Hull?.StorageBytes ?? 0)
        + (_solid?.StorageBytes ?? 0) + (ChildBoundsX8?.StorageBytes ?? 0)
        + (Floats?.StorageBytes ?? 0) + (Clusters?.StorageBytes ?? 0) + 160;

    /// <summary>Lists the children, and those of groups among them, each behind its group.</summary>
    public IEnumerable<ChildInstance> AllChildren()
    {
        // No list of all, which would be a megabyte of garbage for a wide set.
        var open = new Stack<ChildInstance>();
        PushAll(Children);
        while (open.TryPop(out var child))
        {
            yield return child;
            PushAll(child.Group?.Children ?? []);
        }

        void PushAll(ChildInstance[] children)
        {
            for (var i = children.Length - 1; i >= 0; i--)
            {
                open.Push(children[i]);
            }
        }
    }

    /// <summary>True for a child without faces, whose box is far from everything.</summary>
    public bool IsChildEmpty(int child) => ChildBounds[child] == FarAwayPoint.X;

    /// <summary>A box around a child that is not empty, in the frame of the sub-fractal.</summary>
    public BoundingBox ChildBox(int child)
    {
        Vector Row(int first) => new(
            ChildBounds[(first * PaddedCount) + child], ChildBounds[((first + 1) * PaddedCount) + child],
            ChildBounds[((first + 2) * PaddedCount) + child]);
        return new(Row(0) - Row(3), Row(0) + Row(3));
    }

    /// <summary>Computes a box around the image of the sub-fractal under a map.</summary>
    /// <param name="map">From the frame of the sub-fractal to that of the image.</param>
    /// <param name="operatorNormBound">Upper bound of the factor by which the map lengthens vectors.</param>
    public BoundingBox TransformedBox(AffineMap map, double operatorNormBound) =>
        BoundingVolume.TransformedBox(Box, Hull?.CopyVertices(), Hull?.Margin ?? 0, map, operatorNormBound);

    /// <summary>Tells whether a position is within so many radii of the box's centre.</summary>
    /// <param name="position">In the frame of the sub-fractal: x, y, z, 0.</param>
    /// <param name="count">Number of radii.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool IsWithinRadii(Vector256<double> position, double count)
    {
        var direction = position - Centre;
        return Vector256.Dot(direction, direction) < count * count * RadiusSquared;
    }

    /// <summary>Computes the squared distance of a position from the box.</summary>
    /// <param name="position">In the frame of the sub-fractal: x, y, z, 0.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double BoxDistanceSquared(Vector256<double> position)
    {
        var outside = Vector256.MaxNative(Vector256.Abs(position - Centre) - _halfSize, Vector256<double>.Zero);
        return Vector256.Dot(outside, outside);
    }

    /// <summary>Computes the squared distance of a position from a box around the image of the box.</summary>
    /// <param name="position">In the frame of the image: x, y, z, 0.</param>
    /// <param name="map">From the frame of the sub-fractal to that of the image.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double TransformedBoxDistanceSquared(Vector256<double> position, in SimdAffineMap map)
    {
        var fromCentre = Vector256.Abs(position - map.Apply(Centre));
        var outside = Vector256.MaxNative(fromCentre - map.TransformHalfSize(_halfSize), Vector256<double>.Zero);
        return Vector256.Dot(outside, outside);
    }

    /// <summary>Computes an upper bound of the product of a direction with the points of the sub-fractal's image under a map.</summary>
    public double SupportBound(in AffineMap map, Vector direction)
    {
        var local = map.Linear.Transpose() * direction;
        var boxSupport = Vector.Dot(local, Box.Centre) + (0.5 * Vector.Dot(local.Absolute(), Box.Size));
        var support = Solid is null ? boxSupport : Math.Min(boxSupport, Solid.Support(local));
        return support + Vector.Dot(direction, map.Translation);
    }

    /// <summary>Computes a lower bound of the squared distance of a position from the sub-fractal's image under any map.</summary>
    /// <param name="position">In the frame of the image: x, y, z, 0.</param>
    /// <param name="map">From the frame of the sub-fractal to that of the image.</param>
    /// <param name="inverse">From the frame of the image to that of the sub-fractal; it need not be accurate.</param>
    /// <param name="cutoffSquared">The method may return early at this value.</param>
    /// <param name="isHullTested">True when the box did not suffice.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double TransformedLowerBoundSquared(
        Vector256<double> position, in SimdAffineMap map, in SimdAffineMap inverse, double cutoffSquared, out bool isHullTested)
    {
        var bound = TransformedBoxDistanceSquared(position, in map);
        isHullTested = bound < cutoffSquared && Hull is not null;
        return isHullTested
            ? Math.Max(bound, Hull!.TransformedLowerBoundSquared(position, in map, in inverse, cutoffSquared))
            : bound;
    }

    private static double[] CreateChildBounds(ReadOnlySpan<BoundingBox> childBoxes, int paddedCount)
    {
        var bounds = new double[ValuesPerChild * paddedCount];
        for (var i = 0; i < paddedCount; i++)
        {
            // Padding and empty children are far from everything.
            var (x, y, z) = i < childBoxes.Length && !childBoxes[i].IsEmpty ? childBoxes[i].Centre : FarAwayPoint;
            var (halfX, halfY, halfZ) = i < childBoxes.Length ? (0.5 + RoundingErrors.MappedPoint) * childBoxes[i].Size : Vector.Zero;
            ReadOnlySpan<double> rows = [x, y, z, halfX, halfY, halfZ];
            for (var row = 0; row < ValuesPerChild; row++)
            {
                bounds[(row * paddedCount) + i] = rows[row];
            }
        }

        return bounds;
    }
}
