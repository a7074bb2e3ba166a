using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using static FractalEngine.Tests.Oracles.Graphs.GraphMismatch;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>
/// Compares what the engine says of a fractal with all triangles of its expansion.
/// <para>
/// Distances are promised to 1e-12 of the largest coordinate that matters (docs/colliders.md, docs/stability.md): those of the position, of
/// the closest point, and of the frames on the way to it. The oracle itself rounds by some 1e-15 of the same.
/// </para>
/// </summary>
internal sealed class GraphChecker
{
    private readonly Fractal _fractal;
    private readonly TriangleSoup _soup;
    private readonly GraphQueries _queries;
    private readonly Random _random;
    private readonly Collider _collider;
    private readonly GraphRayChecker _rays;
    private readonly HitTriangles _triangles;
    private readonly QueryContext _context = new();

    public GraphChecker(Fractal fractal, TriangleSoup soup, Random random)
    {
        _fractal = fractal;
        _soup = soup;
        _random = random;
        _queries = new(random, soup);
        _collider = Collider.For(fractal);
        _triangles = new(fractal, soup);
        _rays = new(RayCaster.For(fractal), fractal, soup);
    }

    /// <summary>Asks for counts, bounds, closest points, regions and rays.</summary>
    /// <exception cref="GraphMismatch">An answer is wrong.</exception>
    public GraphTally Check(int points, int rays)
    {
        if (_soup.Triangles.IsEmpty)
        {
            CheckEmpty();
            return GraphTally.Zero with { Graphs = 1 };
        }

        for (var i = 0; i < points; i++)
        {
            CheckClosest(_queries.DrawPosition());
            if (i % 5 == 0)
            {
                CheckWithin(_queries.DrawPosition());
                CheckBox(_queries.DrawBox());
            }
        }

        var tally = GraphTally.Zero with { Graphs = 1, Points = points };
        for (var i = 0; i < rays; i++)
        {
            tally += _rays.Check(i % 2 == 0 ? _queries.DrawPlainRay() : _queries.DrawAimedRay(), isAimed: i % 2 == 1);
        }

        return tally;
    }

    private void CheckEmpty()
    {
        ThrowUnless(!_collider.TryFindClosest(Vector.Zero, double.PositiveInfinity, out _), "empty", $"a closest point of nothing");
        ThrowUnless(!_collider.Overlaps(Vector.Zero, 1e9), "empty", $"nothing overlaps a ball");
        _rays.Check(new(Vector.Zero, Vector.One), isAimed: false);
    }

    private void CheckClosest(Vector position)
    {
        var (distance, point, index) = _soup.FindClosest(position);
        var tolerance = ToleranceAt(position, distance, index);
        var found = _collider.FindClosest(position, _context);
        ThrowUnless(
            Math.Abs(found.Distance - distance) <= tolerance,
            "closest", $"{found.Distance:R} from {QueryText.Of(position)}, not {distance:R} at {point} of {_soup.Describe(index)}");
        ThrowUnless(
            Math.Abs((found.Point - position).Length() - found.Distance) <= tolerance,
            "closest point", $"{found.Point} is not {found.Distance:R} from {QueryText.Of(position)}");
        var gap = _soup.FindClosest(found.Point);
        ThrowUnless(
            gap.Distance <= Math.Max(tolerance, ToleranceAt(found.Point, 0, gap.Triangle)),
            "closest point", $"{found.Point} of {QueryText.Of(position)} is {gap.Distance:R} off all faces");
        CheckInstance(position, found, tolerance);
        ThrowUnless(Math.Abs(found.Normal.Length() - 1) <= 1e-12, "normal", $"{found.Normal} at {QueryText.Of(position)}");

        // Within more and less than the distance.
        ThrowUnless(
            _collider.Overlaps(position, distance + (2 * tolerance)), "ball", $"none within {distance:R} of {QueryText.Of(position)}");
        ThrowUnless(
            distance <= 2 * tolerance || !_collider.Overlaps(position, distance - (2 * tolerance)),
            "ball", $"some within less than {distance:R} of {QueryText.Of(position)}");
    }

