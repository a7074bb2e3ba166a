using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Support;

/// <summary>Tests that random shapes are of all sorts, each often enough to be seen in a test of a hundred of them.</summary>
public class RandomShapesTests
{
    private const int Shapes = 2000;

    private static readonly Dictionary<string, Func<Mesh, bool>> MeshSorts = new()
    {
        ["flat along an axis, not at 0"] = mesh => Enumerable.Range(0, 3).Any(
            axis => Component(mesh.Bounds.Size, axis) == 0 && Component(mesh.Bounds.Minimum, axis) != 0),
        ["flat, turned"] = mesh => IsFlat(mesh) && !Enumerable.Range(0, 3).Any(axis => Component(mesh.Bounds.Size, axis) == 0),
        ["a needle"] = mesh => Heights(mesh).Any(height => height is > 0 and < 1e-3),
        ["a face without area"] = mesh => Heights(mesh).Any(height => height < 1e-15),
        ["a vertex far away"] = HasFarVertex,
        ["vertices twice"] = mesh => NaiveFractal.Vertices(mesh).Distinct().Count() < mesh.VertexCount,
        ["more than 16 faces of a hull"] = mesh => mesh.FaceCount > 16 && !IsFlat(mesh),
        ["several components"] = mesh => ComponentCount(mesh) > 1,
        ["around (1000, −999, 0)"] = mesh => (mesh.Bounds.Centre - new Vector(1000, -999, 0)).MaxAbsComponent() < 10,
        ["a closed solid"] = mesh => mesh.FaceCount == 4 && mesh.VertexCount == 4,
        ["tiny"] = mesh => mesh.Bounds.Diagonal < 1e-3,
        ["huge"] = mesh => mesh.Bounds.Diagonal > 1e3,
    };

    private static readonly Dictionary<MapTraits, Func<TransformationSet, bool>> MapSorts = new()
    {
        [MapTraits.Identities] = set => set.Maps.Any(IsIdentity),
        [MapTraits.Equal] = set => CountDistinct(set.Maps.Where(map => !IsIdentity(map))) < set.Maps.Count(map => !IsIdentity(map)),
        [MapTraits.Outliers] = set => set.Transformations.Any(map => map.Position.MaxAbsComponent() > 5e5),
        [MapTraits.LargeScales] = set => set.Transformations.Length > 1 && set.Transformations.Any(
            map => map.Scale.Absolute().MaxAbsComponent() > 1),
        [MapTraits.UnevenScales] = set => set.Transformations.Any(map => map.Scale.Absolute() is var (x, y, z)
            && (x != y || y != z) && Math.Min(x, Math.Min(y, z)) > 1e-2),
        [MapTraits.Mirrors] = set => set.Maps.Any(map => map.Linear.Determinant() < 0),
        [MapTraits.NearlyFlat] = set => set.Transformations.Any(map => map.Scale.Absolute() is var (x, y, z)
            && Math.Min(x, Math.Min(y, z)) < 2e-3 * map.Scale.MaxAbsComponent()),
    };

    [Fact]
    public void Create_OfManySeeds_DrawsAllSortsOfMeshes()
    {
        var counts = MeshSorts.Keys.ToDictionary(sort => sort, _ => 0);
        Seeded.Run(Shapes, random =>
        {
            var mesh = RandomShapes.Create(random).BaseMesh;
            Assert.InRange(mesh.FaceCount, 1, RandomMeshes.MaxFaces);
            foreach (var (sort, isOfSort) in MeshSorts)
            {
                counts[sort] += isOfSort(mesh) ? 1 : 0;
            }
        });
        Assert.All(counts, count => Seeded.AssertMost(count.Value, Shapes, 0.02));
    }

    [Fact]
    public void Create_OfManySeeds_DrawsAllSortsOfMaps()
    {
        var counts = MapSorts.Keys.ToDictionary(trait => trait, _ => 0);
        var manyLevels = 0;
        Seeded.Run(Shapes, random =>
        {
            var fractal = RandomShapes.Create(random);
            Assert.InRange((int)fractal.InstanceCount!.Value, 1, 400);
            var sets = Sets(fractal).ToArray();
            foreach (var (trait, isOfSort) in MapSorts)
            {
                counts[trait] += sets.Any(isOfSort) ? 1 : 0;
            }

            manyLevels += fractal.LevelCount >= 2 && fractal.InstanceCount >= 30 ? 1 : 0;
        });
        Assert.All(counts, count => Seeded.AssertMost(count.Value, Shapes, 0.05));
        Seeded.AssertMost(manyLevels, Shapes, 0.4);
    }

