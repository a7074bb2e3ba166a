using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;

namespace FractalEngine.Benchmarks.Rays;

/// <summary>Rays as images need them: those of a camera, from what they hit towards the sun, and in all directions.</summary>
internal sealed class RaySets
{
    // Beside the surface that a ray leaves, as a part of the size.
    private const double SurfaceOffset = 1e-9;

    private static readonly Vector TowardsSun = new Vector(0.3, 0.8, 0.5).UnitVector();

    /// <summary>Makes the three sets of rays.</summary>
    /// <param name="caster">Finds where shadow rays start.</param>
    /// <param name="box">Bounds of the shape.</param>
    /// <param name="count">Number of rays of the camera, and in all directions; a square number.</param>
    public RaySets(RayCaster caster, BoundingBox box, int count)
    {
        Primary = CreatePrimary(box, (int)Math.Sqrt(count));
        var context = new QueryContext();
        Shadow = [.. Primary.Select(ray => CreateShadow(caster, ray, box.Diagonal, context)).OfType<Ray>()];
        var random = new Random(1);
        Random = [.. Enumerable.Range(0, count).Select(_ => new Ray(
            box.Centre + box.Size.Stretch(RandomVector(random)), RandomVector(random)))];
    }

    /// <summary>From a camera outside, which sees the whole shape; by rows.</summary>
    public Ray[] Primary { get; }

    /// <summary>From what they hit towards the sun; any hit counts.</summary>
    public Ray[] Shadow { get; }

    /// <summary>From anywhere within the bounds, in any direction.</summary>
    public Ray[] Random { get; }

    private static Ray[] CreatePrimary(BoundingBox box, int side)
    {
        const double Slope = 0.42;
        var eye = box.Centre + (1.3 * box.Diagonal * new Vector(0.5, 0.35, 0.8));
        var forward = (box.Centre - eye).UnitVector();
        var right = Vector.Cross(forward, Vector.J).UnitVector();
        var up = Vector.Cross(right, forward);
        return [.. from y in Enumerable.Range(0, side)
            from x in Enumerable.Range(0, side)
            select new Ray(eye, forward + (Slope * ((2.0 * x / side) - 1) * right) + (Slope * ((2.0 * y / side) - 1) * up))];
    }

    private static Ray? CreateShadow(RayCaster caster, Ray ray, double size, QueryContext context) =>
        caster.TryFindNearest(ray, context, out var hit)
            ? new Ray(hit.Point + ((hit.IsFrontFace ? SurfaceOffset : -SurfaceOffset) * size * hit.Normal), TowardsSun)
            : null;

    private static Vector RandomVector(Random random) =>
        new(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5);
}
