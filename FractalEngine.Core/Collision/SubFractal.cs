using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Collision;

/// <summary>The part of a fractal that has some number of levels left, in its own frame: its copies and bounds.</summary>
internal sealed class SubFractal
{
    /// <summary>Numbers of boxes are rounded up to a multiple of this, with boxes that are infinitely far away.</summary>
    public const int Lanes = 4;

    /// <summary>For a level.</summary>
    /// <param name="set">The set of the level; null for the base.</param>
    /// <param name="copies">The copies it makes.</param>
    /// <param name="boxes">A box around each copy, in this frame.</param>
    /// <param name="box">A box around everything.</param>
    /// <param name="emitsBase">Whether the base mesh stands here beside the copies.</param>
    public SubFractal(CopySet? set, Copy[] copies, ReadOnlySpan<BoundingBox> boxes, BoundingBox box, bool emitsBase)
    {
        (Set, Copies, Box, EmitsBase) = (set, copies, box, emitsBase);
        Padded = (copies.Length + Lanes - 1) / Lanes * Lanes;
        Bounds = new double[6 * Padded];
        Array.Fill(Bounds, double.PositiveInfinity);
        for (var i = 0; i < boxes.Length; i++)
        {
            var ((x0, y0, z0), (x1, y1, z1)) = (boxes[i].Minimum, boxes[i].Maximum);
            (Bounds[i], Bounds[Padded + i], Bounds[(2 * Padded) + i]) = (x0, y0, z0);
            (Bounds[(3 * Padded) + i], Bounds[(4 * Padded) + i], Bounds[(5 * Padded) + i]) = (x1, y1, z1);
        }

        RadiusSquared = 0.25 * box.Size.LengthSquared();
    }

    /// <summary>The set of this level; null for the base.</summary>
    public CopySet? Set { get; }

    /// <summary>What the level copies.</summary>
    public Copy[] Copies { get; }

    /// <summary>The number of boxes, padding included.</summary>
    public int Padded { get; }

    /// <summary>The copies' boxes, [6 × <see cref="Padded"/>]: smallest x, y, z, then largest x, y, z.</summary>
    public double[] Bounds { get; }

    /// <summary>Around everything, in this frame.</summary>
    public BoundingBox Box { get; }

    /// <summary>Square of half the box's diagonal.</summary>
    public double RadiusSquared { get; }

    /// <summary>Whether the base mesh stands here beside the copies.</summary>
    public bool EmitsBase { get; }

    /// <summary>Bytes of the arrays.</summary>
    public long StorageBytes => (sizeof(double) * Bounds.Length) + (Copies.Length * 16) + 120;

    /// <summary>The box around one copy.</summary>
    public BoundingBox BoxOf(int copy) => new(
        new(Bounds[copy], Bounds[Padded + copy], Bounds[(2 * Padded) + copy]),
        new(Bounds[(3 * Padded) + copy], Bounds[(4 * Padded) + copy], Bounds[(5 * Padded) + copy]));
}
