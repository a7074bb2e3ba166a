using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>The part of a fractal that has some number of levels left, in its own frame: its copies and bounds.</summary>
internal sealed class SubFractal
{
    /// <summary>Numbers of boxes are rounded up to a multiple of this, with boxes that are infinitely far away.</summary>
    public const int Lanes = 4;

    /// <summary>Numbers kept for each copy: a box.</summary>
    private const int Rows = 6;

    private static readonly Vector Nowhere = 1e300 * Vector.One;

    private readonly Vector256<double> _halfSize;

    /// <summary>For a level.</summary>
    /// <param name="set">The set of the level; null for the base.</param>
    /// <param name="copies">The copies it makes.</param>
    /// <param name="boxes">Around the copies, in this frame.</param>
    /// <param name="outline">Of everything.</param>
    /// <param name="baseBox">Of the base mesh.</param>
    /// <param name="hull">Of everything, if that is a bound better than the box.</param>
    /// <param name="solid">The hull of what the first copy is of.</param>
    public SubFractal(CopySet? set, Copy[] copies, ReadOnlySpan<BoundingBox> boxes, Outline outline, BoundingBox baseBox, HullBound? hull, HullBound? solid)
    {
        (Set, Copies, Box, Centre, Hull) = (set, copies, outline.Box, AffineLanes.Of(outline.Box.Centre), hull);
        _halfSize = AffineLanes.Of(0.5 * outline.Box.Size);
        Padded = (copies.Length + Lanes - 1) / Lanes * Lanes;
        Bounds = new double[Rows * Padded];
        for (var i = 0; i < Padded; i++)
        {
            // What stands for no copy has no centre near anything.
            var (x, y, z) = i < boxes.Length && !boxes[i].IsEmpty ? boxes[i].Centre : Nowhere;
            var (halfX, halfY, halfZ) = i < boxes.Length ? 0.5 * boxes[i].Size : Vector.Zero;
            ReadOnlySpan<double> rows = [x, y, z, halfX, halfY, halfZ];
            for (var row = 0; row < Rows; row++)
            {
                Bounds[(row * Padded) + i] = rows[row];
            }
        }

        AreTurned = !CopyShifts.AreNone(copies);
        Shifts = copies.Length > 0 ? CopyShifts.Of(solid, copies, Padded) : null;
        RadiusSquared = 0.25 * BoundingBox.Union(Box, baseBox).Size.LengthSquared();
    }

    /// <summary>The set of this level; null for the base.</summary>
    public CopySet? Set { get; }

    /// <summary>What the level copies.</summary>
    public Copy[] Copies { get; }

    /// <summary>The number of boxes, padding included.</summary>
    public int Padded { get; }

    /// <summary>Boxes around the copies, [6 × <see cref="Padded"/>]: x, y, z of their centres, then of half their sizes.</summary>
    public double[] Bounds { get; }

    /// <summary>Bounds of all copies together; null where they are not alike.</summary>
    public CopyShifts? Shifts { get; }

    /// <summary>False where each copy's box is that of its sub-fractal, moved and scaled.</summary>
    public bool AreTurned { get; }

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
    public double DistanceSquared(Vector256<double> position)
    {
        var outside = Vector256.MaxNative(Vector256.Abs(position - Centre) - _halfSize, Vector256<double>.Zero);
        return Vector256.Dot(outside, outside);
    }

    /// <summary>The squared distance of a position from a box around the image of the box.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double ImageDistanceSquared(Vector256<double> position, in AffineLanes map)
    {
        var outside = Vector256.MaxNative(Vector256.Abs(position - map.Apply(Centre)) - map.HalfSizeOf(_halfSize), Vector256<double>.Zero);
        return Vector256.Dot(outside, outside);
    }

    /// <summary>Bytes of the arrays.</summary>
    public long StorageBytes => (sizeof(double) * Bounds.Length) + (Shifts?.StorageBytes ?? 0) + (Copies.Length * 24) + (Hull?.StorageBytes ?? 0) + 160;
}
