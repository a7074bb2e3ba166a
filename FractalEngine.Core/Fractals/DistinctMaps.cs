using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// The rule of which instances are the same: their images of the base mesh's box differ by no more than <see cref="ToleranceOf"/> of their
/// largest coordinate.
/// </summary>
/// <remarks>
/// The same sum or product in another order differs by rounding only, which the tolerance covers, but where coordinates on the way were
/// some ten times larger than those of the image: such instances may count more than once. What is far away has no part in it. Counts,
/// exports, the comparison colliders and lists of faces use the rule. Searches and culling leave out, before anything is computed, what
/// equal maps in a set and identities make more than once: that needs no tolerance.
/// </remarks>
internal static class DistinctMaps
{
    private const double UnitInLastPlace = 2.220446049250313e-16;

    // A product of maps takes some roundings, of which few add up.
    private const double UnitsPerLevel = 4;
    private const double MaxUnits = 64;

    // Chains that go on and differ by more may be told apart when they have come back from afar.
    private const double ChainTolerance = 8 * UnitInLastPlace;

    private const double DegreesPerRadian = 180 / Math.PI;

    /// <summary>By how much two images of the same instance may differ, relative to their largest coordinate.</summary>
    /// <param name="levels">Number of maps in a chain; null for any number.</param>
    public static double ToleranceOf(long? levels) =>
        Math.Min(UnitsPerLevel * Math.Max(levels ?? long.MaxValue, 1), MaxUnits) * UnitInLastPlace;

    /// <summary>Makes a list of the distinct images of a base mesh under maps that are added to it.</summary>
    /// <param name="fractal">Has the base mesh, and the number of maps in a chain.</param>
    /// <param name="capacity">Number of maps for which there is room.</param>
    public static DistinctList<AffineMap> Images(Fractal fractal, int capacity) =>
        Images(fractal.BaseMesh.UsedBounds, fractal.Description.HasOnlyTransformations ? fractal.LevelCount : null, capacity);

    /// <summary>Makes a list of the distinct images of a box under maps that are added to it.</summary>
    /// <param name="box">The box of a base mesh.</param>
    /// <param name="levels">Number of maps in a chain; null for any number.</param>
    /// <param name="capacity">Number of maps for which there is room.</param>
    public static DistinctList<AffineMap> Images(BoundingBox box, long? levels, int capacity)
    {
        var relativeTolerance = ToleranceOf(levels);
        var centre = box.Centre;
        var halfSize = 0.5 * box.Size;
        return new(WriteImage, capacity);

        void WriteImage(in AffineMap map, Span<double> entries, Span<double> tolerances)
        {
            Write(map * centre, entries);
            Write(halfSize.X * map.Linear.V1, entries[3..]);
            Write(halfSize.Y * map.Linear.V2, entries[6..]);
            Write(halfSize.Z * map.Linear.V3, entries[9..]);
            tolerances.Fill(relativeTolerance * MaxAbs(entries));
        }
    }

    /// <summary>
    /// Lists the distinct products m1·m2 in the order of <see cref="FractalGenerator.ConcatenatePair"/>, without an array of all pairs.
    /// </summary>
    /// <param name="outer">The maps m1.</param>
    /// <param name="inner">The maps m2.</param>
    /// <param name="fractal">
    /// The fractal whose instances the products are; null where maps are applied before them. Then only products are the same that are so
    /// for whatever comes before.
    /// </param>
    /// <param name="maxCount">Maximum number of distinct products.</param>
    /// <returns>Null if there are more, or if telling them apart takes too long.</returns>
    public static DistinctList<AffineMap>? Products(
        ReadOnlySpan<AffineMap> outer, ReadOnlySpan<AffineMap> inner, Fractal? fractal, long maxCount)
    {
        var capacity = Capacity(outer.Length, inner.Length, maxCount);
        var products = fractal is null ? new(WriteMap, capacity) : Images(fractal, capacity);
        return TryAddPairs(products, outer, inner, static (m1, m2) => m1 * m2, maxCount);
    }

    /// <summary>
    /// Lists the distinct componentwise compositions, without an array of all pairs: those of the first transformation with all sums,
    /// then those of the second, and so on.
    /// </summary>
    /// <param name="transformations">The transformations of one level.</param>
    /// <param name="sums">The sums so far.</param>
    /// <param name="maxCount">Maximum number of distinct sums.</param>
    /// <returns>Null if there are more, or if telling them apart takes too long.</returns>
    /// <remarks>Angles are compared as numbers, so 360° differs from 0°.</remarks>
    public static DistinctList<Transformation>? Sums(
        ReadOnlySpan<Transformation> transformations, ReadOnlySpan<Transformation> sums, long maxCount)
    {
        var list = new DistinctList<Transformation>(WriteTransformation, Capacity(transformations.Length, sums.Length, maxCount));
        return TryAddPairs(
            list, transformations, sums, static (added, previous) => Transformation.ComposeComponentwise(previous, added), maxCount);
    }

    private static DistinctList<T>? TryAddPairs<T>(
        DistinctList<T> list, ReadOnlySpan<T> set1, ReadOnlySpan<T> set2, Func<T, T, T> compose, long maxCount)
    {
        foreach (var item1 in set1)
        {
            foreach (var item2 in set2)
            {
                if (!list.TryAdd(compose(item1, item2), maxCount))
                {
                    return null;
                }
            }
        }

        return list;
    }

    /// <summary>Not more than one beyond the limit, and without growing, which would leave garbage as large.</summary>
    private static int Capacity(int count1, int count2, long maxCount) =>
        (int)Math.Clamp(Math.Min(((long)count1 * count2) - 1, maxCount) + 1, 1, Array.MaxLength);

    private static double MaxAbs(ReadOnlySpan<double> numbers)
    {
        var max = 0.0;
        foreach (var number in numbers)
        {
            max = Math.Max(max, Math.Abs(number));
        }

        return max;
    }

    private static void WriteMap(in AffineMap map, Span<double> entries, Span<double> tolerances)
    {
        Write(map.Translation, entries);
        Write(map.Linear.V1, entries[3..]);
        Write(map.Linear.V2, entries[6..]);
        Write(map.Linear.V3, entries[9..]);
        tolerances.Fill(ChainTolerance * map.Linear.MaxAbsEntry());
        tolerances[0] = ChainTolerance * Math.Max(map.Translation.MaxAbsComponent(), map.Linear.MaxAbsEntry());
    }

    private static void WriteTransformation(
        in Transformation transformation, Span<double> entries, Span<double> tolerances)
    {
        Write(transformation.Position, entries);
        Write(transformation.Rotation, entries[3..]);
        Write(transformation.Scale, entries[6..]);
        Write(Vector.Zero, entries[9..]);
        tolerances[0] = ChainTolerance * transformation.Position.MaxAbsComponent();
        // A difference of angles by the tolerance, in radians, moves an image by as much of its size.
        tolerances[1] = ChainTolerance * Math.Max(DegreesPerRadian, transformation.Rotation.MaxAbsComponent());
        tolerances[2] = ChainTolerance * transformation.Scale.MaxAbsComponent();
        tolerances[3] = 0;
    }

    private static void Write(Vector v, Span<double> entries)
    {
        entries[0] = v.X;
        entries[1] = v.Y;
        entries[2] = v.Z;
    }
}
