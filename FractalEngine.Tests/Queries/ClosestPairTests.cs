using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Queries.Regions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Queries;

/// <summary>Tests the closest points of two shapes.</summary>
public class ClosestPairTests
{
    private const int MaxTriangles = 400;

    // Relative to the largest coordinate on the way to a triangle.
    private const double Tolerance = 1e-13;
    private const long MaxBoundTests = 1_100_000;

    [Fact]
    public void FindClosestPair_OfRandomShapes_EqualsThatOfAllTriangles() => CheckAll(1, 120);

    [Fact]
    [Trait("Category", "Soak")]
    public void FindClosestPair_OfManyRandomShapes_EqualsThatOfAllTriangles() => CheckAll(1_000_000, 10_000);

    [Fact]
    public void Pairs_ThatDifferInOneNumber_AreNotEqual()
    {
        var sponge = Collider.For(RegionQueryTests.Sponge(2));
        var pair = sponge.FindClosestPair(sponge, AffineMap.Translate(9 * Vector.I));
        Assert.Equal(sponge.FindClosestPair(sponge, AffineMap.Translate(9 * Vector.I)), pair);
        Assert.All(
            (ClosestPair[])
            [
                pair with { Distance = 1 }, pair with { Point = Vector.Zero }, pair with { OtherPoint = Vector.Zero },
                pair with { FaceIndex = -1 }, pair with { OtherFaceIndex = -1 }, pair with { ErrorBound = 1 },
                pair with { InstancePath = [7] }, pair with { OtherInstancePath = [7] },
            ],
            other => Assert.NotEqual(pair, other));
    }

    [Theory]
    [InlineData(null)]
    [InlineData(1_000_000)]
    [InlineData(4)]
    public void FindClosestPair_WithAPoint_EqualsTheClosestPoint(int? depth)
    {
        var sponge = new ExactFractalCollider(RegionQueryTests.Sponge(depth));
        var point = new HierarchyCollider(new([0, 0, 0], [0, 0, 0]));
        Seeded.Run(30, random =>
        {
            var position = (1.5 * Vector.One) + random.Vector(3);
            var closest = sponge.FindClosest(position);
            var pair = sponge.FindClosestPair(point, AffineMap.Translate(position));
            Assert.InRange(pair.Distance, closest.Distance - 1e-13, closest.Distance + Math.Max(1e-13, pair.ErrorBound));
            Assert.Equal(position, pair.OtherPoint);
            Assert.InRange(sponge.FindClosest(pair.Point).Distance, 0, 1e-13);
            Assert.Empty(pair.OtherInstancePath);
        });
    }

    [Theory]
    [InlineData(2)]
    [InlineData(1e-3)]
    [InlineData(1e-9)]
    [InlineData(0)]
    public void FindClosestPair_OfInfiniteSpongesSideBySide_IsTheGap(double gap)
    {
        var sponge = new ExactFractalCollider(RegionQueryTests.Sponge(null));
        var context = new QueryContext();
        var pair = sponge.FindClosestPair(sponge, AffineMap.Translate((3 + gap) * Vector.I), context);
        Assert.InRange(pair.Distance, gap - 1e-14, gap + pair.ErrorBound);
        Assert.InRange(pair.ErrorBound, 0, 1e-7);
        Assert.InRange(context.Statistics.BoundTests, 1, MaxBoundTests);
    }

    [Fact]
    public void FindClosestPair_OfInfiniteFractalsCornerToCorner_IsExact()
    {
        var sponge = new ExactFractalCollider(RegionQueryTests.Sponge(null));
        var other = new Transformation(new(-2, -3, -4), Vector.Zero, -Vector.One).ToAffineMap();
        var pair = sponge.FindClosestPair(sponge, other);
        Assert.Equal(Math.Sqrt(29), pair.Distance, 1e-14);
        Assert.InRange(pair.ErrorBound, 0, 1e-13);
        Assert.All(pair.InstancePath, map => Assert.Equal(0, map));
    }

    [Fact]
    public void FindClosestPair_OfInfiniteFractalsThatIntersect_IsZeroToRounding()
    {
        var sponge = new ExactFractalCollider(RegionQueryTests.Sponge(null));
        Seeded.Run(10, random =>
        {
            var context = new QueryContext();
            // Rotated about its middle, and moved by less than a third of its size.
            var rotation = AffineMap.Rotate(random.Degrees(), 1.5 * Vector.One);
            var pair = sponge.FindClosestPair(sponge, AffineMap.Translate(random.Vector(0.9)) * rotation, context);
            Assert.InRange(pair.Distance, 0, Math.Max(1e-13, pair.ErrorBound));
            Assert.InRange(context.Statistics.BoundTests, 1, MaxBoundTests);
        });
    }

