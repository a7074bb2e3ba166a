using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Queries.Regions;

/// <summary>Tests queries of balls and boxes at their limits.</summary>
public class RegionQueryTests
{
    // Several times the limit of a walk, which tests a few bounds more for each face it finds.
    private const long MaxBoundTests = 3_000_000;

    private static readonly Fractal InfiniteSponge = Sponge(null);
    private static readonly BoundingBox UnitBox = new(Vector.Zero, Vector.One);

    [Fact]
    public void FindAllWithin_OnAMesh_GivesFacesByDistanceThenIndex()
    {
        var mesh = CollisionMeshes.All["sphere"]();
        var hits = new HierarchyCollider(mesh).FindAllWithin(Vector.Zero, 10, mesh.FaceCount);
        var expected = new SimpleCollider(mesh).FindAllWithin(Vector.Zero, 10, mesh.FaceCount);
        Assert.Equal(mesh.FaceCount, hits.Length);
        Assert.True(expected.AsSpan().SequenceEqual(hits.AsSpan()));
        Assert.True(hits.OrderBy(hit => hit.Distance).ThenBy(hit => hit.FaceIndex).SequenceEqual(hits));
    }

    [Theory]
    [InlineData("soup")]
    [InlineData("rough grid")]
    [InlineData("coincident faces")]
    public void FindAllWithin_TheClosestDistance_GivesTheClosestFace(string name)
    {
        var collider = new HierarchyCollider(CollisionMeshes.All[name]());
        Seeded.Run(50, random =>
        {
            var position = random.Vector(2);
            var closest = collider.FindClosest(position);
            Assert.Equal(closest, collider.FindAllWithin(position, closest.Distance, 1000)[0]);
            Assert.True(collider.Overlaps(position, closest.Distance));
            Assert.False(collider.Overlaps(position, Math.BitDecrement(closest.Distance)));
            Assert.Empty(collider.FindAllWithin(position, Math.BitDecrement(closest.Distance), 0));
        });
    }

    [Fact]
    public void FindAllWithin_OfSeveralMeshes_NamesThatOfEachFace()
    {
        var collider = Collider.For(Fractal.Of(Shapes.Cube()) + Fractal.Of(Samples.Tetrahedron).Apply([Samples.Move(6, 0, 0)]));
        var context = new QueryContext();
        var hits = collider.FindAllWithin(new(3, 0, 0), 100, 100, context);
        Assert.Equal(12 + 4, hits.Length);
        Assert.All(hits, static hit => Assert.Equal(hit.Point.X > 3 ? 1 : 0, hit.MeshIndex));
        Assert.True(context.InstancePath.IsEmpty);
        var (closest, alone) = (collider.FindClosest(new(7, 0, 0)), collider.FindAllWithin(new(7, 0, 0), 1, 100)[0]);
        Assert.Equal((closest.FaceIndex, closest.MeshIndex), (alone.FaceIndex, alone.MeshIndex));
    }

    [Fact]
    public void FindAllWithin_OfMoreThanTheMaximum_IsRefusedWithTheCount()
    {
        var collider = new HierarchyCollider(CollisionMeshes.All["sphere"]());
        var error = Assert.Throws<FractalLimitException>(() => collider.FindAllWithin(Vector.Zero, 10.5, 5));
        Assert.Equal("at least 6 faces lie within 10.5: expected at most 5", error.Message);
        Assert.Equal(ErrorKind.Limit, error.Kind);
    }

    [Fact]
    public void FindAllWithin_OfAnInfiniteFractal_IsRefusedSoon()
    {
        var collider = new ExactFractalCollider(InfiniteSponge);
        var context = new QueryContext();
        Assert.Throws<FractalLimitException>(() => collider.FindAllWithin(Vector.Zero, 100, 10_000, context));
        Assert.InRange(context.Statistics.BoundTests, 1, MaxBoundTests);
    }

    [Theory]
    [InlineData(null)]
    [InlineData(1_000_000)]
    public void FindAllWithin_AtTheCornerOfADeepFractal_FindsWhatTheLastLevelHasThere(int? depth)
    {
        var collider = new ExactFractalCollider(Sponge(depth));
        Vector position = new(-1, -2, -3);
        var hits = collider.FindAllWithin(position, position.Length(), 100);
        Assert.InRange(hits.Length, 3, 100);
        Assert.Equal(collider.FindClosest(position).Distance, hits[0].Distance);
        Assert.Contains(hits, hit => hit.Point == Vector.Zero && hit.InstancePath.All(map => map == 0) && hit.InstancePath.Length > 30);
        Assert.Empty(collider.FindAllWithin(position, position.Length() - 1e-12, 0));
    }

