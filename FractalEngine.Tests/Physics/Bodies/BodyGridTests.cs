using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;

namespace FractalEngine.Tests.Physics.Bodies;

/// <summary>The cells of the hashed grid: how wide they are, which a path needs, and what each holds.</summary>
public class BodyGridTests
{
    [Fact]
    public void Count_OfARange_IsThatOfItsCells()
    {
        Assert.Equal(3 * 6 * 2, new BodyGrid.CellRange(new(1, 2, 3), new(3, 7, 4)).Count);
        Assert.Equal(1, new BodyGrid.CellRange(new(-5, 2, 3), new(-5, 2, 3)).Count);
        var range = new BodyGrid.CellRange(new(1, 2, 3), new(3, 7, 4));
        Assert.True(range.Contains(new BodyGrid.CellRange(new(1, 2, 3), new(3, 7, 4))));
        foreach (var (x, y, z) in new[] { (0, 2, 3), (1, 1, 3), (1, 2, 2), (4, 7, 4), (3, 8, 4), (3, 7, 5) })
        {
            Assert.False(range.Contains(new BodyGrid.Cell(x, y, z)));
        }
    }

    /// <summary>Cells are four radii wide, of the body that is larger than nine tenths of all.</summary>
    [Fact]
    public void Cells_OfBodiesOfManySizes_AreAsWideAsMostNeed()
    {
        // The tenth of eleven radii from 0.1 to 1.1 counts: cells of 4. Bodies of more than half of that are large.
        var grid = Build([.. Enumerable.Range(1, 10).Select(static i => (new Vector(i, 0, 0), 0.1 * i)), (new(11, 0, 0), 2.5)]);
        Assert.Equal([10], grid.LargeBodies);
        var cells = grid.CellsAround(new(new(-0.5, 3.5, 8), new(0.5, 3.5, 9)), 0.25);
        // The largest radius of a body in a cell is 1.
        Assert.Equal(new(new(-1, 0, 1), new(0, 1, 2)), cells);
        Assert.Equal([3, 4, 5, 6, 7, 8, 9], CollectIn(grid, new(new(1, 0, 0), new(2, 0, 0))).Order());
        Assert.Equal([], CollectIn(grid, new(new(1, 1, 0), new(2, 1, 0))));
        Assert.Equal([], CollectIn(grid, new(new(1, 0, -1), new(2, 0, -1))));
        Assert.Equal([0, 1, 2], CollectIn(grid, new(new(0, -1, 0), new(0, 0, 1))).Order());
    }

    [Fact]
    public void TryCollect_OfAsManyCellsAsBodies_DoesSo()
    {
        var grid = Build([.. Enumerable.Range(0, 8).Select(static i => (new Vector(4 * i, 0, 0), 1.0))]);
        var found = new List<int>();
        Assert.True(grid.TryCollect(new(new(0, 0, 0), new(1, 1, 1)), found));
        Assert.Equal([0, 1], found);
        Assert.False(grid.TryCollect(new(new(0, 0, 0), new(2, 1, 1)), found));
        Assert.Equal([0, 1], found);
        found.Clear();
        grid.CollectAll(found);
        Assert.Equal(Enumerable.Range(0, 8), found);
        found.Clear();
        // Around a centre in the middle of cells of 4: three of them each way, with the largest radius of all.
        Assert.False(grid.TryCollectOverlaps(new(2, 2, 2), 1.5, 3, found));
        Assert.True(grid.TryCollectOverlaps(new(6, 2, 2), 0.5, 3, found));
        Assert.Empty(found);
        Assert.True(grid.TryCollectOverlaps(new(4, 0.5, 0.5), 0.5, 3, found));
        Assert.Equal([1], found);
        found.Clear();
        Assert.True(grid.TryCollectOverlaps(new(4, 0.5, 0.5), 0.5, 1, found));
        Assert.Empty(found);
    }

    [Fact]
    public void Update_OfABodyThatEntersAnotherCell_TellsOfIt()
    {
        List<Body> bodies = [.. Enumerable.Range(0, 40).Select(static i => new Body(new(new(4 * i, 0, 0), 1), i))];
        var grid = new BodyGrid();
        grid.Build(bodies);
        var version = grid.Version;
        bodies[3].Position = new(12.5, 3.9, 3.9);
        Assert.True(grid.TryUpdateWithinCell(3));
        Assert.Equal(version, grid.Version);
        bodies[3].Position = new(17, 1, 1);
        Assert.False(grid.TryUpdateWithinCell(3));
        grid.Update(3);
        Assert.Equal(version + 1, grid.Version);
        Assert.Equal([], CollectIn(grid, new(new(3, 0, 0), new(3, 0, 0))));
        // The last to enter a cell is the first of it.
        Assert.Equal([3, 4], CollectIn(grid, new(new(4, 0, 0), new(4, 0, 0))));
        bodies[4].Position = new(21, 1, 1);
        grid.Update(4);
        Assert.Equal([3], CollectIn(grid, new(new(4, 0, 0), new(4, 0, 0))));
        Assert.Equal([4, 5], CollectIn(grid, new(new(5, 0, 0), new(5, 0, 0))));
        Assert.True(grid.Overlaps(3, new(new(17, 3, 1), new(17, 9, 1)), 1));
        Assert.False(grid.Overlaps(3, new(new(17, 3.001, 1), new(17, 9, 1)), 1));
        grid.Build([]);
        Assert.Empty(grid.LargeBodies);
        Assert.Equal(version + 3, grid.Version);
    }

    private static BodyGrid Build((Vector Position, double Radius)[] balls)
    {
        var grid = new BodyGrid();
        grid.Build([.. balls.Select(static (ball, i) => new Body(new(ball.Position, ball.Radius), i))]);
        return grid;
    }

    private static List<int> CollectIn(BodyGrid grid, BodyGrid.CellRange cells)
    {
        var found = new List<int>();
        Assert.True(grid.TryCollect(in cells, found));
        Assert.All(found, index => Assert.True(grid.IsWithin(index, in cells)));
        return found;
    }
}
