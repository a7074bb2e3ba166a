using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Core.Geometry.Hulls;

/// <summary>
/// Computes lower bounds of distances from a convex solid that contains a sub-fractal. Near the solid they come from the planes of its
/// facets, far from it from its support in the direction of the position.
/// </summary>
/// <remarks>Both are exact where it matters: in front of a facet, and far from a vertex or an edge.</remarks>
internal sealed class HullBound
{
    // More planes save hardly any sub-fractals and cost time; those of the largest facets are kept.
    private const int MaxPlanes = 16;
    private const int MaxPlanesWithAxes = 32;
    private const int MaxSmallHullVertices = 2 * VectorX4.Count;

    // In half sizes: from there on a facet's plane bounds hardly better than the support.
    private const double FarFactor = 4;

    // Relative to the square of that: a plane under a map costs the search for it alone, since the support of the box was computed before.
    private const double TransformedFarRatio = 10;

    private const double AxisParallelCosine = 1 - 1e-12;

    private readonly double[] _planes;
    private readonly double[] _vertices;
    private readonly int _planeCount;
    private readonly int _vertexCount;
    private readonly int _hullVertexCount;
    private readonly Vector256<double>[] _smallHullVertices = [];
    private readonly Vector256<double> _centre;
    private readonly double _farDistanceSquared;

    /// <summary>Prepares a hull that is widened by a margin on all sides.</summary>
    /// <param name="hull">The hull, which may be flat.</param>
    /// <param name="box">A box around the hull.</param>
    /// <param name="margin">The margin in scene units, not negative.</param>
    /// <param name="includeAxisPlanes">
    /// False where the planes of an axis-parallel box are tested elsewhere. Skewed maps need them, and more of the others.
    /// </param>
    public HullBound(ConvexHull hull, BoundingBox box, double margin, bool includeAxisPlanes)
    {
        var planes = hull.Planes.Where(plane => includeAxisPlanes || plane.Normal.MaxAbsComponent() < AxisParallelCosine)
            .Take(includeAxisPlanes ? MaxPlanesWithAxes : MaxPlanes).ToArray();
        Planes = [.. planes.Select(plane => plane with { Offset = plane.Offset + margin })];
        _centre = SimdAffineMap.ToVector256(box.Centre);
        _farDistanceSquared = FarFactor * FarFactor * 0.25 * box.Size.LengthSquared();
        Margin = margin;
        _planeCount = VectorX4.PaddedCount(planes.Length);
        _planes = VectorX4.CreateRows<HullPlane>(
            planes, 4, plane => [plane.Normal.X, plane.Normal.Y, plane.Normal.Z, plane.Offset + margin]);
        _hullVertexCount = hull.Vertices.Length;
        _vertexCount = VectorX4.PaddedCount(hull.Vertices.Length);
        _vertices = VectorX4.CreateRows<Vector>(hull.Vertices, 3, static vertex => [vertex.X, vertex.Y, vertex.Z]);
        if (_vertexCount <= MaxSmallHullVertices)
        {
            _smallHullVertices = [.. Enumerable.Range(0, _vertexCount)
                .Select(i => Vector256.Create(_vertices[i], _vertices[_vertexCount + i], _vertices[(2 * _vertexCount) + i], 0))];
        }
    }

    /// <summary>The planes of the solid, without those that fill the last lanes.</summary>
    public IReadOnlyList<HullPlane> Planes { get; }

    /// <summary>The vertices of the hull, in front of the margin.</summary>
    public Vector[] CopyVertices() =>
        [.. Enumerable.Range(0, _hullVertexCount).Select(
            i => new Vector(_vertices[i], _vertices[_vertexCount + i], _vertices[(2 * _vertexCount) + i]))];

    /// <summary>How far the solid reaches beyond its vertices.</summary>
    public double Margin { get; }

    /// <summary>Number of bytes of the arrays.</summary>
    public long StorageBytes => sizeof(double) * (long)(_planes.Length + _vertices.Length + (4 * _smallHullVertices.Length));

    /// <summary>Computes a lower bound of a position's squared distance from the solid.</summary>
    /// <param name="position">In the solid's frame: x, y, z, 0.</param>
    /// <param name="cutoffSquared">The method may return early at this value.</param>
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

