using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Approximation;

/// <summary>Finds the map that takes one level of a recursion to the next one.</summary>
public sealed class ConjugationTests
{
    private static readonly List<AffineMap> From =
    [
        AffineMap.Identity, new(0.5 * Matrix.Rotation(Vector.J, 1), new(1, 0, 0)), new(Matrix.Rotation(Vector.I, 2), new(0, 3, 0)),
        new(0.25 * Matrix.Rotation(Vector.K, -1), new(0, 0.5, 2)),
    ];

    [Fact]
    public void Find_OfGeneralMaps_FindsTheOnlyOne()
    {
        var map = new AffineMap(0.4 * Matrix.Rotation(new Vector(1, 2, 3).UnitVector(), 0.7), new(0.2, -0.3, 0.9));
        var to = From.ConvertAll(inner => map * inner * map.Inverse());
        to.Reverse(1, 3);
        var found = Assert.NotNull(Find(From, to));
        // A conjugation leaves the scale free where maps have a common fixed point only, so that these differ in nothing.
        Assert.True(MapRows.AreNear(map, found, 1e-9, 1), $"{map} {found}");
    }

    [Fact]
    public void Find_OfTranslationsInAPlane_TakesTheUniformScale()
    {
        List<AffineMap> from = [AffineMap.Identity, AffineMap.Translate(new(1, 0, 0)), AffineMap.Translate(new(0, 1, 0))];
        List<AffineMap> to = [AffineMap.Identity, AffineMap.Translate(new(0.5, 0, 0)), AffineMap.Translate(new(0, 0.5, 0))];
        var found = Assert.NotNull(Find(from, to));
        Assert.True((found.Linear - (0.5 * Matrix.Identity)).MaxAbsEntry() < 1e-9, found.ToString());
    }

    [Fact]
    public void Find_OfOtherMaps_FindsNone()
    {
        var to = From.ConvertAll(inner => inner);
        to[2] = new(1.01 * to[2].Linear, to[2].Translation);
        Assert.Null(Find(From, to));
    }

    [Fact]
    public void Find_ThroughASymmetry_FindsTheMap()
    {
        var map = new AffineMap(0.4 * Matrix.Identity, new(0.2, -0.3, 0.9));
        var mirror = new AffineMap(Matrix.Diagonal(new(1, 1, -1)), new(0, 0, 0.1));
        var to = From.ConvertAll(inner => map * inner * map.Inverse());
        to[1] *= mirror;
        Assert.Null(Find(From, to));
        Assert.NotNull(Conjugation.Find(From, new(to, [AffineMap.Identity, mirror], []), []));
    }

    private static AffineMap? Find(List<AffineMap> from, List<AffineMap> to) =>
        Conjugation.Find(from, new(to, [AffineMap.Identity], []), []);
}
