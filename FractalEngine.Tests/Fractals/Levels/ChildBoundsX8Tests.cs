using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals.Levels;

/// <summary>Bounds in single precision exclude no child that is close enough, however they round.</summary>
public class ChildBoundsX8Tests
{
    private const int PointsPerChild = 20;

    [Fact]
    public void FillQueue_OfRandomChildren_ExcludesNoPoint() => Seeded.RunMost(400, Check, minShare: 0.8);

    [Fact]
    [Trait("Category", "Soak")]
    public void FillQueue_OfManyRandomChildren_ExcludesNoPoint() => Seeded.RunMostInParallel(40_000, Check, minShare: 0.8);

    private static bool Check(Random random)
    {
        var fractal = CreateFractal(random);
        var hierarchy = fractal.Hierarchy;
        var root = hierarchy.Root;
        if (root.ChildBoundsX8 is not { } lanes)
        {
            return false;
        }

        for (var query = 0; query < 10; query++)
        {
            var childPoints = root.Children.Select(child => RandomPoints(random, hierarchy, child, fractal.BaseMesh)).ToArray();
            var points = childPoints[random.Next(childPoints.Length)];
            var position = points[random.Next(points.Length)] + (Distance(random, root.Radius) * random.Direction());
            var simdPosition = SimdAffineMap.ToVector256(position);
            if ((position - root.Box.Centre).Length() > ChildBoundsX8.MaxDistanceFactor * root.Radius)
            {
                continue;
            }

            for (var i = 0; i < childPoints.Length; i++)
            {
                var closestSquared = childPoints[i].Min(point => (point - position).LengthSquared());
                var queue = new FloatChildQueue(new double[lanes.PaddedCount], lanes.DistanceError(simdPosition));
                lanes.FillQueue(hierarchy, hierarchy.Levels, simdPosition, double.PositiveInfinity, in queue);
                for (var other = 0; other < childPoints.Length; other++)
                {
                    if (other != i)
                    {
                        queue.Remove(other);
                    }
                }

                // Points are rounded, too.
                var cutoff = Math.Sqrt(closestSquared) + (1e-13 * (position.MaxAbsComponent() + root.Radius));
                Ensure.That(queue.TryPeek(cutoff * cutoff, cutoff, out var found), $"child {i} is excluded at {Math.Sqrt(closestSquared)}");
                Assert.Equal(i, found);
                Assert.InRange(queue.BoundOf(i), 0, cutoff * cutoff);
                Assert.True(queue.MayContain(i) || queue.BoundOf(i) > 0);
            }
        }

        return true;
    }

    private static double Distance(Random random, double radius) => random.Next(3) switch
    {
        0 => 0,
        1 => radius * Math.Pow(10, -6 * random.NextDouble()),
        _ => 20 * radius * random.NextDouble(),
    };

    /// <summary>Points of the faces that a child holds.</summary>
    private static Vector[] RandomPoints(Random random, FractalHierarchy hierarchy, ChildInstance child, Mesh baseMesh)
    {
        var points = new Vector[PointsPerChild];
        for (var i = 0; i < points.Length; i++)
        {
            var map = child.Map;
            var levels = child.RemainingLevels(hierarchy.Levels);
            while (levels > 0)
            {
                var children = hierarchy.At(levels).Children;
                var next = children[random.Next(children.Length)];
                map *= next.Map;
                levels = next.RemainingLevels(levels);
            }

            points[i] = map * baseMesh.Vertex(baseMesh.VertexIndices[random.Next(baseMesh.VertexIndices.Length)]);
        }

        return points;
    }

    private static Fractal CreateFractal(Random random)
    {
        var isRotated = random.Next(2) == 0;
        var unit = Math.Pow(10, random.Next(-6, 7));
        var maps = new Transformation[random.Next(2, 28)];
        for (var i = 0; i < maps.Length; i++)
        {
            var angles = isRotated ? random.Degrees() : Vector.Zero;
            maps[i] = new(random.Vector(unit), angles, Math.Pow(10, -3 * random.NextDouble()) * Vector.One);
        }

        Vector[] corners = [.. Enumerable.Range(0, random.Next(4, 12)).Select(_ => random.Vector(unit))];
        int[] indices = [.. Enumerable.Range(0, 3 * random.Next(2, 12)).Select(_ => random.Next(corners.Length))];
        var mesh = new Mesh([.. corners.SelectMany(corner => (double[])[corner.X, corner.Y, corner.Z])], [.. indices]);
        return Fractal.Of(mesh).Repeat(maps, random.Next(1, 4));
    }
}