    [Theory]
    [InlineData(null)]
    [InlineData(1_000_000)]
    public void Overlaps_OfBallsAndADeepFractal_AgreesWithTheClosestDistance(int? depth)
    {
        var collider = new ExactFractalCollider(Sponge(depth));
        Seeded.Run(200, random =>
        {
            var position = (1.5 * Vector.One) + random.Vector(3);
            var distance = collider.FindClosest(position).Distance;
            Assert.True(collider.Overlaps(position, distance));
            Assert.True(collider.Overlaps(position, 1.5 * distance));
            Assert.False(distance > 1e-11 && collider.Overlaps(position, distance - 1e-12));
        });
    }

    [Fact]
    public void FindAllWithin_OfADepthThatIsStillListed_StartsWithTheClosestPoint()
    {
        var collider = new ExactFractalCollider(Sponge(6));
        Seeded.Run(50, random =>
        {
            var position = (1.5 * Vector.One) + random.Vector(3);
            var closest = collider.FindClosest(position);
            var hits = collider.FindAllWithin(position, closest.Distance, 1000);
            Assert.Equal(closest.Distance, hits[0].Distance);
            Assert.Contains(hits, hit => hit.InstancePath.SequenceEqual(closest.InstancePath) && hit.FaceIndex == closest.FaceIndex);
        });
    }

    [Fact]
    public void Overlaps_OfBoxesAndADeepFractal_TellsHolesFromWalls()
    {
        foreach (var depth in new int?[] { 4, 1000, null })
        {
            var collider = new ExactFractalCollider(Sponge(depth));
            // The middle third of the cube from 0 to 3 is open along each axis.
            Assert.False(collider.Overlaps(new BoundingBox(new(1.05, 1.05, -1), new(1.95, 1.95, 5))));
            Assert.True(collider.Overlaps(new BoundingBox(new(0.9, 1.05, -1), new(1.95, 1.95, 5))));
            Assert.True(collider.Overlaps(new BoundingBox(new(-9, -9, -9), new(9, 9, 9))));
            Assert.True(collider.Overlaps(new BoundingBox(new(3, 0, 0), new(4, 3, 3))));
            Assert.False(collider.Overlaps(new BoundingBox(new(3.01, 0, 0), new(4, 3, 3))));
        }
    }

    [Fact]
    public void Overlaps_OfABoxThatAlmostTouches_IsAnsweredOrRefusedSoon()
    {
        var collider = new ExactFractalCollider(InfiniteSponge);
        for (var exponent = 1; exponent < 18; exponent++)
        {
            var context = new QueryContext();
            var gap = Math.Pow(10, -exponent);
            try
            {
                var overlaps = collider.Overlaps(new BoundingBox(new(3 + gap, 0, 0), new(4, 3, 3)), context);
                Assert.Equal(exponent > 13, overlaps);
            }
            catch (FractalLimitException error)
            {
                Assert.Contains("touches too many small parts closely", error.Message, StringComparison.Ordinal);
            }

            Assert.InRange(context.Statistics.BoundTests, 1, MaxBoundTests);
        }
    }

    [Fact]
    public void Overlaps_OfTheBoxThatAMeshTouches_IsTrue()
    {
        Collider[] colliders = [new HierarchyCollider(Samples.Triangle), new SimpleCollider(Samples.Triangle)];
        foreach (var collider in colliders)
        {
            Assert.True(collider.Overlaps(new BoundingBox(new(-1, 0, 0), new(0, 0, 0))));
            Assert.False(collider.Overlaps(new BoundingBox(new(-1, 0, 0), new(Math.BitDecrement(0.0), 0, 0))));
            Assert.True(collider.Overlaps(new BoundingBox(new(0.25, 0.25, -1), new(0.25, 0.25, 1))));
            Assert.False(collider.Overlaps(new BoundingBox(new(0.6, 0.6, -1), new(1, 1, 1))));
        }
    }

