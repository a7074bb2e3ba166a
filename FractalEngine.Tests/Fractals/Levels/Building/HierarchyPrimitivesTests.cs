using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Fractals.Levels.Building;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals.Levels.Building;

/// <summary>Tests the parts of the hierarchy of sub-fractals, each by itself.</summary>
public sealed class HierarchyPrimitivesTests
{
    private static readonly BoundingBox Unit = new(Vector.Zero, Vector.One);

    [Fact]
    public void Then_OfTwoSteps_LeadsWhereOneAfterTheOtherDoes()
    {
        LevelStep[] steps = [LevelStep.Down(0), LevelStep.Down(3), LevelStep.To(0), LevelStep.To(20)];
        foreach (var first in steps)
        {
            foreach (var second in new[] { LevelStep.Down(1), LevelStep.Down(0), LevelStep.To(0), LevelStep.To(5) })
            {
                var joined = first.Then(second);
                if (first != LevelStep.To(0) || second.IsAbsolute || second == LevelStep.Down(0))
                {
                    Assert.Equal(second.RemainingLevels(first.RemainingLevels(100)), joined.RemainingLevels(100));
                    Assert.Equal(first.IsAbsolute || second.IsAbsolute, joined.IsAbsolute);
                }
            }
        }

        Assert.Equal((97L, 20L, 0L), (steps[1].RemainingLevels(100), steps[3].RemainingLevels(100), steps[2].RemainingLevels(7)));
        Assert.Equal(LevelStep.Down(0), default);
    }

    [Fact]
    public void FindIndex_OfALevel_FollowsPeriodsAndRefusesWhatIsAbove()
    {
        LevelRegion[] regions = [new(0, 3, 0, 3), new(3, 10, 3, 2), new(13, 1L << 40, 5, 1)];
        int[] expected = [0, 1, 2, 3, 4, 3, 4, 3, 4, 3, 4, 3, 4, 5, 5];
        for (var level = 0; level < expected.Length; level++)
        {
            Assert.Equal(expected[level], LevelRegion.FindIndex(regions, level));
        }

        Assert.Equal(5, LevelRegion.FindIndex(regions, 12 + (1L << 40)));
        Assert.Throws<ArgumentOutOfRangeException>(() => LevelRegion.FindIndex(regions, 13 + (1L << 40)));
        Assert.Throws<ArgumentOutOfRangeException>(() => LevelRegion.FindIndex(regions, -1));
    }

    [Fact]
    public void MapSet_OfMaps_TellsScalesNormsAndTheFirstIdentity()
    {
        AffineMap[] maps = [Scaled(-2), AffineMap.Identity, Scaled(0.5), AffineMap.Identity];
        var set = new MapSet(maps);
        Assert.Equal(new[] { 4, 1, 0.25, 1 }, set.ScalesSquared);
        Assert.Equal((1, true), (set.IdentityIndex, set.AreSimilarities));
        for (var i = 0; i < maps.Length; i++)
        {
            var scale = Math.Sqrt(set.ScalesSquared[i]);
            Assert.InRange(set.OperatorNormBounds[i], scale, scale * (1 + 1e-14));
        }

        // Twelve numbers of a map with its scale and its norm, and as many of its inverse once that is needed.
        Assert.Equal(4 * 14 * 8, set.StorageBytes);
        Near.Equal(Scaled(-0.5), set.Inverses[0], 1e-15);
        Assert.Equal(4 * 26 * 8, set.StorageBytes);
        var stretched = new MapSet([Scaled(1.5), new(Matrix.Diagonal(new(1, 2, 1)), Vector.Zero), Scaled(1.5)]);
        Assert.Equal((-1, false), (stretched.IdentityIndex, stretched.AreSimilarities));
        Assert.Throws<SingularMatrixException>(() => new MapSet([new(Matrix.Diagonal(new(1, 0, 1)), Vector.Zero)]));
    }

