using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Colliders;

/// <summary>The paper's descent: its exact costs, and how it errs.</summary>
public class FractalColliderTests
{
    [Theory]
    // The paper's worked example (§5.2.3), and models 3 to 5 of its figure 17. For model 3 it prints 420, which is not its own b·t·d.
    [InlineData(10, 50, 4, 2_000)]
    [InlineData(10, 7, 5, 350)]
    [InlineData(10, 49, 3, 1_470)]
    [InlineData(12, 20, 5, 1_200)]
    public void TryFindClosest_CostsExactlyBaseTimesTransformationsTimesDepth(int faces, int transformations, int depth, long cost)
    {
        var set = Enumerable.Range(0, transformations).Select(i => Samples.MoveAndScale(i, 0.5 * i, 0, 0.3));
        var fractal = new Fractal(new([new Repetition([new TransformationSet([.. set])], depth)]), Fan(faces));
        var context = new QueryContext();
        Assert.True(new FractalCollider(fractal).TryFindClosest(new(1, 2, 3), double.PositiveInfinity, context, out _));
        Assert.Equal((cost, depth), (context.Statistics.FaceTests, context.InstancePath.Length));
    }

    [Fact]
    public void TryFindClosest_OfAnInfiniteFractalWithTheIdentity_Ends()
    {
        // Nearest is always the instance of the identity, which never shrinks.
        TransformationSet set = new([Transformation.Identity, Samples.MoveAndScale(9, 0, 0, 0.5)]);
        var collider = new FractalCollider(new(new([new Repetition([set], null)]), Fan(1)));
        var context = new QueryContext();
        Assert.True(collider.TryFindClosest(new(-1, -1, 0), double.PositiveInfinity, context, out _));
        Assert.Equal(2, context.Statistics.FaceTests);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(4)]
    [Trait("Category", "Soak")]
    public void TryFindClosest_BeyondTheLimitOfTests_IsRefused(int beamWidth)
    {
        var set = Enumerable.Range(0, 1000).Select(i => Samples.MoveAndScale(i, 0.5 * i, 0, 1));
        var fractal = new Fractal(new([new Repetition([new TransformationSet([.. set])], 1_000_000)]), Fan(100));
        Assert.Contains(
            "its cost grows with the depth",
            Assert.Throws<FractalLimitException>(
                () => new FractalCollider(fractal, beamWidth).TryFindClosest(
                    new(1, 2, 3), double.PositiveInfinity, new QueryContext(), out _)).Message,
            StringComparison.Ordinal);
    }

    [Fact]
    public void TryFindClosest_WithTwoSetsInABody_ConcatenatesThem()
    {
        // Appendix B has 5·5 transformations a level.
        var context = new QueryContext();
        Assert.True(new FractalCollider(Samples.AppendixBAt(6)).TryFindClosest(new(1, 2, 3), double.PositiveInfinity, context, out _));
        Assert.Equal(1 * 25 * 6, context.Statistics.FaceTests);
    }

    [Fact]
    public void TryFindClosest_IsNeverCloserThanExactSearch() => Seeded.RunMost(200, random =>
    {
        var fractal = RandomFractals.Create(random);
        var position = random.Vector(4);
        var context = new QueryContext();
        if (!new FractalCollider(fractal).TryFindClosest(position, double.PositiveInfinity, context, out var greedy))
        {
            return false;
        }

        Assert.True(new ExactFractalCollider(fractal).TryFindClosest(position, double.PositiveInfinity, context, out var exact));
        Assert.True(exact.Distance <= greedy.Distance + (1e-12 * fractal.Bounds.Diagonal), $"{exact.Distance} and {greedy.Distance}");
        return true;
    });

