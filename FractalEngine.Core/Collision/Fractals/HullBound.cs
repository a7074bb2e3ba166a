using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// A convex solid that holds a sub-fractal, as a bound of distances: near to it by the planes of its facets, far from it by how far it
/// reaches in the direction of the position. Both are exact where it matters: in front of a facet, and far from a corner or an edge.
/// </summary>
internal sealed class HullBound
{
    private const int Lanes = 4;

    // More save hardly any sub-fractals and cost time; the largest facets are kept.
    private const int MaxPlanes = 16;
    private const int MaxPlanesWithAxes = 32;
    private const int MaxSmallHullVertices = 2 * Lanes;

    // In half sizes: from there on a facet's plane says hardly more than how far the solid reaches.
    private const double FarFactor = 4;

    private const double AxisParallelCosine = 1 - 1e-12;

    private readonly double[] _planes;
    private readonly double[] _vertices;
    private readonly int _planeCount;
    private readonly int _vertexCount;
    private readonly Vector256<double>[] _smallHullVertices = [];
    private readonly Vector256<double> _centre;
    private readonly double _farDistanceSquared;
    private readonly double _margin;

    /// <summary>A hull, widened by a margin on all sides.</summary>
    /// <param name="hull">May be flat.</param>
    /// <param name="box">Around the hull.</param>
    /// <param name="margin">Not negative.</param>
    /// <param name="includeAxisPlanes">
    /// False where the planes of an axis-parallel box are looked at elsewhere. Skewed maps need them, and more of the others.
    /// </param>
    public HullBound(ConvexHull hull, BoundingBox box, double margin, bool includeAxisPlanes)
    {
        var planes = hull.Planes.Where(plane => includeAxisPlanes || plane.Normal.MaxAbsComponent() < AxisParallelCosine)
            .Take(includeAxisPlanes ? MaxPlanesWithAxes : MaxPlanes).ToArray();
        (_centre, _farDistanceSquared, _margin) =
            (SimdAffineMap.ToVector256(box.Centre), FarFactor * FarFactor * 0.25 * box.Size.LengthSquared(), margin);
        Planes = [.. planes.Select(plane => plane with { Offset = plane.Offset + margin })];
        (_planeCount, _vertexCount) = (RoundUpToLanes(planes.Length), RoundUpToLanes(hull.Vertices.Length));
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

        if (_vertexCount <= MaxSmallHullVertices)
        {
            _smallHullVertices =
                [.. Enumerable.Range(0, _vertexCount)
                .Select(i => Vector256.Create(_vertices[i], _vertices[_vertexCount + i], _vertices[(2 * _vertexCount) + i], 0))];
        }
    }

    /// <summary>The planes, those that fill the last lanes left out.</summary>
    public IReadOnlyList<HullPlane> Planes { get; }

    /// <summary>Bytes of the arrays.</summary>
    public long StorageBytes => sizeof(double) * (long)(_planes.Length + _vertices.Length + (4 * _smallHullVertices.Length));

    /// <summary>At most the squared distance of a position from the solid.</summary>
    /// <param name="position">In the solid's frame: x, y, z, 0.</param>
    /// <param name="cutoffSquared">A bound so large is as good as any larger one.</param>
    public double LowerBoundSquared(Vector256<double> position, double cutoffSquared)
    {
        var direction = position - _centre;
        var directionLengthSquared = Vector256.Dot(direction, direction);
        var bound = 0.0;
        if (directionLengthSquared < _farDistanceSquared)
        {
            var height = MaxPlaneHeight(position);
            bound = height > 0 ? height * height : 0;
            if (!(bound < cutoffSquared))
            {
                return bound;
            }
        }

        if (_smallHullVertices.Length == 0)
        {
            return Math.Max(bound, SeparationSquared(direction, directionLengthSquared, position, VertexSupport(direction)));
        }

        bound = Math.Max(bound,
            SeparationSquared(direction, directionLengthSquared, position, VertexSupport(direction, out var supportVertex)));
        if (bound < cutoffSquared)
        {
            // Seen from the corner that reaches farthest: exact where that is the nearest, as it mostly is for solids of few corners.
            direction = position - supportVertex;
            bound = Math.Max(bound, SeparationSquared(direction, Vector256.Dot(direction, direction), position, VertexSupport(direction)));
        }

        return bound;
    }

