using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals;

/// <summary>Rays around a camera deep in a fractal: where doubles can still tell, they equal those of the fractal's own frame.</summary>
public class DeepZoomRayCasterTests
{
    private const int MaxAncestors = 1000;

    // Far enough from the fixed point that the camera sees all sides of it.
    private static readonly Vector Offset = new(-0.31, -0.27, -0.19);

    [Theory]
    [InlineData("menger", 0)]
    [InlineData("menger", 7)]
    [InlineData("sierpinski", 0)]
    [InlineData("tree", 1)]
    public void TryFindNearest_SomeLevelsDeep_EqualsThatOfTheWholeFractal(string name, int mapIndex)
    {
        // Finite, so that both end at the base mesh.
        var fractal = FractalAddressTests.CreateInfinite(name).WithDepth(7);
        var whole = RayCaster.For(fractal);
        var dive = new FractalDive(LodHierarchy.Build(fractal), mapIndex, AffineMap.Identity, new(-1, -0.7, -0.9));
        dive.GoToDepth(4);
        var caster = new DeepZoomRayCaster(fractal, dive.Address.CollectRoots(MaxAncestors));
        var (eye, unit) = (dive.Address.WorldPosition(AffineMap.Identity), Math.Exp(dive.Address.LogUnit));
        var context = new QueryContext();
        var (checkedRays, hits) = (0, 0);
        Seeded.Run(2000, random =>
        {
            var direction = random.Vector(1);
            var ray = new Ray(eye, direction);
            var isHit = whole.TryFindNearest(ray, context, out var expected);
            if (!IsCertain(whole, ray, isHit, expected.Distance))
            {
                return;
            }

            checkedRays++;
            Assert.Equal(isHit, caster.TryFindNearest(new(Vector.Zero, direction), context, out var hit, out var rootIndex));
            Assert.Equal(isHit, caster.HitsAny(new(Vector.Zero, direction), context));
            Assert.Equal(isHit, rootIndex >= 0);
            if (isHit)
            {
                hits++;
                Near.Equal(expected.Distance, unit * hit.Distance, 1e-9);
                Near.Equal(0, (expected.Normal - hit.Normal).Length(), 1e-9);
                Near.Equal(0, (eye + (unit * hit.Point) - expected.Point).Length(), 1e-9);
            }
        });
        Assert.InRange(checkedRays, 1000, 2000);
        Assert.InRange(hits, 20, 2000);
    }

    [Theory]
    [InlineData("menger", 0, 300)]
    [InlineData("menger", 7, 10_000)]
    [InlineData("sierpinski", 0, 300)]
    public void TryFindNearest_AtAnyDepth_IsThatOfDepth50(string name, int mapIndex, int depth) => CheckSameAsAt50(name, mapIndex, depth);

    [Theory]
    [InlineData("menger", 0)]
    [InlineData("menger", 7)]
    [InlineData("sierpinski", 0)]
    [Trait("Category", "Soak")]
    public void TryFindNearest_NearlyAMillionLevelsDeep_IsThatOfDepth50(string name, int mapIndex) =>
        // Short of the last level that a camera can enter: there it sees its sub-fractal from nearer.
        CheckSameAsAt50(name, mapIndex, (int)FractalLimits.Depth.Value - 1000);