    [Fact]
    public void Create_WithoutATrait_NeverDrawsIt() => Seeded.Run(300, random =>
    {
        foreach (var (trait, isOfSort) in MapSorts)
        {
            Assert.False(Sets(RandomShapes.Create(random, excluded: trait)).Any(isOfSort), $"a set has {trait}");
        }
    });

    [Fact]
    public void Create_OfOneSeed_IsTheSameTwiceAndWithinItsBudget() => Seeded.Run(200, random =>
    {
        var seed = random.Next();
        var fractal = RandomShapes.Create(new(seed), 50, 300);
        Assert.Equal(fractal, RandomShapes.Create(new(seed), 50, 300));
        Assert.InRange((int)fractal.InstanceCount!.Value, 1, 50);
        Assert.InRange((int)fractal.FaceCount!.Value, 1, 300);
    });

    [Fact]
    public void Respell_OfAnyMap_IsTheSameMap() => Seeded.Run(200, random =>
    {
        var map = random.Transformation();
        var respelled = RandomMapSets.Respell(random, map);
        Assert.NotEqual(map, respelled);
        Near.Equal(0, Near.Difference(map.ToAffineMap(), respelled.ToAffineMap()), 1e-14);
    });

    private static IEnumerable<TransformationSet> Sets(Fractal fractal) =>
        Enumerable.Range(0, (int)fractal.LevelCount!.Value).Select(level => fractal.LevelAt(level)).Distinct();

    // Rounding of sines and cosines is the only difference.
    private static bool IsIdentity(AffineMap map) => Near.Difference(map, AffineMap.Identity) < 1e-14;

    private static int CountDistinct(IEnumerable<AffineMap> maps)
    {
        List<AffineMap> distinct = [];
        foreach (var map in maps)
        {
            if (distinct.TrueForAll(other => Near.Difference(map, other) > 1e-14 * (1 + map.Translation.MaxAbsComponent())))
            {
                distinct.Add(map);
            }
        }

        return distinct.Count;
    }

    private static double Component(Vector v, int axis) => axis == 0 ? v.X : axis == 1 ? v.Y : v.Z;

    /// <summary>Tells whether one vertex is farther from all others than these are from each other.</summary>
    private static bool HasFarVertex(Mesh mesh) => NaiveFractal.Vertices(mesh).Any(v =>
    {
        var box = NaiveFractal.Box(NaiveFractal.Vertices(mesh).Where(other => other != v));
        return !box.IsEmpty && (v - box.Centre).Length() > 20 * box.Diagonal;
    });

    private static bool IsFlat(Mesh mesh)
    {
        var (a, b, c) = mesh.Face(0);
        var normal = Vector.Cross(b - a, c - a);
        return normal.Length() > 0 && NaiveFractal.Vertices(mesh).All(
            v => Math.Abs(Vector.Dot(v - a, normal.UnitVector())) < 1e-14 * (mesh.Bounds.Diagonal + a.MaxAbsComponent()));
    }

    /// <summary>Heights of all faces above their longest edge, as parts of its length.</summary>
    private static IEnumerable<double> Heights(Mesh mesh) => Enumerable.Range(0, mesh.FaceCount).Select(face =>
    {
        var (a, b, c) = mesh.Face(face);
        var longest = Math.Max((b - a).Length(), Math.Max((c - b).Length(), (a - c).Length()));
        return longest > 0 ? Vector.Cross(b - a, c - a).Length() / (longest * longest) : 0;
    });

    /// <summary>Counts parts that are connected by vertices at the same place.</summary>
    private static int ComponentCount(Mesh mesh)
    {
        var parts = new List<HashSet<Vector>>();
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            HashSet<Vector> joined = [a, b, c];
            joined.UnionWith(parts.Where(part => part.Overlaps(joined)).SelectMany(part => part).ToArray());
            parts.RemoveAll(part => part.Overlaps(joined));
            parts.Add(joined);
        }

        return parts.Count;
    }
}
