using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals.Levels.Rays;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>Tests the parts of a search by rays, each by itself: frames, boxes, planes and triangles.</summary>
public sealed class RayPrimitivesTests
{
    private static readonly BoundingBox Cube = new(-Vector.One, Vector.One);

    [Fact]
    public void IsNear_OfABoxUnderAMap_LooksAtBothSidesOfTheImage()
    {
        var box = new RayBox(Cube);
        Assert.True(RayFrame.IsNear(Cube, box, Scaled(3.9, Vector.Zero)));
        Assert.False(RayFrame.IsNear(Cube, box, Scaled(3.9999, Vector.Zero)));
        foreach (var axis in new[] { Vector.I, Vector.J, Vector.K, -Vector.I, -Vector.J, -Vector.K })
        {
            Assert.True(RayFrame.IsNear(Cube, box, Scaled(1, 2.9 * axis)));
            Assert.False(RayFrame.IsNear(Cube, box, Scaled(1, 3.1 * axis)));
            Assert.False(RayFrame.IsNear(Cube, box, Scaled(5.5, 4.5 * axis)));
        }

        // In the units of the parent's box.
        var larger = new BoundingBox(-2 * Vector.One, 2 * Vector.One);
        Assert.True(RayFrame.IsNear(larger, new RayBox(larger), Scaled(3.9, Vector.Zero)));
    }

    [Fact]
    public void ToUnits_OfABox_MapsItToTheUnitsAndBack()
    {
        var box = new RayBox(new(new(1, 2, 3), new(5, 4, 5)));
        Near.Equal(2, box.HalfExtent, 1e-15);
        Assert.Equal(1 / box.InverseHalfExtent, box.HalfExtent);
        Near.Equal(new Vector(1, 0.5, -0.5), box.ToUnits * new Vector(5, 4, 3), 1e-15);
        Near.Equal(AffineMap.Identity, box.ToUnits * box.FromUnits, 1e-15);
        var point = new RayBox(new(Vector.Zero, Vector.Zero));
        Assert.Equal((1.0, 1.0), (point.HalfExtent, point.InverseHalfExtent));
        var far = new RayBox(new(1000 * Vector.One, 1000 * Vector.One));
        Near.Equal(1e-11, far.HalfExtent, 1e-14);
    }

    [Theory]
    [InlineData(-9, 0, 0, 1, 0, 0, 8)]
    [InlineData(9, 0.5, 0.5, -1, 0, 0, 8)]
    [InlineData(0.5, -4, 0, 0, 1, 0, 3)]
    [InlineData(0.5, 0.5, 6, 0, 0, -2, 2.5)]
    [InlineData(0, 0, 0, 1, 1, 1, 0)]
    [InlineData(-3, -4, 0, 1, 1, 0, 3)]
    [InlineData(-9, 2, 0, 1, 0, 0, double.PositiveInfinity)]
    [InlineData(-9, 0, -1.001, 1, 0, 0, double.PositiveInfinity)]
    [InlineData(9, 0, 0, 1, 0, 0, double.PositiveInfinity)]
    [InlineData(-3, -6, 0, 1, 1, 0, double.PositiveInfinity)]
    public void FindEntry_OfARay_IsWhereItEntersTheBox(double x, double y, double z, double dx, double dy, double dz, double expected)
    {
        var ray = RayOf(new(x, y, z), new(dx, dy, dz));
        var entry = RayBox.FindEntry(Cube, in ray);
        Assert.Equal(expected, entry, 1e-12);
    }

