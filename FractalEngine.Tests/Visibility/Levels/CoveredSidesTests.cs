using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;

namespace FractalEngine.Tests.Visibility.Levels;

/// <summary>
/// Sides that instances are said to have covered, beside a comparison of all rectangles: each of them is the side of another instance, too.
/// </summary>
public class CoveredSidesTests
{
    private static readonly BoundingBox Base = new(new(2, -1, 0), new(5, 1, 0.5));

    /// <summary>A cube has 6 sides, of which those outside of a sponge of depth n are 2·20ⁿ + 4·8ⁿ.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    public void Sides_OfASponge_AreCoveredButForItsSurface(int depth)
    {
        var count = (int)Math.Pow(20, depth);
        var (covered, hidden) = Compare(CullingViews.Menger(depth));
        Assert.Equal((6 * count) - (2 * count) - (4 * (int)Math.Pow(8, depth)), covered);
        Assert.Equal(hidden, covered);
    }

    /// <summary>Cells of a grid that are kept alike on both sides of each axis: all sides that touch are found.</summary>
    [Fact]
    public void Sides_OfSymmetricGrids_AreAllFound()
    {
        var total = 0;
        Seeded.Run(60, random =>
        {
            var kept = random.Next(1, 256);
            var sizes = (random.Next(1, 4), random.Next(1, 4), random.Next(1, 4));
            var maps = Grid(sizes, (x, y, z) => (kept >> (x + (2 * y) + (4 * z)) & 1) != 0).ToArray();
            if (maps.Length is > 1 and <= 27)
            {
                var (covered, hidden) = Compare(Fractal.Of(Shapes.Box(Base)).Repeat(maps, maps.Length > 12 ? 2 : 3));
                // Where the box of a fractal is smaller than its base, nothing is marked.
                Assert.True(covered == hidden || covered == 0, $"{covered} of {hidden}");
                total += covered;
            }

            static IEnumerable<Transformation> Grid((int X, int Y, int Z) sizes, Func<int, int, int, bool> isKept) =>
                from x in Enumerable.Range(0, sizes.X)
                from y in Enumerable.Range(0, sizes.Y)
                from z in Enumerable.Range(0, sizes.Z)
                where isKept(Distance(x, sizes.X), Distance(y, sizes.Y), Distance(z, sizes.Z))
                select Cell((x, y, z), sizes);

            static int Distance(int cell, int size) => Math.Min(cell, size - 1 - cell);
        });
        Assert.InRange(total, 1000, 1_000_000);
    }

    /// <summary>Grids whose sides have different holes, with copies that are turned, mirrored or of another size: none is wrong.</summary>
    [Fact]
    public void Sides_OfAnyGrid_AreHidden()
    {
        var total = 0;
        Seeded.Run(200, random =>
        {
            var sizes = (X: random.Next(1, 4), Y: random.Next(1, 4), Z: random.Next(1, 3));
            var share = random.Between(0.5, 1.3);
            var cells = from x in Enumerable.Range(0, sizes.X)
                        from y in Enumerable.Range(0, sizes.Y)
                        from z in Enumerable.Range(0, sizes.Z)
                        where random.NextDouble() < share
                        select Cell((x, y, z), sizes);
            var maps = cells.ToList();
            if (maps.Count == 0)
            {
                return;
            }

            switch (random.Next(6))
            {
                case 0:
                    maps[0] = maps[0] with { Scale = new Vector(-1, 1, 1).Stretch(maps[0].Scale) };
                    break;
                case 1:
                    maps[0] = maps[0] with { Rotation = new(0, 180, 0) };
                    break;
                case 2:
                    maps.Add(maps[0] with { Scale = 0.5 * maps[0].Scale });
                    break;
                case 3:
                    maps.Add(Transformation.Identity);
                    break;
            }

            var fractal = Fractal.Of(Shapes.Box(Base)).Repeat(maps, maps.Count > 9 ? 2 : 3);
            total += Compare(fractal).Covered;
        });
        Assert.InRange(total, 500, 1_000_000);
    }