    [Theory]
    [InlineData("sphere", "knot")]
    [InlineData("terrain", "sphere")]
    [InlineData("soup", "soup")]
    public void FindClosestPair_OfLargeMeshes_IsClosestFromBothSides(string name1, string name2)
    {
        var mesh1 = CollisionMeshes.All[name1]();
        var mesh2 = CollisionMeshes.All[name2]();
        var collider = new HierarchyCollider(mesh1);
        Seeded.Run(5, random =>
        {
            var map = new Transformation(6 * mesh1.Bounds.Diagonal * random.Direction(), random.Degrees(), Vector.One).ToAffineMap();
            var other = new HierarchyCollider(mesh2.Transform(v => map * v));
            var pair = collider.FindClosestPair(new SimpleCollider(mesh2), map);
            var swapped = other.FindClosestPair(collider, AffineMap.Identity);
            Assert.Equal(pair.Distance, swapped.Distance, 1e-12);
            Assert.Equal(pair.Distance, collider.FindClosest(pair.OtherPoint).Distance, 1e-12);
            Assert.Equal(pair.Distance, other.FindClosest(pair.Point).Distance, 1e-12);
            Assert.InRange(pair.ErrorBound, 0, 1e-11);
        });
    }

    [Fact]
    public void FindClosestPair_OfTheSameQuery_IsTheSame()
    {
        var sponge = new ExactFractalCollider(RegionQueryTests.Sponge(5));
        var map = new Transformation(new(5, 1, 2), new(10, 20, 30), Vector.One).ToAffineMap();
        Assert.Equal(sponge.FindClosestPair(sponge, map), sponge.FindClosestPair(sponge, map));
    }

    [Fact]
    public void FindClosestPair_WithWhatHasNoAnswer_IsRefused()
    {
        var collider = new HierarchyCollider(Samples.Tetrahedron);
        Assert.Throws<InvalidOperationException>(() => collider.FindClosestPair(new HierarchyCollider(Mesh.Empty), AffineMap.Identity));
        Assert.Throws<InvalidOperationException>(
            () => new ExactFractalCollider(Fractal.Of(Mesh.Empty)).FindClosestPair(collider, AffineMap.Identity));
        Assert.Throws<ArgumentOutOfRangeException>(() => collider.FindClosestPair(collider, AffineMap.Translate(new(double.NaN, 0, 0))));
        Assert.Throws<NotSupportedException>(
            () => collider.FindClosestPair(new BoundingBoxCollider(Samples.Tetrahedron), AffineMap.Identity));
    }

    [Theory]
    [InlineData(1e-120)]
    [InlineData(1e150)]
    public void FindClosestPair_OfExtremeSizes_ScalesWithTheShapes(double scale)
    {
        var collider = new HierarchyCollider(Samples.Tetrahedron.Transform(v => scale * v));
        var pair = collider.FindClosestPair(collider, AffineMap.Translate(-3 * scale * Vector.I));
        Assert.Equal(1, pair.Distance / scale, 1e-12);
    }

    /// <summary>The closest children of the walls are pairs without number, and their bounds are hardly below the gap.</summary>
    [Theory]
    [InlineData(0.1)]
    [InlineData(1e-6)]
    public void FindClosestPair_OfSlantedWalls_StatesWhatIsLeftOpen(double gap)
    {
        var corners = Samples.Tetrahedron;
        var fractal = new Fractal(
            new([new Repetition([new TransformationSet([.. new[] { Vector.Zero, Vector.I, 0.5 * Vector.J, 1.5 * Vector.K }
                .Select(position => Transformation.At(position, 0.5))])], null)]),
            corners);
        var collider = new ExactFractalCollider(fractal);
        // The slanted face has the corners (2, 0, 0), (0, 1, 0), (0, 0, 3): mirrored through its plane, and moved by the gap.
        var normal = new Vector(3, 6, 2) / 7;
        var mirror = new Matrix(
            Vector.I - (2 * normal.X * normal), Vector.J - (2 * normal.Y * normal), Vector.K - (2 * normal.Z * normal));
        var map = new AffineMap(mirror, ((2 * 6 / 7.0) + gap) * normal);
        var context = new QueryContext();
        var pair = collider.FindClosestPair(collider, map, context);
        Assert.InRange(pair.Distance, gap - 1e-14, gap + Math.Max(pair.ErrorBound, 1e-14));
        Assert.InRange(pair.ErrorBound, 0, 1e-5);
        Assert.InRange(context.Statistics.BoundTests, 1, MaxBoundTests);
    }