    [Fact]
    public void TryApproach_FromAfar_StartsAtTheBox()
    {
        var box = new RayBox(Cube);
        var search = new RaySearch(0, double.PositiveInfinity, false, 1e-12, default);
        foreach (var axis in new[] { Vector.I, Vector.J, Vector.K, -Vector.I, -Vector.J, -Vector.K })
        {
            var across = new Vector(Math.Abs(axis.Y), Math.Abs(axis.Z), Math.Abs(axis.X));
            var ray = LocalRay.Of((-90 * axis) + (0.5 * across), axis, 0);
            Assert.True(box.TryApproach(ref ray, in search));
            Near.Equal(89, ray.Start, 1e-9);
            Near.Equal((0.5 * across) - axis, SimdAffineMap.ToVector(ray.Origin), 1e-9);
            Assert.Equal((1.0, 1.0), (ray.Scale, ray.InverseScale));

            var beside = LocalRay.Of((-90 * axis) + (1.001 * across), axis, 0);
            Assert.False(box.TryApproach(ref beside, in search));
            var away = LocalRay.Of(-90 * axis, -axis, 0);
            Assert.False(box.TryApproach(ref away, in search));
            var near = LocalRay.Of(-3.9 * axis, -axis, 0);
            Assert.True(box.TryApproach(ref near, in search));
            Assert.Equal(0, near.Start);
        }

        foreach (var (maxDistance, expected) in new[] { (88.9, false), (89.1, true), (0.0, false) })
        {
            var ray = LocalRay.Of(-90 * Vector.I, Vector.I, 0);
            var limited = new RaySearch(0, maxDistance, false, 1e-12, default);
            Assert.Equal(expected, box.TryApproach(ref ray, in limited));
            var later = LocalRay.Of(-100 * Vector.I, Vector.I, 10);
            var limitedLater = new RaySearch(0, maxDistance + 10, false, 1e-12, default);
            Assert.Equal(expected, box.TryApproach(ref later, in limitedLater));
        }
    }

    [Fact]
    public void LocalRay_UnderAMap_KeepsTheParameter() => Seeded.Run(30, random =>
    {
        var map = new AffineMap(2 * random.Orthogonal(), random.Vector());
        var (origin, direction) = (random.Vector(), random.Direction());
        var ray = LocalRay.Of(origin, direction, 3);
        Assert.Equal((3.0, 1.0, 1.0), (ray.Start, ray.Scale, ray.InverseScale));
        Near.Equal(origin + (3 * direction), SimdAffineMap.ToVector(ray.Origin), 1e-15);
        Assert.Equal(direction.MaxAbsComponent(), ray.Speed);
        var mapped = ray.Transform(new SimdAffineMap(map), 2, 0.5).Advance(7);
        Assert.Equal((10.0, 0.5, 2.0), (mapped.Start, mapped.Scale, mapped.InverseScale));
        Near.Equal(map * (origin + (10 * direction)), SimdAffineMap.ToVector(mapped.Origin), 1e-13);
        Near.Equal(map.Linear * direction, SimdAffineMap.ToVector(mapped.Direction), 1e-14);
    });

    [Fact]
    public void RaySearch_OfLimits_AllowsTheErrorBelowAndAddsItsCosts()
    {
        var search = new RaySearch(2, 9, true, 0.5, new(3, 0.25)) { FaceTests = 4, BoundTests = 6 };
        Assert.Equal((1.5, 9.0, -1, true), (search.MinDistance, search.MaxDistance, search.Face, search.StopsAtFirst));
        search.MaxDistance = 7;
        search.Face = 3;
        var other = search.WithError(0.25, new(1, 0.5));
        Assert.Equal((1.75, 7.0, -1, 0.25), (other.MinDistance, other.MaxDistance, other.Face, other.Error));
        Assert.Equal((0L, 0L, new RayFootprint(1, 0.5), true), (other.FaceTests, other.BoundTests, other.Footprint, other.StopsAtFirst));
        other.MaxDistance = 5;
        other.Face = 8;
        search.Accept(in other);
        Assert.Equal((5.0, 8, 0.5), (search.MaxDistance, search.Face, search.Error));
        var statistics = new QueryStatistics { FaceTests = 10, BoundTests = 20 };
        statistics.Add(in search);
        Assert.Equal((14L, 26L), (statistics.FaceTests, statistics.BoundTests));
        Assert.Equal(3 + (0.25 * 8), search.Footprint.RadiusAt(8));
    }