    [Fact]
    public void Comparers_OfMapsAndEdges_TellEqualOnesFromOthers()
    {
        AffineMap[] maps = [Scaled(2), Scaled(3), Scaled(2)];
        var comparer = new MapIndexComparer(new(maps));
        Assert.True(comparer.Equals(0, 2) && !comparer.Equals(0, 1));
        Assert.Equal(comparer.GetHashCode(0), comparer.GetHashCode(2));
        Assert.NotEqual(comparer.GetHashCode(0), comparer.GetHashCode(1));
        var set = new MapSet(maps);
        ChildEdge[] edges = [new(set, 0, LevelStep.Down(1)), new(set, 1, LevelStep.Down(1))];
        var edgesComparer = ChildEdgesComparer.Instance;
        Assert.True(edgesComparer.Equals(edges, [.. edges]));
        Assert.Equal(edgesComparer.GetHashCode(edges), edgesComparer.GetHashCode([.. edges]));
        foreach (ChildEdge[] other in (ChildEdge[][])
            [
                [edges[0]], [edges[1], edges[0]], [edges[0], edges[1] with { MapIndex = 2 }],
                [edges[0], edges[1] with { LevelStep = LevelStep.Down(2) }], [edges[0], edges[1] with { Set = new(maps) }],
            ])
        {
            Assert.False(edgesComparer.Equals(edges, other));
            Assert.NotEqual(edgesComparer.GetHashCode(edges), edgesComparer.GetHashCode(other));
        }
    }

    [Fact]
    public void ChildInstance_OfSeveralEdges_ComposesMapsScalesAndSteps()
    {
        var set = new MapSet([new(2 * Matrix.Identity, Vector.I), new(-0.25 * Matrix.Identity, Vector.J)]);
        ChildEdge[] edges = [new(set, 1, LevelStep.Down(1)), new(set, 0, LevelStep.Down(2)), new(set, 0, LevelStep.Down(4))];
        var child = new ChildInstance(edges, 0, 2);
        Near.Equal(set.Maps[1] * set.Maps[0], child.Map, 1e-15);
        Near.Equal(AffineMap.Identity, child.Map * child.InverseSimdMap.ToAffineMap(), 1e-15);
        Assert.Equal((0.25, 4.0, 2.0), (child.ScaleSquared, child.InverseScaleSquared, child.InverseScale));
        Near.Equal(0.5, child.OperatorNormBound, 1e-14);
        Assert.Equal((LevelStep.Down(3), 2, false), (child.LevelStep, child.Edges.Length, child.HasMapsOfLevels));
        Assert.Equal(97, child.RemainingLevels(100));
        var single = new ChildInstance(edges, 1, 1);
        Assert.Equal((set.Maps[0], false), (single.Map, single.HasMapsOfLevels));
        Assert.True(new ChildInstance(edges, 0, 1).HasMapsOfLevels);
        // A composed map is kept in an array, and an edge is three words.
        Assert.Equal(single.StorageBytes + (15 * 8) + 24, child.StorageBytes);
        Assert.Equal(3, new ChildInstance(edges).Edges.Length);
        Assert.Null(child.Group);
    }

    [Fact]
    public void SimplexDistance_OfRandomPoints_IsTheClosestOfTheHull() => Seeded.Run(200, random =>
    {
        var offset = random.Next(2) == 0 ? Vector.Zero : random.Vector(2);
        Vector[] points = [.. Enumerable.Range(0, random.Next(1, 5)).Select(_ => random.Vector() + offset)];
        var simplex = new SimplexDistance();
        foreach (var point in points)
        {
            Assert.True(simplex.TryAdd(point));
            Assert.False(simplex.TryAdd(point));
        }

        var closest = simplex.FindClosestToOrigin();
        // The closest point of a convex set is the one behind which all points lie, and it is a mean of them.
        var squared = closest.LengthSquared();
        Assert.All(points, point => Assert.True(Vector.Dot(closest, point) >= squared - 1e-11));
        var hull = ConvexHull.Build(points, 4);
        Assert.True(hull.DistanceUpperBound(closest) <= hull.MaxOutsideDistance + 1e-7);
    });

