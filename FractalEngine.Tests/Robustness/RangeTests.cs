using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Robustness;

/// <summary>Queries of all shapes at all sizes, from all distances: an answer or a refusal, never a wrong "none".</summary>
public sealed class RangeTests
{
    private static readonly double[] Sizes = [1e-300, 1e-160, 1e-60, 1, 1e60, 1e149, 1e160, 1e300, 1.7e308];

    private static readonly Vector Direction = new(0.3, -0.9, 0.31);

    /// <summary>Sizes with numbers of faces: tested at once, precomputed, and in a hierarchy.</summary>
    public static TheoryData<double, int> Shapes
    {
        get
        {
            var shapes = new TheoryData<double, int>();
            foreach (var size in Sizes)
            {
                shapes.Add(size, 4);
                shapes.Add(size, 30);
                shapes.Add(size, 100);
            }

            return shapes;
        }
    }

    [Theory]
    [MemberData(nameof(Shapes))]
    public void TryFindClosest_OfAMesh_FindsTheClosestPoint(double size, int faces)
    {
        var unit = CreateUnitMesh(faces);
        var mesh = unit.Transform(v => size * v);
        var scene = new SceneCollider(Scene(new PlacedModel(new SceneObject(mesh))));
        foreach (var (position, magnitude) in Positions(size))
        {
            var expected = ExpectedDistance(unit, size, position, magnitude);
            foreach (var kind in new[] { ColliderKind.Exact, ColliderKind.Simple })
            {
                Assert.True(Collider.For(mesh, kind).TryFindClosest(position, double.PositiveInfinity, out var hit));
                AssertNear(expected, hit, magnitude);
            }

            Assert.True(scene.TryFindClosest(position, double.PositiveInfinity, out var sceneHit));
            AssertNear(expected, sceneHit, magnitude);
        }
    }