    [Fact]
    public void WithoutZeros_OfADirection_KeepsSignsAndLargeComponents()
    {
        var direction = FloatRay.WithoutZeros(Vector128.Create(0f, -0f, 1e-13f, -1e-13f));
        Assert.Equal(Vector128.Create(1e-12f, -1e-12f, 1e-12f, -1e-12f), direction);
        var large = Vector128.Create(1e-12f, -1e-12f, 0.5f, -1);
        Assert.Equal(large, FloatRay.WithoutZeros(large));
    }

    [Fact]
    public void LimitFor_ADistance_IsALittleBeyondItsParameter()
    {
        foreach (var (start, perDistance, distance) in new[] { (0.0, 1.0, 5.0), (3.0, 2.0, 10.0), (10.0, 0.5, 10.0), (0.0, 1.0, 1e6) })
        {
            var exact = (distance - start) * perDistance;
            Assert.InRange(FloatRay.LimitFor(start, perDistance, distance), exact + (0.5e-5 * exact), exact + (2e-5 * exact) + 1e-5);
        }

        Assert.Equal(float.PositiveInfinity, FloatRay.LimitFor(0, 1, double.PositiveInfinity));
        Assert.True(FloatRay.LimitFor(10, 1, 9) < 0);
    }

    [Fact]
    public void CheckedUnitDirection_OfAnyMaximum_IsTheSameBitForBit() => Seeded.Run(100, random =>
    {
        var direction = random.Next(2) == 0 ? random.Direction() : random.Vector(100);
        var ray = new Ray(random.Vector(), direction);
        var expected = RayCaster.CheckedUnitDirection(in ray, 0, double.PositiveInfinity);
        Near.Equal(1, expected.Length(), 1e-15);
        Near.Equal(0, Vector.Cross(direction, expected).Length(), 1e-12);
        foreach (var maxDistance in new[] { 0, 0.5, 1e-300, 1, 7 })
        {
            Assert.Equal(expected, RayCaster.CheckedUnitDirection(in ray, 0, maxDistance));
            Assert.Equal(expected, RayCaster.CheckedUnitDirection(in ray, 0.5, maxDistance));
        }
    });

    [Fact]
    public void RoundingError_OfALongWay_IsThatOfTheSum() => Near.Equal(
        4e-15 * (3 + 5 + 7), RayCaster.RoundingError(new(1, -3, 2), 5, 7), 1e-28);

    [Fact]
    public void Correct_OfAParameterBesideThePlane_LeadsToIt() => Seeded.Run(50, random =>
    {
        var (a, b, c) = (random.Vector(), random.Vector(), random.Vector());
        var target = a + (0.3 * (b - a)) + (0.2 * (c - a));
        var direction = random.Direction();
        var normal = TriangleKernel.UnitNormal(a, b, c);
        if (Math.Abs(Vector.Dot(normal, direction)) < 0.1)
        {
            return;
        }

        var origin = target - (5 * direction);
        foreach (var parameter in new[] { 4.9, 5, 5.1 })
        {
            Near.Equal(5, TrianglePlane.Correct(origin, direction, parameter, a, normal), 1e-12);
            Near.Equal(5, TrianglePlane.Correct(origin, direction, parameter, a, b, c), 1e-11);
            Near.Equal(2.5, TrianglePlane.Correct(origin, 2 * direction, parameter / 2, a, b, c), 1e-11);
        }
    });

    [Fact]
    public void Correct_OfAThinTriangle_UsesItsLongestEdgeWhicheverItIs()
    {
        // In the plane x + z = 5, with altitudes of a ten thousandth.
        Vector[] corners = [new(0, 0, 5), new(2, 0, 3), new(1, 1e-4, 4)];
        foreach (var (i, j, k) in new[] { (0, 1, 2), (1, 2, 0), (2, 0, 1), (1, 0, 2), (0, 2, 1), (2, 1, 0) })
        {
            Assert.True(TrianglePlane.IsThin(corners[i], corners[j], corners[k]));
            var corrected = TrianglePlane.Correct(new(1, 0.2e-4, 0), Vector.K, 3, corners[i], corners[j], corners[k]);
            Near.Equal(4, corrected, 1e-10);
        }
    }

