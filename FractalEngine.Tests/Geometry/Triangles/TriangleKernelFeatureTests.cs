using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Triangles;

/// <summary>Which feature of a triangle is closest, with its weights, and what two triangles are apart, in closed forms.</summary>
public sealed class TriangleKernelFeatureTests
{
    private static readonly Vector A = new(0, 0, 0);
    private static readonly Vector B = new(4, 0, 0);
    private static readonly Vector C = new(0, 4, 0);

    [Theory]
    [InlineData(1, 1, 2, TriangleFeature.Interior, 1, 1, 4)]
    [InlineData(1, -2, 0, TriangleFeature.EdgeAB, 1, 0, 4)]
    [InlineData(3, 3, 1, TriangleFeature.EdgeBC, 2, 2, 3)]
    [InlineData(-1, 3, 0, TriangleFeature.EdgeCA, 0, 3, 1)]
    [InlineData(-1, -1, 1, TriangleFeature.VertexA, 0, 0, 3)]
    [InlineData(6, -1, 0, TriangleFeature.VertexB, 4, 0, 5)]
    [InlineData(-2, 5, 0, TriangleFeature.VertexC, 0, 4, 5)]
    public void ClosestPoint_OfAPosition_HasItsFeatureAndWeights(
        double x, double y, double z, TriangleFeature feature, double footX, double footY, double distanceSquared)
    {
        var point = TriangleKernel.ClosestPoint(new(x, y, z), A, B, C);
        Assert.Equal((feature, new Vector(footX, footY, 0), distanceSquared), (point.Feature, point.Point, point.DistanceSquared));
        Near.Equal(new Vector(1 - (footX / 4) - (footY / 4), footX / 4, footY / 4), point.Barycentrics, 1e-15);
    }

    [Fact]
    public void ClosestPoint_OfTurnedCorners_TurnsFeatureAndWeights()
    {
        foreach (var position in new Vector[] { new(1, 1, 2), new(1, -2, 0), new(3, 3, 1), new(-1, 3, 0), new(6, -1, 0) })
        {
            var point = TriangleKernel.ClosestPoint(position, A, B, C);
            var turned = TriangleKernel.ClosestPoint(position, B, C, A);
            Assert.Equal((point.Point, point.DistanceSquared), (turned.Point, turned.DistanceSquared));
            var (weightA, weightB, weightC) = point.Barycentrics;
            Near.Equal(new Vector(weightB, weightC, weightA), turned.Barycentrics, 1e-15);
        }
    }

    [Fact]
    public void ClosestPoint_OfTrianglesWithoutArea_IsThatOfTheSegmentOrThePoint()
    {
        var segment = TriangleKernel.ClosestPoint(new(1, 2, 0), A, B, 0.5 * (A + B));
        Assert.Equal((new Vector(1, 0, 0), 4.0), (segment.Point, segment.DistanceSquared));
        var point = TriangleKernel.ClosestPoint(new(3, 4, 1), C, C, C);
        Assert.Equal((C, 10.0), (point.Point, point.DistanceSquared));
        Assert.Equal(1, point.Barycentrics.X + point.Barycentrics.Y + point.Barycentrics.Z);
    }

    [Fact]
    public void UnitNormal_OfTriangles_FollowsTheWindingAtAnySize()
    {
        Assert.Equal(Vector.K, TriangleKernel.UnitNormal(A, B, C));
        Assert.Equal(-Vector.K, TriangleKernel.UnitNormal(A, C, B));
        Assert.Equal(Vector.J, TriangleKernel.UnitNormal(A, A, A));
        foreach (var size in new[] { 1e-300, 1e-160, 1e-40, 1e40, 1e150 })
        {
            Near.Equal(Vector.K, TriangleKernel.UnitNormal(size * A, size * B, size * C), 1e-15);
            // Needles, whose longest edge is each of the three.
            var apex = new Vector(2, 1e-9, 0);
            Near.Equal(Vector.K, TriangleKernel.UnitNormal(size * A, size * B, size * apex), 1e-12);
            Near.Equal(Vector.K, TriangleKernel.UnitNormal(size * apex, size * A, size * B), 1e-12);
            Near.Equal(Vector.K, TriangleKernel.UnitNormal(size * B, size * apex, size * A), 1e-12);
        }

        foreach (var direction in new[] { Vector.I, Vector.J, Vector.K, new(1, 1, 0), new(1, 2, 3) })
        {
            // Without area: any normal across the line.
            var normal = TriangleKernel.UnitNormal(A, direction, 3 * direction);
            Near.Equal(1, normal.Length(), 1e-15);
            Near.Equal(0, Vector.Dot(normal, direction), 1e-14);
        }
    }