    [Fact]
    public void TryAdd_ToAReducedSimplex_HasRoomAgain()
    {
        var simplex = new SimplexDistance();
        Assert.True(simplex.TryAdd(new(1, 0, 0)) && simplex.TryAdd(new(3, 0, 0)));
        Assert.True(simplex.TryAdd(new(2, 5, 0)) && simplex.TryAdd(new(2, 0, 5)));
        Assert.False(simplex.TryAdd(new(9, 9, 9)));
        Assert.Equal(new(1, 0, 0), simplex.FindClosestToOrigin());
        Assert.True(simplex.TryAdd(new(1, 4, 0)));
        Assert.Equal(new(1, 0, 0), simplex.FindClosestToOrigin());
        Assert.True(simplex.TryAdd(new(-1, 2, 0)));
        // The middle of (1, 0) and (−1, 2).
        Near.Equal(new Vector(0.5, 0.5, 0), simplex.FindClosestToOrigin(), 1e-15);
    }

    [Fact]
    public void ConvexSolid_OfABox_HasItsDistanceSupportAndLowestCorners() => Seeded.Run(50, random =>
    {
        var box = BoundingBox.Empty.Including(random.Vector()).Including(random.Vector());
        var solid = ConvexSolid.FromBox(box);
        Assert.True(solid.IsBox && solid.Margin == 0);
        Assert.Equal((3 * 8 * 8) + 96, solid.StorageBytes);
        var position = random.Vector(4);
        var bound = solid.LowerBoundSquared(SimdAffineMap.ToVector256(position), in SimdAffineMap.Identity, double.PositiveInfinity);
        Near.Equal(box.DistanceSquared(position), bound, 1e-10);
        var direction = random.Vector();
        var expected = Vector.Dot(direction, box.Centre) + (0.5 * Vector.Dot(direction.Absolute(), box.Size));
        Near.Equal(expected, solid.Support(direction), 1e-14);
        Near.Equal(expected, -Vector.Dot(-direction, solid.FindLowestVertex(-direction)), 1e-14);

        Vector[] corners = [.. Enumerable.Range(0, 5).Select(_ => random.Vector())];
        var widened = new ConvexSolid(corners, 0.125);
        Assert.Equal((false, 0.125, (3L * 8 * 8) + 96), (widened.IsBox, widened.Margin, widened.StorageBytes));
        Near.Equal(
            corners.Max(corner => Vector.Dot(direction, corner)) + (0.125 * direction.Length()), widened.Support(direction), 1e-14);
        var without = new ConvexSolid(corners, 0).LowerBoundSquared(
            SimdAffineMap.ToVector256(3 * position), in SimdAffineMap.Identity, double.PositiveInfinity);
        var withMargin = widened.LowerBoundSquared(
            SimdAffineMap.ToVector256(3 * position), in SimdAffineMap.Identity, double.PositiveInfinity);
        Assert.True(Math.Sqrt(withMargin) >= Math.Sqrt(without) - 0.125 - 1e-7);
        Assert.True(without == 0 || Math.Sqrt(withMargin) <= Math.Max(0, Math.Sqrt(without) - 0.124));
    });

    [Fact]
    public void ClusterBounds_OfBoxes_AreAsFarAsTheNearestOfThem() => Seeded.Run(50, random =>
    {
        BoundingBox[] boxes = [.. Enumerable.Range(0, random.Next(1, 10))
            .Select(_ => BoundingBox.Empty.Including(random.Vector(5)).Including(random.Vector(5)))];
        var clusters = new ClusterBounds(boxes);
        Assert.Equal(boxes[0], clusters.Bulk);
        Assert.Equal((6L * 8 * ((boxes.Length + 3) / 4 * 4)) + 40, clusters.StorageBytes);
        var position = random.Vector(20);
        var simdPosition = SimdAffineMap.ToVector256(position);
        Near.Equal(boxes.Min(box => box.DistanceSquared(position)), clusters.LowerBoundSquared(simdPosition), 1e-10);
        var map = new AffineMap(new(random.Vector(), random.Vector(), random.Vector()), random.Vector(3));
        Near.Equal(
            boxes.Min(box => box.Transform(map).DistanceSquared(position)),
            clusters.LowerBoundSquared(simdPosition, new SimdAffineMap(map)), 1e-10);
    });

