using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Hulls;

/// <summary>
/// The convex hull of a few vertices, widened by a margin. Its distance from a position is computed exactly, for searches where cheaper
/// bounds leave too many sub-fractals.
/// </summary>
/// <remarks>
/// The algorithm of Gilbert, Johnson and Keerthi (1988): a simplex of vertices moves towards the position. Each step's direction gives a
/// lower bound that holds whatever the rounding of the simplex, so the best of them is returned.
/// </remarks>
/// <param name="vertices">At least one vertex.</param>
/// <param name="margin">How far the solid reaches beyond the hull of the vertices, in scene units.</param>
internal sealed class ConvexSolid(ReadOnlySpan<Vector> vertices, double margin)
{
    private const int MaxSteps = 24;

    // The distance is exact to this part when a step comes no closer.
    private const double ConvergenceTolerance = 1e-14;

    private readonly double[] _rows = VectorX4.CreateRows(vertices, 3, static vertex => [vertex.X, vertex.Y, vertex.Z]);
    private readonly int _paddedCount = VectorX4.PaddedCount(vertices.Length);
    private readonly Vector256<double> _centre = SimdAffineMap.ToVector256(BoundingBox.Around(vertices).Centre);

    /// <summary>Number of bytes of the arrays.</summary>
    public long StorageBytes => (sizeof(double) * (long)_rows.Length) + 96;

    /// <summary>How far the solid reaches beyond the hull of the vertices, in scene units.</summary>
    public double Margin => margin;

    /// <summary>True for a solid that is a box parallel to the axes.</summary>
    public bool IsBox { get; private init; }

    /// <summary>Creates the solid box.</summary>
    public static ConvexSolid FromBox(BoundingBox box) => new([.. Enumerable.Range(0, 8).Select(box.Corner)], 0) { IsBox = true };

    /// <summary>Computes the squared distance of a position from the solid's image under a map, or a little less.</summary>
    /// <param name="position">In the frame of the image: x, y, z, 0.</param>
    /// <param name="map">From the solid's frame to that of the image.</param>
    /// <param name="cutoffSquared">The method may return early at this value.</param>
    public double LowerBoundSquared(Vector256<double> position, in SimdAffineMap map, double cutoffSquared)
    {
        var simplex = new SimplexDistance();
        var toSolid = SimdAffineMap.ToVector(map.Apply(_centre) - position);
        var bound = 0.0;
        for (var step = 0; step < MaxSteps; step++)
        {
            var lengthSquared = toSolid.LengthSquared();
            if (!(lengthSquared > 0))
            {
                // The position is inside, or beyond the range of a double.
                return bound;
            }

            var localDirection = map.MultiplyTransposed(SimdAffineMap.ToVector256(toSolid));
            var vertex = FindLowestVertex(localDirection);
            var toVertex = SimdAffineMap.ToVector(map.Apply(vertex) - position);
            var height = Vector.Dot(toSolid, toVertex);
            var separation = height - (margin * Math.Sqrt(Vector256.Dot(localDirection, localDirection)));
            if (separation > 0)
            {
                bound = Math.Max(bound, separation * (separation / lengthSquared));
            }

            if (!(bound < cutoffSquared) || lengthSquared - height <= ConvergenceTolerance * lengthSquared || !simplex.TryAdd(toVertex))
            {
                return bound;
            }

            toSolid = simplex.FindClosestToOrigin();
        }

        return bound;
    }

    /// <summary>Computes the largest product of a direction with a point of the solid.</summary>
    /// <param name="direction">In the solid's frame, of any length.</param>
    public double Support(Vector direction)
    {
        var vertex = FindLowestVertex(SimdAffineMap.ToVector256(-direction));
        return Vector.Dot(direction, SimdAffineMap.ToVector(vertex)) + (margin * direction.Length());
    }

    /// <summary>Finds the vertex with the smallest product with a direction.</summary>
    /// <param name="direction">In the solid's frame, of any length.</param>
    public Vector FindLowestVertex(Vector direction) =>
        SimdAffineMap.ToVector(FindLowestVertex(SimdAffineMap.ToVector256(direction)));

    /// <summary>Finds the vertex with the smallest product with a direction.</summary>
    private Vector256<double> FindLowestVertex(Vector256<double> direction)
    {
        var count = _paddedCount;
        ref var rows = ref MemoryMarshal.GetArrayDataReference(_rows);
        var directionX4 = VectorX4.Broadcast(direction);
        var lowest = Vector256.Create(double.PositiveInfinity);
        var lowestIndices = Vector256<long>.Zero;
        var indices = Vector256.Create(0L, 1, 2, 3);
        for (var i = 0; i < count; i += VectorX4.Count)
        {
            var product = VectorX4.Dot(directionX4, VectorX4.Load(ref rows, i, count));
            var isLower = Vector256.LessThan(product, lowest);
            lowest = Vector256.ConditionalSelect(isLower, product, lowest);
            lowestIndices = Vector256.ConditionalSelect(isLower.AsInt64(), indices, lowestIndices);
            indices += Vector256.Create((long)VectorX4.Count);
        }

        var best = 0;
        for (var lane = 1; lane < VectorX4.Count; lane++)
        {
            best = lowest[lane] < lowest[best] ? lane : best;
        }

        var index = (int)lowestIndices[best];
        return Vector256.Create(_rows[index], _rows[count + index], _rows[(2 * count) + index], 0);
    }
}