    [Fact]
    public void Correct_OfARayInThePlaneOrAPoint_LeavesTheParameter()
    {
        Assert.Equal(3, TrianglePlane.Correct(Vector.Zero, Vector.I, 3, Vector.I, Vector.J, Vector.Zero));
        Assert.Equal(3, TrianglePlane.Correct(Vector.Zero, Vector.J, 3, Vector.I, Vector.I, Vector.I));
        Assert.False(TrianglePlane.IsSteep(Vector.I, Vector.K));
        Assert.False(TrianglePlane.IsSteep(new(10, 0, 0.99e-3), Vector.K));
        Assert.True(TrianglePlane.IsSteep(new(10, 0, -1.01e-3), Vector.K));
    }

    [Fact]
    public void IsThin_OfATriangle_LooksAtTheAngleAtItsFirstCorner()
    {
        foreach (var size in new[] { 1e-200, 1, 1e200 })
        {
            Assert.True(TrianglePlane.IsThin(Vector.Zero, size * Vector.I, size * new Vector(1, 0.099, 0)));
            Assert.False(TrianglePlane.IsThin(Vector.Zero, size * Vector.I, size * new Vector(1, 0.102, 0)));
            Assert.True(TrianglePlane.IsThin(Vector.Zero, size * Vector.I, -size * Vector.I));
        }

        Assert.True(TrianglePlane.IsThin(Vector.One, Vector.One, Vector.One));
        Assert.True(TrianglePlane.IsWellShaped(Vector.I, Vector.J, 1));
        Assert.False(TrianglePlane.IsWellShaped(Vector.I, new(1, 0.099, 0), 0.099 * 0.099));
        Assert.False(TrianglePlane.IsWellShaped(1e-51 * Vector.I, 1e-51 * Vector.J, 1e-204));
        Assert.False(TrianglePlane.IsWellShaped(1e51 * Vector.I, 1e51 * Vector.J, 1e204));
        Assert.True(TrianglePlane.IsWellShaped(1e49 * Vector.I, 1e49 * Vector.J, 1e196));
    }

    [Fact]
    public void ApproachEdges_OfARay_IsWhereItIsNearestToTheNearestEdge()
    {
        // The ray passes above the middle of each edge in turn.
        var (a, b, c) = (new Vector(0, 0, 0), new Vector(6, 0, 0), new Vector(0, 6, 0));
        (Vector Above, Vector Nearest)[] cases =
        [
            (new(3, -2, 0), new(3, 0, 0)), (new(4, 5, 0), new(2.5, 3.5, 0)), (new(-1, 3, 0), new(0, 3, 0)),
            (new(-3, -4, 0), new(0, 0, 0)), (new(9, -4, 0), new(6, 0, 0)),
        ];
        foreach (var (above, nearest) in cases)
        {
            var approach = TrianglePlane.ApproachEdges(above + (7 * Vector.K), -Vector.K, a, b, c);
            Near.Equal(7, approach.Distance, 1e-14);
            Near.Equal((above - nearest).Length(), approach.Apart, 1e-14);
        }

        // Along an edge, all its places are as near, and the first counts.
        Assert.Equal((1.0, 0.0), TrianglePlane.ApproachEdges(Vector.Zero, Vector.I, Vector.I, 2 * Vector.I, new(1.5, 1, 0)));
        Assert.Equal((5.0, 3.0), TrianglePlane.ApproachEdges(new(0, 3, 0), Vector.I, 5 * Vector.I, 5 * Vector.I, 5 * Vector.I));
    }

