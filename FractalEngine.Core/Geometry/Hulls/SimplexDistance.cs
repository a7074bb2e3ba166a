using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Hulls;

/// <summary>A simplex of up to four points, reduced to those that span its point closest to the origin.</summary>
/// <remarks>The regions of segments, triangles and tetrahedra: Ericson, Real-Time Collision Detection (2005), 5.1.</remarks>
internal struct SimplexDistance
{
    private Vector _p0;
    private Vector _p1;
    private Vector _p2;
    private Vector _p3;
    private int _count;

    /// <summary>Adds a point to the simplex, unless it is there.</summary>
    /// <param name="point">The point.</param>
    /// <returns>False when the point is in the simplex already, or the simplex is full.</returns>
    public bool TryAdd(Vector point)
    {
        if (_count == 4 || (_count > 0 && point == _p0) || (_count > 1 && point == _p1) || (_count > 2 && point == _p2))
        {
            return false;
        }

        switch (_count++)
        {
            case 0:
                _p0 = point;
                break;
            case 1:
                _p1 = point;
                break;
            case 2:
                _p2 = point;
                break;
            default:
                _p3 = point;
                break;
        }

        return true;
    }

    /// <summary>Finds the point of the simplex closest to the origin, and drops the points that do not span it.</summary>
    /// <returns>The point; zero when the origin is inside.</returns>
    public Vector FindClosestToOrigin() => _count switch
    {
        1 => _p0,
        2 => ReduceSegment(_p0, _p1),
        3 => ReduceTriangle(_p0, _p1, _p2),
        _ => ReduceTetrahedron(),
    };

    private Vector ReduceTetrahedron()
    {
        var (a, b, c, d) = (_p0, _p1, _p2, _p3);
        var isInside = true;
        var best = this;
        var closest = Vector.Zero;
        var distanceSquared = double.PositiveInfinity;
        ReadOnlySpan<(Vector, Vector, Vector, Vector)> faces = [(a, b, c, d), (a, b, d, c), (a, c, d, b), (b, c, d, a)];
        foreach (var (v1, v2, v3, opposite) in faces)
        {
            var normal = Vector.Cross(v2 - v1, v3 - v1);
            if (Vector.Dot(normal, -v1) * Vector.Dot(normal, opposite - v1) > 0)
            {
                continue;
            }

            isInside = false;
            var candidate = this;
            var point = candidate.ReduceTriangle(v1, v2, v3);
            if (point.LengthSquared() < distanceSquared)
            {
                distanceSquared = point.LengthSquared();
                closest = point;
                best = candidate;
            }
        }

        if (!isInside)
        {
            this = best;
        }

        return closest;
    }

    private Vector ReduceTriangle(Vector a, Vector b, Vector c)
    {
        var ab = b - a;
        var ac = c - a;
        var d1 = -Vector.Dot(ab, a);
        var d2 = -Vector.Dot(ac, a);
        var d3 = -Vector.Dot(ab, b);
        var d4 = -Vector.Dot(ac, b);
        var d5 = -Vector.Dot(ab, c);
        var d6 = -Vector.Dot(ac, c);
        var weightC = (d1 * d4) - (d3 * d2);
        var weightB = (d5 * d2) - (d1 * d6);
        var weightA = (d3 * d6) - (d5 * d4);
        var sum = weightA + weightB + weightC;
        if (weightA > 0 && weightB > 0 && weightC > 0)
        {
            (_p0, _p1, _p2, _count) = (a, b, c, 3);
            // The height is more accurate along the normal than as a sum of the corners.
            return a + ((weightB / sum) * ab) + ((weightC / sum) * ac);
        }

        // Outside all edges or degenerate: the closest of the three edges.
        var best = this;
        var closest = best.ReduceSegment(a, b);
        var other = this;
        var point = other.ReduceSegment(a, c);
        if (point.LengthSquared() < closest.LengthSquared())
        {
            closest = point;
            best = other;
        }

        other = this;
        point = other.ReduceSegment(b, c);
        if (point.LengthSquared() < closest.LengthSquared())
        {
            closest = point;
            best = other;
        }

        this = best;
        return closest;
    }

    private Vector ReduceSegment(Vector a, Vector b)
    {
        var ab = b - a;
        var along = -Vector.Dot(ab, a);
        var lengthSquared = ab.LengthSquared();
        if (!(along > 0))
        {
            (_p0, _count) = (a, 1);
            return a;
        }

        if (along >= lengthSquared)
        {
            (_p0, _count) = (b, 1);
            return b;
        }

        (_p0, _p1, _count) = (a, b, 2);
        return a + ((along / lengthSquared) * ab);
    }
}
