using System.Globalization;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Queries.Regions;
using Xunit.Sdk;

namespace FractalEngine.Tests.Rays;

/// <summary>Checks what a ray caster finds against all triangles of the shape. Safe for concurrent use.</summary>
/// <param name="name">The shape, for messages of failures.</param>
/// <param name="caster">The caster of the shape.</param>
/// <param name="oracle">The triangles of the shape.</param>
/// <param name="resolve">Finds the triangle of an instance path and a hit.</param>
internal sealed class RayChecker(string name, RayCaster caster, RayOracle oracle, Func<int[], RayHit, ExpandedTriangle> resolve)
{
    private const int RingCount = 8;

    public RayOracle Oracle => oracle;

    /// <summary>Makes the checker of an expansion.</summary>
    public static RayChecker For(string name, RayCaster caster, ShapeExpansion shape) =>
        new(name, caster, new(shape.Triangles), (path, hit) => shape.Resolve(path, hit.FaceIndex));

    /// <summary>Casts a ray for the nearest and for any hit, and fails unless both are right.</summary>
    /// <returns>True when the ray had to hit something.</returns>
    public bool Check(Ray ray, QueryContext context, double minDistance = 0, double maxDistance = double.PositiveInfinity)
    {
        var projected = new ProjectedRay(ray);
        var isFound = caster.TryFindNearest(ray, context, out var hit, minDistance, maxDistance);
        var expected = oracle.CertainDistance(in projected, minDistance, maxDistance);
        ThrowUnless(isFound || double.IsPositiveInfinity(expected), ray, minDistance, maxDistance,
            $"no hit, though one within {expected:R}");
        if (isFound)
        {
            var path = context.InstancePath.ToArray();
            ThrowUnless(hit.Distance <= expected, ray, minDistance, maxDistance,
                $"{hit.Distance:R} on face {hit.FaceIndex} of [{string.Join(", ", path)}], though a hit within {expected:R}");
            ThrowUnless(hit.Distance >= minDistance && hit.Distance <= maxDistance, ray, minDistance, maxDistance,
                $"{hit.Distance:R} is out of range");
            var problem = RayHitCheck.FindProblem(in projected, in hit, Resolve(path, hit));
            ThrowUnless(problem is null, ray, minDistance, maxDistance, $"{hit} on [{string.Join(", ", path)}]: {problem}");
        }

        ThrowUnless(caster.HitsAny(ray, context, minDistance, maxDistance) == isFound, ray, minDistance, maxDistance,
            $"any hit: {!isFound}, nearest hit: {isFound}");
        return !double.IsPositiveInfinity(expected);
    }

    /// <summary>Casts a ray again with limits around its hit, just before it, and beyond it. Grazing hits have no sharp limits.</summary>
    /// <returns>True when the hit was certain, so that it was checked.</returns>
    public bool CheckLimits(Ray ray, QueryContext context)
    {
        var projected = new ProjectedRay(ray);
        if (!caster.TryFindNearest(ray, context, out var hit)
            || projected.Cross(Resolve(context.InstancePath.ToArray(), hit)) is not { IsCertain: true } crossing)
        {
            return false;
        }

        var margin = 2 * crossing.Tolerance;
        var before = hit.Distance - margin;
        var isFound = caster.TryFindNearest(ray, context, out var again, Math.Max(before, 0), hit.Distance + margin);
        ThrowUnless(isFound && Math.Abs(again.Distance - hit.Distance) <= margin, ray, before, hit.Distance + margin,
            $"{(isFound ? again.Distance : double.NaN):R}, not {hit.Distance:R}");
        // What is uncertain may come first once, and last another time.
        ThrowUnless(before < 0 || !caster.TryFindNearest(ray, context, out again, 0, before)
            || !projected.Cross(Resolve(context.InstancePath.ToArray(), again)).IsCertain, ray, 0, before,
            $"a hit at {again.Distance:R}, before {hit.Distance:R}");
        Check(ray, context, hit.Distance + margin);
        return true;
    }

    /// <summary>
    /// Casts a ray at an edge or a vertex. Where all rays on a narrow ring around it certainly hit, the surface has no gap there, and
    /// the ray itself must hit too.
    /// </summary>
    /// <returns>True when the ring was whole.</returns>
    public bool CheckEdge(Ray ray, QueryContext context)
    {
        Check(ray, context);
        var radius = 1e-7 * oracle.Magnitude;
        var projected = new ProjectedRay(ray);
        var farthest = 0.0;
        for (var i = 0; i < RingCount; i++)
        {
            var shifted = projected.Shift(radius, 2 * Math.PI * (i + 0.3) / RingCount);
            farthest = Math.Max(farthest, oracle.CertainDistance(in shifted));
        }

        if (double.IsPositiveInfinity(farthest))
        {
            return false;
        }

        // The middle of a dent lies deeper than its ring, by the radius and the slope of its sides.
        var isFound = caster.TryFindNearest(ray, context, out var hit);
        ThrowUnless(isFound && hit.Distance <= farthest + (1000 * radius), ray, 0, double.PositiveInfinity,
            $"{(isFound ? hit.Distance : double.NaN):R}: leaks, all around it hits within {farthest:R}");
        return true;
    }

    private ExpandedTriangle Resolve(int[] path, RayHit hit) => oracle.WithReach(resolve(path, hit));

    private void ThrowUnless(bool condition, Ray ray, double minDistance, double maxDistance, FormattableString message)
    {
        if (!condition)
        {
            var cast = string.Create(
                CultureInfo.InvariantCulture,
                $"{name}, ray new(new{Format(ray.Origin)}, new{Format(ray.Direction)}) from {minDistance:R} to {maxDistance:R}");
            throw new XunitException($"{cast}: {message.ToString(CultureInfo.InvariantCulture)}");
        }
    }

    private static string Format(Vector v) => string.Create(CultureInfo.InvariantCulture, $"({v.X:R}, {v.Y:R}, {v.Z:R})");
}
