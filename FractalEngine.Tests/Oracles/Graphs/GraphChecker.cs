using System.Numerics;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Oracles.Graphs.Models;
using FractalEngine.Tests.Support;
using static FractalEngine.Tests.Oracles.Graphs.GraphMismatch;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>
/// Compares what the engine says of a fractal with all triangles of its expansion.
/// <para>
/// Distances are promised to 1e-12 of the largest coordinate that matters (docs/colliders.md, docs/stability.md): those of the position, of
/// the closest point, and of the frames on the way to it. The oracle itself rounds by some 1e-15 of the same.
/// </para>
/// <para>
/// Hits of rays are promised to 1e-12 of the largest coordinate of the whole shape (docs/rays.md), and of what a slope makes of it. A ray
/// that passes an edge within 4e-14 of that may hit or miss, and so may one that lies in the plane of a triangle. What the engine hits has
/// to be a point of a triangle in each case, and must not lie behind what the ray certainly hits.
/// </para>
/// </summary>
internal sealed class GraphChecker
{
    private readonly Fractal _fractal;
    private readonly TriangleSoup _soup;
    private readonly GraphQueries _queries;
    private readonly Random _random;
    private readonly Collider _collider;
    private readonly RayCaster _caster;
    private readonly QueryContext _context = new();
    private readonly Dictionary<Mesh, OracleMesh> _meshes = new(ReferenceEqualityComparer.Instance);
    private readonly Dictionary<int, Mesh> _meshesByIndex = [];

    public GraphChecker(Fractal fractal, TriangleSoup soup, Random random)
    {
        _fractal = fractal;
        _soup = soup;
        _random = random;
        _queries = new(random, soup);
        _collider = Collider.For(fractal);
        _caster = RayCaster.For(fractal);
    }

    /// <summary>Asks for counts, bounds, closest points, regions and rays.</summary>
    /// <exception cref="GraphMismatch">An answer is wrong.</exception>
    public GraphTally Check(int points, int rays)
    {
        CheckCounts(_fractal, _soup);
        if (_soup.Triangles.IsEmpty)
        {
            CheckEmpty();
            return GraphTally.Zero with { Graphs = 1 };
        }

        CheckBounds();
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
            tally += CheckRay(i % 2 == 0 ? _queries.DrawPlainRay() : _queries.DrawAimedRay(), isAimed: i % 2 == 1);
        }

