using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Fractals.Levels.Building;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Fractals.Levels.Building;
using FractalEngine.Tests.Queries.Regions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>Rays at recursives that call each other, with several base meshes, against all their faces.</summary>
public class RecursiveRaysTests
{
    private const int MaxFaces = 20_000;

    [Fact]
    public void TryFindNearest_InRandomRecursives_EqualsEveryFace() =>
        Seeded.RunMostInParallel(300, random => Check(random, RandomRecursives.Create(random), 40, mayBePart: true), minShare: 0.7);

    [Fact]
    [Trait("Category", "Soak")]
    public void TryFindNearest_InManyRandomRecursives_EqualsEveryFace() =>
        Seeded.RunMostInParallel(20_000, random => Check(random, RandomRecursives.Create(random), 100, mayBePart: true), minShare: 0.7);

    [Fact]
    public void TryFindNearest_InUnusualRecursives_EqualsEveryFace() =>
        Seeded.RunMostInParallel(200, random => Check(random, CreateUnusual(random), 40), minShare: 0.5);

    [Fact]
    [Trait("Category", "Soak")]
    public void TryFindNearest_InManyUnusualRecursives_EqualsEveryFace() =>
        Seeded.RunMostInParallel(20_000, random => Check(random, CreateUnusual(random), 100), minShare: 0.5);

    [Fact]
    public void TryFindNearest_OfAFaceOfFlattenedRecursives_HitsItOrANearerOne() =>
        Seeded.RunMostInParallel(100, CheckFlattened, minShare: 0.6);

    [Fact]
    [Trait("Category", "Soak")]
    public void TryFindNearest_OfManyFacesOfFlattenedRecursives_HitsThemOrNearerOnes() =>
        Seeded.RunMostInParallel(20_000, CheckFlattened, minShare: 0.6);

    [Fact]
    public void TryFindNearest_InWideRecursives_EqualsEveryFace() => Seeded.RunMostInParallel(6, CheckWide, minShare: 0.5);

    [Fact]
    [Trait("Category", "Soak")]
    public void TryFindNearest_InManyWideRecursives_EqualsEveryFace() => Seeded.RunMostInParallel(500, CheckWide, minShare: 0.5);

    [Fact]
    public void TryFindNearest_AtFacesOfDeepRecursives_HitsThemOrNearerOnes() => Seeded.RunMostInParallel(12, CheckDeep, minShare: 0.25);

    [Fact]
    [Trait("Category", "Soak")]
    public void TryFindNearest_AtFacesOfManyDeepRecursives_HitsThemOrNearerOnes() =>
        Seeded.RunMostInParallel(1_000, CheckDeep, minShare: 0.25);

    /// <summary>Recursives whose meshes have all sizes, places and shapes, and maps that lead far away or change the size.</summary>
    private static RecursiveSystem CreateUnusual(Random random) => RandomRecursives.Create(
        random,
        [.. Enumerable.Range(0, random.Next(1, 5)).Select(_ => random.Next(6) == 0 ? Mesh.Empty : RandomMeshes.Create(random))],
        () =>
        {
            var map = RandomRecursives.CreateMap(random, random.Next(2) == 0);
            return random.Draw<Func<AffineMap>>(
                (8, () => map),
                (1, () => AffineMap.Identity),
                (1, () => map with { Translation = Math.Pow(10, random.Next(1, 7)) * map.Translation }),
                (1, () => new AffineMap(Math.Pow(10, random.Next(-6, 3)) * map.Linear, map.Translation)))();
        });

    /// <summary>Casts rays at faces that are no needles, from above: one that a ray sees edge on is not certain to be hit.</summary>
    private static bool CheckFlattened(Random random)
    {
        var system = RandomRecursives.Create(random);
        var recursives = system.Recursives;
        foreach (ref var recursive in recursives.AsSpan())
        {
            recursive = recursive with
            {
                Calls = [.. recursive.Calls.Select(call => random.Next(3) > 0 ? call : call with { Map = Flatten(call.Map) })],
            };
        }

        var (root, levels) = (random.Next(recursives.Length), random.Next(1, 5));
        var start = RecursiveChain.Begin(root, levels);
        var triangles = Triangles(system, start, new(system.GraphOf(root, levels))).ToArray();
        var targets = triangles.Where(HasHeight).ToArray();
        if (targets.Length is 0 or > MaxFaces)
        {
            return false;
        }

        var caster = CreateCaster(system, root, levels, isPart: false, out var hierarchy);
        var tolerance = 1e-11 * triangles.Max(static triangle => triangle.Reach);
        var context = new QueryContext();
        for (var i = 0; i < 40; i++)
        {
            var (_, a, b, c, _) = targets[random.Next(targets.Length)];
            var target = (a + b + c) / 3;
            var origin = target + Vector.Cross(b - a, c - a).UnitVector() + random.Vector(0.25);
            var isFound = caster.TryFindNearest(new(origin, target - origin), context, out var hit);
            Assert.True(isFound, $"a ray from {origin} to {target} misses");
            Assert.InRange(hit.Distance, 0, (target - origin).Length() + tolerance);
            var named = Resolve(system, hierarchy, start, context.InstancePath.ToArray(), hit);
            Assert.InRange(named.Distance(hit.Point), 0, tolerance);
        }

        return true;

        AffineMap Flatten(AffineMap map) =>
            new(map.Linear * Matrix.Diagonal(new(1, Math.Pow(10, -random.Next(1, 9)), 1)), map.Translation);
    }

