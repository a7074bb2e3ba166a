using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Islands;

/// <summary>The sorted grid finds what a search through all bodies finds, wherever it says that it can.</summary>
public class NeighbourGridTests
{
    [Fact]
    public void CollectOverlaps_OfAnySpheres_FindsThoseOfASearchThroughAll() => Seeded.Run(60, random =>
    {
        var bodies = CreateBodies(random, random.Next(1, 200), new(random.Between(0, 9), random.Between(0, 9), random.Between(0, 9)));
        var grid = Build(bodies);
        Assert.True(grid.IsBuilt);
        for (var i = 0; i < bodies.Length; i++)
        {
            var (centre, radius) = random.Next(3) == 0
                ? (random.Vector(12), random.Between(0.01, 4))
                : (bodies[i].Position, bodies[i].Radius * random.Between(1, 1.5));
            var found = new List<int> { -7 };
            grid.CollectOverlaps(centre, radius, i, found);
            var expected = Enumerable.Range(0, bodies.Length).Where(other =>
                other != i && (bodies[other].Position - centre).LengthSquared() <= Squared(bodies[other].Radius + radius));
            Assert.Equal([-7, .. expected], found.Order());
        }
    });

    /// <summary>Two spheres that touch exactly overlap.</summary>
    [Fact]
    public void CollectOverlaps_OfSpheresThatTouch_FindsThem()
    {
        GraphBody[] bodies = [Body(Vector.Zero, 1), Body(new(0, 0, 2), 1), Body(new(3, 0, 0), 0.5)];
        var found = new List<int>();
        Build(bodies).CollectOverlaps(Vector.Zero, 1, 0, found);
        Assert.Equal([1], found);
    }

    /// <summary>A row of cells begins where the bodies do, wherever that is.</summary>
    [Theory]
    [InlineData(-90)]
    [InlineData(0)]
    [InlineData(90)]
    public void CollectOverlaps_OfARow_FindsThemCellByCell(double start)
    {
        GraphBody[] bodies = [.. new[] { 6, 3, 9, 0 }.Select(x => Body(new(start + x, 0, 0), 1))];
        var found = new List<int>();
        Build(bodies).CollectOverlaps(new(start, 0, 0), 50, -1, found);
        Assert.Equal([3, 1, 0, 2], found);
    }

    /// <summary>Cells are a radius long along x and three wide; there may be 4,096, or sixteen for each body.</summary>
    [Theory]
    [InlineData(10, 16 * 3 - 0.5, 16 * 3 - 0.5, 15.5, false)]
    [InlineData(10, 16 * 3 - 0.5, 15 * 3 - 0.5, 15.5, true)]
    [InlineData(10, 15 * 3 - 0.5, 16 * 3 - 0.5, 15.5, true)]
    [InlineData(10, 16 * 3 - 0.5, 16 * 3 - 0.5, 14.5, true)]
    [InlineData(10, 0, 0, 4094.5, true)]
    [InlineData(10, 0, 0, 4095.5, false)]
    [InlineData(10, 4095 * 3 - 0.5, 0, 0, true)]
    [InlineData(10, 0, 4095 * 3 - 0.5, 0, true)]
    [InlineData(10, 0, 4096 * 3 - 0.5, 0, false)]
    [InlineData(300, 0, 0, 4798.5, true)]
    [InlineData(300, 0, 0, 4799.5, false)]
    [InlineData(0, 0, 0, 0, false)]
    public void Build_OfBodiesFarApart_SaysWhetherTheyFitIntoCells(int count, double y, double z, double x, bool isBuilt)
    {
        var bodies = CreateBodies(new(1), count, Vector.Zero);
        if (count > 0)
        {
            bodies[0].Radius = 0.5;
            bodies[^1].Position = bodies[0].Position + (0.5 * new Vector(x, y, z));
        }

        Assert.Equal(isBuilt, Build(bodies).IsBuilt);
    }

    [Fact]
    public void Bounds_OfTwoSets_HoldBoth()
    {
        var first = GridBounds.None.With(new(1, 5, -3), 0.5).With(new(2, 4, 0), 0.25);
        var second = GridBounds.None.With(new(-1, 6, -2), 0.75);
        var expected = new GridBounds(new(-1, 4, -3), new(2, 6, 0), 0.75);
        Assert.Equal(new(new(1, 4, -3), new(2, 5, 0), 0.5), first);
        Assert.Equal(expected, GridBounds.Union(in first, in second));
        Assert.Equal(expected, GridBounds.Union(in second, in first));
        Assert.Equal(first, GridBounds.Union(in first, GridBounds.None));
    }

    private static GraphBody[] CreateBodies(Random random, int count, Vector extent)
    {
        var centre = random.Vector(100);
        return [.. Enumerable.Range(0, count).Select(_ =>
        {
            var offset = random.Vector();
            return Body(centre + new Vector(offset.X * extent.X, offset.Y * extent.Y, offset.Z * extent.Z), random.Between(0.2, 0.5));
        })];
    }

    private static GraphBody Body(Vector position, double radius) => new() { Position = position, Radius = radius };

    private static NeighbourGrid Build(GraphBody[] bodies)
    {
        var grid = new NeighbourGrid();
        grid.Reserve(bodies.Length);
        var bounds = bodies.Aggregate(GridBounds.None, static (sum, body) => sum.With(body.Position, body.Radius));
        grid.Build(bodies, in bounds);
        return grid;
    }

    private static double Squared(double number) => number * number;
}
