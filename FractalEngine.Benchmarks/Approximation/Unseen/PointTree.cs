using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Finds the closest of many points exactly: a balanced tree that is divided at medians.</summary>
/// <remarks>Built in O(n·log n). A search is exact up to the rounding of one distance.</remarks>
internal sealed class PointTree
{
    private const int LeafSize = 8;

    private readonly Vector[] _points;
    private readonly byte[] _axes;

    /// <summary>Builds the tree of points; the array is reordered, and must not change afterwards.</summary>
    public PointTree(Vector[] points)
    {
        (_points, _axes) = (points, new byte[points.Length]);
        Build(0, points.Length);
    }

    /// <summary>
    /// Finds the squared distance of the closest point; infinite without points. <paramref name="last"/> is the index of the point found
    /// last, or −1: searches at neighbouring positions one after the other are faster.
    /// </summary>
    public double DistanceSquared(Vector position, ref int last)
    {
        var best = last >= 0 ? (_points[last] - position).LengthSquared() : double.PositiveInfinity;
        Search(0, _points.Length, position, ref best, ref last);
        return best;
    }

    private void Build(int start, int end)
    {
        if (end - start <= LeafSize)
        {
            return;
        }

        // The node of a range is its median, along the axis on which the range is longest.
        var (middle, axis) = ((start + end) / 2, LongestAxis(start, end));
        Select(start, end - 1, middle, axis);
        _axes[middle] = (byte)axis;
        Build(start, middle);
        Build(middle + 1, end);
    }

    private int LongestAxis(int start, int end)
    {
        var (minimum, maximum) = (_points[start], _points[start]);
        for (var i = start + 1; i < end; i++)
        {
            (minimum, maximum) = (Vector.Min(minimum, _points[i]), Vector.Max(maximum, _points[i]));
        }

        var (x, y, z) = maximum - minimum;
        return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    }

    /// <summary>Brings the point of a rank to its place, with none before it that is greater, and none behind that is less.</summary>
    private void Select(int first, int last, int rank, int axis)
    {
        while (first < last)
        {
            var (pivot, i, j) = (Coordinate(_points[(first + last) / 2], axis), first, last);
            while (i <= j)
            {
                while (Coordinate(_points[i], axis) < pivot)
                {
                    i++;
                }

                while (Coordinate(_points[j], axis) > pivot)
                {
                    j--;
                }

                if (i <= j)
                {
                    (_points[i], _points[j]) = (_points[j], _points[i]);
                    (i, j) = (i + 1, j - 1);
                }
            }

            (first, last) = rank <= j ? (first, j) : rank >= i ? (i, last) : (rank, rank);
        }
    }

    private void Search(int start, int end, in Vector position, ref double best, ref int closest)
    {
        if (end - start <= LeafSize)
        {
            for (var i = start; i < end; i++)
            {
                Consider(i, position, ref best, ref closest);
            }

            return;
        }

        var middle = (start + end) / 2;
        Consider(middle, position, ref best, ref closest);
        var axis = _axes[middle];
        var offset = Coordinate(position, axis) - Coordinate(_points[middle], axis);
        var isBefore = offset < 0;
        Search(isBefore ? start : middle + 1, isBefore ? middle : end, position, ref best, ref closest);
        if (offset * offset < best)
        {
            Search(isBefore ? middle + 1 : start, isBefore ? end : middle, position, ref best, ref closest);
        }
    }

    private void Consider(int index, in Vector position, ref double best, ref int closest)
    {
        var distance = (_points[index] - position).LengthSquared();
        if (distance < best)
        {
            (best, closest) = (distance, index);
        }
    }

    private static double Coordinate(in Vector point, int axis) => axis switch { 0 => point.X, 1 => point.Y, _ => point.Z };
}
