using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// A convex solid that holds a sub-fractal, as a bound of distances: near to it by the planes of its facets, far from it by how far it
/// reaches in the direction of the position. Both are exact where it matters: in front of a facet, and far from a corner or an edge.
/// </summary>
internal sealed class HullBound
{
    private const int Lanes = 4;

    // More save hardly any sub-fractals and cost time; the largest facets are kept.
    private const int MostPlanes = 32;
    private const int FewVertices = 2 * Lanes;

    // In half sizes: from there on a facet's plane says hardly more than how far the solid reaches.
    private const double Far = 4;

    private const double AlongAxis = 1 - 1e-12;

    private readonly double[] _planes;
    private readonly double[] _vertices;
    private readonly int _planeCount;
    private readonly int _vertexCount;
    private readonly Vector256<double>[] _corners = [];
    private readonly Vector _centre;
    private readonly Vector256<double> _centre4;
    private readonly double _farSquared;
    private readonly double _margin;

    /// <summary>A hull, widened by a margin on all sides.</summary>
    /// <param name="hull">May be flat.</param>
    /// <param name="box">Around the hull.</param>
    /// <param name="margin">Not negative.</param>
    /// <param name="withAxes">False where the planes of an axis-parallel box are looked at elsewhere.</param>
    public HullBound(ConvexHull hull, BoundingBox box, double margin, bool withAxes)
    {
        var planes = hull.Planes.Where(plane => withAxes || plane.Normal.MaximumComponent() < AlongAxis).Take(MostPlanes).ToArray();
        (_centre, _farSquared, _margin) = (box.Centre, Far * Far * 0.25 * box.Size.LengthSquared(), margin);
        _centre4 = Vector256.Create(_centre.X, _centre.Y, _centre.Z, 0);
        Planes = [.. planes.Select(plane => plane with { Offset = plane.Offset + margin })];
        (_planeCount, _vertexCount) = (Padded(planes.Length), Padded(hull.Vertices.Length));
        (_planes, _vertices) = (new double[4 * _planeCount], new double[3 * _vertexCount]);
        // The last ones fill the lanes that are left over.
        for (var i = 0; i < _planeCount; i++)
        {
            var (normal, offset, _) = planes[Math.Min(i, planes.Length - 1)];
            (_planes[i], _planes[_planeCount + i], _planes[(2 * _planeCount) + i]) = normal;
            _planes[(3 * _planeCount) + i] = offset + margin;
        }

        for (var i = 0; i < _vertexCount; i++)
        {
            var vertex = hull.Vertices[Math.Min(i, hull.Vertices.Length - 1)];
            (_vertices[i], _vertices[_vertexCount + i], _vertices[(2 * _vertexCount) + i]) = vertex;
        }

        if (_vertexCount <= FewVertices)
        {
            _corners = [.. Enumerable.Range(0, _vertexCount).Select(i => Vector256.Create(_vertices[i], _vertices[_vertexCount + i], _vertices[(2 * _vertexCount) + i], 0))];
        }
    }

    /// <summary>The planes, those that fill the last lanes left out.</summary>
    public IReadOnlyList<HullPlane> Planes { get; }

    /// <summary>Bytes of the arrays.</summary>
    public long StorageBytes => sizeof(double) * (long)(_planes.Length + _vertices.Length + (4 * _corners.Length));

    /// <summary>At most the squared distance of a position from the solid.</summary>
    /// <param name="position">In the solid's frame: x, y, z, 0.</param>
    /// <param name="enough">A bound so large is as good as any larger one.</param>
    public double DistanceSquared(Vector256<double> position, double enough)
    {
        var direction = position - _centre4;
        var squared = Vector256.Dot(direction, direction);
        var bound = 0.0;
        if (squared < _farSquared)
        {
            var height = HighestAbove(position);
            bound = height > 0 ? height * height : 0;
            if (!(bound < enough))
            {
                return bound;
            }
        }

        if (_corners.Length == 0)
        {
            return Math.Max(bound, Beyond(direction, squared, position, Support(direction)));
        }

        bound = Math.Max(bound, Beyond(direction, squared, position, Support(direction, out var corner)));
        if (bound < enough)
        {
            // Seen from the corner that reaches farthest: exact where that is the nearest, as it mostly is for solids of few corners.
            direction = position - corner;
            bound = Math.Max(bound, Beyond(direction, Vector256.Dot(direction, direction), position, Support(direction)));
        }

        return bound;
    }

    /// <summary>The squared distance by which a position lies beyond the solid in some direction, 0 if it does not.</summary>
    /// <param name="direction">Of any length.</param>
    /// <param name="squared">Of its length.</param>
    /// <param name="position">In the solid's frame.</param>
    /// <param name="support">How far the solid reaches in the direction.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private double Beyond(Vector256<double> direction, double squared, Vector256<double> position, double support)
    {
        // The sum of the components is no less than the length that the margin is to be multiplied by.
        var reach = Vector256.Dot(direction, position) - support - (_margin * Vector256.Sum(Vector256.Abs(direction)));
        return reach > 0 ? reach * reach / squared : 0;
    }

    /// <summary>The largest product of a direction with one of few corners, and which that is.</summary>
    private double Support(Vector256<double> direction, out Vector256<double> corner)
    {
        ref var vertices = ref MemoryMarshal.GetArrayDataReference(_vertices);
        var (x, y, z) = (Vector256.Create(direction[0]), Vector256.Create(direction[1]), Vector256.Create(direction[2]));
        var first = Product(ref vertices, 0, _vertexCount, x, y, z);
        var second = Product(ref vertices, _vertexCount - Lanes, _vertexCount, x, y, z);
        var most = Largest(Vector256.MaxNative(first, second));
        var both = Vector256.Equals(first, Vector256.Create(most)).ExtractMostSignificantBits()
            | (Vector256.Equals(second, Vector256.Create(most)).ExtractMostSignificantBits() << (_vertexCount - Lanes));
        corner = _corners[System.Numerics.BitOperations.TrailingZeroCount(both)];
        return most;
    }

