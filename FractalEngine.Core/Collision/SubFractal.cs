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

    private static readonly BoundingBox Nowhere = new(double.PositiveInfinity * Vector.One, double.PositiveInfinity * Vector.One);

    /// <summary>For a level.</summary>
    /// <param name="set">The set of the level; null for the base.</param>
    /// <param name="copies">The copies it makes.</param>
    /// <param name="boxes">Around the copies, in this frame.</param>
    /// <param name="outline">Of everything.</param>
    /// <param name="baseBox">Of the base mesh.</param>
    /// <param name="hull">Of everything, if that is a bound better than the box.</param>
    public SubFractal(CopySet? set, Copy[] copies, ReadOnlySpan<BoundingBox> boxes, Outline outline, BoundingBox baseBox, HullBound? hull)
    {
        (Set, Copies, Box, Hull) = (set, copies, outline.Box, hull);
        Padded = (copies.Length + Lanes - 1) / Lanes * Lanes;
        Bounds = new double[Rows * Padded];
        Array.Fill(Bounds, double.PositiveInfinity);
        for (var i = 0; i < boxes.Length; i++)
        {
            var ((x0, y0, z0), (x1, y1, z1)) = boxes[i].IsEmpty ? Nowhere : boxes[i];
            ReadOnlySpan<double> rows = [x0, y0, z0, x1, y1, z1];
            for (var row = 0; row < Rows; row++)
            {
                Bounds[(row * Padded) + i] = rows[row];
            }
        }

        RadiusSquared = 0.25 * BoundingBox.Union(Box, baseBox).Size.LengthSquared();
    }

    /// <summary>The set of this level; null for the base.</summary>
    public CopySet? Set { get; }

    /// <summary>What the level copies.</summary>
    public Copy[] Copies { get; }

    /// <summary>The number of boxes, padding included.</summary>
    public int Padded { get; }

    /// <summary>Around the copies, [6 × <see cref="Padded"/>]: smallest x, y, z, then largest x, y, z.</summary>
    public double[] Bounds { get; }

    /// <summary>Around everything, in this frame.</summary>
    public BoundingBox Box { get; }

    /// <summary>Around everything; null where it is no better than the box.</summary>
    public HullBound? Hull { get; }

    /// <summary>Square of half the diagonal of a box around this and the base mesh.</summary>
    public double RadiusSquared { get; }

    /// <summary>Bytes of the arrays.</summary>
    public long StorageBytes => (sizeof(double) * Bounds.Length) + (Copies.Length * 24) + (Hull?.StorageBytes ?? 0) + 160;
}