    [Fact]
    public void TryFindNearest_OnceWarm_AllocatesNothing()
    {
        var caster = CasterAt("menger", 0, 300, out _);
        var context = new QueryContext();
        var random = new Random(3);
        var rays = Enumerable.Range(0, 500).Select(_ => new Ray(Vector.Zero, random.Vector(1))).ToArray();
        var cast = () => Array.ForEach(rays, ray => caster.TryFindNearest(ray, context, out _, out _));
        cast();
        Assert.InRange(Allocation.Measure(cast), 0, 200);
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void GradientFactorOf_SomeLevelsDeep_IsThatOfTheWholeFractal(bool hasTwoSets)
    {
        var fractal = FractalAddressTests.CreateInfinite("menger").WithDepth(6);
        if (hasTwoSets)
        {
            // The same shape by turns with and without another map far away: a place in the one is another in the other.
            var set = (TransformationSet)((Repetition)fractal.Description.Steps[0]).Round[0];
            TransformationSet larger = new([.. set.Transformations, Samples.MoveAndScale(40, 0, 0, 0.01)]);
            fractal = new(new([new Repetition([set, larger], 3)]), fractal.BaseMesh);
        }

        var whole = RayCaster.For(fractal);
        var dive = new FractalDive(LodHierarchy.Build(fractal), 7, AffineMap.Identity, new(-1, 1, 0.8));
        dive.GoToDepth(3);
        var caster = new DeepZoomRayCaster(fractal, dive.Address.CollectRoots(MaxAncestors));
        var eye = dive.Address.WorldPosition(AffineMap.Identity);
        var context = new QueryContext();
        var hits = 0;
        Seeded.Run(300, random =>
        {
            var ray = new Ray(eye, random.Vector(1));
            if (!whole.TryFindNearest(ray, context, out var hit) || !IsCertain(whole, ray, true, hit.Distance))
            {
                return;
            }

            var path = context.InstancePath.ToArray();
            Assert.True(caster.TryFindNearest(new(Vector.Zero, ray.Direction), context, out _, out var rootIndex));
            Near.Equal(
                ColourPath.GradientFactorOf(fractal, GradientKind.Path, path),
                caster.GradientFactorOf(GradientKind.Path, rootIndex, context), 1e-5);
            hits++;
        });
        Assert.InRange(hits, 20, 300);
    }

    [Fact]
    public void DeepZoomRayCaster_OfAComponentwiseFractal_IsRefused()
    {
        var fractal = FractalAddressTests.CreateInfinite("menger").WithDepth(2);
        var componentwise = new Fractal(fractal.Description with { Composition = Composition.Componentwise }, fractal.BaseMesh);
        Assert.Throws<ArgumentException>(() => new DeepZoomRayCaster(componentwise, []));
        Assert.Throws<ArgumentNullException>("fractal", () => new DeepZoomRayCaster(null!, []));
    }

    /// <summary>Compares rays at a depth with those at depth 50, where an infinite fractal looks the same.</summary>
    private static void CheckSameAsAt50(string name, int mapIndex, int depth)
    {
        var shallow = CasterAt(name, mapIndex, 50, out var shallowDive);
        var deep = CasterAt(name, mapIndex, depth, out var deepDive);
        Near.Equal(0, Near.Difference(shallowDive.Address.FrameToCamera, deepDive.Address.FrameToCamera), 1e-9);
        var context = new QueryContext();
        var (same, hits) = (0, 0);
        Seeded.Run(1000, random =>
        {
            var ray = new Ray(Vector.Zero, random.Vector(1));
            var isHit = shallow.TryFindNearest(ray, context, out var expected, out _);
            var isDeepHit = deep.TryFindNearest(ray, context, out var hit, out _);
            hits += isHit ? 1 : 0;
            same += isHit == isDeepHit && (!isHit || Math.Abs(expected.Distance - hit.Distance) <= 1e-7 * (1 + hit.Distance)) ? 1 : 0;
        });
        Assert.InRange(hits, 50, 1000);
        // The cameras differ by rounding, so that a ray in a hundred passes another part.
        Assert.InRange(same, 990, 1000);
    }

    private static DeepZoomRayCaster CasterAt(string name, int mapIndex, int depth, out FractalDive dive)
    {
        dive = FractalAddressTests.CreateDive(name, mapIndex, AffineMap.Identity);
        dive.GoToDepth(depth);
        dive.ConvergeTo(Offset);
        return new(FractalAddressTests.CreateInfinite(name), dive.Address.CollectRoots(MaxAncestors));
    }

    /// <summary>Tells whether rays beside a ray, by more than rounding, hit at the same distance.</summary>
    private static bool IsCertain(RayCaster caster, Ray ray, bool isHit, double distance)
    {
        const double Shift = 1e-12;
        foreach (var shift in (Vector[])[Shift * Vector.I, -Shift * Vector.J, Shift * Vector.K, -Shift * Vector.One])
        {
            var beside = caster.FindNearest(ray with { Origin = ray.Origin + shift });
            if (beside is not null != isHit || (isHit && !(Math.Abs(beside!.Value.Distance - distance) <= 1e-10)))
            {
                return false;
            }
        }

        return true;
    }
}
