using FractalEngine.Core.Distances;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Symmetries;

/// <summary>Looks for the plane about which a surface comes closest to its own mirror image.</summary>
/// <remarks>
/// Planes of many directions through the centroid are compared by a few points of the surface; the best ones are moved by closest
/// points (P. Besl, N. McKay, "A method for registration of 3-D shapes", 1992) until they stand still.
/// </remarks>
public static class MirrorSearch
{
    private const int Directions = 400;
    private const int CoarseSamples = 120;
    private const int FineSamples = 1_500;
    private const int RefinedPlanes = 6;
    private const int MaxSteps = 200;

    // Steps of the inverse iteration; it begins anew with each closest points, where the last one ended.
    private const int PowerSteps = 40;
    private const double MaxShift = 1.01;

    // A larger share of the mean distance is no noise of the samples.
    private const double Indifference = 0.02;

    /// <summary>Finds the plane with the smallest mean distance between the surface and its image.</summary>
    /// <param name="mesh">A surface with area.</param>
    /// <param name="cancellation">Ends the search early.</param>
    /// <remarks>Cost some 10⁵ closest points. The same mesh gives the same bits.</remarks>
    public static MirrorPlane Find(Mesh mesh, CancellationToken cancellation)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        var target = new TargetSurface(mesh);
        var (coarse, fine) = (SampleEvenly(mesh, CoarseSamples), SampleEvenly(mesh, FineSamples));
        var centroid = Vector.Mean(fine);
        return SpreadDirections().Select(normal => Measured(normal, Vector.Dot(normal, centroid), coarse))
            .OrderBy(plane => plane.MeanDistance).Take(RefinedPlanes).ToArray()
            .Select(Refine).MinBy(plane => plane.MeanDistance) is var best && Simplified(best!) is { } simple ? simple : best!;

        MirrorPlane Measured(Vector normal, double offset, Vector[] samples)
        {
            cancellation.ThrowIfCancellationRequested();
            var plane = new MirrorPlane(normal, offset, 0);
            var reflection = plane.Reflection;
            var face = 0;
            var sum = 0.0;
            foreach (var sample in samples)
            {
                var closest = target.Measure(reflection * sample, face);
                (sum, face) = (sum + closest.Distance, closest.Face);
            }

            return plane with { MeanDistance = sum / samples.Length };
        }

        // People model along axes, and about the origin. Where such a plane is as good, it has round numbers.
        MirrorPlane? Simplified(MirrorPlane plane)
        {
            var axis = new Vector(Math.Round(plane.Normal.X), Math.Round(plane.Normal.Y), Math.Round(plane.Normal.Z));
            return axis.Length() != 1 ? null : new[] { 0, Vector.Dot(axis, centroid), plane.Offset }
                .Select(offset => Measured(axis, offset, fine))
                .FirstOrDefault(other => other.MeanDistance <= (1 + Indifference) * plane.MeanDistance);
        }

        MirrorPlane Refine(MirrorPlane plane)
        {
            plane = Measured(plane.Normal, plane.Offset, fine);
            for (var step = 0; step < MaxSteps; step++)
            {
                var (normal, offset) = FitPlane(target, plane, fine);
                var next = Measured(normal, offset, fine);
                if (!(next.MeanDistance < plane.MeanDistance))
                {
                    break;
                }

                plane = next;
            }

            return plane;
        }
    }

    /// <summary>The plane that mirrors points onto what is closest to their images now, by least squares.</summary>
    /// <remarks>
    /// |q − p + 2·n·(n·p)|² is |q − p|² + 4·(n·p)·(n·q), so n is the eigenvector of the smallest eigenvalue of Σ p·qᵀ + q·pᵀ.
    /// </remarks>
    private static (Vector Normal, double Offset) FitPlane(TargetSurface target, MirrorPlane plane, Vector[] samples)
    {
        var reflection = plane.Reflection;
        var images = Array.ConvertAll(samples, sample => target.ClosestPoint(target.Measure(reflection * sample, 0)));
        var (mean, imageMean) = (Vector.Mean(samples), Vector.Mean(images));
        var products = default(Matrix);
        var size = 0.0;
        for (var index = 0; index < samples.Length; index++)
        {
            var (p, q) = (samples[index] - mean, images[index] - imageMean);
            products += Matrix.Outer(p, q) + Matrix.Outer(q, p);
            size += 2 * p.Length() * q.Length();
        }

        // With a multiple of the identity added, all eigenvalues are positive, and the inverse stretches what is looked for most.
        var inverse = (products + (MaxShift * size * Matrix.Identity)).Inverse();
        var normal = plane.Normal;
        for (var step = 0; step < PowerSteps; step++)
        {
            normal = (inverse * normal).UnitVector();
        }

        return (normal, 0.5 * Vector.Dot(normal, mean + imageMean));
    }

    /// <summary>Directions that are spread evenly over a half sphere, by the golden ratio; the axes first.</summary>
    private static IEnumerable<Vector> SpreadDirections()
    {
        foreach (var axis in new Vector[] { new(1, 0, 0), new(0, 1, 0), new(0, 0, 1) })
        {
            yield return axis;
        }

        for (var index = 0; index < Directions; index++)
        {
            var height = (index + 0.5) / Directions;
            var (sine, cosine) = Math.SinCos(Math.PI * (Math.Sqrt(5) - 1) * index);
            var radius = Math.Sqrt(1 - (height * height));
            yield return new(radius * cosine, radius * sine, height);
        }
    }

    /// <summary>
    /// Points of the surface at even steps of its area; where in a face is a sequence of low discrepancy (M. Roberts, 2018).
    /// </summary>
    private static Vector[] SampleEvenly(Mesh mesh, int count)
    {
        var points = new Vector[count];
        var step = mesh.SurfaceArea() / count;
        var (face, passed) = (-1, 0.0);
        for (var index = 0; index < count; index++)
        {
            while (face + 1 < mesh.FaceCount && (face < 0 || passed <= (index + 0.5) * step))
            {
                face++;
                var (p, q, r) = mesh.Face(face);
                passed += 0.5 * Vector.Cross(q - p, r - p).Length();
            }

            var (u, v) = ((index * 0.7548776662466927) % 1, (index * 0.5698402909980532) % 1);
            (u, v) = u + v > 1 ? (1 - u, 1 - v) : (u, v);
            var (a, b, c) = mesh.Face(face);
            points[index] = a + (u * (b - a)) + (v * (c - a));
        }

        return points;
    }
}
