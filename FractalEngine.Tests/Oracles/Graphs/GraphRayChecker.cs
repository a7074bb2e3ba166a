using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using static FractalEngine.Tests.Oracles.Graphs.GraphMismatch;
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
internal sealed class GraphRayChecker(Fractal fractal, TriangleSoup soup, HitTriangles triangles)
{
    private readonly RayCaster _caster = RayCaster.For(fractal);
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

        var isFound = _caster.TryFindNearest(ray, _context, out var hit);
        if (!(isFound ? hit.Distance <= certain : double.IsPositiveInfinity(certain)))
        {
            var crossing = seen.Cross(in soup.Triangles[certainIndex], reach);
            throw new GraphMismatch("ray", $"{QueryText.Of(ray)} hits {hit.Distance:R} ({isFound}), not {certain:R}, {crossing.Inside} within {soup.Describe(certainIndex)}");
        }

        if (isFound)
        {
            CheckHit(ray, in seen, in hit, reach);
        }

        ThrowUnless(_caster.HitsAny(ray, _context) == isFound, "any hit", $"{QueryText.Of(ray)} hits any: {!isFound}");
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
        ThrowUnless(hit.Distance >= 0 && offRay <= tolerance, "hit", $"{QueryText.Of(ray)} hits {hit.Point}, {offRay:R} off the ray");
        ThrowUnless(
            ReferenceEquals(fractal.BaseMeshes[hit.MeshIndex], hit.Mesh), "hit mesh", $"{QueryText.Of(ray)} hits another mesh than number {hit.MeshIndex}");
        var (index, corners) = triangles.Find(hit.MeshIndex, hit.FaceIndex, hit.InstanceMap);
        ThrowUnless(corners <= tolerance, "hit instance", $"{QueryText.Of(ray)} hits {hit.InstanceMap}, which is {corners:R} off all instances");
        var triangle = soup.Triangles[index];
        var off = (triangle.ClosestPoint(hit.Point) - hit.Point).Length();
        ThrowUnless(off <= tolerance, "hit", $"{QueryText.Of(ray)} hits {hit.Point}, {off:R} off {soup.Describe(index)}");
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
            ThrowUnless((hit.Normal - (normal / area)).Length() <= 1e-12 + (4 * error), "normal", $"{QueryText.Of(ray)}: {hit.Normal}, not {normal / area}");
            ThrowUnless(
                Math.Abs(facing) <= 1e-12 + (4 * error) || hit.IsFrontFace == facing < 0, "front", $"{QueryText.Of(ray)}: {hit.IsFrontFace}, facing {facing:R}");
        }
    }
}
