using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Colliders;

/// <summary>The exact fractal collider against brute force over the expanded instances.</summary>
public class ExactFractalColliderTests
{
    // As a part of the fractal's size: distances round in some last places over a chain of a few maps.
    private const double Tolerance = 1e-12;

    [Fact]
    public void TryFindClosest_OnRandomFractals_EqualsBruteForce() => Seeded.Run(400, random =>
    {
        var fractal = RandomFractals.CreateAny(random);
        var collider = new ExactFractalCollider(fractal);
        var oracle = new SimpleCollider(FractalGenerator.Flatten(fractal, 10_000_000));
        for (var query = 0; query < 12; query++)
        {
            Check(collider, oracle, fractal, RandomPosition(random, fractal));
        }
    });

    [Fact]
    public void TryFindClosest_OnSetsBesideInnerRepetitions_EqualsBruteForce() => Seeded.Run(40, random =>
    {
        // A round has more levels than steps. Of more than two rounds, those that recur are not built again.
        var set = TransformationSet.Of(random.Transformation());
        var inner = new Repetition([TransformationSet.Of([random.Transformation(), random.Transformation()])], 2);
        FractalStep[] body = random.Next(2) == 0 ? [set, inner] : [inner, set];
        var fractal = new Fractal(new([new Repetition([.. body], random.Next(3, 6))]), Samples.Tetrahedron);
        var collider = new ExactFractalCollider(fractal);
        var oracle = new SimpleCollider(FractalGenerator.Flatten(fractal, 10_000_000));
        for (var query = 0; query < 12; query++)
        {
            Check(collider, oracle, fractal, RandomPosition(random, fractal));
        }
    });

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void TryFindClosest_OnAppendixB_EqualsBruteForce(int depth)
    {
        var fractal = Samples.AppendixBAt(depth);
        var collider = new ExactFractalCollider(fractal);
        var oracle = new SimpleCollider(FractalGenerator.Flatten(fractal, 10_000_000));
        Seeded.Run(60, random => Check(collider, oracle, fractal, RandomPosition(random, fractal)));
    }

    [Fact]
    public void TryFindClosest_FromAVertex_IsAtDistanceZero() => Seeded.Run(40, random =>
    {
        var fractal = RandomFractals.CreateAny(random);
        var collider = new ExactFractalCollider(fractal);
        var context = new QueryContext();
        var size = fractal.Bounds.Diagonal;
        foreach (var map in FractalGenerator.Expand(fractal, 10_000).Take(20))
        {
            Assert.True(collider.TryFindClosest(map * fractal.BaseMesh.Vertex(0), double.PositiveInfinity, context, out var closest));
            Assert.True(closest.Distance <= Tolerance * size, $"distance {closest.Distance} of a vertex");
            Assert.True(closest.Normal.IsFinite());
        }
    });

