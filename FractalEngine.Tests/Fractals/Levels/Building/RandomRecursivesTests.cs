using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels.Building;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;
using static FractalEngine.Tests.Fractals.Levels.Building.RecursiveChecks;

namespace FractalEngine.Tests.Fractals.Levels.Building;

/// <summary>Recursives at random: up to four that call each other, some of them without faces or calls.</summary>
public class RandomRecursivesTests
{
    private static Mesh[] Meshes => RandomRecursives.Meshes;

    [Fact]
    public void Searches_InRandomRecursives_AgreeWithAllFaces() => Seeded.RunMost(60, CheckRandom, minShare: 0.7);

    [Fact]
    [Trait("Category", "Soak")]
    public void Searches_InManyRandomRecursives_AgreeWithAllFaces() => Seeded.RunMostInParallel(20_000, CheckRandom, minShare: 0.7);

    [Fact]
    public void FindClosest_OfPointsOfRandomDeepRecursives_IsAtThem() => Seeded.RunMost(6, CheckRandomDeep, minShare: 0.6);

    [Fact]
    [Trait("Category", "Soak")]
    public void FindClosest_OfPointsOfManyRandomDeepRecursives_IsAtThem() =>
        Seeded.RunMostInParallel(5_000, CheckRandomDeep, minShare: 0.6);

    private static bool CheckRandomDeep(Random random)
    {
        var system = RandomRecursives.Create(random);
        var recursives = system.Recursives;
        var root = random.Next(recursives.Length);
        // Where a base mesh is empty, recursives may alternate between faces and none, so that there is no limit.
        var isInfinite = random.Next(2) == 0 && recursives.All(static recursive => Meshes[recursive.BasePart].FaceCount > 0);
        var levels = isInfinite ? (int?)null : random.Next(20, 1000);
        var collider = new ExactFractalCollider(FractalHierarchyBuilder.Build(system.GraphOf(root, levels)));
        var found = 0;
        for (var query = 0; query < 10; query++)
        {
            // A chain of maps below the precision of coordinates, or to the end.
            var (recursive, map) = (root, AffineMap.Identity);
            for (var left = levels ?? 1000; left > 0 && recursives[recursive].Calls.Length > 0;)
            {
                var call = recursives[recursive].Calls[random.Next(recursives[recursive].Calls.Length)];
                (recursive, map, left) = (call.Target, map * call.Map, left - call.LevelsLess!.Value);
                if (map.Linear.MaxAbsEntry() < 1e-18 || left <= 0)
                {
                    var hasFaces = map.Linear.MaxAbsEntry() < 1e-18 || Meshes[recursives[recursive].BasePart].FaceCount > 0;
                    var point = map.Translation + (hasFaces && left <= 0 && Meshes[recursives[recursive].BasePart].FaceCount > 0
                        ? map.Linear * Meshes[recursives[recursive].BasePart].Vertex(0)
                        : Vector.Zero);
                    if (hasFaces && IsAlive(recursives, recursive, left))
                    {
                        Near.Equal(0, collider.FindClosest(point).Distance, Tolerance * (1 + point.MaxAbsComponent()));
                        found++;
                    }

                    break;
                }
            }
        }

        return found > 0;
    }

    /// <summary>Tells whether a recursive with so many levels has faces at all.</summary>
    private static bool IsAlive(FractalRecursive[] recursives, int recursive, int levels)
    {
        // From the base meshes upwards; a chain of an infinite one is followed for a thousand levels.
        var count = Math.Max(levels, 0);
        var alive = new bool[count + 1, recursives.Length];
        for (var level = 0; level <= count; level++)
        {
            for (var i = 0; i < recursives.Length; i++)
            {
                var left = level;
                alive[level, i] = level == 0
                    ? Meshes[recursives[i].BasePart].FaceCount > 0
                    : recursives[i].Calls.Any(call => alive[Math.Max(0, left - call.LevelsLess!.Value), call.Target]);
            }
        }

        return alive[count, recursive];
    }

    private static bool CheckRandom(Random random)
    {
        var system = RandomRecursives.Create(random);
        var (root, levels) = (random.Next(system.Recursives.Length), random.Next(6));
        var (hierarchy, expanded) = Create(system.GraphOf(root, levels));
        Assert.Equal((expanded.Instances.Count, expanded.FaceCount), Count(hierarchy));
        if (expanded.FaceCount == 0)
        {
            Assert.True(hierarchy.Root.Box.IsEmpty);
            return false;
        }

        AssertBounds(hierarchy, expanded, maxLooseness: 0.15);
        var collider = new ExactFractalCollider(hierarchy);
        for (var query = 0; query < 4; query++)
        {
            var position = RandomPosition(random, expanded.Box);
            AssertClosest(collider, expanded, position);
            AssertAllWithin(collider, expanded, position, random.Between(0, 1));
        }

        return true;
    }
}