    private static bool HasHeight(ExpandedTriangle triangle)
    {
        var (ab, ac, bc) = (triangle.B - triangle.A, triangle.C - triangle.A, triangle.C - triangle.B);
        var longest = Math.Max(ab.Length(), Math.Max(ac.Length(), bc.Length()));
        return Vector.Cross(ab, ac).Length() > 1e-4 * longest;
    }

    private static IEnumerable<ExpandedTriangle> Triangles(
        RecursiveSystem system, RecursiveChain start, ExpandedGraph expanded) =>
        from instance in expanded.Instances
        let chain = start.Follow(system.Recursives, instance.Path)
        from face in Enumerable.Range(0, instance.Mesh.FaceCount)
        select chain.Triangle(instance.Mesh, face);

    private static bool CheckWide(Random random)
    {
        var system = RandomRecursives.Create(random);
        var recursives = system.Recursives;
        var last = recursives.Length - 1;
        recursives[last] = recursives[last] with
        {
            Calls = [.. Enumerable.Range(0, random.Next(65, 200)).Select(_ => new RecursiveCall(
                RandomRecursives.CreateMap(random, random.Next(2) == 0) with { Translation = random.Vector(9) }, random.Next(last + 1)))],
        };
        return Check(random, system, 200, root: last, maxLevels: 1);
    }

    private static bool Check(
        Random random, RecursiveSystem system, int rays, int? root = null, int maxLevels = 4, bool mayBePart = false)
    {
        var (top, levels) = (root ?? random.Next(system.Recursives.Length), random.Next(1, maxLevels + 1));
        var start = RecursiveChain.Begin(top, levels);
        var expanded = new ExpandedGraph(system.GraphOf(top, levels));
        if (expanded.FaceCount is 0 or > MaxFaces)
        {
            return false;
        }

        // One recursive that calls itself only is built as a repetition, whose rounds need not be its levels.
        var isPart = mayBePart && system.Recursives.Length > 1 && random.Next(4) == 0;
        var caster = CreateCaster(system, top, levels, isPart, out var hierarchy);
        var oracle = new RayOracle(Triangles(system, start, expanded));
        var checker = new RayChecker("recursives", caster, oracle, (path, hit) => Resolve(system, hierarchy, start, path, hit));
        var source = new RandomRays(random, oracle);
        var context = new QueryContext();
        for (var i = 0; i < rays; i++)
        {
            var isAtEdge = random.Next(3) == 0;
            var ray = isAtEdge ? source.DrawAtEdge(random, oracle)
                : random.Next(4) == 0 ? DrawGrazing(random, oracle)
                : source.Draw(random, oracle);
            if (isAtEdge)
            {
                checker.CheckEdge(ray, context);
            }
            else
            {
                checker.Check(ray, context);
            }

            if (i % 5 == 0)
            {
                checker.CheckLimits(ray, context);
                CheckFootprint(caster, oracle, ray, new(0, Math.Pow(10, -random.Next(1, 6))), context);
            }
        }

        return true;
    }

    /// <summary>Makes the caster of a hierarchy, or of one of the sub-fractals of a larger hierarchy.</summary>
    private static FractalRayCaster CreateCaster(
        RecursiveSystem system, int root, int levels, bool isPart, out FractalHierarchy hierarchy)
    {
        hierarchy = FractalHierarchyBuilder.Build(system.GraphOf(root, levels + (isPart ? 2 : 0)), keepsAllLevels: isPart);
        var caster = new FractalRayCaster(hierarchy);
        return isPart ? caster.At(new(hierarchy.Levels - (2 * system.Recursives.Length), 0)) : caster;
    }