    [Fact]
    public void FloatBound_OfAHull_IsAsFarAsItsBoxPlanesAndVerticesTell() => Seeded.Run(50, random =>
    {
        // An octahedron about the middle of its box, whose planes are |x| + |y| + |z| ≤ 1.
        Vector[] vertices = [Vector.I, -Vector.I, Vector.J, -Vector.J, Vector.K, -Vector.K];
        var box = new BoundingBox(-Vector.One, Vector.One);
        var hull = ConvexHull.Build(vertices, 6);
        Assert.Equal(8, hull.Planes.Length);
        const double Margin = 0.125;
        var position = random.Vector(3);
        var scale = random.Between(0.5, 2);
        var far = Math.Sqrt(box.DistanceSquared(position));
        var height = (position.Absolute().X + position.Absolute().Y + position.Absolute().Z - 1) / Math.Sqrt(3);
        var separation = position.Length() - (position.MaxAbsComponent() / position.Length()) - Margin;
        Near.Equal(scale * far, Distance(new(box, [], [], Margin), out _), 1e-5);
        Near.Equal(scale * Math.Max(0, Math.Max(far, height)), Distance(new(box, hull.Planes, [], Margin), out _), 1e-5);
        var all = new FloatBound(box, hull.Planes, vertices, Margin);
        Near.Equal(scale * Math.Max(0, Math.Max(far, Math.Max(height, separation))), Distance(all, out var fromCentre), 1e-5);
        Near.Equal(position.Length(), fromCentre, 1e-5);
        Assert.Equal((4 * ((4 * 8) + (3 * 6))) + 256, all.StorageBytes);
        // A hull of more than eight planes or sixteen vertices is not kept.
        Assert.Equal(256, new FloatBound(box, [.. hull.Planes, hull.Planes[0]], vertices, Margin).StorageBytes);
        Vector[] many = [.. Enumerable.Repeat(Vector.I, 17)];
        Assert.Equal((4 * 4 * 8) + 256, new FloatBound(box, hull.Planes, many, Margin).StorageBytes);
        Assert.Equal((4 * ((4 * 8) + (3 * 16))) + 256, new FloatBound(box, hull.Planes, many[1..], Margin).StorageBytes);

        double Distance(FloatBound bound, out double fromCentre)
        {
            var squared = bound.DistanceSquared(
                Vector256.Create((float)position.X), Vector256.Create((float)position.Y), Vector256.Create((float)position.Z),
                Vector256.Create((float)(scale * scale)), Vector256.Create(float.PositiveInfinity), out var fromCentreSquared);
            fromCentre = Math.Sqrt(fromCentreSquared[3]);
            return Math.Sqrt(squared[7]);
        }
    });

    [Fact]
    public void MapPowers_OfStaircases_HaveOneInstanceForEachStep()
    {
        for (var depth = 1; depth <= 70; depth++)
        {
            var fractal = Samples.Repeated(depth, Samples.Move(0, 0, 1), Transformation.Identity);
            var counts = new InstanceCounts(fractal.Hierarchy, static _ => 1);
            Assert.Equal(depth + 1, counts.SumAt(fractal.Hierarchy.Levels));
            Assert.Equal(depth >= 8, fractal.Hierarchy.HasDoubledPowers);
            Assert.Equal(depth, fractal.BuildHierarchy(doublesPowers: false).Levels);
        }
    }

    [Fact]
    public void TryCreate_OfARepetition_TakesOneMapThatKeepsSizes()
    {
        Assert.NotNull(MapPowers.TryCreate(RepetitionOf(8, Samples.Move(1, 0, 0))));
        Assert.NotNull(MapPowers.TryCreate(RepetitionOf(8, Transformation.Identity, Samples.Move(1, 0, 0), Samples.Move(1, 0, 0))));
        Assert.Null(MapPowers.TryCreate(RepetitionOf(7, Samples.Move(1, 0, 0))));
        Assert.Null(MapPowers.TryCreate(RepetitionOf(null, Samples.Move(1, 0, 0))));
        Assert.Null(MapPowers.TryCreate(RepetitionOf(8)));
        Assert.Null(MapPowers.TryCreate(RepetitionOf(8, Transformation.Identity, Transformation.Identity)));
        Assert.Null(MapPowers.TryCreate(RepetitionOf(8, Samples.Move(1, 0, 0), Samples.Move(2, 0, 0))));
        Assert.Null(MapPowers.TryCreate(RepetitionOf(8, Samples.MoveAndScale(1, 0, 0, 0.89))));
        Assert.NotNull(MapPowers.TryCreate(RepetitionOf(8, Samples.MoveAndScale(1, 0, 0, 0.91))));
        // A map that flattens, whatever it stretches along another axis; and one that leaves the range of a double.
        Assert.Null(MapPowers.TryCreate(RepetitionOf(8, new Transformation(Vector.Zero, Vector.Zero, new(10, 1, 1e-4)))));
        Assert.NotNull(MapPowers.TryCreate(RepetitionOf(8, new Transformation(Vector.Zero, Vector.Zero, new(1, 1, 0.1)))));
        Assert.Null(MapPowers.TryCreate(RepetitionOf(1000, Samples.MoveAndScale(0, 0, 0, 2000))));
    }