    // What is thrown far away makes a fractal's precision that of the result, in whichever unit.
    [Theory]
    [InlineData(1e-140)]
    [InlineData(1e-60)]
    [InlineData(1e-42)]
    [InlineData(1e-39)]
    [InlineData(1)]
    [InlineData(1e60)]
    [InlineData(1e130)]
    public void FindClosest_NearWhatAFractalThrowsFarAway_FindsIt(double size)
    {
        var fractal = Fractal.Of(new Mesh([0, 0, 0, size, 0, 0, 0, size, 0], [0, 1, 2]));
        foreach (var far in new[] { 31, 1e3, 1e6 })
        {
            var thrown = fractal.Apply([Transformation.Identity, Transformation.At(new(far * size, 0, 0))]);
            foreach (var shape in new[] { thrown, thrown.Apply([Transformation.Identity, Transformation.At(Vector.Zero, 1e-8)]) })
            {
                var collider = Collider.For(shape);
                var position = size * new Vector(far + 2.5, 0, 0);
                Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, new QueryContext(), out var hit));
                Near.Equal(1.5, hit.Distance / size, 1e-13 * far);
                Assert.True(hit.ErrorBound <= 1e-12 * far * size, $"{hit.ErrorBound:R}");
                Assert.True(collider.Overlaps(position, 1.501 * size));
                // And where another unit begins only behind a map.
                Transformation toUnit = new(new(1, 2, 3), Vector.Zero, Vector.One / size);
                Near.Equal(1.5, Collider.For(shape.WithPlacement(toUnit)).FindClosest(new(far + 3.5, 2, 3)).Distance, 1e-13 * far);
            }
        }
    }

    [Theory]
    [MemberData(nameof(Shapes))]
    public void TryFindClosest_WithAnyEpsilonAndRadius_FindsAPointOrRefuses(double size, int faces)
    {
        var mesh = CreateUnitMesh(faces).Transform(v => size * v);
        Transformation[] maps =
        [
            new(new(0.5 * size, 0, 0), Vector.Zero, 0.5 * Vector.One), new(new(-0.5 * size, 0.1 * size, 0), Vector.Zero, 0.4 * Vector.One),
        ];
        var fractal = Fractal.Of(mesh).Repeat(maps, 3);
        Transformation skewed = new(Vector.Zero, new(10, 20, 30), new(1, 0.5, 0.9));
        // Each is made, or refused, once.
        List<Lazy<Collider>> colliders =
        [
            .. Enum.GetValues<ColliderKind>().Where(kind => kind != ColliderKind.Fractal)
                .Select(kind => new Lazy<Collider>(() => Collider.For(mesh, kind))),
            new(() => Collider.For(fractal)), new(() => Collider.For(fractal, ColliderKind.Fractal)),
        ];
        List<Lazy<SceneCollider>> scenes =
        [
            new(() => new(Scene(new PlacedModel(new SceneObject(mesh) { Placement = skewed })))),
            new(() => new(Scene([.. Enumerable.Range(0, 80).Select(i => new PlacedModel(
                new SceneObject(mesh) { Placement = Samples.Move(size / 100 * i, 0, 0) }))]))),
            new(() => new(Scene([.. Enumerable.Range(0, 2).Select(_ => new PlacedModel(
                new SceneObject(mesh) { Placement = Samples.MoveAndScale(0, 0, 0, 1e-200) }))]))),
        ];
        foreach (var (position, magnitude) in Positions(size))
        {
            foreach (var epsilon in new[] { 0, 1, 1e308, double.PositiveInfinity })
            {
                foreach (var radius in new[] { 1e308, double.PositiveInfinity })
                {
                    foreach (var collider in colliders)
                    {
                        AssertFoundOrRefused(magnitude, () => (
                            collider.Value.TryFindClosest(position, radius, new(), out var closest, epsilon), closest));
                    }

                    foreach (var scene in scenes)
                    {
                        AssertFoundOrRefused(magnitude, () => (
                            scene.Value.TryFindClosest(
                                position, radius, new(), out var closest, out _, epsilon: epsilon), closest));
                    }
                }
            }
        }
    }

    [Theory]
    [MemberData(nameof(Shapes))]
    public void RegionsAndPairs_OfAnySize_AreAnsweredOrRefused(double size, int faces)
    {
        var collider = Collider.For(CreateUnitMesh(faces).Transform(v => size * v));
        foreach (var (position, magnitude) in Positions(size))
        {
            foreach (var radius in new[] { 0, 1e-200, 1, 1e160, 1e308, double.PositiveInfinity })
            {
                var holdsAll = radius > 4 * magnitude;
                Assert.True(collider.FindAllWithin(position, radius, faces).Length == faces || !holdsAll);
                Assert.True(collider.Overlaps(position, radius) || !holdsAll);
                var corner = Math.Min(radius, 1e307) * Vector.One;
                Assert.True(collider.Overlaps(new BoundingBox((0.5 * position) - corner, (0.5 * position) + corner))
                    || !(corner.X > 4 * magnitude));
            }

            try
            {
                var scale = Math.Max(1, position.MaxAbsComponent());
                Assert.True(double.IsFinite(collider.FindClosestPair(collider, new(scale * Matrix.Identity, position)).Distance));
            }
            catch (FractalLimitException)
            {
                Assert.True(size > 1e8, "refused without a reason");
            }
        }
    }

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    public void Queries_OfWhatIsNoNumber_AreRefused(double number)
    {
        var collider = Collider.For(CreateUnitMesh(4));
        var position = new Vector(0, number, 0);
        Assert.Throws<ArgumentOutOfRangeException>(() => collider.FindClosest(position));
        Assert.Throws<ArgumentOutOfRangeException>(() => collider.FindAllWithin(position, 1, 9));
        Assert.Throws<ArgumentOutOfRangeException>(() => collider.Overlaps(position, 1));
        Assert.Throws<ArgumentOutOfRangeException>(() => collider.Overlaps(new BoundingBox(position, position)));
        Assert.Throws<ArgumentOutOfRangeException>(() => collider.FindClosestPair(collider, new(Matrix.Identity, position)));
        Assert.Throws<ArgumentOutOfRangeException>(() => BatchQuery.Run([position], (p, context) => collider.FindClosest(p, context)));
        Assert.Throws<ArgumentOutOfRangeException>(() => collider.Overlaps(Vector.Zero, double.NaN));
    }

    /// <summary>Errors of a query come as they are, not wrapped by the threads that ran them.</summary>
    [Fact]
    public void BatchQuery_OfPositionsThatAColliderRefuses_ThrowsItsError() => Assert.Throws<FractalLimitException>(
        () => BatchQuery.Run(
            [1e100 * Vector.One],
            (position, context) => Collider.For(CreateUnitMesh(4), ColliderKind.BoundingBox).FindClosest(position, context)));

    private static Mesh CreateUnitMesh(int faces)
    {
        var random = new Random(5);
        return new(
            [.. Enumerable.Range(0, 9 * faces).Select(_ => random.Between(-1, 1))], [.. Enumerable.Range(0, 3 * faces)]);
    }

    private static LoadedScene Scene(params PlacedModel[] objects) => new(new(), [.. objects]);

    /// <summary>Positions with the largest coordinate of shape or position.</summary>
    private static IEnumerable<(Vector Position, double Magnitude)> Positions(double size) =>
        Sizes.Append(0).Select(distance => (distance * Direction, Math.Max(size, distance)));

    /// <summary>The distance in units of the magnitude, by the plain kernel on the mesh of size 1.</summary>
    private static double ExpectedDistance(Mesh unit, double size, Vector position, double magnitude)
    {
        var relativeSize = size / magnitude;
        // From so far away the mesh is a point.
        return relativeSize < 1e-40
            ? (position / magnitude).Length()
            : relativeSize * Enumerable.Range(0, unit.FaceCount).Min(face =>
            {
                var (a, b, c) = unit.Face(face);
                return Math.Sqrt(TriangleKernel.ClosestPoint(position / magnitude / relativeSize, a, b, c).DistanceSquared);
            });
    }

    private static void AssertNear(double expected, ClosestHit hit, double magnitude)
    {
        // The rounding of coordinates, as elsewhere.
        Assert.Equal(expected, hit.Distance / magnitude, 1e-12);
        Assert.True(hit.Point.IsFinite());
        Assert.Equal(1, hit.Normal.Length(), 1e-12);
    }

    private static void AssertFoundOrRefused(double magnitude, Func<(bool IsFound, ClosestPoint Closest)> query)
    {
        try
        {
            var (isFound, closest) = query();
            Assert.True(isFound || magnitude > 2e307, "none");
            Assert.True(double.IsFinite(closest.Distance) && closest.Point.IsFinite(), $"{closest}");
        }
        catch (FractalLimitException exception)
        {
            Assert.True(
                magnitude > 1e307 || exception.Message.Contains("not exact", StringComparison.Ordinal), exception.Message);
        }
    }
}