    /// <summary>A triangle whose area is about that of the rounding of a direction after some maps, but not before.</summary>
    [Fact]
    public void TryIntersect_OfATriangleNearlyEdgeOn_DependsOnWhatTheDirectionIsOffBy()
    {
        const double Width = 3e-14;
        var mesh = new Mesh([Width, 0, 1, -Width, Width, 1, -Width, -Width, 3], [0, 1, 2]);
        Assert.True(Hits(mesh, RayOf(Vector.Zero, Vector.K), 0, out _));
        Assert.False(Hits(mesh, new LocalRay(Vector256<double>.Zero, SimdAffineMap.ToVector256(Vector.K), 0, 2, 0.5), 0, out _));
        Assert.False(Hits(mesh, new LocalRay(Vector256<double>.Zero, SimdAffineMap.ToVector256(Vector.K), 0, 1, 2), 0, out _));
    }

    [Fact]
    public void TryIntersect_OfFourTriangles_FindsTheNearestWithinTheLimits()
    {
        // Four parallel triangles at distances of 4, 2, 3 and 5, along each axis and both ways.
        foreach (var axis in new[] { Vector.I, Vector.J, Vector.K, -Vector.I, -Vector.J, -Vector.K })
        {
            var (u, v) = (new Vector(axis.Y, axis.Z, axis.X), new Vector(axis.Z, axis.X, axis.Y));
            Vector[] corners = [.. new[] { 4, 2, 3, 5 }.SelectMany(height => new[]
            {
                (height * axis) - u - v, (height * axis) + (2 * u), (height * axis) + (2 * v),
            })];
            var mesh = new Mesh([.. corners.SelectMany(corner => new[] { corner.X, corner.Y, corner.Z })], [.. Enumerable.Range(0, 12)]);
            var ray = RayOf(Vector.Zero, axis);
            Assert.Equal((1, 2.0), Nearest(mesh, ray, 0, double.PositiveInfinity));
            Assert.Equal((1, 2.0), Nearest(mesh, ray, 2, 2));
            Assert.Equal((2, 3.0), Nearest(mesh, ray, 2.5, double.PositiveInfinity));
            Assert.Equal((3, 5.0), Nearest(mesh, ray, 4.5, 5));
            Assert.Equal((-1, 4.9), Nearest(mesh, ray, 4.5, 4.9));
            Assert.Equal((-1, 9.0), Nearest(mesh, RayOf(Vector.Zero, -axis), 0, 9));
            Assert.Equal((-1, 9.0), Nearest(mesh, RayOf(3 * (u + v), axis), 0, 9));
        }
    }

    [Fact]
    public void TryIntersect_BesideAnEdge_HitsWithinTheErrorOnly()
    {
        var mesh = Samples.Triangle;
        foreach (var (error, apart, expected) in new[] { (1e-9, 1e-9, true), (1e-9, 1e-8, false), (0.0, 1e-9, false), (0.0, 0.0, true) })
        {
            Assert.Equal(expected, Hits(mesh, RayOf(new(0.5, -apart, 2), -Vector.K), error, out var distance));
            Assert.True(!expected || Math.Abs(distance - 2) < 1e-12);
        }
    }

    [Fact]
    public void GatherAll_OfFaces_RepeatsTheLastInLanesLeftOver()
    {
        var mesh = RandomMeshes.CreateSoup(new(1), 6);
        int[] faces = [5, 0, 3, 1, 2];
        var quads = RayTriangles.GatherAll(mesh, faces);
        Assert.Equal(2 * TriangleRay.VectorsPerQuad, quads.Length);
        for (var lane = 0; lane < 8; lane++)
        {
            var (a, b, c) = mesh.Face(faces[Math.Min(lane, faces.Length - 1)]);
            var first = lane / 4 * TriangleRay.VectorsPerQuad;
            Assert.Equal((a, b, c), (Corner(first), Corner(first + 3), Corner(first + 6)));
            Vector Corner(int row) => new(quads[row][lane % 4], quads[row + 1][lane % 4], quads[row + 2][lane % 4]);
        }
    }

