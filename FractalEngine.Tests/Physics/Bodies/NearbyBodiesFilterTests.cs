using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Tests.Physics.Bodies;

/// <summary>Bodies near a mover, by their layers, and of a grid that was built just now.</summary>
public sealed class NearbyBodiesFilterTests
{
    /// <summary>Nothing was collected before the first search, whatever the version of the grid.</summary>
    [Fact]
    public void CollectOverlaps_OfANewGrid_SearchesIt()
    {
        // All in the cell from 0 to 4, and so is the search.
        var (grid, bodies) = Create(new BodyDescription(new(2, 2, 2), 1), new BodyDescription(new(2.5, 2, 2), 1));
        Assert.Equal(1, grid.Version);
        var nearby = new NearbyBodies(grid, bodies);
        Assert.Equal([0, 1], Collect(nearby, new(1.75, 2, 2), 0.25, Contact.NoBody).Order());
        Assert.Equal([1], Collect(nearby, new(1.75, 2, 2), 0.25, 0));
    }

    [Theory]
    [InlineData(false, 0, "12")]
    [InlineData(true, 0, "2")]
    [InlineData(true, 1, "")]
    [InlineData(true, -1, "012")]
    [InlineData(false, -1, "012")]
    public void CollectOverlaps_WithLayers_LeavesOutThoseThatDoNotMeet(bool hasFilters, int index, string digits)
    {
        var (grid, bodies) = CreateLayers();
        int[] expected = [.. digits.Select(static digit => digit - '0')];
        var nearby = new NearbyBodies(grid, bodies) { HasFilters = hasFilters };
        Assert.Equal(expected, Collect(nearby, new(2, 2, 2), 1, index).Order());
        var found = new List<int> { 77 };
        nearby.CollectOverlaps(new Vector(2, 2, 2), 1, index, found);
        Assert.Equal(expected.Prepend(77).Order(), found.Order());
        // Without the bodies their layers are not known.
        var all = new NearbyBodies(grid) { HasFilters = hasFilters };
        Assert.Equal(Enumerable.Range(0, 3).Where(i => i != index), Collect(all, new(2, 2, 2), 1, index).Order());
    }

    /// <summary>Bodies wider than a cell are met by their layers too.</summary>
    [Theory]
    [InlineData(0, true)]
    [InlineData(1, false)]
    public void CollectOverlaps_OfALargeBody_GoesByItsLayer(int layer, bool meets)
    {
        var (grid, bodies) = Create(
            [
                new(new(2, 2, 2), 0.125), new(new(2, 2, 2), 9) { Layer = layer },
                .. Enumerable.Range(0, 12).Select(static i => new BodyDescription(new(50 + i, 0, 0), 0.125)),
            ]);
        bodies[0] = new(new(new(2, 2, 2), 0.125) { Mask = 1 }, 0);
        Assert.Equal([1], grid.LargeBodies);
        var nearby = new NearbyBodies(grid, bodies) { HasFilters = true };
        int[] expected = meets ? [1] : [];
        Assert.Equal(expected, Collect(nearby, new(2, 2, 2), 0.125, 0));
        Assert.False(nearby.Prepare(new(new(2, 2, 2), new(2, 2, 2)), 0.125, 0));
    }

    private static (BodyGrid Grid, List<Body> Bodies) CreateLayers() => Create(
        new BodyDescription(new(2, 2, 2), 1) { Layer = 1, Mask = 0b100 }, new BodyDescription(new(2.5, 2, 2), 1),
        new BodyDescription(new(2, 2.5, 2), 1) { Layer = 2, Mask = 0b010 });

    private static (BodyGrid Grid, List<Body> Bodies) Create(params BodyDescription[] descriptions)
    {
        List<Body> bodies = [.. descriptions.Select(static (one, i) => new Body(one, i))];
        var grid = new BodyGrid();
        grid.Build(bodies);
        return (grid, bodies);
    }

    private static List<int> Collect(NearbyBodies nearby, Vector centre, double radius, int index)
    {
        var found = new List<int>();
        nearby.CollectOverlaps(new BoundingBox(centre, centre), radius, index, found);
        return found;
    }
}