    /// <summary>The point lies on the face and the mesh that are named, and on the instance of the path.</summary>
    private void CheckInstance(Vector position, ClosestHit found, double tolerance)
    {
        var (index, distance) = _triangles.Find(found.MeshIndex, found.FaceIndex, found.Point);
        ThrowUnless(
            index >= 0 && distance <= Math.Max(tolerance, ToleranceAt(found.Point, 0, index)),
            "closest face",
            $"{found.Point} of {QueryText.Of(position)} is {distance:R} off all of face {found.FaceIndex} of mesh {found.MeshIndex}");
        var path = $"[{string.Join(", ", found.InstancePath)}] of {QueryText.Of(position)}";
        var steps = _fractal.Follow(found.InstancePath.AsSpan());
        ThrowUnless(steps is not null, "path", $"no path {path}");
        // Below identities without end, and below the precision, paths end earlier.
        var map = steps!.Aggregate(AffineMap.Identity, static (map, step) => map * step.Map);
        var (placed, corners) = _triangles.Find(found.MeshIndex, found.FaceIndex, map);
        var allowed = 1e-12 * Math.Max(_soup.Triangles[placed].Reach, TriangleSoup.Largest(position));
        ThrowUnless(corners <= allowed, "path", $"{path} is {corners:R} off all instances");
        var off = (_soup.Triangles[placed].ClosestPoint(found.Point) - found.Point).Length();
        ThrowUnless(off <= Math.Max(tolerance, allowed), "path", $"{path} is {off:R} off its point");
    }

    private void CheckWithin(Vector position)
    {
        var distances = _soup.FindDistances(position);
        var sorted = distances.Order().ToArray();
        var radius = sorted[_random.Next(Math.Min(sorted.Length, 50))] * 1.001;
        var tolerance = 1e-12 * (_soup.Reach + TriangleSoup.Largest(position) + radius);
        var most = sorted.Count(distance => distance <= radius + tolerance);
        if (most > 1000)
        {
            return;
        }

        var hits = _collider.FindAllWithin(position, radius, 1_000_000, _context);
        // Equal instances are found once, so that numbers of faces say little; a distance of each is there.
        var found = hits.Select(static hit => hit.Distance).ToArray();
        var missing = sorted.Where(distance => distance <= radius - tolerance).FirstOrDefault(
            distance => !HasNear(found, distance, tolerance), -1);
        ThrowUnless(missing < 0, "within", $"none of {hits.Length} faces is {missing:R} from {QueryText.Of(position)} within {radius:R}");
        var wrong = found.FirstOrDefault(distance => !HasNear(sorted, distance, tolerance) || distance > radius + tolerance, -1);
        ThrowUnless(wrong < 0, "within", $"no face is {wrong:R} from {QueryText.Of(position)} within {radius:R}");
        ThrowUnless(found.Length <= most, "within", $"{found.Length} faces within {radius:R} of {QueryText.Of(position)}, not {most}");
    }

    private void CheckBox(BoundingBox box)
    {
        // Rounding is that of the bounds of a search, which hold meshes that do not stand there by chance, too.
        var reach = _fractal.BaseMeshes.Aggregate(_soup.Reach, static (reach, mesh) => Math.Max(
            reach, Math.Max(TriangleSoup.Largest(mesh.Bounds.Minimum), TriangleSoup.Largest(mesh.Bounds.Maximum))));
        var margin = 1e-12 * (reach + TriangleSoup.Largest(box.Minimum) + TriangleSoup.Largest(box.Maximum)) * Vector.One;
        var (isPossible, isCertain) = (false, false);
        foreach (ref readonly var triangle in _soup.Triangles)
        {
            isPossible |= TriangleClip.Meets(in triangle, box.Minimum - margin, box.Maximum + margin);
            isCertain |= TriangleClip.Meets(in triangle, box.Minimum + margin, box.Maximum - margin);
        }

        var overlaps = _collider.Overlaps(box, _context);
        ThrowUnless(
            overlaps ? isPossible : !isCertain,
            "box", $"overlaps: {overlaps}, {QueryText.Of(box.Minimum)} to {QueryText.Of(box.Maximum)}");
    }

    private double ToleranceAt(Vector position, double distance, int triangle) =>
        1e-12 * Math.Max(TriangleSoup.Largest(position) + distance, _soup.Triangles[triangle].Reach);

    private static bool HasNear(double[] ascending, double value, double tolerance)
    {
        var index = Array.BinarySearch(ascending, value - tolerance);
        index = index < 0 ? ~index : index;
        return index < ascending.Length && ascending[index] <= value + tolerance;
    }
}
