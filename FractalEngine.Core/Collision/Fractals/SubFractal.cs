using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>The part of a fractal that has some number of levels left, in its own frame: its copies and bounds.</summary>
internal sealed class SubFractal
{
    /// <summary>Numbers of boxes are rounded up to a multiple of this, with boxes that are infinitely far away.</summary>
    public const int Lanes = 4;

    /// <summary>Numbers kept for each copy: a box.</summary>
    private const int ValuesPerChild = 6;

    private static readonly Vector FarAwayPoint = 1e300 * Vector.One;

    private readonly Vector256<double> _halfSize;

    /// <summary>For a level.</summary>
    /// <param name="set">The set of the level; null for the base.</param>
    /// <param name="children">The copies it makes.</param>
    /// <param name="childBoxes">Around the copies, in this frame.</param>
    /// <param name="boundingVolume">Of everything.</param>
    /// <param name="baseBox">Of the base mesh.</param>
    /// <param name="hull">Of everything, if that is a bound better than the box.</param>
    /// <param name="childHull">The hull of what the first copy is of.</param>
    public SubFractal(MapSet? set, ChildInstance[] children, ReadOnlySpan<BoundingBox> childBoxes, BoundingVolume boundingVolume,
        BoundingBox baseBox, HullBound? hull, HullBound? childHull)
    {
        (Set, Children, Box, Centre, Hull) = (set, children, boundingVolume.Box, SimdAffineMap.ToVector256(boundingVolume.Box.Centre),
            hull);
        _halfSize = SimdAffineMap.ToVector256(0.5 * boundingVolume.Box.Size);
        PaddedCount = (children.Length + Lanes - 1) / Lanes * Lanes;
        ChildBounds = new double[ValuesPerChild * PaddedCount];
        for (var i = 0; i < PaddedCount; i++)
        {
            // What stands for no copy has no centre near anything.
            var (x, y, z) = i < childBoxes.Length && !childBoxes[i].IsEmpty ? childBoxes[i].Centre : FarAwayPoint;
            var (halfX, halfY, halfZ) = i < childBoxes.Length ? 0.5 * childBoxes[i].Size : Vector.Zero;
            ReadOnlySpan<double> rows = [x, y, z, halfX, halfY, halfZ];
            for (var row = 0; row < ValuesPerChild; row++)
            {
                ChildBounds[(row * PaddedCount) + i] = rows[row];
            }
        }

        HasRotatedChildren = !UnrotatedChildBounds.HasNoRotation(children);
        UnrotatedBounds = children.Length > 0 ? UnrotatedChildBounds.CreateOrNull(childHull, children, PaddedCount) : null;
        RadiusSquared = 0.25 * BoundingBox.Union(Box, baseBox).Size.LengthSquared();
    }

    /// <summary>The set of this level; null for the base.</summary>
    public MapSet? Set { get; }

    /// <summary>What the level copies.</summary>
    public ChildInstance[] Children { get; }

    /// <summary>The number of boxes, padding included.</summary>
    public int PaddedCount { get; }

    /// <summary>Boxes around the copies, [6 × <see cref="PaddedCount"/>]: x, y, z of their centres, then of half their sizes.</summary>
    public double[] ChildBounds { get; }

    /// <summary>Bounds of all copies together; null where they are not alike.</summary>
    public UnrotatedChildBounds? UnrotatedBounds { get; }

    /// <summary>False where each copy's box is that of its sub-fractal, moved and scaled.</summary>
    public bool HasRotatedChildren { get; }

    /// <summary>Around everything, in this frame.</summary>
    public BoundingBox Box { get; }

    /// <summary>Of the box: x, y, z, 0.</summary>
    public Vector256<double> Centre { get; }

    /// <summary>Around everything; null where it is no better than the box.</summary>
    public HullBound? Hull { get; }

    /// <summary>Square of half the diagonal of a box around this and the base mesh.</summary>
    public double RadiusSquared { get; }

    /// <summary>The squared distance of a position from the box.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double BoxDistanceSquared(Vector256<double> position)
    {
        var outside = Vector256.MaxNative(Vector256.Abs(position - Centre) - _halfSize, Vector256<double>.Zero);
        return Vector256.Dot(outside, outside);
    }

    /// <summary>The squared distance of a position from a box around the image of the box.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double TransformedBoxDistanceSquared(Vector256<double> position, in SimdAffineMap map)
    {
        var outside = Vector256.MaxNative(Vector256.Abs(position - map.Apply(Centre)) - map.TransformHalfSize(_halfSize),
            Vector256<double>.Zero);
        return Vector256.Dot(outside, outside);
    }

    /// <summary>Bytes of the arrays.</summary>
    public long StorageBytes =>
        (sizeof(double) * ChildBounds.Length) + (UnrotatedBounds?.StorageBytes ?? 0) + (Children.Length * 24) + (Hull?.StorageBytes ?? 0)
        + 160;
}
