using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Bodies;

/// <summary>What is collected once for a mover gives the same bodies, in the same order, as a search of its own.</summary>
public class NearbyBodiesTests
{
    private const int Seed = 11;

    [Fact]
    public void CollectOverlaps_AfterPrepare_FindsAllBodiesInTheOrderOfAFreshSearch()
    {
        var random = new Random(Seed);
        var bodies = CreateBodies(random, 400);
        var grid = new BodyGrid();
        grid.Build(bodies);
        var nearby = new NearbyBodies(grid);
        for (var i = 0; i < 500; i++)
        {
            var mover = bodies[random.Next(bodies.Count)];
            nearby.Prepare(RandomBox(mover.Position, random, 0.2), mover.Radius, mover.Index);
            for (var search = 0; search < 4; search++)
            {
                var box = RandomBox(mover.Position, random, search == 3 ? 3 : 0.1);
                var found = Collect(nearby, box, mover);
                Assert.Equal(Collect(new NearbyBodies(grid), box, mover), found);
                var expected = bodies.Where(other => other != mover && Overlaps(other, box, mover)).Select(other => other.Index);
                Assert.Equal(expected, found.Order());
            }

            mover.Position += random.Vector(0.3);
            grid.Update(mover.Index);
        }
    }

    [Fact]
    public void Prepare_AmongSmallBodies_TellsWhetherAnyOverlapsTheBox()
    {
        var random = new Random(Seed);
        var bodies = CreateBodies(random, 400).FindAll(static body => body.Radius < 0.1);
        bodies = [.. bodies.Select((body, i) => new Body(body.Description, i))];
        var grid = new BodyGrid();
        grid.Build(bodies);
        var nearby = new NearbyBodies(grid);
        var clearCount = 0;
        for (var i = 0; i < 500; i++)
        {
            var mover = bodies[random.Next(bodies.Count)];
            var box = RandomBox(mover.Position, random, 0.05);
            var isClear = nearby.Prepare(in box, mover.Radius, mover.Index);
            Assert.Equal(!bodies.Exists(other => other != mover && Overlaps(other, box, mover)), isClear);
            clearCount += isClear ? 1 : 0;
        }

        Assert.InRange(clearCount, 50, 450);
    }

    private static List<int> Collect(NearbyBodies nearby, BoundingBox box, Body mover)
    {
        var found = new List<int>();
        nearby.CollectOverlaps(in box, mover.Radius, mover.Index, found);
        return found;
    }

    private static bool Overlaps(Body other, BoundingBox box, Body mover) =>
        box.DistanceSquared(other.Position) <= (other.Radius + mover.Radius) * (other.Radius + mover.Radius);

    private static BoundingBox RandomBox(Vector position, Random random, double size)
    {
        var corner = position + random.Vector(size);
        return new(Vector.Min(position, corner), Vector.Max(position, corner));
    }

    /// <summary>Every twentieth body is wider than a cell.</summary>
    private static List<Body> CreateBodies(Random random, int count) => [.. Enumerable.Range(0, count).Select(
        i => new Body(new BodyDescription(random.Vector(1), i % 20 == 0 ? 0.3 : 0.03 + (0.02 * random.NextDouble())), i))];
}
