using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Queries.Regions;

/// <summary>Compares queries of balls and boxes with all triangles of small shapes.</summary>
public class RegionQueryPropertyTests
{
    private const int QueriesPerShape = 6;

    // Relative to the reach: rounding along a chain of up to a dozen maps, each 1e-15 or so.
    private const double Tolerance = 1e-13;

    [Fact]
    public void Regions_OfRandomShapes_HoldWhatAllTrianglesSay() => CheckAll(1, 120);

    [Fact]
    [Trait("Category", "Soak")]
    public void Regions_OfManyRandomShapes_HoldWhatAllTrianglesSay() => CheckAll(1_000_000, 10_000);

    private static void CheckAll(int firstSeed, int shapes) =>
        Parallel.For(firstSeed, firstSeed + shapes, seed => Seeded.RunOne(seed, random =>
        {
            var (fractal, collider) = QueryShapes.Create(random);
            var shape = new ShapeExpansion(fractal);
            for (var i = 0; i < QueriesPerShape; i++)
            {
                CheckBall(random, shape, collider);
                CheckBox(random, shape, collider);
            }
        }));

    private static void CheckBall(Random random, ShapeExpansion shape, Collider collider)
    {
        var position = QueryShapes.Position(random, shape);
        var distances = shape.Triangles.Select(triangle => triangle.Distance(position)).ToArray();
        var radius = Radius(random, distances);
        var hits = collider.FindAllWithin(position, radius, shape.Triangles.Length);
        var tolerance = Tolerance * Math.Max(shape.Magnitude, position.MaxAbsComponent());
        var found = hits.Select(hit => shape.Resolve(hit.InstancePath.AsSpan(), hit.FaceIndex)).ToArray();
        foreach (var (hit, triangle) in hits.Zip(found))
        {
            Assert.InRange(hit.Distance, 0, radius);
            Assert.InRange(triangle.Distance(position), hit.Distance - tolerance, hit.Distance + tolerance);
            Assert.InRange((hit.Point - position).Length(), hit.Distance - tolerance, hit.Distance + tolerance);
        }

        // No face twice, in order.
        Assert.Equal(hits.Length, hits.Select(hit => (string.Join(' ', hit.InstancePath), hit.FaceIndex)).Distinct().Count());
        Assert.Equal(hits.Select(hit => hit.Distance).Order(), hits.Select(hit => hit.Distance));
        var certain = shape.Triangles.Zip(distances).Where(pair => pair.Second < radius - tolerance).Select(pair => pair.First).ToArray();
        foreach (var triangle in certain)
        {
            Assert.True(found.Any(other => other.IsNear(triangle, tolerance)), $"face {triangle.Face} at {triangle.A} within {radius:R}");
        }

        var possible = distances.Count(distance => distance <= radius + tolerance);
        var isComplete = !shape.HasEqualInstances && hits.All(hit => hit.InstancePath.Length == shape.Levels);
        Assert.InRange(hits.Length, isComplete ? certain.Length : 0, possible);
        var overlaps = collider.Overlaps(position, radius);
        AssertOverlap(certain.Length > 0, possible > 0, overlaps, $"ball {position} {radius:R}");
        Assert.Equal(collider.TryFindClosest(position, radius, out _), overlaps);
        // Coordinates are rounded on the way to a face, in another order than for the closest one.
        Assert.True(overlaps == hits.Length > 0 || Math.Abs(distances.Min() - radius) <= tolerance);
    }

    private static void CheckBox(Random random, ShapeExpansion shape, Collider collider)
    {
        var position1 = QueryShapes.Position(random, shape);
        var position2 = random.Next(3) switch
        {
            0 => position1,
            1 => QueryShapes.Position(random, shape),
            _ => position1 + (Math.Pow(10, -random.Next(0, 12)) * random.Vector(shape.Magnitude)),
        };
        var box = new BoundingBox(Vector.Min(position1, position2), Vector.Max(position1, position2));
        var magnitude = Math.Max(shape.Magnitude, Math.Max(position1.MaxAbsComponent(), position2.MaxAbsComponent()));
        var margin = Tolerance * magnitude * Vector.One;
        var smaller = new BoundingBox(box.Minimum + margin, box.Maximum - margin);
        var larger = new BoundingBox(box.Minimum - margin, box.Maximum + margin);
        AssertOverlap(
            !smaller.IsEmpty && shape.Triangles.Any(triangle => triangle.Meets(smaller)),
            // Rounding makes the cuts miss triangles that a tiny box just touches, but not the distances of its corners.
            shape.Triangles.Any(triangle => triangle.Meets(larger)
                || Math.Min(triangle.Distance(position1), triangle.Distance(position2)) <= margin.X),
            collider.Overlaps(box),
            $"box {box}");
    }

    private static void AssertOverlap(bool isCertain, bool isPossible, bool actual, string region)
    {
        var reason = actual ? "nothing is near" : "a triangle is inside";
        Assert.True(actual ? isPossible : !isCertain, $"{region}: {actual}, though {reason}");
    }

    private static double Radius(Random random, double[] distances) => distances.Length == 0 ? 1 : random.Next(5) switch
    {
        0 => 0,
        1 => distances.Min(),
        2 => distances[random.Next(distances.Length)],
        3 => double.PositiveInfinity,
        _ => distances.Min() * (1 + random.NextDouble()),
    };
}