    [Fact]
    public void Create_OfAHitBeyondALimit_HasTheWeightsOfThePointThere()
    {
        var mesh = new Mesh([0, 0, 0, 4, 0, 0, 0, 4, 0], [0, 1, 2]);
        var (origin, direction) = (new Vector(0.25, 0.25, 1), new Vector(0.6, 0, -0.8));
        foreach (var (minDistance, maxDistance) in new[] { (0.0, 1.2), (1.3, 9.0), (0.0, 9.0) })
        {
            var search = new RaySearch(minDistance, maxDistance, false, 1e-15, default) { MaxDistance = 1.25, Face = 0 };
            RayHitFactory.Create(
                origin, direction, in search, minDistance, maxDistance, mesh, in SimdAffineMap.Identity, out var hit);
            var distance = Math.Clamp(1.25, minDistance, maxDistance);
            Near.Equal(distance, hit.Distance, 1e-15);
            Near.Equal(origin + (distance * direction), hit.Point, 1e-15);
            Near.Equal(new Vector(1 - ((hit.Point.X + 0.25) / 4), hit.Point.X / 4, 0.25 / 4), hit.Barycentrics, 2e-15);
            Assert.Equal((Vector.K, true, 0), (hit.Normal, hit.IsFrontFace, hit.FaceIndex));
            Assert.Equal(AffineMap.Identity, hit.InstanceMap);
        }
    }

    [Fact]
    public void Create_OfANeedle_HasWeightsThatMakeThePoint()
    {
        // Each corner in turn is opposite to the longest edge.
        Vector[] corners = [new(0, 0, 0), new(4, 0, 0), new(1, 1e-5, 0)];
        foreach (var (i, j, k) in new[] { (0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (1, 0, 2), (2, 1, 0) })
        {
            var (a, b, c) = (corners[i], corners[j], corners[k]);
            var target = (0.2 * corners[0]) + (0.3 * corners[1]) + (0.5 * corners[2]);
            var mesh = new Mesh([a.X, a.Y, a.Z, b.X, b.Y, b.Z, c.X, c.Y, c.Z], [0, 1, 2]);
            var search = new RaySearch(0, 9, false, 1e-15, default) { MaxDistance = 2, Face = 0 };
            RayHitFactory.Create(
                target + (2 * Vector.K), -Vector.K, in search, 0, 9, mesh, in SimdAffineMap.Identity, out var hit);
            double[] weights = [0.2, 0.3, 0.5];
            Near.Equal(new Vector(weights[i], weights[j], weights[k]), hit.Barycentrics, 1e-9);
            Near.Equal(2, hit.Distance, 1e-14);
        }
    }

    [Fact]
    public void RayStack_DeeperThanItsRoom_KeepsItsFrames()
    {
        var stack = new RayStack();
        stack[3].PathLength = 33;
        stack.Entries(3) = 0.5f;
        for (var depth = 10; depth < 100; depth++)
        {
            stack.EnsureRoom(depth);
            stack[depth].PathLength = depth;
            stack.Entries(depth) = depth;
        }

        Assert.Equal((33, 0.5f), (stack[3].PathLength, stack.Entries(3)));
        Assert.Equal((77, 77f), (stack[77].PathLength, stack.Entries(77)));
    }

    private static AffineMap Scaled(double scale, Vector translation) => new(scale * Matrix.Identity, translation);

    private static LocalRay RayOf(Vector origin, Vector direction) => LocalRay.Of(origin, direction, 0);

    private static bool Hits(Mesh mesh, LocalRay ray, double error, out double distance)
    {
        var quads = RayTriangles.GatherAll(mesh, [0]);
        var search = new RaySearch(0, double.PositiveInfinity, false, error, default);
        var isHit = new TriangleRay(in ray, error).TryIntersect(ref quads[0], ref search);
        distance = search.MaxDistance;
        return isHit;
    }

    private static (int Face, double Distance) Nearest(Mesh mesh, LocalRay ray, double minDistance, double maxDistance)
    {
        var quads = RayTriangles.GatherAll(mesh, [0, 1, 2, 3]);
        var search = new RaySearch(minDistance, maxDistance, false, 0, default);
        new TriangleRay(in ray, 0).TryIntersect(ref quads[0], ref search);
        return (search.Face, search.MaxDistance);
    }
}
