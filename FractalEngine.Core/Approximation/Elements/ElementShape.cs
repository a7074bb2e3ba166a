using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Elements;

/// <summary>
/// The vertices of an element about their mean, with the products that no affine map changes: (p − c)ᵀ Σ⁻¹ (q − c), with Σ the
/// covariance of the vertices.
/// </summary>
/// <remarks>
/// A flat element has no extent along its normal, so that many maps take it to another one. Of these the one counts that stretches
/// normals by the square root of the stretch of areas, as a similarity does.
/// </remarks>
internal sealed class ElementShape
{
    // Below this ratio of variances an element counts as flat.
    private const double FlatVariance = 1e-14;

    private ElementShape(Vector[] points, Vector centroid, Matrix inverse, Vector normal, double size)
    {
        Points = points;
        Centroid = centroid;
        Inverse = inverse;
        Normal = normal;
        Size = size;
        Radii = [.. points.Select(point => Product(point - centroid, point - centroid))];
        Order = [.. Enumerable.Range(0, points.Length)];
        SortedRadii = [.. Radii];
        Array.Sort(SortedRadii, Order);
    }

    /// <summary>The vertices of the element, scene units.</summary>
    public Vector[] Points { get; }

    /// <summary>The mean of the vertices.</summary>
    public Vector Centroid { get; }

    /// <summary>The inverse of the vertices' covariance; of a flat element with the normal's variance added.</summary>
    public Matrix Inverse { get; }

    /// <summary>Of a flat element its normal, as long as the root of its variances in the plane; zero of all others.</summary>
    public Vector Normal { get; }

    /// <summary>Root of the mean squared distance from the centroid, scene units.</summary>
    public double Size { get; }

    /// <summary>Squared affine distance of each vertex from the centroid.</summary>
    public double[] Radii { get; }

    /// <summary>The vertices by rising radius.</summary>
    public int[] Order { get; }

    /// <summary>The radii of all vertices, the smallest first.</summary>
    public double[] SortedRadii { get; }

    /// <summary>Whether all vertices lie in one plane.</summary>
    public bool IsFlat => Normal != Vector.Zero;

    /// <summary>The affine product of two differences from the centroid.</summary>
    public double Product(Vector u, Vector v) => Vector.Dot(u, Inverse * v);

    /// <summary>Makes the shape of an element's vertices, or null where they lie on one line.</summary>
    /// <param name="points">The vertices.</param>
    /// <param name="noise">How far vertices may be from a plane that they lie in, scene units.</param>
    public static ElementShape? Create(Vector[] points, double noise = 0)
    {
        var centroid = points.Aggregate(Vector.Zero, (sum, point) => sum + (point / points.Length));
        var covariance = points.Aggregate(
            default(Matrix), (sum, point) => sum + (Matrix.Outer(point - centroid, point - centroid) / points.Length));
        var trace = covariance.V1.X + covariance.V2.Y + covariance.V3.Z;
        if (!(trace > 0) || !double.IsNormal(trace))
        {
            return null;
        }

        var relative = covariance / trace;
        var normal = Vector.Zero;
        var cofactorNorm = relative.Cofactors().MaxAbsEntry();
        if (relative.Determinant() <= Math.Max(FlatVariance, noise * noise / trace * cofactorNorm))
        {
            // The columns of the cofactors are multiples of the normal; their trace is the product of the two other variances.
            var cofactors = relative.Cofactors();
            var longest = new[] { cofactors.V1, cofactors.V2, cofactors.V3 }.MaxBy(column => column.LengthSquared());
            var area = cofactors.V1.X + cofactors.V2.Y + cofactors.V3.Z;
            if (area <= FlatVariance)
            {
                return null;
            }

            normal = Math.Sqrt(trace * Math.Sqrt(area)) * longest.UnitVector();
            relative += Matrix.Outer(normal, normal) / trace;
        }

        return new(points, centroid, relative.Inverse() / trace, normal, Math.Sqrt(trace));
    }
}
