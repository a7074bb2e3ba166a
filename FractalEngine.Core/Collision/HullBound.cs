using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Collision;

/// <summary>
/// A convex solid that holds a sub-fractal, as a bound of distances: near to it by the planes of its facets, far from it by how far it
/// reaches in the direction of the position. Both are exact where it matters: in front of a facet, and far from a corner or an edge.
/// </summary>
internal sealed class HullBound
{
    private const int Lanes = 4;

    // More save hardly any sub-fractals and cost time; the largest facets are kept.
    private const int MostPlanes = 16;
    private const int MostPlanesWithAxes = 32;
    private const int FewVertices = 2 * Lanes;

    // In half sizes: from there on a facet's plane says hardly more than how far the solid reaches.
    private const double Far = 4;

    private const double AlongAxis = 1 - 1e-12;

    private readonly double[] _planes;
    private readonly double[] _vertices;
    private readonly int _planeCount;
    private readonly int _vertexCount;
    private readonly Vector256<double>[] _corners = [];
    private readonly Vector256<double> _centre;
    private readonly double _farSquared;
    private readonly double _margin;

    /// <summary>A hull, widened by a margin on all sides.</summary>
    /// <param name="hull">May be flat.</param>
    /// <param name="box">Around the hull.</param>
    /// <param name="margin">Not negative.</param>
    /// <param name="withAxes">False where the planes of an axis-parallel box are looked at elsewhere. Skewed maps need them, and more of the others.</param>
    public HullBound(ConvexHull hull, BoundingBox box, double margin, bool withAxes)
    {
        var planes = hull.Planes.Where(plane => withAxes || plane.Normal.MaximumComponent() < AlongAxis).Take(withAxes ? MostPlanesWithAxes : MostPlanes).ToArray();
        (_centre, _farSquared, _margin) = (AffineLanes.Of(box.Centre), Far * Far * 0.25 * box.Size.LengthSquared(), margin);
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
        var direction = position - _centre;
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
        var reach = Vector256.Dot(direction, position) - support - (_margin * Math.Sqrt(squared));
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
    /// <param name="position">In the frame of the image: x, y, z, 0.</param>
    /// <param name="map">From the solid's frame to that of the image.</param>
    /// <param name="inverse">Its inverse, which need not be accurate: it only says where to look.</param>
    /// <param name="enough">A bound so large is as good as any larger one.</param>
    public double ImageDistanceSquared(Vector256<double> position, in AffineLanes map, in AffineLanes inverse, double enough)
    {
        var bound = BeyondImage(position - map.Apply(_centre), position, in map);
        if (bound < enough && _planeCount > 0)
        {
            var local = inverse.Apply(position);
            var fromCentre = local - _centre;
            bound = Vector256.Dot(fromCentre, fromCentre) < 10 * _farSquared
                ? Math.Max(bound, BeyondImage(FarthestPlane(local, in inverse), position, in map))
                : bound;
        }

        return bound;
    }

    /// <summary>The squared distance by which a position lies beyond the image in some direction, 0 if it does not.</summary>
    private double BeyondImage(Vector256<double> direction, Vector256<double> position, in AffineLanes map)
    {
        var pulledBack = map.PullBack(direction);
        var reach = Vector256.Dot(direction, position - map.Translation) - Support(pulledBack) - (_margin * Length(pulledBack));
        return reach > 0 ? reach * reach / Vector256.Dot(direction, direction) : 0;
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
    private Vector256<double> FarthestPlane(Vector256<double> local, in AffineLanes inverse)
    {
        var count = _planeCount;
        ref var planes = ref MemoryMarshal.GetArrayDataReference(_planes);
        var p = VectorQuartet.All(local);
        var (v1, v2, v3) = (VectorQuartet.All(inverse.V1), VectorQuartet.All(inverse.V2), VectorQuartet.All(inverse.V3));
        var (most, index) = (Vector256.Create(double.NegativeInfinity), Vector256<long>.Zero);
        var (lanes, step) = (Vector256.Create(0L, 1, 2, 3), Vector256.Create((long)Lanes));
        for (var i = 0; i < count; i += Lanes)
        {
            var normal = VectorQuartet.Load(ref planes, i, count);
            var height = VectorQuartet.Dot(normal, p) - Vector256.LoadUnsafe(ref planes, (nuint)((3 * count) + i));
            VectorQuartet image = new(VectorQuartet.Dot(normal, v1), VectorQuartet.Dot(normal, v2), VectorQuartet.Dot(normal, v3));
            // With its sign, so that a position below a plane is never higher than one above another.
            var squared = height * Vector256.Abs(height) / image.LengthSquared();
            var isHigher = Vector256.GreaterThan(squared, most);
            most = Vector256.ConditionalSelect(isHigher, squared, most);
            index = Vector256.ConditionalSelect(isHigher.AsInt64(), lanes, index);
            lanes += step;
        }

        var (best, plane) = (most[0], index[0]);
        for (var lane = 1; lane < Lanes; lane++)
        {
            (best, plane) = most[lane] > best ? (most[lane], index[lane]) : (best, plane);
        }

        return inverse.PullBack(Vector256.Create(_planes[plane], _planes[count + plane], _planes[(2 * count) + plane], 0));
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

    private static double Length(Vector256<double> v) => Math.Sqrt(Vector256.Dot(v, v));

    private static int Padded(int count) => (count + Lanes - 1) / Lanes * Lanes;
}
