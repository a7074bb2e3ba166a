using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals;

/// <summary>Tests lists of instances against expansions, and their paths against the maps of the fractal.</summary>
[Collection(AloneTests.Name)]
public class InstanceEnumerationTests
{
    private const long MaxInstances = 20_000;

    // Of the largest entry: products in another order differ by some roundings a level.
    private const double Tolerance = 1e-11;

    public static TheoryData<string> Files =>
        [.. Directory.GetFiles(Repository.Full("assets/fractals"), "*.fdo").Select(path => Path.GetFileName(path)!).Order()];

    [Fact]
    public void Enumerate_OfAnyFractal_IsItsExpansion() => Seeded.RunMost(300, random =>
    {
        var fractal = RandomFractals.CreateAny(random);
        return HaveSameInstances(fractal, hasPaths: false) && HaveSameInstances(fractal, hasPaths: true);
    });

    [Theory]
    [MemberData(nameof(Files))]
    public void Enumerate_OfAFile_IsItsExpansionWithPaths(string name)
    {
        var fractal = FractalFile.Read(Repository.Full($"assets/fractals/{name}"));
        for (var depth = 4; depth > 0 && (fractal.Description.IsInfinite || fractal.InstanceCount > MaxInstances); depth--)
        {
            fractal = fractal.Description.HasDepth ? fractal.WithDepth(depth) : fractal.WithMaxInstances(100);
        }

        fractal = fractal.InstanceCount <= MaxInstances ? fractal : fractal.WithMaxInstances(MaxInstances);
        foreach (var part in fractal.ByMesh.Where(static part => part.BaseMesh.FaceCount > 0))
        {
            Assert.True(HaveSameInstances(part, hasPaths: true));
        }
    }

    [Fact]
    public void Enumerate_OfWhatCantCoincide_HoldsNoneOfThem()
    {
        var (instances, count) = RenderScenes.Menger(5).Fractal.Enumerate(4_000_000);
        Assert.Equal(3_200_000, count);
        _ = instances.Take(1000).Count();
        var before = GC.GetTotalMemory(forceFullCollection: true);
        var most = instances.Take(200_000).Index().Where(static item => item.Index % 50_000 == 0)
            .Max(_ => GC.GetTotalMemory(forceFullCollection: true));
        // One instance takes 136 bytes, and a level of twenty some kilobytes.
        Assert.True(most - before < 1_000_000, $"{most - before} bytes");
    }

    [Fact]
    public void Enumerate_OfMoreThanTheLimit_SaysSo() => Assert.Equal(
        "the fractal has 8,000 instances, more than the limit of 7,999",
        Assert.Throws<FractalLimitException>(() => RenderScenes.Menger(3).Fractal.Enumerate(7999)).Message);

    [Theory]
    [InlineData(1, 1)]
    [InlineData(19, 1)]
    [InlineData(20, 20)]
    [InlineData(100, 96)]
    [InlineData(418, 400)]
    [InlineData(419, 419)]
    public void ListLargest_OfASponge_DividesTheLargestFirst(int max, int expected)
    {
        var found = InstanceEnumeration.ListLargest([(RenderScenes.Menger(null).Fractal, AffineMap.Identity)], max);
        Assert.Equal(expected, found.Count);
        var sizes = found.Select(one => one.Instance.Map.Linear.V1.X).ToArray();
        // No part is left that is more than one step larger than another.
        Assert.InRange(sizes.Max() / sizes.Min(), 1, 3.0000001);
        // Twenty parts of a third in place of each.
        Near.Equal(1, found.Sum(one => Math.Pow(one.Instance.Map.Linear.V1.X, Math.Log(20) / Math.Log(3))), 1e-9);
    }

    [Fact]
    public void ListLargest_OfAMapWithoutEnd_EndsWhereNothingIsLeftOfTheMesh()
    {
        var (_, instance) = Assert.Single(InstanceEnumeration.ListLargest(
            [(Samples.Repeated(null, Samples.MoveAndScale(1, 0, 0, 0.5)), AffineMap.Identity)], 9));
        Assert.InRange(instance.Path!.ToArray().Length, 40, 1100);
    }

    [Fact]
    public void ListLargest_WithRoomForAll_IsTheWholeFractal()
    {
        var fractal = RenderScenes.Menger(2).Fractal;
        var placement = Transformation.Identity with { Scale = new(2, 1, 1) };
        var found = InstanceEnumeration.ListLargest([(fractal, AffineMap.Identity), (fractal, placement.ToAffineMap())], 1000);
        foreach (var index in (int[])[0, 1])
        {
            AssertSame(
                fractal.Expand(1000).Select(map => new MeshInstance(0, map, Tint.None)),
                found.Where(one => one.Fractal == index).Select(one => one.Instance));
        }
    }

    private static bool HaveSameInstances(Fractal fractal, bool hasPaths)
    {
        var (instances, count) = fractal.Enumerate(MaxInstances, hasPaths);
        var found = instances.ToArray();
        Assert.Equal(found.Length, count);
        var (maps, tints) = fractal.ExpandTinted(MaxInstances);
        AssertSame(maps.Select((map, i) => new MeshInstance(0, map, tints.IsEmpty ? Tint.None : tints[i])), found);
        if (!hasPaths)
        {
            return true;
        }

        foreach (var instance in found)
        {
            var path = instance.Path?.ToArray() ?? [];
            var steps = fractal.Follow(path);
            Assert.NotNull(steps);
            var product = steps.Aggregate(AffineMap.Identity, static (map, step) => map * step.Map);
            Near.Equal(product, instance.Map, Tolerance * SizeOf(product));
        }

        return found.Any(static instance => instance.Path is not null) || found.Length <= 1;
    }

    private static void AssertSame(IEnumerable<MeshInstance> expected, IEnumerable<MeshInstance> actual)
    {
        var left = expected.ToList();
        var found = actual.ToArray();
        Assert.Equal(left.Count, found.Length);
        // By a coarse order first, since all pairs would be too many.
        static double KeyOf(MeshInstance one) => Vector.Dot(new(0.37, 0.61, 0.29), one.Map * new Vector(0.11, 0.23, 0.31));
        var keyed = left.Select(one => (Key: KeyOf(one), One: one)).OrderBy(static item => item.Key).ToArray();
        foreach (var (instance, other) in found.OrderBy(KeyOf).Zip(keyed))
        {
            Near.Equal(other.Key, KeyOf(instance), 1e-9 * SizeOf(other.One.Map));
        }
    }

    private static double SizeOf(AffineMap map) => 1 + map.Linear.MaxAbsEntry() + map.Translation.MaxAbsComponent();
}