        var support = SmallHullSupport(direction, out var supportVertex);
        bound = Math.Max(bound, SeparationSquared(direction, directionLengthSquared, position, support));
        if (bound < cutoffSquared)
        {
            // The direction from the support vertex is exact where that is the closest point, as it mostly is for solids of few vertices.
            direction = position - supportVertex;
            bound = Math.Max(bound, SeparationSquared(direction, Vector256.Dot(direction, direction), position, VertexSupport(direction)));
        }

        return bound;
    }

    /// <summary>Computes a lower bound of a position's squared distance from the solid's image under any map.</summary>
    /// <param name="position">In the frame of the image: x, y, z, 0.</param>
    /// <param name="map">From the solid's frame to that of the image.</param>
    /// <param name="inverse">From the frame of the image to the solid's. It need not be accurate: it only selects a direction.</param>
    /// <param name="cutoffSquared">The method may return early at this value.</param>
    public double TransformedLowerBoundSquared(
        Vector256<double> position, in SimdAffineMap map, in SimdAffineMap inverse, double cutoffSquared)
    {
        var bound = TransformedSeparationSquared(position - map.Apply(_centre), position, in map);
        if (bound < cutoffSquared && _planeCount > 0)
        {
            var localPosition = inverse.Apply(position);
            var fromCentre = localPosition - _centre;
            bound = Vector256.Dot(fromCentre, fromCentre) < TransformedFarRatio * _farDistanceSquared
                ? Math.Max(bound, TransformedSeparationSquared(FarthestPlaneNormal(localPosition, in inverse), position, in map))
                : bound;
        }

        return bound;
    }

    /// <summary>Computes the support of the solid: how far it reaches in a direction.</summary>
    /// <param name="unitDirection">Direction of length 1: x, y, z, 0.</param>
    public double Support(Vector256<double> unitDirection) => VertexSupport(unitDirection) + Margin;

    /// <summary>Computes the squared distance by which a position lies beyond the solid in a direction; 0 if it does not.</summary>
    /// <param name="direction">Direction of any length.</param>
    /// <param name="directionLengthSquared">Squared length of the direction.</param>
    /// <param name="position">In the solid's frame.</param>
    /// <param name="support">Largest product of the direction with a vertex of the hull.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private double SeparationSquared(Vector256<double> direction, double directionLengthSquared, Vector256<double> position, double support)
    {
        var separation = Vector256.Dot(direction, position) - support - (Margin * Math.Sqrt(directionLengthSquared));
        return separation > 0 ? separation * (separation / directionLengthSquared) : 0;
    }

    /// <summary>Computes the squared distance by which a position lies beyond the image in a direction; 0 if it does not.</summary>
    private double TransformedSeparationSquared(Vector256<double> direction, Vector256<double> position, in SimdAffineMap map)
    {
        var localDirection = map.MultiplyTransposed(direction);
        var separation = Vector256.Dot(direction, position - map.Translation) - VertexSupport(localDirection)
            - (Margin * Length(localDirection));
        return separation > 0 ? separation * (separation / Vector256.Dot(direction, direction)) : 0;
    }

    /// <summary>Computes the largest height of a position above a plane; negative inside.</summary>
    private double MaxPlaneHeight(Vector256<double> position)
    {
        var count = _planeCount;
        ref var planes = ref MemoryMarshal.GetArrayDataReference(_planes);
        var positionX4 = VectorX4.Broadcast(position);
        var maxHeight = Vector256.Create(double.NegativeInfinity);
        for (var i = 0; i < count; i += VectorX4.Count)
        {
            var height = VectorX4.Dot(positionX4, VectorX4.Load(ref planes, i, count))
                - Vector256.LoadUnsafe(ref planes, (nuint)((3 * count) + i));
            maxHeight = Vector256.MaxNative(maxHeight, height);
        }

        return VectorX4.HorizontalMax(maxHeight);
    }

    /// <summary>Computes the normal, in the frame of an image, of the plane that a position seems to be farthest above there.</summary>
    private Vector256<double> FarthestPlaneNormal(Vector256<double> localPosition, in SimdAffineMap inverse)
    {
        var count = _planeCount;
        ref var planes = ref MemoryMarshal.GetArrayDataReference(_planes);
        var positionX4 = VectorX4.Broadcast(localPosition);
        var (v1, v2, v3) = (VectorX4.Broadcast(inverse.V1), VectorX4.Broadcast(inverse.V2), VectorX4.Broadcast(inverse.V3));
        var maxHeightSquared = Vector256.Create(double.NegativeInfinity);
        var highestPlanes = Vector256<long>.Zero;
        var planeIndices = Vector256.Create(0L, 1, 2, 3);
        var step = Vector256.Create((long)VectorX4.Count);
        for (var i = 0; i < count; i += VectorX4.Count)
        {
            var normal = VectorX4.Load(ref planes, i, count);
            var height = VectorX4.Dot(normal, positionX4) - Vector256.LoadUnsafe(ref planes, (nuint)((3 * count) + i));
            VectorX4 transformedNormal = new(VectorX4.Dot(normal, v1), VectorX4.Dot(normal, v2), VectorX4.Dot(normal, v3));
            // The square keeps its sign, so that a position below a plane is never higher than one above another.
            var heightSquared = height * Vector256.Abs(height) / transformedNormal.LengthSquared();
            var isHigher = Vector256.GreaterThan(heightSquared, maxHeightSquared);
            maxHeightSquared = Vector256.ConditionalSelect(isHigher, heightSquared, maxHeightSquared);
            highestPlanes = Vector256.ConditionalSelect(isHigher.AsInt64(), planeIndices, highestPlanes);
            planeIndices += step;
        }

        var bestHeightSquared = maxHeightSquared[0];
        var bestPlane = highestPlanes[0];
        for (var lane = 1; lane < VectorX4.Count; lane++)
        {
            if (maxHeightSquared[lane] > bestHeightSquared)
            {
                bestHeightSquared = maxHeightSquared[lane];
                bestPlane = highestPlanes[lane];
            }
        }

        return inverse.MultiplyTransposed(
            Vector256.Create(_planes[bestPlane], _planes[count + bestPlane], _planes[(2 * count) + bestPlane], 0));
    }

    /// <summary>Computes the largest product of a direction with a vertex.</summary>
    private double VertexSupport(Vector256<double> direction)
    {
        var count = _vertexCount;
        ref var vertices = ref MemoryMarshal.GetArrayDataReference(_vertices);
        var directionX4 = VectorX4.Broadcast(direction);
        var maxProduct = Vector256.Create(double.NegativeInfinity);
        for (var i = 0; i < count; i += VectorX4.Count)
        {
            maxProduct = Vector256.MaxNative(maxProduct, VectorX4.Dot(directionX4, VectorX4.Load(ref vertices, i, count)));
        }

        return VectorX4.HorizontalMax(maxProduct);
    }

    /// <summary>Computes the largest product of a direction with a vertex of a small hull, and that vertex.</summary>
    private double SmallHullSupport(Vector256<double> direction, out Vector256<double> supportVertex)
    {
        ref var vertices = ref MemoryMarshal.GetArrayDataReference(_vertices);
        var directionX4 = VectorX4.Broadcast(direction);
        // Hulls of up to four vertices fill one vector, which is then read twice.
        var secondStart = _vertexCount - VectorX4.Count;
        var firstProducts = VectorX4.Dot(directionX4, VectorX4.Load(ref vertices, 0, _vertexCount));
        var secondProducts = VectorX4.Dot(directionX4, VectorX4.Load(ref vertices, secondStart, _vertexCount));
        var maxProduct = VectorX4.HorizontalMax(Vector256.MaxNative(firstProducts, secondProducts));
        var matchMask = Vector256.Equals(firstProducts, Vector256.Create(maxProduct)).ExtractMostSignificantBits()
            | (Vector256.Equals(secondProducts, Vector256.Create(maxProduct)).ExtractMostSignificantBits() << secondStart);
        supportVertex = _smallHullVertices[BitOperations.TrailingZeroCount(matchMask)];
        return maxProduct;
    }

    private static double Length(Vector256<double> v) => Math.Sqrt(Vector256.Dot(v, v));
}