    /// <summary>A triangle whose corners are exactly 1 from a large one that it pierces.</summary>
    [Fact]
    public void Closest_OfATriangleThatPiercesAnother_IsZeroThoughAllCornersAreOneAway()
    {
        var large = (new Vector(-50, -50, 0), new Vector(50, -50, 0), new Vector(0, 80, 0));
        var small = (new Vector(0, 0, 1), new Vector(0.5, 0, -1), new Vector(0, 0.5, -1));
        foreach (var (triangle1, triangle2) in new[] { (large, small), (small, large) })
        {
            var pair = TrianglePairKernel.Closest(in triangle1, in triangle2);
            Assert.Equal(0, pair.DistanceSquared);
            Assert.Equal(pair.Point1, pair.Point2);
            Assert.Equal(0, pair.Point1.Z);
        }
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(2)]
    public void Closest_OfCrossedEdges_IsBetweenTheirMiddles(int turn)
    {
        (Vector A, Vector B, Vector C) lower = Turn((new(-1, 0, 0), new(1, 0, 0), new(0, 0, -3)), turn);
        (Vector A, Vector B, Vector C) upper = Turn((new(0, -1, 2), new(0, 1, 2), new(0, 0, 5)), turn);
        var pair = TrianglePairKernel.Closest(in lower, in upper);
        Assert.Equal((Vector.Zero, new Vector(0, 0, 2), 4.0), (pair.Point1, pair.Point2, pair.DistanceSquared));
        var swapped = TrianglePairKernel.Closest(in upper, in lower);
        Assert.Equal((new Vector(0, 0, 2), Vector.Zero, 4.0), (swapped.Point1, swapped.Point2, swapped.DistanceSquared));
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(2)]
    public void Closest_OfACornerAboveAFace_IsItsHeight(int turn)
    {
        (Vector A, Vector B, Vector C) face = (A, B, C);
        (Vector A, Vector B, Vector C) above = Turn((new(1, 1, 3), new(1, 1, 9), new(1, 2, 9)), turn);
        var pair = TrianglePairKernel.Closest(in face, in above);
        Assert.Equal((new Vector(1, 1, 0), new Vector(1, 1, 3), 9.0), (pair.Point1, pair.Point2, pair.DistanceSquared));
        var swapped = TrianglePairKernel.Closest(in above, in face);
        Assert.Equal((new Vector(1, 1, 3), new Vector(1, 1, 0), 9.0), (swapped.Point1, swapped.Point2, swapped.DistanceSquared));
    }

    [Fact]
    public void Closest_OfParallelEdgesBesideEachOther_IsTheirDistance()
    {
        (Vector A, Vector B, Vector C) left = (A, B, new(0, -4, 0));
        (Vector A, Vector B, Vector C) right = (new(1, 3, 0), new(9, 3, 0), new(5, 7, 0));
        Assert.Equal(9, TrianglePairKernel.Closest(in left, in right).DistanceSquared);
        (Vector A, Vector B, Vector C) beyond = (new(7, 4, 0), new(9, 4, 0), new(8, 7, 0));
        Assert.Equal(25, TrianglePairKernel.Closest(in left, in beyond).DistanceSquared);
    }

    [Fact]
    public void OnMeshAndOnInstance_OfTheSameFace_AreTheSamePoint() => Seeded.Run(20, random =>
    {
        var mesh = RandomMeshes.CreateSoup(random, 3);
        var map = new AffineMap(1.5 * random.Orthogonal(), random.Vector());
        var moved = mesh.Transform(v => map * v);
        var position = random.Vector(3);
        for (var face = 0; face < 3; face++)
        {
            var (a, b, c) = moved.Face(face);
            var expected = TriangleKernel.ClosestPoint(position, a, b, c);
            var onMesh = ClosestPointFactory.OnMesh(moved, face, position);
            Assert.Equal(onMesh, ClosestPointFactory.OnMesh(moved, face, expected));
            Assert.Equal((Math.Sqrt(expected.DistanceSquared), expected.Point, face), (onMesh.Distance, onMesh.Point, onMesh.FaceIndex));
            Assert.Equal((expected.Barycentrics, expected.Feature), (onMesh.Barycentrics, onMesh.Feature));
            Assert.Equal((TriangleKernel.UnitNormal(a, b, c), 0.0), (onMesh.Normal, onMesh.ErrorBound));
            var onInstance = ClosestPointFactory.OnInstance(mesh, face, map, position);
            Near.Equal(onMesh.Distance, onInstance.Distance, 1e-12);
            Near.Equal(onMesh.Point, onInstance.Point, 1e-12);
            Assert.Equal((onMesh.Feature, face), (onInstance.Feature, onInstance.FaceIndex));
        }
    });

    private static (Vector A, Vector B, Vector C) Turn((Vector A, Vector B, Vector C) triangle, int times) => times switch
    {
        0 => triangle,
        1 => (triangle.B, triangle.C, triangle.A),
        _ => (triangle.C, triangle.A, triangle.B),
    };
}