    [Fact]
    public void Regions_WithoutFaces_HoldNothing()
    {
        Collider[] colliders =
        [
            new HierarchyCollider(Mesh.Empty), new SimpleCollider(Mesh.Empty), new ExactFractalCollider(Fractal.Of(Mesh.Empty)),
            new ExactFractalCollider(Fractal.Of(Samples.Tetrahedron).Apply([])),
        ];
        foreach (var collider in colliders)
        {
            Assert.Empty(collider.FindAllWithin(Vector.Zero, double.PositiveInfinity, 0));
            Assert.False(collider.Overlaps(Vector.Zero, double.PositiveInfinity));
            Assert.False(collider.Overlaps(UnitBox));
        }
    }

    [Fact]
    public void Regions_ThatAreNone_AreRefused()
    {
        var collider = new HierarchyCollider(Samples.Tetrahedron);
        Assert.Throws<ArgumentOutOfRangeException>("position", () => collider.FindAllWithin(new(double.NaN, 0, 0), 1, 1));
        Assert.Throws<ArgumentOutOfRangeException>("radius", () => collider.FindAllWithin(Vector.Zero, -1, 1));
        Assert.Throws<ArgumentOutOfRangeException>("radius", () => collider.FindAllWithin(Vector.Zero, double.NaN, 1));
        Assert.Throws<ArgumentOutOfRangeException>("maxFaces", () => collider.FindAllWithin(Vector.Zero, 1, -1));
        Assert.Throws<ArgumentOutOfRangeException>("centre", () => collider.Overlaps(new(0, double.PositiveInfinity, 0), 1));
        Assert.Throws<ArgumentOutOfRangeException>("radius", () => collider.Overlaps(Vector.Zero, double.NaN));
        Assert.Throws<ArgumentOutOfRangeException>("box", () => collider.Overlaps(new BoundingBox(new(double.NaN, 0, 0), Vector.One)));
        Assert.Throws<ArgumentOutOfRangeException>(
            "box", () => collider.Overlaps(UnitBox with { Maximum = new(double.PositiveInfinity, 1, 1) }));
        Assert.False(collider.Overlaps(BoundingBox.Empty));
    }

    [Fact]
    public void Regions_OfAnApproximateCollider_AreNotSupported()
    {
        var collider = new FractalCollider(Sponge(2));
        var error = Assert.Throws<NotSupportedException>(() => collider.Overlaps(UnitBox));
        Assert.Equal(
            "FractalCollider finds closest points of positions only: expected an exact collider of a mesh or a fractal", error.Message);
        Assert.Throws<NotSupportedException>(() => collider.FindAllWithin(Vector.Zero, 1, 1));
        Assert.Throws<NotSupportedException>(() => collider.Overlaps(Vector.Zero, 1));
    }

    [Theory]
    [InlineData(-130)]
    [InlineData(-50)]
    [InlineData(145)]
    public void Regions_OfExtremeSizes_ScaleWithTheShape(int exponent)
    {
        var scale = Math.Pow(10, exponent);
        var fractal = Sponge(2).WithPlacement(new(Vector.Zero, Vector.Zero, scale * Vector.One));
        var collider = new ExactFractalCollider(fractal);
        var hits = collider.FindAllWithin(new(1.5 * scale, 1.5 * scale, 1.5 * scale), 0.8 * scale, 10_000);
        var expected = new ExactFractalCollider(Sponge(2)).FindAllWithin(new(1.5, 1.5, 1.5), 0.8, 10_000);
        Assert.Equal(expected.Length, hits.Length);
        Assert.Equal(expected[0].Distance, hits[0].Distance / scale, 1e-12);
        Assert.False(collider.Overlaps(new(1.5 * scale, 1.5 * scale, 1.5 * scale), 0.7 * scale));
        Assert.True(collider.Overlaps(new BoundingBox(Vector.Zero, 0.1 * scale * Vector.One)));
    }

    /// <summary>Menger's sponge from 0 to 3.</summary>
    internal static Fractal Sponge(int? depth) => Fractal.Of(Shapes.Box(new(Vector.Zero, 3 * Vector.One))).Repeat(
        from x in Enumerable.Range(0, 3)
        from y in Enumerable.Range(0, 3)
        from z in Enumerable.Range(0, 3)
        where (x == 1 ? 1 : 0) + (y == 1 ? 1 : 0) + (z == 1 ? 1 : 0) < 2
        select Transformation.At(new(x, y, z), 1 / 3.0),
        depth);
}
