using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals;

public class FractalTrailTests
{
    private static readonly Transformation First = Samples.MoveAndScale(0.2, 0, 0, 0.5);
    private static readonly Fractal Infinite = Samples.Repeated(null, First, Samples.MoveAndScale(30, 0, 0, 0.5));

    /// <summary>The rows of the paper's Figure 9: a queue of three, from no transformation to four.</summary>
    [Fact]
    public void Update_DeeperAndDeeper_FillsTheQueueAsInFigure9()
    {
        var m = AffineMap.Translate(new(1, 2, 3));
        var t = First.ToAffineMap();
        AffineMap[] chain = [m, m * t, m * t * t, m * t * t * t, m * t * t * t * t];
        AffineMap[][] rows =
        [
            [m, m, m],
            [m, m, chain[1]],
            [m, chain[1], chain[2]],
            [chain[1], chain[2], chain[3]],
            [chain[2], chain[3], chain[4]],
        ];
        for (var depth = 0; depth < rows.Length; depth++)
        {
            var fractal = depth == 0 ? Samples.Repeated(0, First) : Infinite.WithDepth(depth);
            var trail = new FractalTrail(fractal, 3);
            // The position of the deepest matrix is within all radii: only the depth ends the search.
            Assert.Equal(rows[depth][0], trail.Update(m, chain[depth].Translation));
            Assert.Equal(depth, trail.Depth);
            Assert.Equal(rows[depth], trail.Queue);
        }
    }

    [Fact]
    public void Update_OfSetsThatDiffer_TakesThatOfEachLevel()
    {
        var fractal = Samples.Repeated(5, Samples.MoveAndScale(0, 0, 0, 0.5)).Apply([Samples.Move(3, 0, 0)]);
        var trail = new FractalTrail(fractal, 1);
        var expected = new AffineMap(Matrix.Diagonal(Vector.One / 32), new(3, 0, 0));
        Assert.Equal(expected, trail.Update(AffineMap.Identity, new(3, 0, 0)));
        Assert.Equal(6, trail.Depth);
    }

    [Fact]
    public void Update_FarFromEverything_IsTheObjectsOwnMatrix()
    {
        var m = AffineMap.Translate(new(1, 2, 3));
        var trail = new FractalTrail(Infinite, 1);
        Assert.Equal(m, trail.Update(m, new(500, 0, 0)));
        Assert.Equal(0, trail.Depth);
    }

    [Theory]
    [InlineData(1, 4)]
    [InlineData(2, 3)]
    [InlineData(5, 0)]
    public void Update_WithAQueue_DrawsWhatIsFurtherOut(int length, int drawn)
    {
        var t = First.ToAffineMap();
        var chain = Enumerable.Repeat(t, drawn).Aggregate(AffineMap.Identity, (map, next) => map * next);
        var target = Enumerable.Repeat(t, 4).Aggregate(AffineMap.Identity, (map, next) => map * next).Translation;
        Assert.Equal(chain, new FractalTrail(Infinite.WithDepth(4), length).Update(AffineMap.Identity, target));
    }

    [Fact]
    public void Update_WithIdentitiesAndInfiniteDepth_Ends()
    {
        var fractal = Samples.Repeated(null, Transformation.Identity, First);
        var trail = new FractalTrail(fractal, 3);
        trail.Update(AffineMap.Identity, new(0.4, 0, 0));
        Assert.InRange(trail.Depth, 40, FractalTrail.MaxDepth);
    }
}
