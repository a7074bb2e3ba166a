using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Geometry.Surfaces;

/// <summary>The reflex corners of a polygon in the order of the corners, with their points one after the other in memory.</summary>
internal sealed class ReflexCorners
{
    private int[] _corners = [];
    private int[] _positions = [];
    private double[] _x = [];
    private double[] _y = [];
    private int _count;
    private int _removedCount;
    private int _cornerCount;

    /// <summary>The corner at a position.</summary>
    public int this[int position] => _corners[position];

    /// <summary>Collects the reflex corners of a polygon.</summary>
    public void Collect(ReadOnlySpan<(double X, double Y)> points, EarClipper clipper)
    {
        _cornerCount = points.Length;
        _count = 0;
        _removedCount = 0;
        if (_corners.Length < _cornerCount)
        {
            _corners = new int[_cornerCount];
            _positions = new int[_cornerCount];
            _x = new double[_cornerCount];
            _y = new double[_cornerCount];
        }

        for (var corner = 0; corner < _cornerCount; corner++)
        {
            _positions[corner] = _count;
            if (clipper.IsReflex(corner))
            {
                _corners[_count] = corner;
                _x[_count] = points[corner].X;
                _y[_count] = points[corner].Y;
                _count++;
            }
        }
    }

    /// <summary>Returns the position of a corner, or of the next one behind it that was collected.</summary>
    public int PositionOf(int corner) => _positions[corner];

    /// <summary>Removes a corner that is no longer reflex.</summary>
    /// <returns>False if it is none of these.</returns>
    public bool Remove(int corner)
    {
        var position = _positions[corner];
        if (position >= _count || _corners[position] != corner || double.IsNaN(_x[position]))
        {
            return false;
        }

        // Such a point lies in no triangle.
        _x[position] = double.NaN;
        _removedCount++;
        if (_removedCount > _count / 2)
        {
            Compact();
        }

        return true;
    }

    /// <summary>Finds the first point in a triangle or on its border.</summary>
    /// <param name="a">Corner of the triangle, which is anticlockwise.</param>
    /// <param name="b">Corner of the triangle.</param>
    /// <param name="c">Corner of the triangle.</param>
    /// <param name="start">Position from which on it is looked for.</param>
    /// <returns>Its position; −1 if there is none.</returns>
    public int FindInside((double X, double Y) a, (double X, double Y) b, (double X, double Y) c, int start)
    {
        var position = start;
        for (; position <= _count - Vector256<double>.Count; position += Vector256<double>.Count)
        {
            var x = Vector256.Create(_x.AsSpan(position));
            var y = Vector256.Create(_y.AsSpan(position));
            var inside = IsLeft(a, b, x, y) & IsLeft(b, c, x, y) & IsLeft(c, a, x, y);
            if (inside.ExtractMostSignificantBits() is not 0 and var bits)
            {
                return position + System.Numerics.BitOperations.TrailingZeroCount(bits);
            }
        }

        for (; position < _count; position++)
        {
            var point = (_x[position], _y[position]);
            if (EarClipper.TwiceSignedArea(a, b, point) >= 0 && EarClipper.TwiceSignedArea(b, c, point) >= 0
                && EarClipper.TwiceSignedArea(c, a, point) >= 0)
            {
                return position;
            }
        }

        return -1;
    }

    /// <summary>Tests which points lie on the left of a line or on it, in the order of operations of a signed area.</summary>
    private static Vector256<double> IsLeft((double X, double Y) a, (double X, double Y) b, Vector256<double> x, Vector256<double> y)
    {
        var alongY = Vector256.Create(b.X - a.X) * (y - Vector256.Create(a.Y));
        var alongX = Vector256.Create(b.Y - a.Y) * (x - Vector256.Create(a.X));
        return Vector256.GreaterThanOrEqual(alongY - alongX, Vector256<double>.Zero);
    }

    private void Compact()
    {
        var kept = 0;
        var position = 0;
        for (var corner = 0; corner < _cornerCount; corner++)
        {
            var isHere = position < _count && _corners[position] == corner;
            var isKept = isHere && !double.IsNaN(_x[position]);
            _positions[corner] = kept;
            if (isKept)
            {
                _corners[kept] = corner;
                _x[kept] = _x[position];
                _y[kept] = _y[position];
                kept++;
            }

            position += isHere ? 1 : 0;
        }

        _count = kept;
        _removedCount = 0;
    }
}