    /// <summary>The squared distance by which a position lies beyond the solid in some direction, 0 if it does not.</summary>
    /// <param name="direction">Of any length.</param>
    /// <param name="directionLengthSquared">Of its length.</param>
    /// <param name="position">In the solid's frame.</param>
    /// <param name="support">How far the solid reaches in the direction.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private double SeparationSquared(Vector256<double> direction, double directionLengthSquared, Vector256<double> position, double support)
    {
        var separation = Vector256.Dot(direction, position) - support - (_margin * Math.Sqrt(directionLengthSquared));
        return separation > 0 ? separation * separation / directionLengthSquared : 0;
    }

    /// <summary>The largest product of a direction with one of few corners, and which that is.</summary>
    private double VertexSupport(Vector256<double> direction, out Vector256<double> supportVertex)
    {
        ref var vertices = ref MemoryMarshal.GetArrayDataReference(_vertices);
        var (x, y, z) = (Vector256.Create(direction[0]), Vector256.Create(direction[1]), Vector256.Create(direction[2]));
        var firstProducts = DotX4(ref vertices, 0, _vertexCount, x, y, z);
        var secondProducts = DotX4(ref vertices, _vertexCount - Lanes, _vertexCount, x, y, z);
        var maxProduct = HorizontalMax(Vector256.MaxNative(firstProducts, secondProducts));
        var matchMask = Vector256.Equals(firstProducts, Vector256.Create(maxProduct)).ExtractMostSignificantBits()
            | (Vector256.Equals(secondProducts, Vector256.Create(maxProduct)).ExtractMostSignificantBits() << (_vertexCount - Lanes));
        supportVertex = _smallHullVertices[System.Numerics.BitOperations.TrailingZeroCount(matchMask)];
        return maxProduct;
    }

    /// <summary>At most the squared distance of a position from the image of the solid under any map.</summary>
    /// <param name="position">In the frame of the image: x, y, z, 0.</param>
    /// <param name="map">From the solid's frame to that of the image.</param>
    /// <param name="inverse">Its inverse, which need not be accurate: it only says where to look.</param>
    /// <param name="cutoffSquared">A bound so large is as good as any larger one.</param>
    public double TransformedLowerBoundSquared(Vector256<double> position, in SimdAffineMap map, in SimdAffineMap inverse,
        double cutoffSquared)
    {
        var bound = TransformedSeparationSquared(position - map.Apply(_centre), position, in map);
        if (bound < cutoffSquared && _planeCount > 0)
        {
            var local = inverse.Apply(position);
            var fromCentre = local - _centre;
            bound = Vector256.Dot(fromCentre, fromCentre) < 10 * _farDistanceSquared
                ? Math.Max(bound, TransformedSeparationSquared(FarthestPlaneNormal(local, in inverse), position, in map))
                : bound;
        }

        return bound;
    }

    /// <summary>The squared distance by which a position lies beyond the image in some direction, 0 if it does not.</summary>
    private double TransformedSeparationSquared(Vector256<double> direction, Vector256<double> position, in SimdAffineMap map)
    {
        var localDirection = map.MultiplyTransposed(direction);
        var separation = Vector256.Dot(direction, position - map.Translation) - VertexSupport(localDirection)
            - (_margin * Length(localDirection));
        return separation > 0 ? separation * separation / Vector256.Dot(direction, direction) : 0;
    }

    /// <summary>The largest height of a position above a plane; negative inside.</summary>
    private double MaxPlaneHeight(Vector256<double> position)
    {
        var count = _planeCount;
        ref var planes = ref MemoryMarshal.GetArrayDataReference(_planes);
        var (x, y, z) = (Vector256.Create(position[0]), Vector256.Create(position[1]), Vector256.Create(position[2]));
        var maxHeight = Vector256.Create(double.NegativeInfinity);
        for (var i = 0; i < count; i += Lanes)
        {
            maxHeight =
                Vector256.MaxNative(maxHeight, DotX4(ref planes, i, count, x, y, z)
                    - Vector256.LoadUnsafe(ref planes, (nuint)((3 * count) + i)));
        }

        return HorizontalMax(maxHeight);
    }