    [Fact]
    public void Sides_WhereNothingStandsSideBySide_AreNotListed()
    {
        Transformation[] cells = [Cell((0, 0, 0), (2, 1, 1)), Cell((1, 0, 0), (2, 1, 1))];
        Assert.False(CullingViews.CreateObject(Fractal.Of(Samples.Tetrahedron).Repeat(cells, 2)).Hierarchy.HasCoveredSides);
        Assert.False(CullingViews.CreateObject(Fractal.Of(Shapes.Box(Base)).Repeat(cells[..1], 2)).Hierarchy.HasCoveredSides);
        Assert.True(CullingViews.CreateObject(CullingViews.Menger(null)).Hierarchy.HasCoveredSides);
    }

    /// <summary>The map from the base to a cell of a grid that fills it.</summary>
    private static Transformation Cell((int X, int Y, int Z) place, (int X, int Y, int Z) sizes)
    {
        var scale = new Vector(1.0 / sizes.X, 1.0 / sizes.Y, 1.0 / sizes.Z);
        var first = Base.Minimum + new Vector(place.X, place.Y, place.Z).Stretch(scale.Stretch(Base.Size));
        return new(first - scale.Stretch(Base.Minimum), Vector.Zero, scale);
    }

    /// <summary>
    /// Counts the sides that culling calls covered, each of which must be that of another instance, and those that are.
    /// </summary>
    private static (int Covered, int Hidden) Compare(Fractal fractal)
    {
        var item = CullingViews.CreateObject(fractal);
        var set = new VisibleSet();
        var box = fractal.Bounds;
        set.Cull(CullingViews.CreateView(box.Centre - (4 * box.Diagonal * Vector.K), box.Centre), [item], CullingViews.NoCulling);
        var boxes = CullingViews.VisibleMaps(set, item).ConvertAll(map => item.Hierarchy.Mesh.Bounds.Transform(map));
        float[] sides = item.Hierarchy.HasCoveredSides
            ? [.. Enumerable.Range(0, VisibleSet.ChunkCount).SelectMany(chunk => set.CoveredSides(0, chunk).ToArray())]
            : new float[boxes.Count];
        Assert.Equal(boxes.Count, sides.Length);
        var rectangles = boxes.SelectMany(one => Enumerable.Range(0, 6).Select(side => KeyOf(one, side, box)))
            .GroupBy(static key => key).ToDictionary(static group => group.Key, static group => group.Count());
        var (covered, hidden) = (0, 0);
        for (var i = 0; i < boxes.Count; i++)
        {
            for (var side = 0; side < 6; side++)
            {
                var (axis, isHigh, place) = KeyOf(boxes[i], side, box);
                var isHidden = rectangles.ContainsKey((axis, !isHigh, place));
                var isCovered = ((int)sides[i] & (1 << side)) != 0;
                Assert.True(isHidden || !isCovered, $"side {side} of {boxes[i]}");
                hidden += isHidden ? 1 : 0;
                covered += isCovered ? 1 : 0;
            }
        }

        return (covered, hidden);
    }

    /// <summary>A side as its axis, whether it is the upper one, and the box of its rectangle in steps of a ten thousandth.</summary>
    private static (int Axis, bool IsHigh, BoundingBox Place) KeyOf(BoundingBox one, int side, BoundingBox whole)
    {
        var (axis, isHigh) = (side % 3, side < 3);
        var direction = axis == 0 ? Vector.I : axis == 1 ? Vector.J : Vector.K;
        var place = isHigh ? one with { Minimum = one.Minimum + direction.Stretch(one.Size) }
            : one with { Maximum = one.Maximum - direction.Stretch(one.Size) };
        return (axis, isHigh, new(Round(place.Minimum), Round(place.Maximum)));

        Vector Round(Vector v)
        {
            var step = 1e-4 * whole.Diagonal;
            return new(Math.Round(v.X / step), Math.Round(v.Y / step), Math.Round(v.Z / step));
        }
    }
}