    /// <summary>Rounds of sets and nested repetitions don't recur as rounds of sets do.</summary>
    [Fact]
    public void Levels_OfNestedRepetitions_AreThoseOfTheFractal()
    {
        foreach (var count in new[] { 1, 2, 3, 40, 60 })
        {
            TransformationSet Set() => TransformationSet.Of(
                new[] { Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.5) });
            var fractal = new Fractal(new([new Repetition([Set(), new Repetition([Set()], 2)], count)]), Samples.Tetrahedron);
            Assert.Equal(3 * count, fractal.LevelCount);
            Assert.Equal(fractal.LevelCount, fractal.Hierarchy.Levels);
        }
    }

    [Fact]
    public void HasOutliers_OfASetThatThrowsOneMapFarAway_MakesClusters()
    {
        Transformation[] near = [.. Enumerable.Range(0, 4).Select(i => Samples.MoveAndScale(i, 0, 0, 0.2))];
        Transformation[] far = [.. near, Samples.MoveAndScale(100_000, 0, 0, 0.2)];
        var clusters = Samples.Repeated(2, far).Hierarchy.Root.Clusters;
        Assert.NotNull(clusters);
        Assert.InRange(clusters.Bulk.Diagonal, 0.1, 100_000);
        Assert.Null(Samples.Repeated(2, near).Hierarchy.Root.Clusters);
        Assert.Null(Samples.Repeated(2, [.. near, Samples.MoveAndScale(20, 0, 0, 0.2)]).Hierarchy.Root.Clusters);
    }

    [Fact]
    public void IsWithinRadii_OfAPosition_ComparesWithHalfTheDiagonal()
    {
        var root = Samples.Repeated(2, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(2, 2, 2, 0.5)).Hierarchy.Root;
        Near.Equal(0.5 * BoundingBox.Union(root.Box, Samples.Tetrahedron.Bounds).Diagonal, root.Radius, 1e-12);
        foreach (var (distance, expected) in new[] { (0.999, true), (1.001, false) })
        {
            var position = SimdAffineMap.ToVector256(root.Box.Centre + (3 * distance * root.Radius * Vector.J));
            Assert.Equal(expected, root.IsWithinRadii(position, 3));
        }
    }

    [Fact]
    public void BoxDistances_OfASubFractal_AreThoseOfItsBox() => Seeded.Run(30, random =>
    {
        var root = Samples.Repeated(2, random.Transformation(), random.Transformation()).Hierarchy.Root;
        var position = random.Vector(20);
        var simdPosition = SimdAffineMap.ToVector256(position);
        Near.Equal(root.Box.DistanceSquared(position), root.BoxDistanceSquared(simdPosition), 1e-11);
        var map = new AffineMap(new(random.Vector(), random.Vector(), random.Vector()), random.Vector());
        Near.Equal(
            root.Box.Transform(map).DistanceSquared(position),
            root.TransformedBoxDistanceSquared(simdPosition, new SimdAffineMap(map)), 1e-10);
        Assert.False(root.IsChildEmpty(0));
    });

    private static AffineMap Scaled(double scale) => new(scale * Matrix.Identity, Vector.Zero);

    private static Repetition RepetitionOf(int? count, params Transformation[] set) => new([new TransformationSet([.. set])], count);
}
