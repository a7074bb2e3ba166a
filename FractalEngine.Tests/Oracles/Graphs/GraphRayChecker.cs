using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using static FractalEngine.Tests.Oracles.Graphs.GraphMismatch;
using static FractalEngine.Tests.Oracles.Graphs.QueryText;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>
/// Compares the hits of rays with all triangles of an expansion.
/// <para>
/// Hits are promised to 1e-12 of the largest coordinate of the whole shape (docs/rays.md), and of what a slope makes of it. A ray that
/// passes an edge within 4e-14 of that may hit or miss, and so may one that lies in the plane of a triangle. What the engine hits has to be
/// a point of a triangle in each case, and must not lie behind what the ray certainly hits.
/// </para>
/// </summary>
/// <param name="caster">Casts rays at the fractal, or at a scene of it.</param>
/// <param name="fractal">The fractal.</param>
/// <param name="soup">The triangles of the fractal, or of its only object in the scene.</param>
internal sealed class GraphRayChecker(RayCaster caster, Fractal fractal, TriangleSoup soup)
{
    private readonly HitTriangles _triangles = new(fractal, soup);
    private readonly QueryContext _context = new();

    /// <summary>Casts a ray.</summary>
    /// <param name="ray">The ray.</param>
    /// <param name="isAimed">Whether it is aimed at what is hard to tell.</param>
    /// <exception cref="GraphMismatch">The answer is wrong.</exception>
    public GraphTally Check(Ray ray, bool isAimed)
    {
        OracleRay seen = new(ray);
        var reach = Math.Max(soup.Reach, TriangleSoup.Largest(ray.Origin));
        var (certain, plain, certainIndex) = (double.PositiveInfinity, double.PositiveInfinity, 0);
        for (var i = 0; i < soup.Triangles.Length; i++)
        {
            var crossing = seen.Cross(in soup.Triangles[i], reach);
            if (crossing.IsCertain(reach) && crossing.LatestDistance < certain)
            {
                (certain, certainIndex) = (crossing.LatestDistance, i);
            }

            plain = crossing.IsPlain(reach) ? Math.Min(plain, crossing.Distance) : plain;
        }

        var isFound = caster.TryFindNearest(ray, _context, out var hit);
        if (!(isFound ? hit.Distance <= certain : double.IsPositiveInfinity(certain)))
        {
            var crossing = seen.Cross(in soup.Triangles[certainIndex], reach);
            throw new GraphMismatch(
                "ray",
                $"{Of(ray)} hits {hit.Distance:R} ({isFound}), not {certain:R}, {crossing.Inside} within {soup.Describe(certainIndex)}");
        }

        if (isFound)
        {
            CheckHit(ray, in seen, in hit, reach);
        }

        ThrowUnless(caster.HitsAny(ray, _context) == isFound, "any hit", $"{Of(ray)} hits any: {!isFound}");
        // Both are right: rounding decides whether something is hit, or which of two surfaces.
        var isAmbiguous = isFound == double.IsPositiveInfinity(plain) || (isFound && Math.Abs(hit.Distance - plain) > 1e-10 * reach);
        return GraphTally.Zero with
        {
            Rays = 1,
            Hits = isFound ? 1 : 0,
            Aimed = isAimed ? 1 : 0,
            Ambiguous = isAmbiguous && !isAimed ? 1 : 0,
            AmbiguousAimed = isAmbiguous && isAimed ? 1 : 0,
        };
    }

    private void CheckHit(Ray ray, in OracleRay seen, in RayHit hit, double reach)
    {
        var tolerance = RayCrossing.DistanceError * Math.Max(reach, TriangleSoup.Largest(hit.Point));
        var offRay = (seen.Origin + (hit.Distance * seen.Direction) - hit.Point).Length();
        ThrowUnless(hit.Distance >= 0 && offRay <= tolerance, "hit", $"{Of(ray)} hits {hit.Point}, {offRay:R} off the ray");
        ThrowUnless(
            ReferenceEquals(fractal.BaseMeshes[hit.MeshIndex], hit.Mesh),
            "hit mesh", $"{Of(ray)} hits another mesh than number {hit.MeshIndex}");
        var (index, corners) = _triangles.Find(hit.MeshIndex, hit.FaceIndex, hit.InstanceMap);
        ThrowUnless(
            corners <= tolerance, "hit instance", $"{Of(ray)} hits {hit.InstanceMap}, which is {corners:R} off all instances");
        var triangle = soup.Triangles[index];
        var off = (triangle.ClosestPoint(hit.Point) - hit.Point).Length();
        ThrowUnless(off <= tolerance, "hit", $"{Of(ray)} hits {hit.Point}, {off:R} off {soup.Describe(index)}");
        CheckNormal(ray, in seen, in hit, in triangle, reach);
    }

    private static void CheckNormal(Ray ray, in OracleRay seen, in RayHit hit, in OracleTriangle triangle, double reach)
    {
        var normal = Vector.Cross(triangle.B - triangle.A, triangle.C - triangle.A);
        var area = normal.Length();
        // By how much corners that are off turn the normal.
        var error = RayCrossing.CornerError * reach * triangle.LongestEdge / area;
        var facing = Vector.Dot(normal, seen.Direction) / area;
        if (error < 1e-3)
        {
            ThrowUnless(
                (hit.Normal - (normal / area)).Length() <= 1e-12 + (4 * error),
                "normal", $"{Of(ray)}: {hit.Normal}, not {normal / area}");
            ThrowUnless(
                Math.Abs(facing) <= 1e-12 + (4 * error) || hit.IsFrontFace == facing < 0,
                "front", $"{Of(ray)}: {hit.IsFrontFace}, facing {facing:R}");
        }
    }
}
