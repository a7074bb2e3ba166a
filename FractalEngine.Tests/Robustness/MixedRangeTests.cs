using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Robustness;

/// <summary>Shapes whose parts, or whose base mesh and maps, are of very different sizes.</summary>
public sealed class MixedRangeTests
{
    [Theory]
    [InlineData(1e20)]
    [InlineData(1e100)]
    [InlineData(1e300)]
    public void Queries_BesideAnUnusedVertex_KnowNothingOfIt(double far)
    {
        var mesh = new Mesh([-10, -10, 0, 10, -10, 0, 0, 10, 0, far, 0, 0], [0, 1, 2]);
        var single = Fractal.Of(mesh).Apply([Transformation.Identity]);
        Collider[] colliders =
        [
            Collider.For(mesh), Collider.For(mesh, ColliderKind.Simple), Collider.For(mesh, ColliderKind.BoundingBox), Collider.For(single),
        ];
        foreach (var collider in colliders)
        {
            var hit = collider.FindClosest(new Vector(0.5, 0, 1));
            Assert.Equal((1, new Vector(0.5, 0, 0)), (hit.Distance, hit.Point));
        }

        Assert.Single(colliders[0].FindAllWithin(Vector.K, 1, 9));
        Assert.True(colliders[0].Overlaps(new BoundingBox(new(-1, -1, -1), new(1, 1, 0))));
        Assert.False(colliders[0].Overlaps(new BoundingBox(new(-1, -1, 1e-9), new(1, 1, 1))));
        var pair = colliders[0].FindClosestPair(colliders[3], AffineMap.Translate(2 * Vector.K));
        Assert.Equal(2, pair.Distance);
        foreach (var caster in (RayCaster[])[RayCaster.For(mesh), RayCaster.For(single)])
        {
            Assert.Equal(3, Assert.NotNull(caster.FindNearest(new(new(0, 0, 3), -Vector.K))).Distance);
            // Beside an edge by a billionth.
            Assert.Null(caster.FindNearest(new(new(0, -10 - 1e-9, 3), -Vector.K)));
        }
    }

    /// <summary>A large triangle under the position, and a small one farther away.</summary>
    [Theory]
    [InlineData(1e90)]
    [InlineData(1e-90)]
    [InlineData(1e30)]
    public void FindClosest_OfABaseMeshInOtherUnits_FindsTheInsideOfAFace(double unit)
    {
        var mesh = new Mesh(
            [.. new[] { -10, -10, 0, 10, -10, 0, 0, 10, 0, 0, 0, 4, 0.1, 0, 4, 0, 0.1, 4 }.Select(coordinate => unit * coordinate)],
            [0, 1, 2, 3, 4, 5]);
        var collider = Collider.For(Fractal.Of(mesh).Apply([Transformation.At(Vector.Zero, 1 / unit)]));
        var hit = collider.FindClosest(Vector.K);
        Assert.Equal(0, hit.FaceIndex);
        Near.Equal(1, hit.Distance, 1e-14);
        Near.Equal(Vector.Zero, hit.Point, 1e-14);
    }

    [Theory]
    [InlineData(1e-160)]
    [InlineData(1e-100)]
    [InlineData(1e-10)]
    public void FindClosest_OfAnInstanceLikeAPoint_FindsIt(double scale)
    {
        var point = Transformation.At(new(5, 0, 0), scale);
        var collider = Collider.For(Fractal.Of(Shapes.Cube()).Apply([point, Transformation.At(new(-5, 0, 0), 0.5)]));
        Near.Equal(0.25, collider.FindClosest(new Vector(5.25, 0, 0)).Distance, 1e-9);
        Near.Equal(0.25, Collider.For(Fractal.Of(Shapes.Cube()).Apply([point])).FindClosest(new Vector(5.25, 0, 0)).Distance, 1e-9);
    }

    [Fact]
    public void FindClosest_OfTinyMapsInARow_FindsTheirInstance()
    {
        var collider = Collider.For(Fractal.Of(Shapes.Cube()).Repeat([Transformation.At(new(5, 0, 0), 1e-80)], 2));
        Near.Equal(0.25, collider.FindClosest(new Vector(5.25, 0, 0)).Distance, 1e-14);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(1e-100)]
    [InlineData(1e-158)]
    public void FindClosestPair_OfAnySize_HasAnHonestBound(double size)
    {
        var cube = Shapes.Cube().Transform(vertex => size * vertex);
        var collider = Collider.For(Fractal.Of(cube).Repeat(
            [Transformation.At(new(size, 0, 0), 0.5), Transformation.At(new(-size, 0, 0), 0.5)], 3));
        var pair = collider.FindClosestPair(collider, AffineMap.Translate(new(9 * size, 0, 0)));
        // It reaches 1 + 1/2 + 1/4 + 1/16 to both sides.
        Near.Equal(9 - 3.625, pair.Distance / size, 1e-12);
        Assert.InRange(pair.ErrorBound / size, 0, 1e-12);
    }

    /// <summary>What is accepted first may be beyond the radius, and hide what is within it.</summary>
    [Fact]
    public void TryFindClosest_WithARadiusAndEpsilonAndAnOutlier_FindsWhatIsWithin() => Seeded.Run(300, random =>
    {
        Transformation At(Vector position) => new(position, random.Degrees(), new(0.1, 0.12, 0.09));
        var direction = random.Direction();
        var collider = Collider.For(Fractal.Of(Shapes.Cube()).Apply(
            [At(random.Between(1.01, 1.2) * random.Direction()), At(random.Between(1, 1.1) * direction), At(1e15 * random.Direction())]));
        var context = new QueryContext();
        Assert.True(collider.TryFindClosest(Vector.Zero, double.PositiveInfinity, context, out var exact));
        var radius = exact.Distance * (1 + 1e-6);
        foreach (var epsilon in (double[])[0.01, 0.1, 1])
        {
            Assert.True(collider.TryFindClosest(Vector.Zero, radius, context, out var found, epsilon));
            Assert.InRange(found.Distance, exact.Distance * (1 - 1e-12), radius);
        }
    });

    [Fact]
    public void Rays_AtASceneWithAnUnusedVertex_PassBesideFaces()
    {
        var mesh = new Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0, 1e12, 0, 0], [0, 1, 2]);
        var caster = RayCaster.For(mesh);
        Assert.Null(caster.FindNearest(new(new(0.503, 0.503, 1), -Vector.K)));
        Assert.NotNull(caster.FindNearest(new(new(0.497, 0.497, 1), -Vector.K)));
    }
}
