using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>Bounds of the children of a sub-fractal in single precision, eight at a time.</summary>
/// <remarks>
/// Children that are instances of one simple solid are bounded in their own frames: the position is taken there, and compared with the box
/// and the planes of the solid. Others are bounded by boxes in the frame of the parent. For similarities only, and for positions no farther
/// away than <see cref="MaxDistanceFactor"/>. Why the bounds hold in spite of rounding is proved in docs/colliders.md.
/// </remarks>
internal sealed class ChildBoundsX8(float[] rows, int groupCount, int rowCount, double reach, LevelStep levelStep)
{
    /// <summary>Positions so many radii of the parent away are left to double precision, where bounds tell small children apart.</summary>
    public const double MaxDistanceFactor = 24;

    private const int LaneCount = FloatChildQueue.LaneCount;

    // Three coordinates of the centre, then of half the size.
    private const int BoxRows = 6;

    // The diagonal of the inverse, its translation, and the scale; then the other entries of the inverse, where there are any.
    private const int UnrotatedRows = 7;
    private const int RotatedRows = 13;

    // In units of half a last place, as a part of the largest coordinate of the position and the children: docs/colliders.md.
    private const float RoundingError = 64f / (1 << 24);

    // Relative error of the scale and of the root of a squared distance.
    private const float ScaleFactor = 1 - (16f / (1 << 24));

    // Products of coordinates and inverse scales stay well within the range of a float.
    private const double MaxMagnitude = 1e8;
    private const double MaxRelativeMagnitude = 100;
    private const double MinChildScale = 1e-5;

    // Far away, for lanes without a child.
    private const float FarAway = 1e18f;

    private readonly float[] _rows = rows;
    private readonly int _groupCount = groupCount;
    private readonly int _rowCount = rowCount;
    private readonly float _reach = (float)reach;

    /// <summary>Number of bytes of the arrays.</summary>
    public long StorageBytes => (sizeof(float) * (long)_rows.Length) + 64;

    /// <summary>Number of values that a queue of the children needs.</summary>
    public int PaddedCount => LaneCount * _groupCount;

    /// <summary>True when the bounds are the best there are.</summary>
    public bool IsComplete => _rowCount != BoxRows;

    /// <summary>Prepares the children; null where floats would not bound them well.</summary>
    /// <param name="children">The children.</param>
    /// <param name="childBoxes">Boxes around them in the frame of the parent.</param>
    /// <param name="childHull">The hull of the sub-fractal that the first child is an instance of.</param>
    /// <param name="box">A box around the parent and the base mesh.</param>
    public static ChildBoundsX8? CreateOrNull(
        ChildInstance[] children, ReadOnlySpan<BoundingBox> childBoxes, HullBound? childHull, BoundingBox box)
    {
        if (children.Length == 0 || !IsInRange(children, box))
        {
            return null;
        }

        var groupCount = (children.Length + LaneCount - 1) / LaneCount;
        var rowCount = !HaveSimpleHull(children, childHull) ? BoxRows
            : UnrotatedChildBounds.HasNoRotation(children) ? UnrotatedRows
            : RotatedRows;
        var rows = new float[groupCount * rowCount * LaneCount];
        var reach = box.MaxAbsCoordinate();
        Span<float> values = stackalloc float[RotatedRows];
        for (var i = 0; i < groupCount * LaneCount; i++)
        {
            if (i >= children.Length || childBoxes[i].IsEmpty)
            {
                FillNoChild(values[..rowCount]);
            }
            else if (rowCount == BoxRows)
            {
                FillBox(values, childBoxes[i]);
            }
            else
            {
                FillFrame(values, children[i]);
            }

            for (var row = 0; row < rowCount; row++)
            {
                rows[(((i / LaneCount * rowCount) + row) * LaneCount) + (i % LaneCount)] = values[row];
            }

            reach = i < children.Length ? Math.Max(reach, children[i].Map.Translation.MaxAbsComponent()) : reach;
        }

        return new(rows, groupCount, rowCount, reach, children[0].LevelStep);
    }

    /// <summary>An upper bound of the rounding error of the distances.</summary>
    /// <param name="position">In the frame of the parent: x, y, z, 0.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public float DistanceError(Vector256<double> position)
    {
        var magnitude = Vector256.Abs(position);
        return RoundingError * ((float)Math.Max(Math.Max(magnitude[0], magnitude[1]), magnitude[2]) + _reach);
    }

    /// <summary>Queues all children by lower bounds of their distances.</summary>
    /// <param name="hierarchy">The hierarchy.</param>
    /// <param name="remainingLevels">Remaining levels of the parent.</param>
    /// <param name="position">In the frame of the parent: x, y, z, 0.</param>
    /// <param name="cutoffSquared">Bounds at or above it need not be the best.</param>
    /// <param name="queue">The queue of the children.</param>
    public void FillQueue(
        FractalHierarchy hierarchy, long remainingLevels, Vector256<double> position, double cutoffSquared, in FloatChildQueue queue)
    {
        var point = Vector256.Narrow(position, position);
        var px = Vector256.Create(point[0]);
        var py = Vector256.Create(point[1]);
        var pz = Vector256.Create(point[2]);
        if (IsComplete)
        {
            FillByFrames(hierarchy.At(levelStep.RemainingLevels(remainingLevels)).Floats!, px, py, pz, (float)cutoffSquared, in queue);
        }
        else
        {
            FillByBoxes(px, py, pz, in queue);
        }
    }

