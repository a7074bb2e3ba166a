using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Approximation;

/// <summary>Finds powers of one map in sets of maps.</summary>
public sealed class MapRowsTests
{
    [Fact]
    public void Find_OfARowTimesTwoMaps_SplitsTheRowOff()
    {
        var step = new AffineMap(0.9 * Matrix.Rotation(Vector.J, 0.3), new(0, 1, 0));
        AffineMap[] others = [AffineMap.Identity, new(0.5 * Matrix.Rotation(Vector.K, 1), new(2, 0, 0))];
        var maps = Enumerable.Range(0, 5).SelectMany(power => others.Select(other => step.Power(power) * other)).Reverse().ToArray();
        var row = Assert.NotNull(MapRows.Find(maps, 1e-9, 1));
        Assert.Equal((5, 2), (row.Count, row.Others.Count));
    }

    [Fact]
    public void Find_OfUnrelatedMaps_FindsNone() => Assert.Null(MapRows.Find(
        [AffineMap.Identity, AffineMap.Translate(new(1, 0, 0)), AffineMap.Translate(new(0, 1, 0))], 1e-9, 1));
}