        return tally;
    }

    /// <summary>Compares the numbers of chains and of their faces, equal ones counted.</summary>
    public static void CheckCounts(Fractal fractal, TriangleSoup soup)
    {
        ThrowUnless(fractal.InstanceCount == soup.Instances.Length, "instances", $"{fractal.InstanceCount}, not {soup.Instances.Length}");
        var faces = soup.Instances.Sum(static instance => instance.Mesh.FaceCount);
        ThrowUnless(fractal.FaceCount == (BigInteger)faces, "faces", $"{fractal.FaceCount}, not {faces}");
    }

    /// <summary>Compares the box: that of the vertices, the unused ones included or not.</summary>
    private void CheckBounds()
    {
        var vertices = _soup.Instances.SelectMany(static instance => instance.Mesh.Vertices.Select(instance.Map.Apply)).ToArray();
        var (low, high) = (vertices.Aggregate(Vector.Min), vertices.Aggregate(Vector.Max));
        var tolerance = 1e-12 * Math.Max(_soup.Reach, Math.Max(TriangleSoup.Largest(low), TriangleSoup.Largest(high)));
        var box = _fractal.Bounds;
        var margin = tolerance * Vector.One;
        ThrowUnless(
            IsBelow(box.Minimum, _soup.Minimum + margin) && IsBelow(_soup.Maximum - margin, box.Maximum)
            && IsBelow(low - margin, box.Minimum) && IsBelow(box.Maximum, high + margin),
            "bounds", $"{box}, not {_soup.Minimum} to {_soup.Maximum}");
    }

    private void CheckEmpty()
    {
        ThrowUnless(!_collider.TryFindClosest(Vector.Zero, double.PositiveInfinity, out _), "empty", $"a closest point of nothing");
        ThrowUnless(_caster.FindNearest(new(Vector.Zero, Vector.One)) is null, "empty", $"a hit of nothing");
        ThrowUnless(!_collider.Overlaps(Vector.Zero, 1e9), "empty", $"nothing overlaps a ball");
    }

    private void CheckClosest(Vector position)
    {
        var (distance, point, index) = _soup.FindClosest(position);
        var tolerance = ToleranceAt(position, distance, index);
        var found = _collider.FindClosest(position, _context);
        ThrowUnless(
            Math.Abs(found.Distance - distance) <= tolerance,
            "closest", $"{found.Distance:R} from {Format(position)}, not {distance:R} at {point} of {Describe(index)}");
        ThrowUnless(
            Math.Abs((found.Point - position).Length() - found.Distance) <= tolerance,
            "closest point", $"{found.Point} is not {found.Distance:R} from {Format(position)}");
        var gap = _soup.FindClosest(found.Point);
        ThrowUnless(
            gap.Distance <= Math.Max(tolerance, ToleranceAt(found.Point, 0, gap.Triangle)),
            "closest point", $"{found.Point} of {Format(position)} is {gap.Distance:R} off all faces");
        ThrowUnless(Math.Abs(found.Normal.Length() - 1) <= 1e-12, "normal", $"{found.Normal} at {Format(position)}");

        // Within more and less than the distance.
        ThrowUnless(_collider.Overlaps(position, distance + (2 * tolerance)), "ball", $"none within {distance:R} of {Format(position)}");
        ThrowUnless(
            distance <= 2 * tolerance || !_collider.Overlaps(position, distance - (2 * tolerance)),
            "ball", $"some within less than {distance:R} of {Format(position)}");
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
        ThrowUnless(missing < 0, "within", $"none of {hits.Length} faces is {missing:R} from {Format(position)} within {radius:R}");
        var wrong = found.FirstOrDefault(distance => !HasNear(sorted, distance, tolerance) || distance > radius + tolerance, -1);
        ThrowUnless(wrong < 0, "within", $"no face is {wrong:R} from {Format(position)} within {radius:R}");
        ThrowUnless(found.Length <= most, "within", $"{found.Length} faces within {radius:R} of {Format(position)}, not {most}");
    }

    private void CheckBox(BoundingBox box)
    {
        var margin = 1e-12 * (_soup.Reach + TriangleSoup.Largest(box.Minimum) + TriangleSoup.Largest(box.Maximum)) * Vector.One;
        var (isPossible, isCertain) = (false, false);
        foreach (ref readonly var triangle in _soup.Triangles)
        {
            isPossible |= TriangleClip.Meets(in triangle, box.Minimum - margin, box.Maximum + margin);
            isCertain |= TriangleClip.Meets(in triangle, box.Minimum + margin, box.Maximum - margin);
        }

        var overlaps = _collider.Overlaps(box, _context);
        ThrowUnless(overlaps ? isPossible : !isCertain, "box", $"overlaps: {overlaps}, {Format(box.Minimum)} to {Format(box.Maximum)}");
    }

    private GraphTally CheckRay(Ray ray, bool isAimed)
    {
        OracleRay seen = new(ray);
        var reach = Math.Max(_soup.Reach, TriangleSoup.Largest(ray.Origin));
        var (certain, plain, certainIndex) = (double.PositiveInfinity, double.PositiveInfinity, 0);
        for (var i = 0; i < _soup.Triangles.Length; i++)
        {
            var crossing = seen.Cross(in _soup.Triangles[i], reach);
            if (crossing.IsCertain(reach) && crossing.LatestDistance < certain)
            {
                (certain, certainIndex) = (crossing.LatestDistance, i);
            }

            plain = crossing.IsPlain(reach) ? Math.Min(plain, crossing.Distance) : plain;
        }

        var isFound = _caster.TryFindNearest(ray, _context, out var hit);
        if (!(isFound ? hit.Distance <= certain : double.IsPositiveInfinity(certain)))
        {
            var crossing = seen.Cross(in _soup.Triangles[certainIndex], reach);
            throw new GraphMismatch("ray", $"{Format(ray)} hits {hit.Distance:R} ({isFound}), not {certain:R}, {crossing.Inside} within {Describe(certainIndex)}");
        }

        if (isFound)
        {
            CheckHit(ray, in seen, in hit, reach);
        }

        ThrowUnless(_caster.HitsAny(ray, _context) == isFound, "any hit", $"{Format(ray)} hits any: {!isFound}");
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
        ThrowUnless(hit.Distance >= 0 && offRay <= tolerance, "hit", $"{Format(ray)} hits {hit.Point}, {offRay:R} off the ray");
        var mesh = FindMesh(hit.Mesh);
        ThrowUnless(mesh is not null, "hit mesh", $"{Format(ray)} hits no mesh of the model");
        ThrowUnless(
            ReferenceEquals(_meshesByIndex.TryAdd(hit.MeshIndex, hit.Mesh) ? hit.Mesh : _meshesByIndex[hit.MeshIndex], hit.Mesh),
            "hit mesh", $"{Format(ray)} hits another mesh than that of the index {hit.MeshIndex}");
        var (index, corners) = FindTriangle(mesh!, in hit);
        ThrowUnless(corners <= tolerance, "hit instance", $"{Format(ray)} hits {hit.InstanceMap}, which is {corners:R} off all of {mesh!.Name}");
        var triangle = _soup.Triangles[index];
        var off = (triangle.ClosestPoint(hit.Point) - hit.Point).Length();
        ThrowUnless(off <= tolerance, "hit", $"{Format(ray)} hits {hit.Point}, {off:R} off {Describe(index)}");
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
            ThrowUnless((hit.Normal - (normal / area)).Length() <= 1e-12 + (4 * error), "normal", $"{Format(ray)}: {hit.Normal}, not {normal / area}");
            ThrowUnless(
                Math.Abs(facing) <= 1e-12 + (4 * error) || hit.IsFrontFace == facing < 0, "front", $"{Format(ray)}: {hit.IsFrontFace}, facing {facing:R}");
        }
    }

    /// <summary>Finds the triangle of a hit: of its mesh and its face, that whose corners are closest to those of the map.</summary>
    private (int Triangle, double Corners) FindTriangle(OracleMesh mesh, in RayHit hit)
    {
        var (a, b, c) = hit.Mesh.Face(hit.FaceIndex);
        (a, b, c) = (hit.InstanceMap * a, hit.InstanceMap * b, hit.InstanceMap * c);
        var best = (Triangle: -1, Corners: double.PositiveInfinity);
        for (var i = 0; i < _soup.Triangles.Length; i++)
        {
            ref readonly var triangle = ref _soup.Triangles[i];
            if (triangle.Face == hit.FaceIndex && ReferenceEquals(_soup.Instances[triangle.Instance].Mesh, mesh))
            {
                var corners = Math.Max((triangle.A - a).Length(), Math.Max((triangle.B - b).Length(), (triangle.C - c).Length()));
                best = corners < best.Corners ? (i, corners) : best;
            }
        }

        return best;
    }

    private OracleMesh? FindMesh(Mesh mesh)
    {
        if (!_meshes.TryGetValue(mesh, out var known))
        {
            var vertices = Enumerable.Range(0, mesh.VertexCount).Select(mesh.Vertex).ToArray();
            known = _soup.Instances.Select(static instance => instance.Mesh).FirstOrDefault(
                item => item.Indices.SequenceEqual(mesh.VertexIndices) && item.Vertices.SequenceEqual(vertices));
            if (known is not null)
            {
                _meshes.Add(mesh, known);
            }
        }

        return known;
    }

    private double ToleranceAt(Vector position, double distance, int triangle) =>
        1e-12 * Math.Max(TriangleSoup.Largest(position) + distance, _soup.Triangles[triangle].Reach);

    private string Describe(int triangle)
    {
        var found = _soup.Triangles[triangle];
        return FormattableString.Invariant(
            $"face {found.Face} of instance {found.Instance}, {_soup.Instances[found.Instance].Mesh.Name}, {found.LongestEdge} long, reach {_soup.Reach}");
    }

    private static bool HasNear(double[] ascending, double value, double tolerance)
    {
        var index = Array.BinarySearch(ascending, value - tolerance);
        index = index < 0 ? ~index : index;
        return index < ascending.Length && ascending[index] <= value + tolerance;
    }

    private static bool IsBelow(Vector v1, Vector v2) => v1.X <= v2.X && v1.Y <= v2.Y && v1.Z <= v2.Z;

    private static string Format(Vector v) => FormattableString.Invariant($"new({v.X:R}, {v.Y:R}, {v.Z:R})");

    private static string Format(Ray ray) => $"new Ray({Format(ray.Origin)}, {Format(ray.Direction)})";
}
