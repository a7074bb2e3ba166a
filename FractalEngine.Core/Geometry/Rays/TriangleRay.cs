using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Rays;

/// <summary>
/// Tests a ray against four triangles at once, in double precision. The triangles are sheared so that the ray is an axis. Then the signs of
/// three areas tell on which side of each edge it passes: two triangles that share an edge see the same area with opposite signs, so that
/// no ray passes between them.
/// </summary>
/// <remarks>
/// After Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2013. Edges are widened by the rounding of the ray, so that
/// neighbours in different frames leave no gap either.
/// </remarks>
internal readonly struct TriangleRay
{
    /// <summary>Vectors of four triangles: x, y and z of the first vertices, then of the second and third.</summary>
    public const int VectorsPerQuad = 9;

    // The rounding of the direction of a query, and that after some levels of maps, as a part of its length.
    private const double QueryDirectionError = 1e-15;
    private const double MappedDirectionError = 1.6e-14;

    // Rounding is too large a part of an area that is a smaller part of the squared extent.
    private const double UncertainArea = 1e-3;

    // Largest area of an edge and a ray beside it, as a part of the triangle's. Lower triangles are seen nearly edge on.
    private const double MaxAreaBeside = 0.1;

    private readonly Vector _origin;
    private readonly Vector _direction;
    private readonly int _x;
    private readonly int _y;
    private readonly int _z;
    private readonly Vector256<double> _originX;
    private readonly Vector256<double> _originY;
    private readonly Vector256<double> _originZ;
    private readonly Vector256<double> _shearX;
    private readonly Vector256<double> _shearY;
    private readonly Vector256<double> _inverseZ;
    private readonly Vector256<double> _widening;
    private readonly Vector256<double> _directionError;
    private readonly double _start;

    /// <summary>Prepares a ray in the frame of the triangles.</summary>
    /// <param name="ray">The ray.</param>
    /// <param name="error">How far rounding may have moved it, in the frame of the query.</param>
    public TriangleRay(in LocalRay ray, double error)
    {
        var size = Vector256.Abs(ray.Direction);
        // The axis along which the ray runs fastest; the others in their order, or swapped: winding does not matter.
        _z = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
        _x = _z == 0 ? 1 : 0;
        _y = _z == 2 ? 1 : 2;
        var inverse = 1 / ray.Direction.GetElement(_z);
        _originX = Vector256.Create(ray.Origin.GetElement(_x));
        _originY = Vector256.Create(ray.Origin.GetElement(_y));
        _originZ = Vector256.Create(ray.Origin.GetElement(_z));
        _shearX = Vector256.Create(ray.Direction.GetElement(_x) * inverse);
        _shearY = Vector256.Create(ray.Direction.GetElement(_y) * inverse);
        _inverseZ = Vector256.Create(inverse);
        // Coordinates in the frame of the triangles may be larger than those of the query: maps lead back to the origin.
        var magnitude = Vector256.MaxNative(
            Vector256.MaxNative(Vector256.Abs(_originX), Vector256.Abs(_originY)), Vector256.Abs(_originZ));
        _widening = Vector256.Create(2 * ray.InverseScale * error) + (Vector256.Create(2 * RoundingErrors.Coordinate) * magnitude);
        _directionError = Vector256.Create(ray.Scale == 1 && ray.InverseScale == 1 ? QueryDirectionError : MappedDirectionError);
        _start = ray.Start;
        _origin = SimdAffineMap.ToVector(ray.Origin);
        _direction = SimdAffineMap.ToVector(ray.Direction);
    }

    /// <summary>Tests four triangles at once.</summary>
    /// <param name="quad">The first of <see cref="VectorsPerQuad"/> vectors.</param>
    /// <param name="search">Receives the nearest hit, with the number of the triangle from 0 to 3 as its face.</param>
    /// <returns>True when there is a nearer hit.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool TryIntersect(ref Vector256<double> quad, ref RaySearch search)
    {
        var az = Unsafe.Add(ref quad, _z) - _originZ;
        var bz = Unsafe.Add(ref quad, 3 + _z) - _originZ;
        var cz = Unsafe.Add(ref quad, 6 + _z) - _originZ;
        var ax = Unsafe.Add(ref quad, _x) - _originX - (_shearX * az);
        var bx = Unsafe.Add(ref quad, 3 + _x) - _originX - (_shearX * bz);
        var cx = Unsafe.Add(ref quad, 6 + _x) - _originX - (_shearX * cz);
        var ay = Unsafe.Add(ref quad, _y) - _originY - (_shearY * az);
        var by = Unsafe.Add(ref quad, 3 + _y) - _originY - (_shearY * bz);
        var cy = Unsafe.Add(ref quad, 6 + _y) - _originY - (_shearY * cz);
        var u = (cx * by) - (cy * bx);
        var v = (ax * cy) - (ay * cx);
        var w = (bx * ay) - (by * ax);
        var extent = Vector256.Abs(ax) + Vector256.Abs(ay) + Vector256.Abs(bx) + Vector256.Abs(by) + Vector256.Abs(cx) + Vector256.Abs(cy);
        var rounding = Vector256.Create(RoundingErrors.Coordinate) * extent;
        var sum = u + v + w;
        // Seen edge on, a triangle has no area but that of rounding, also of the direction, and is not hit. Nor is one without area.
        var depthExtent = Vector256.Abs(az) + Vector256.Abs(bz) + Vector256.Abs(cz);
        var isSeen = Vector256.GreaterThan(
            Vector256.Abs(sum), (rounding + (_directionError * depthExtent)) * extent);
        // All areas get the sign of a hit; those that have the other one are of edges that the ray passes outside.
        var sign = sum & Vector256.Create(-0.0);
        (u, v, w) = (u ^ sign, v ^ sign, w ^ sign);
        var least = Vector256.MinNative(Vector256.MinNative(u, v), w);
        // An area beside an edge is that of the edge, no longer than the extent, and of what the ray is off by: √3 times as much, sheared.
        var reach = _widening + rounding;
        var minArea = Vector256.MaxNative(-(reach + reach) * extent, Vector256.Create(-MaxAreaBeside) * Vector256.Abs(sum));
        var isClose = isSeen & Vector256.GreaterThanOrEqual(least, minArea);
        var close = isClose.ExtractMostSignificantBits();
        if (close == 0)
        {
            return false;
        }

        var depth = ((u * az) + (v * bz) + (w * cz)) / (u + v + w);
        var distances = Vector256.Create(_start) + (depth * _inverseZ);
        var inside = Vector256.GreaterThanOrEqual(least, Vector256<double>.Zero).ExtractMostSignificantBits();
        if ((close & ~inside) != 0)
        {
            distances = WithDistancesBeside(distances, close & ~inside, reach, ref quad);
        }

        var hits = isClose & Vector256.GreaterThanOrEqual(distances, Vector256.Create(search.MinDistance))
            & Vector256.LessThanOrEqual(distances, Vector256.Create(search.MaxDistance));
        var mask = hits.ExtractMostSignificantBits();
        if (mask == 0)
        {
            return false;
        }

        var isSmall = Vector256.LessThan(Vector256.Abs(sum), Vector256.Create(UncertainArea) * extent * extent);
        // Where a ray passes beside a face, it may cross the plane far from there.
        return TryUpdate(distances, mask, inside & isSmall.ExtractMostSignificantBits(), ref quad, ref search);
    }

    private bool TryUpdate(
        Vector256<double> distances, uint mask, uint uncertain, ref Vector256<double> quad, ref RaySearch search)
    {
        var isNearer = false;
        for (; mask != 0; mask &= mask - 1)
        {
            var lane = System.Numerics.BitOperations.TrailingZeroCount(mask);
            var distance = distances.GetElement(lane);
            if ((uncertain & (1u << lane)) != 0)
            {
                distance = CorrectDistance(distance, lane, ref quad);
                if (!(distance >= search.MinDistance))
                {
                    continue;
                }
            }

            if (distance < search.MaxDistance || (search.Face < 0 && distance <= search.MaxDistance))
            {
                search.MaxDistance = distance;
                search.Face = lane;
                isNearer = true;
            }
        }

        return isNearer;
    }

    /// <summary>Computes the distance of a triangle whose area is so small that rounding moves it.</summary>
    private double CorrectDistance(double distance, int lane, ref Vector256<double> quad)
    {
        var (a, b, c) = CornersOf(ref quad, lane);
        return _start + TrianglePlane.Correct(_origin, _direction, distance - _start, a, b, c);
    }

    /// <summary>
    /// Replaces the distances of triangles that the ray passes beside by those of the nearest edges; NaN where it passes by more than its
    /// rounding.
    /// </summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    private Vector256<double> WithDistancesBeside(
        Vector256<double> distances, uint lanes, Vector256<double> reach, ref Vector256<double> quad)
    {
        var speed = _direction.Length();
        for (; lanes != 0; lanes &= lanes - 1)
        {
            var lane = System.Numerics.BitOperations.TrailingZeroCount(lanes);
            var (a, b, c) = CornersOf(ref quad, lane);
            var (distance, apart) = TrianglePlane.ApproachEdges(_origin, _direction / speed, a, b, c);
            distances = distances.WithElement(lane, apart <= reach[lane] ? _start + (distance / speed) : double.NaN);
        }

        return distances;
    }

    private static (Vector A, Vector B, Vector C) CornersOf(ref Vector256<double> quad, int lane) =>
        (CornerOf(ref quad, lane), CornerOf(ref Unsafe.Add(ref quad, 3), lane), CornerOf(ref Unsafe.Add(ref quad, 6), lane));

    private static Vector CornerOf(ref Vector256<double> rows, int lane) => new(
        rows.GetElement(lane), Unsafe.Add(ref rows, 1).GetElement(lane), Unsafe.Add(ref rows, 2).GetElement(lane));
}