    [Fact]
    public void TryFindClosest_WithMaxDistance_FindsWhatIsThereAndNothingElse() => Seeded.RunMost(200, random =>
    {
        var fractal = RandomFractals.CreateAny(random);
        var collider = new ExactFractalCollider(fractal);
        var context = new QueryContext();
        var position = RandomPosition(random, fractal);
        if (!collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest) || closest.Distance == 0)
        {
            return false;
        }

        Assert.True(collider.TryFindClosest(position, closest.Distance * 1.0001, context, out var again));
        Assert.Equal(closest.Distance, again.Distance, Tolerance * fractal.Bounds.Diagonal);
        Assert.False(collider.TryFindClosest(position, closest.Distance * 0.9999, context, out _));
        return true;
    });

    [Fact]
    public void TryFindClosest_WithEpsilon_IsWithinTheFactor() => Seeded.RunMost(200, random =>
    {
        var fractal = RandomFractals.CreateAny(random);
        var collider = new ExactFractalCollider(fractal);
        var context = new QueryContext();
        var position = RandomPosition(random, fractal);
        if (!collider.TryFindClosest(position, double.PositiveInfinity, context, out var exact))
        {
            return false;
        }

        var rounding = Tolerance * fractal.Bounds.Diagonal;
        Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, context, out var near, 0.25));
        Assert.InRange(near.Distance, exact.Distance - rounding, (1.25 * exact.Distance) + rounding);
        return true;
    });

    [Fact]
    public void TryFindClosest_NamesTheInstanceThatItFound() => Seeded.RunMost(200, random =>
    {
        var fractal = RandomFractals.CreateAny(random);
        var context = new QueryContext();
        var position = RandomPosition(random, fractal);
        if (!new ExactFractalCollider(fractal).TryFindClosest(position, double.PositiveInfinity, context, out var closest))
        {
            return false;
        }

        Assert.Equal(fractal.LevelCount, context.InstancePath.Length);
        var map = AffineMap.Identity;
        for (var level = 0; level < context.InstancePath.Length; level++)
        {
            map *= fractal.LevelAt(level).Maps[context.InstancePath[level]];
        }

        var (a, b, c) = fractal.BaseMesh.Face(closest.FaceIndex);
        var point = TriangleKernel.ClosestPoint(position, map * a, map * b, map * c);
        Assert.Equal(closest.Distance, Math.Sqrt(point.DistanceSquared), Tolerance * fractal.Bounds.Diagonal);
        return true;
    });

    [Theory]
    [InlineData(20)]
    [InlineData(60)]
    [InlineData(1_000)]
    [InlineData(1_000_000)]
    [InlineData(null)]
    public void TryFindClosest_AtAnyDepth_AgreesWithAShallowerSponge(int? depth)
    {
        // Depth 8 is within 3⁻⁸ of every greater depth, and so are the distances.
        var deep = new ExactFractalCollider(CreateMenger(depth));
        var shallow = new ExactFractalCollider(CreateMenger(8));
        var context = new QueryContext();
        Seeded.Run(200, random =>
        {
            var position = new Vector(Draw(random), Draw(random), Draw(random));
            Assert.True(deep.TryFindClosest(position, double.PositiveInfinity, context, out var fine));
            Assert.True(shallow.TryFindClosest(position, double.PositiveInfinity, context, out var coarse));
            Assert.Equal(coarse.Distance, fine.Distance, 2 * Math.Pow(3, -8));
            Assert.True(fine.Point.IsFinite() && fine.Normal.IsFinite());
        });
        Assert.True(deep.StorageBytes < 64 * 1024, $"{deep.StorageBytes} bytes");

        static double Draw(Random random) => 1.4 * (random.NextDouble() - 0.5);
    }

    [Fact]
    public void TryFindClosest_AllocatesNothing()
    {
        var collider = new ExactFractalCollider(CreateMenger(6));
        var context = new QueryContext();
        Assert.Equal(0, Allocation.Measure(() =>
        {
            for (var i = 0; i < 100; i++)
            {
                collider.TryFindClosest(new(0.01 * i, 0.2, 0.3), double.PositiveInfinity, context, out _);
            }
        }));
    }

    [Fact]
    public void TryFindClosest_OnTheEmptyFractal_FindsNothing()
    {
        Fractal[] empty = [new(new([new TransformationSet([])]), Samples.Tetrahedron), new(new([]), Mesh.Empty)];
        Assert.All(empty, fractal =>
            Assert.False(new ExactFractalCollider(fractal).TryFindClosest(Vector.Zero, double.PositiveInfinity, new(), out _)));
    }

    [Fact]
    public void Create_OfAFractalBeyondADouble_NamesTheLevel()
    {
        var growing = Samples.Repeated(3000, new Transformation(Vector.I, Vector.Zero, 2 * Vector.One), Transformation.Identity);
        var error = Assert.Throws<FractalLimitException>(() => new ExactFractalCollider(growing));
        Assert.Contains("levels above its base", error.Message, StringComparison.Ordinal);
    }

    private static Fractal CreateMenger(int? depth)
    {
        var offsets = from x in Enumerable.Range(-1, 3)
                      from y in Enumerable.Range(-1, 3)
                      from z in Enumerable.Range(-1, 3)
                      where Math.Abs(x) + Math.Abs(y) + Math.Abs(z) > 1
                      select Samples.MoveAndScale(x / 3.0, y / 3.0, z / 3.0, 1 / 3.0);
        return new(new([new Repetition([new TransformationSet([.. offsets])], depth)]), Samples.ParseObj(SampleFiles.Cube).Mesh);
    }

    /// <summary>Draws a position around the fractal, near its surface, or exactly on it.</summary>
    private static Vector RandomPosition(Random random, Fractal fractal)
    {
        var box = fractal.Bounds;
        var offset = 1.5 * new Vector(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5);
        var anywhere = box.IsEmpty ? Vector.Zero : box.Centre + (box.Size + (0.01 * Vector.One)).Stretch(offset);
        if (random.Next(3) == 0 || fractal.InstanceCount == 0)
        {
            return anywhere;
        }

        var instances = FractalGenerator.Expand(fractal, 100_000);
        var (a, b, c) = fractal.BaseMesh.Face(random.Next(fractal.BaseMesh.FaceCount));
        var onSurface = instances[random.Next(instances.Length)] * ((0.2 * a) + (0.3 * b) + (0.5 * c));
        return random.Next(2) == 0 ? onSurface : onSurface + (0.001 * (anywhere - onSurface));
    }

    private static void Check(Collider collider, Collider oracle, Fractal fractal, Vector position)
    {
        var context = new QueryContext();
        var found = collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest);
        Assert.Equal(oracle.TryFindClosest(position, double.PositiveInfinity, new(), out var expected), found);
        if (found)
        {
            var size = Math.Max(fractal.Bounds.Diagonal, position.MaxAbsComponent());
            Assert.True(Math.Abs(closest.Distance - expected.Distance) <= Tolerance * size,
                $"{closest.Distance} instead of {expected.Distance} from {position}");
            Assert.Equal(closest.Distance, (closest.Point - position).Length(), Tolerance * size);
            Assert.Equal(1, closest.Normal.Length(), 1e-12);
        }
    }
}