    [Fact]
    public void FindClosestPair_OfObjectsInAScene_IsInWorldSpace()
    {
        var collider = new SceneCollider(new Scene
        {
            Objects =
            [
                new(Samples.Tetrahedron) { Placement = Transformation.At(new(10, 0, 0)) },
                new(Samples.Tetrahedron) { Placement = new(new(5, 0, 0), Vector.Zero, new(1, 2, 3)) },
            ],
        });
        var pair = collider.FindClosestPair(0, 1);
        Assert.Equal(3, pair.Distance, 1e-14);
        Assert.Equal(new(10, 0, 0), pair.Point);
        Assert.Equal(new(7, 0, 0), pair.OtherPoint);
        Assert.Throws<ArgumentOutOfRangeException>(() => collider.FindClosestPair(0, 2));
        Assert.Throws<ArgumentOutOfRangeException>(() => collider.FindClosestPair(-1, 1));
    }

    private static void CheckAll(int firstSeed, int cases) =>
        Parallel.For(firstSeed, firstSeed + cases, seed => Seeded.RunOne(seed, random =>
        {
            var (fractal1, collider1) = QueryShapes.Create(random, MaxTriangles);
            var (fractal2, collider2) = QueryShapes.Create(random, MaxTriangles);
            var shape1 = new ShapeExpansion(fractal1);
            var shape2 = new ShapeExpansion(fractal2);
            var map = RandomPlacement(random, shape1, shape2);
            if (shape1.Triangles.Length == 0 || shape2.Triangles.Length == 0)
            {
                Assert.Throws<InvalidOperationException>(() => collider1.FindClosestPair(collider2, map));
                return;
            }

            Check(shape1, collider1, shape2, collider2, map);
        }));

    private static void Check(ShapeExpansion shape1, Collider collider1, ShapeExpansion shape2, Collider collider2, AffineMap map)
    {
        var pair = collider1.FindClosestPair(collider2, map);
        var expected = ClosestDistance(shape1, shape2, map);
        var triangle1 = shape1.Resolve(pair.InstancePath.AsSpan(), pair.FaceIndex);
        var triangle2 = shape2.Resolve(pair.OtherInstancePath.AsSpan(), pair.OtherFaceIndex).Transform(map);
        var tolerance = Tolerance
            * Math.Max(Math.Max(shape1.Magnitude, shape2.Magnitude * map.Linear.MaxAbsEntry()), map.Translation.MaxAbsComponent());
        Assert.InRange(triangle1.Distance(pair.Point), 0, tolerance);
        Assert.InRange(triangle2.Distance(pair.OtherPoint), 0, tolerance);
        Assert.InRange((pair.Point - pair.OtherPoint).Length(), pair.Distance - tolerance, pair.Distance + tolerance);
        Assert.InRange(pair.Distance, expected - tolerance, expected + Math.Max(tolerance, pair.ErrorBound));
        Assert.InRange(pair.ErrorBound, 0, Math.Max(pair.Distance, tolerance));
    }

    private static double ClosestDistance(ShapeExpansion shape1, ShapeExpansion shape2, AffineMap map)
    {
        var others = shape2.Triangles.Select(triangle => triangle.Transform(map)).Select(triangle => (triangle, triangle.Box())).ToArray();
        var closest = double.PositiveInfinity;
        foreach (var triangle in shape1.Triangles)
        {
            var box = triangle.Box();
            foreach (var (other, otherBox) in others)
            {
                var gap = Vector.Max(Vector.Max(box.Minimum - otherBox.Maximum, otherBox.Minimum - box.Maximum), Vector.Zero);
                if (gap.LengthSquared() <= closest)
                {
                    closest = Math.Min(
                        closest,
                        TrianglePairKernel.Closest((triangle.A, triangle.B, triangle.C), (other.A, other.B, other.C)).DistanceSquared);
                }
            }
        }

        return Math.Sqrt(closest);
    }

    /// <summary>Places the second shape anywhere, next to the first, or with a vertex on it.</summary>
    private static AffineMap RandomPlacement(Random random, ShapeExpansion shape1, ShapeExpansion shape2)
    {
        var ratio = Math.Clamp(shape1.Magnitude / shape2.Magnitude, 1e-40, 1e40);
        var scale = random.Next(3) == 0 ? random.Vector(1) : random.NextDouble() * Vector.One;
        var linear = new Transformation(Vector.Zero, random.Degrees(), ratio * scale).ToAffineMap();
        if (random.Next(4) == 0)
        {
            linear = AffineMap.Identity;
        }

        if (shape1.Triangles.Length == 0 || shape2.Triangles.Length == 0 || random.Next(3) == 0)
        {
            return linear with { Translation = shape1.Magnitude * random.Vector(3) };
        }

        var vertex = linear * shape2.Triangles[random.Next(shape2.Triangles.Length)].A;
        return linear with { Translation = QueryShapes.Position(random, shape1) - vertex };
    }
}