    /// <summary>Finds the triangle that a hit names, and fails where it names the wrong mesh.</summary>
    private static ExpandedTriangle Resolve(
        RecursiveSystem system, FractalHierarchy hierarchy, RecursiveChain start, int[] path, RayHit hit)
    {
        var chain = start.Follow(system.Recursives, path);
        Assert.Same(hierarchy.BaseMeshes[hit.MeshIndex], hit.Mesh);
        // What is below the precision shows some base mesh.
        if (chain.Levels <= 0)
        {
            Assert.Equal(system.Recursives[chain.Recursive].BasePart, hit.MeshIndex);
            Assert.Same(system.BaseMeshOf(chain.Recursive), hit.Mesh);
        }

        return chain.Triangle(hit.Mesh, hit.FaceIndex);
    }

    /// <summary>Draws a ray that passes a face at a low angle, from near or from far away.</summary>
    private static Ray DrawGrazing(Random random, RayOracle oracle)
    {
        var (_, a, b, c, _) = oracle.Triangles[random.Next(oracle.Triangles.Length)];
        var (u, v) = random.Barycentrics();
        var target = a + (u * (b - a)) + (v * (c - a));
        var along = (random.Between(-1, 1) * (b - a)) + (random.Between(-1, 1) * (c - a));
        var across = Vector.Cross(b - a, c - a);
        var direction = along.Length() > 0 && across.Length() > 0
            ? along.UnitVector() + (Math.Pow(10, -random.Next(0, 8)) * across.UnitVector())
            : random.Direction();
        return new(target - (Math.Pow(10, random.Next(-2, 5)) * oracle.Bounds.Diagonal * direction), direction);
    }

    /// <summary>A wide ray hits what a line hits or something as near, and its hit lies on the triangle that it names.</summary>
    private static void CheckFootprint(RayCaster caster, RayOracle oracle, Ray ray, RayFootprint footprint, QueryContext context)
    {
        var reach = Math.Max(oracle.Magnitude, ray.Origin.MaxAbsComponent());
        if (caster.TryFindNearest(ray, context, out var hit, footprint: footprint))
        {
            var (a, b, c) = hit.Mesh.Face(hit.FaceIndex);
            var local = (hit.Barycentrics.X * a) + (hit.Barycentrics.Y * b) + (hit.Barycentrics.Z * c);
            var tolerance = (4 * footprint.RadiusAt(hit.Distance)) + (1e-11 * reach);
            Near.Equal(hit.Point, hit.InstanceMap * local, tolerance);
            var margin = tolerance * Vector.One;
            var box = new BoundingBox(oracle.Bounds.Minimum - margin, oracle.Bounds.Maximum + margin);
            Assert.Equal(0, box.DistanceSquared(hit.Point));
        }
    }

    private static bool CheckDeep(Random random)
    {
        var system = RandomRecursives.Create(random);
        var recursives = system.Recursives;
        var (root, levels) = (random.Next(recursives.Length), random.Next(5, 60));
        var hierarchy = FractalHierarchyBuilder.Build(system.GraphOf(root, levels));
        var caster = new FractalRayCaster(hierarchy);
        var start = RecursiveChain.Begin(root, levels);
        var context = new QueryContext();
        var checkedCount = 0;
        for (var i = 0; i < 20 && !caster.Box.IsEmpty; i++)
        {
            var chain = start;
            while (chain.Levels > 0 && recursives[chain.Recursive].Calls is { Length: > 0 } calls)
            {
                chain = chain.Call(recursives, random.Next(calls.Length));
            }

            var mesh = system.BaseMeshOf(chain.Recursive);
            if (chain.Levels > 0 || mesh.FaceCount == 0)
            {
                continue;
            }

            var triangle = chain.Triangle(mesh, random.Next(mesh.FaceCount));
            var oracle = new RayOracle([triangle]);
            var magnitude = Math.Max(oracle.Magnitude, caster.Box.MaxAbsCoordinate());
            var target = (triangle.A + triangle.B + triangle.C) / 3;
            var direction = random.Direction();
            var ray = new Ray(target - (random.Between(0, 1) * caster.Box.Diagonal * direction), direction);
            var projected = new ProjectedRay(ray);
            var crossing = projected.Cross(triangle with { Reach = magnitude });
            var isFound = caster.TryFindNearest(ray, context, out var hit);
            if (crossing.IsCertain)
            {
                Assert.True(isFound, $"{ray} misses");
                Assert.InRange(hit.Distance, 0, crossing.Distance + crossing.Tolerance);
                checkedCount++;
            }

            if (isFound)
            {
                var named = Resolve(system, hierarchy, start, context.InstancePath.ToArray(), hit);
                Assert.Null(RayHitCheck.FindProblem(in projected, in hit, named with { Reach = Math.Max(named.Reach, magnitude) }));
            }

            Assert.Equal(isFound, caster.HitsAny(ray, context));
        }

        return checkedCount > 0;
    }
}
