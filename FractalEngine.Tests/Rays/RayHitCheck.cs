using System.Globalization;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Queries.Regions;

namespace FractalEngine.Tests.Rays;

/// <summary>Compares all that a hit says with the triangle it names.</summary>
internal static class RayHitCheck
{
    // The normal of a needle is less certain than that of a triangle whose height is this part of its length.
    private const double MinHeight = 1e-4;

    /// <summary>Finds what is wrong with a hit; null for nothing.</summary>
    /// <param name="ray">The ray.</param>
    /// <param name="hit">What was found.</param>
    /// <param name="triangle">The triangle of the hit, with the reach of the shape.</param>
    public static string? FindProblem(in ProjectedRay ray, in RayHit hit, in ExpandedTriangle triangle)
    {
        var reach = Math.Max(triangle.Reach, Math.Max(ray.Origin.MaxAbsComponent(), hit.Point.MaxAbsComponent()));
        var tolerance = ProjectedRay.DistanceError * reach;
        var offRay = (ray.Origin + (hit.Distance * ray.Direction) - hit.Point).MaxAbsComponent();
        if (!(offRay <= tolerance))
        {
            return Describe($"the point is {offRay:E1} off the ray");
        }

        var offTriangle = triangle.Distance(hit.Point);
        if (!(offTriangle <= tolerance))
        {
            return Describe($"the point is {offTriangle / reach:E1} of the reach off the triangle");
        }

        var crossing = ray.Cross(in triangle);
        if (crossing.IsCertain && !(Math.Abs(crossing.Distance - hit.Distance) <= crossing.Tolerance))
        {
            return Describe($"the distance is off {crossing.Distance:R} by {(crossing.Distance - hit.Distance) / reach:E1} of the reach");
        }

        return FindWeightProblem(in hit, in triangle, tolerance) ?? FindNormalProblem(in ray, in hit, in triangle);
    }

    private static string? FindWeightProblem(in RayHit hit, in ExpandedTriangle triangle, double tolerance)
    {
        var (a, b, c) = hit.Barycentrics;
        if (!(Math.Min(a, Math.Min(b, c)) >= 0 && Math.Abs(a + b + c - 1) <= 1e-14))
        {
            return Describe($"the weights are {hit.Barycentrics}");
        }

        var off = ((a * triangle.A) + (b * triangle.B) + (c * triangle.C) - hit.Point).MaxAbsComponent();
        return off <= tolerance ? null : Describe($"the weights give a point {off:E1} off");
    }

    private static string? FindNormalProblem(in ProjectedRay ray, in RayHit hit, in ExpandedTriangle triangle)
    {
        if (!(Math.Abs(hit.Normal.Length() - 1) <= 1e-14))
        {
            return Describe($"the normal has the length {hit.Normal.Length():R}");
        }

        var cosine = Vector.Dot(hit.Normal, ray.Direction);
        if (hit.IsFrontFace != cosine < 0 && Math.Abs(cosine) > 1e-12)
        {
            return Describe($"the side is wrong");
        }

        var (ab, ac, bc) = (triangle.B - triangle.A, triangle.C - triangle.A, triangle.C - triangle.B);
        var cross = Vector.Cross(ab, ac);
        var length = Math.Max(ab.Length(), Math.Max(ac.Length(), bc.Length()));
        // Corners are off by some last places of the reach, which turns a small triangle.
        var isCertain = cross.Length() > MinHeight * length * length && length > 1e-7 * triangle.Reach;
        var off = (hit.Normal - (cross / cross.Length())).Length();
        return !isCertain || off <= 1e-4 ? null : Describe($"the normal is off by {off:E1}");
    }

    private static string Describe(FormattableString text) => text.ToString(CultureInfo.InvariantCulture);
}