    [Fact]
    public void TryFindClosest_WhereTheCloserChildHasTheFartherChildren_Errs()
    {
        // From (2.6, 0, 0) the instance at 0 ends at 1 and that at 4 begins at 4, so the latter is closer. But children of the first reach
        // farther right at the next level.
        var fractal = new Fractal(new(
        [
            new TransformationSet([Transformation.Identity, Samples.Move(4, 0, 0)]),
            new TransformationSet([Samples.Move(1.5, 0, 0), Samples.Move(9, 9, 9)]),
        ]), Samples.Triangle);
        var context = new QueryContext();
        var position = new Vector(2.6, 0, 0);
        new FractalCollider(fractal).TryFindClosest(position, double.PositiveInfinity, context, out var greedy);
        new ExactFractalCollider(fractal).TryFindClosest(position, double.PositiveInfinity, context, out var exact);
        Assert.Equal(0.1, exact.Distance, 1e-12);
        Assert.True(greedy.Distance > 1, $"{greedy.Distance}");
    }

    [Fact]
    public void BeamWidth_OfMoreInstances_ErrsLess()
    {
        var fractal = AssetFractals.Load("appendix-b", 3);
        var exact = new ExactFractalCollider(fractal);
        var colliders = new[] { 1, 2, 4, 16, 64 }.Select(width => new FractalCollider(fractal, width)).ToArray();
        var context = new QueryContext();
        var random = new Random(1);
        var errors = new double[colliders.Length];
        for (var query = 0; query < 200; query++)
        {
            var position = random.Vector(8);
            exact.TryFindClosest(position, double.PositiveInfinity, context, out var expected);
            for (var i = 0; i < errors.Length; i++)
            {
                Assert.True(colliders[i].TryFindClosest(position, double.PositiveInfinity, context, out var found));
                // The tolerance is the rounding of both, as a part of the size.
                Assert.True(found.Distance >= expected.Distance - (1e-12 * fractal.Bounds.Diagonal),
                    $"{found.Distance} and {expected.Distance}");
                errors[i] += found.Distance - expected.Distance;
            }
        }

        Assert.True(errors.Zip(errors[1..]).All(pair => pair.Second < pair.First), string.Join(' ', errors));
    }

    [Fact]
    public void Width_OfAllInstances_IsExactAndNamesTheInstance() => Seeded.RunMost(200, random =>
    {
        var fractal = RandomFractals.Create(random);
        if (fractal.InstanceCount is not { } count || count > 2000)
        {
            return false;
        }

        var context = new QueryContext();
        var position = random.Vector(4);
        var size = fractal.Bounds.Diagonal;
        var found = new FractalCollider(fractal, 2000).TryFindClosest(position, double.PositiveInfinity, context, out var wide);
        var path = context.InstancePath.ToArray();
        Assert.Equal(new ExactFractalCollider(fractal).TryFindClosest(position, double.PositiveInfinity, context, out var exact), found);
        // The tolerance is the rounding of both, as a part of the size and of the distance.
        Assert.Equal(exact.Distance, wide.Distance, 1e-12 * (size + exact.Distance));
        Assert.All(path, mapIndex => Assert.True(mapIndex >= 0));
        return true;
    });

    [Fact]
    public void BeamWidth_OfMoreInstances_AllocatesNothingAndRespectsMaxDistance()
    {
        var collider = new FractalCollider(AssetFractals.Load("tree", null), 8);
        var context = new QueryContext();
        Assert.True(collider.TryFindClosest(new(1, 2, 3), double.PositiveInfinity, context, out var closest));
        Assert.Equal(0, Allocation.Measure(() =>
        {
            Assert.True(collider.TryFindClosest(new(1, 2, 3), closest.Distance, context, out _));
            Assert.False(collider.TryFindClosest(new(1, 2, 3), 0.99 * closest.Distance, context, out _));
        }));
    }

    [Fact]
    public void BeamWidth_LessThanOne_IsRefused() =>
        Assert.Throws<ArgumentOutOfRangeException>(() => new FractalCollider(Samples.AppendixBAt(2), 0));

    private static Mesh Fan(int faces) => new(
        [0, 0, 0, .. Enumerable.Range(0, faces + 1).SelectMany(i => new[] { Math.Cos(0.3 * i), Math.Sin(0.3 * i), 0.1 * i })],
        [.. Enumerable.Range(1, faces).SelectMany(i => new[] { 0, i, i + 1 })]);
}