    /// <summary>The normal, in the frame of an image, of the plane that a position seems to be farthest above there.</summary>
    private Vector256<double> FarthestPlaneNormal(Vector256<double> localPosition, in SimdAffineMap inverse)
    {
        var count = _planeCount;
        ref var planes = ref MemoryMarshal.GetArrayDataReference(_planes);
        var positionX4 = VectorX4.Broadcast(localPosition);
        var (v1, v2, v3) = (VectorX4.Broadcast(inverse.V1), VectorX4.Broadcast(inverse.V2), VectorX4.Broadcast(inverse.V3));
        var (maxHeightSquared, index) = (Vector256.Create(double.NegativeInfinity), Vector256<long>.Zero);
        var (planeIndices, step) = (Vector256.Create(0L, 1, 2, 3), Vector256.Create((long)Lanes));
        for (var i = 0; i < count; i += Lanes)
        {
            var normal = VectorX4.Load(ref planes, i, count);
            var height = VectorX4.Dot(normal, positionX4) - Vector256.LoadUnsafe(ref planes, (nuint)((3 * count) + i));
            VectorX4 transformedNormal = new(VectorX4.Dot(normal, v1), VectorX4.Dot(normal, v2), VectorX4.Dot(normal, v3));
            // With its sign, so that a position below a plane is never higher than one above another.
            var heightSquared = height * Vector256.Abs(height) / transformedNormal.LengthSquared();
            var isHigher = Vector256.GreaterThan(heightSquared, maxHeightSquared);
            maxHeightSquared = Vector256.ConditionalSelect(isHigher, heightSquared, maxHeightSquared);
            index = Vector256.ConditionalSelect(isHigher.AsInt64(), planeIndices, index);
            planeIndices += step;
        }

        var (bestHeightSquared, plane) = (maxHeightSquared[0], index[0]);
        for (var lane = 1; lane < Lanes; lane++)
        {
            (bestHeightSquared, plane) = maxHeightSquared[lane] > bestHeightSquared
                ? (maxHeightSquared[lane], index[lane])
                : (bestHeightSquared, plane);
        }

        return inverse.MultiplyTransposed(Vector256.Create(_planes[plane], _planes[count + plane], _planes[(2 * count) + plane], 0));
    }

    /// <summary>How far the solid reaches in a direction.</summary>
    /// <param name="unitDirection">Of length 1.</param>
    public double Support(Vector256<double> unitDirection) => VertexSupport(unitDirection) + _margin;

    /// <summary>The largest product of a direction with a corner.</summary>
    private double VertexSupport(Vector256<double> direction)
    {
        var count = _vertexCount;
        ref var vertices = ref MemoryMarshal.GetArrayDataReference(_vertices);
        var (x, y, z) = (Vector256.Create(direction[0]), Vector256.Create(direction[1]), Vector256.Create(direction[2]));
        var maxProduct = Vector256.Create(double.NegativeInfinity);
        for (var i = 0; i < count; i += Lanes)
        {
            maxProduct = Vector256.MaxNative(maxProduct, DotX4(ref vertices, i, count, x, y, z));
        }

        return HorizontalMax(maxProduct);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> DotX4(
        ref double rows, int first, int count, Vector256<double> x, Vector256<double> y, Vector256<double> z) =>
        (x * Vector256.LoadUnsafe(ref rows, (nuint)first)) + (y * Vector256.LoadUnsafe(ref rows, (nuint)(count + first)))
        + (z * Vector256.LoadUnsafe(ref rows, (nuint)((2 * count) + first)));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static double HorizontalMax(Vector256<double> v)
    {
        var pair = Vector128.MaxNative(v.GetLower(), v.GetUpper());
        return Math.Max(pair[0], pair[1]);
    }

    private static double Length(Vector256<double> v) => Math.Sqrt(Vector256.Dot(v, v));

    private static int RoundUpToLanes(int count) => (count + Lanes - 1) / Lanes * Lanes;
}