    private void FillByBoxes(Vector256<float> px, Vector256<float> py, Vector256<float> pz, in FloatChildQueue queue)
    {
        ref var rows = ref MemoryMarshal.GetArrayDataReference(_rows);
        var zero = Vector256<float>.Zero;
        for (var first = 0; first < PaddedCount; first += LaneCount)
        {
            var x = Vector256.Abs(px - Row(ref rows, 0));
            var y = Vector256.Abs(py - Row(ref rows, 1));
            var z = Vector256.Abs(pz - Row(ref rows, 2));
            var outsideX = Vector256.MaxNative(x - Row(ref rows, 3), zero);
            var outsideY = Vector256.MaxNative(y - Row(ref rows, 4), zero);
            var outsideZ = Vector256.MaxNative(z - Row(ref rows, 5), zero);
            queue.SetBounds(
                (outsideX * outsideX) + (outsideY * outsideY) + (outsideZ * outsideZ), (x * x) + (y * y) + (z * z), first);
            rows = ref Unsafe.Add(ref rows, BoxRows * LaneCount);
        }
    }

    private void FillByFrames(
        FloatBound target, Vector256<float> px, Vector256<float> py, Vector256<float> pz, float cutoffSquared, in FloatChildQueue queue)
    {
        ref var rows = ref MemoryMarshal.GetArrayDataReference(_rows);
        var isRotated = _rowCount == RotatedRows;
        var cutoffsSquared = Vector256.Create(cutoffSquared);
        for (var first = 0; first < PaddedCount; first += LaneCount)
        {
            var (x, y, z) = (Row(ref rows, 0) * px, Row(ref rows, 1) * py, Row(ref rows, 2) * pz);
            if (isRotated)
            {
                x += (Row(ref rows, 7) * py) + (Row(ref rows, 8) * pz);
                y += (Row(ref rows, 9) * pz) + (Row(ref rows, 10) * px);
                z += (Row(ref rows, 11) * px) + (Row(ref rows, 12) * py);
            }

            x += Row(ref rows, 3);
            y += Row(ref rows, 4);
            z += Row(ref rows, 5);
            var scale = Row(ref rows, 6);
            var scaleSquared = scale * scale;
            var bounds = target.DistanceSquared(x, y, z, scaleSquared, cutoffsSquared, out var fromCentreSquared);
            queue.SetBounds(bounds, scaleSquared * fromCentreSquared, first);
            rows = ref Unsafe.Add(ref rows, _rowCount * LaneCount);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<float> Row(ref float rows, int row) => Vector256.LoadUnsafe(ref rows, (nuint)(row * LaneCount));

    private static bool HaveSimpleHull(ChildInstance[] children, HullBound? childHull) =>
        childHull is not null && FloatBound.IsSimple(childHull) && children.All(child => child.LevelStep == children[0].LevelStep);

    private static void FillNoChild(Span<float> values)
    {
        values.Clear();
        values[3] = values.Length == BoxRows ? float.NegativeInfinity : FarAway;
        values[^1] = values.Length == UnrotatedRows ? float.PositiveInfinity : 0;
        if (values.Length == RotatedRows)
        {
            values[6] = float.PositiveInfinity;
        }
    }

    private static void FillBox(Span<float> values, BoundingBox box)
    {
        var centre = box.Centre;
        var halfSize = 0.5 * box.Size;
        ReadOnlySpan<float> rows =
            [(float)centre.X, (float)centre.Y, (float)centre.Z, (float)halfSize.X, (float)halfSize.Y, (float)halfSize.Z];
        rows.CopyTo(values);
    }

    private static void FillFrame(Span<float> values, ChildInstance child)
    {
        ref readonly var inverse = ref child.InverseSimdMap;
        ReadOnlySpan<float> rows =
        [
            (float)inverse.V1[0], (float)inverse.V2[1], (float)inverse.V3[2],
            (float)inverse.Translation[0], (float)inverse.Translation[1], (float)inverse.Translation[2],
            (float)Math.Sqrt(child.ScaleSquared) * ScaleFactor,
            (float)inverse.V2[0], (float)inverse.V3[0], (float)inverse.V3[1],
            (float)inverse.V1[1], (float)inverse.V1[2], (float)inverse.V2[2],
        ];
        rows.CopyTo(values);
    }

    private static bool IsInRange(ChildInstance[] children, BoundingBox box)
    {
        foreach (var child in children)
        {
            if (child.Group is not null
                || !(child.ScaleSquared > MinChildScale * MinChildScale) || !(child.ScaleSquared < MaxMagnitude))
            {
                return false;
            }
        }

        var size = box.Size.MaxAbsComponent();
        var magnitude = box.MaxAbsCoordinate();
        return size > 1 / MaxMagnitude && magnitude < MaxMagnitude && magnitude < MaxRelativeMagnitude * size;
    }
}