    /// <summary>At most the squared distance of a position from the image of the solid under any map.</summary>
    /// <param name="position">In the frame of the image.</param>
    /// <param name="map">From the solid's frame to that of the image.</param>
    /// <param name="inverse">Its inverse, which need not be accurate: it only says where to look.</param>
    /// <param name="enough">A bound so large is as good as any larger one.</param>
    public double ImageDistanceSquared(in Vector position, in AffineMap map, in AffineMap inverse, double enough)
    {
        var margin = _margin * BoundingSphere.LengtheningBound(map.Linear);
        var bound = BeyondImage(position - (map * _centre), in position, in map, margin);
        return bound < enough && _planeCount > 0
            ? Math.Max(bound, BeyondImage(FarthestPlane(inverse * position, in inverse), in position, in map, margin))
            : bound;
    }

    /// <summary>The squared distance by which a position lies beyond the image in some direction, 0 if it does not.</summary>
    private double BeyondImage(Vector direction, in Vector position, in AffineMap map, double margin)
    {
        var pulledBack = Vector256.Create(
            Vector.Dot(map.Linear.V1, direction), Vector.Dot(map.Linear.V2, direction), Vector.Dot(map.Linear.V3, direction), 0);
        var reach = Vector.Dot(direction, position - map.Translation) - Support(pulledBack);
        if (!(reach > 0))
        {
            return 0;
        }

        reach = (reach / direction.Length()) - margin;
        return reach > 0 ? reach * reach : 0;
    }

    /// <summary>The largest height of a position above a plane; negative inside.</summary>
    private double HighestAbove(Vector256<double> position)
    {
        var count = _planeCount;
        ref var planes = ref MemoryMarshal.GetArrayDataReference(_planes);
        var (x, y, z) = (Vector256.Create(position[0]), Vector256.Create(position[1]), Vector256.Create(position[2]));
        var most = Vector256.Create(double.NegativeInfinity);
        for (var i = 0; i < count; i += Lanes)
        {
            most = Vector256.MaxNative(most, Product(ref planes, i, count, x, y, z) - Vector256.LoadUnsafe(ref planes, (nuint)((3 * count) + i)));
        }

        return Largest(most);
    }

    /// <summary>The normal, in the frame of an image, of the plane that a position seems to be farthest above there.</summary>
    private Vector FarthestPlane(Vector local, in AffineMap inverse)
    {
        var count = _planeCount;
        ref var planes = ref MemoryMarshal.GetArrayDataReference(_planes);
        var (x, y, z) = (Vector256.Create(local.X), Vector256.Create(local.Y), Vector256.Create(local.Z));
        var (v1, v2, v3) = inverse.Linear;
        var (best, index) = (double.NegativeInfinity, 0);
        for (var i = 0; i < count; i += Lanes)
        {
            var height = Product(ref planes, i, count, x, y, z) - Vector256.LoadUnsafe(ref planes, (nuint)((3 * count) + i));
            var nx = Product(ref planes, i, count, Vector256.Create(v1.X), Vector256.Create(v1.Y), Vector256.Create(v1.Z));
            var ny = Product(ref planes, i, count, Vector256.Create(v2.X), Vector256.Create(v2.Y), Vector256.Create(v2.Z));
            var nz = Product(ref planes, i, count, Vector256.Create(v3.X), Vector256.Create(v3.Y), Vector256.Create(v3.Z));
            // Signs are kept: a negative height never wins over a positive one.
            var squared = height * Vector256.Abs(height) / ((nx * nx) + (ny * ny) + (nz * nz));
            for (var lane = 0; lane < Lanes; lane++)
            {
                (best, index) = squared[lane] > best ? (squared[lane], i + lane) : (best, index);
            }
        }

        Vector normal = new(_planes[index], _planes[count + index], _planes[(2 * count) + index]);
        return new(Vector.Dot(v1, normal), Vector.Dot(v2, normal), Vector.Dot(v3, normal));
    }

    /// <summary>How far the solid reaches in a direction.</summary>
    /// <param name="unit">Of length 1.</param>
    public double Reach(Vector256<double> unit) => Support(unit) + _margin;

    /// <summary>The largest product of a direction with a corner.</summary>
    private double Support(Vector256<double> direction)
    {
        var count = _vertexCount;
        ref var vertices = ref MemoryMarshal.GetArrayDataReference(_vertices);
        var (x, y, z) = (Vector256.Create(direction[0]), Vector256.Create(direction[1]), Vector256.Create(direction[2]));
        var most = Vector256.Create(double.NegativeInfinity);
        for (var i = 0; i < count; i += Lanes)
        {
            most = Vector256.MaxNative(most, Product(ref vertices, i, count, x, y, z));
        }

        return Largest(most);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> Product(
        ref double vectors, int first, int count, Vector256<double> x, Vector256<double> y, Vector256<double> z) =>
        (x * Vector256.LoadUnsafe(ref vectors, (nuint)first)) + (y * Vector256.LoadUnsafe(ref vectors, (nuint)(count + first)))
        + (z * Vector256.LoadUnsafe(ref vectors, (nuint)((2 * count) + first)));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static double Largest(Vector256<double> v)
    {
        var pair = Vector128.MaxNative(v.GetLower(), v.GetUpper());
        return Math.Max(pair[0], pair[1]);
    }

    private static int Padded(int count) => (count + Lanes - 1) / Lanes * Lanes;
}
