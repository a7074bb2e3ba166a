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
    private const double AlongAxis = 1 - 1e-12;

    private readonly double[] _planes;
    private readonly double[] _vertices;
    private readonly int _planeCount;
    private readonly int _vertexCount;
    private readonly Vector _centre;
    private readonly double _margin;

    /// <summary>A hull, widened by a margin on all sides.</summary>
    /// <param name="hull">May be flat.</param>
    /// <param name="centre">Somewhere inside.</param>
    /// <param name="margin">Not negative.</param>
    /// <param name="withAxes">False where the planes of an axis-parallel box are looked at elsewhere.</param>
    public HullBound(ConvexHull hull, Vector centre, double margin, bool withAxes)
    {
        var planes = hull.Planes.Where(plane => withAxes || plane.Normal.MaximumComponent() < AlongAxis).Take(MostPlanes).ToArray();
        (_centre, _margin) = (centre, margin);
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
    }

    /// <summary>Bytes of the arrays.</summary>
    public long StorageBytes => sizeof(double) * (long)(_planes.Length + _vertices.Length);

    /// <summary>At most the squared distance of a position from the solid.</summary>
    /// <param name="position">In the solid's frame.</param>
    /// <param name="enough">A bound so large is as good as any larger one.</param>
    public double DistanceSquared(in Vector position, double enough)
    {
        var height = HighestAbove(in position);
        var bound = height > 0 ? height * height : 0;
        if (!(bound < enough))
        {
            return bound;
        }

        var direction = position - _centre;
        var reach = Vector.Dot(direction, position) - Support(in direction);
        if (reach > 0)
        {
            var squared = direction.LengthSquared();
            reach = (reach / Math.Sqrt(squared)) - _margin;
            bound = reach > 0 ? Math.Max(bound, reach * reach) : bound;
        }

        return bound;
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
        Vector pulledBack = new(
            Vector.Dot(map.Linear.V1, direction), Vector.Dot(map.Linear.V2, direction), Vector.Dot(map.Linear.V3, direction));
        var reach = Vector.Dot(direction, position - map.Translation) - Support(in pulledBack);
        if (!(reach > 0))
        {
            return 0;
        }

        reach = (reach / direction.Length()) - margin;
        return reach > 0 ? reach * reach : 0;
    }

    /// <summary>The largest height of a position above a plane; negative inside.</summary>
    private double HighestAbove(in Vector position)
    {
        var count = _planeCount;
        ref var planes = ref MemoryMarshal.GetArrayDataReference(_planes);
        var (x, y, z) = (Vector256.Create(position.X), Vector256.Create(position.Y), Vector256.Create(position.Z));
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

    /// <summary>The largest product of a direction with a corner.</summary>
    private double Support(in Vector direction)
    {
        var count = _vertexCount;
        ref var vertices = ref MemoryMarshal.GetArrayDataReference(_vertices);
        var (x, y, z) = (Vector256.Create(direction.X), Vector256.Create(direction.Y), Vector256.Create(direction.Z));
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
