using FractalEngine.Core.Approximation;
using FractalEngine.Core.Approximation.Damaged;
using FractalEngine.Core.Approximation.Damaged.Placements;
using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Approximation;

/// <summary>Elements whose noise hides how they lie, and sets that are rows of noisy maps.</summary>
public sealed class NoisyElementsTests
{
    private const double Noise = 0.001;

    private static readonly Vector SmallCentre = new(3, 0.4, 0.2);

    // A quarter turn that takes the tip of the octahedron to a vertex at its side.
    private static readonly Matrix Turn = new(new(0, 1, 0), new(-1, 0, 0), new(0, 0, 1));

    [Fact]
    public void CountSymmetries_OfANearlyRegularElement_FallsWithItsSize()
    {
        var template = Assert.Single(Model().Templates);
        // The tip is a twentieth too far out: turns and mirrors about it are left, unless noise is as large.
        Assert.Equal(8, template.CountSymmetries(0.5));
        Assert.Equal(48, template.CountSymmetries(0.01));
    }

    [Fact]
    public void Match_OfATurnedElement_FindsItWhereNoiseHidesTheTurn()
    {
        var set = new NoisyElements(Model(), 0.02, default);
        Assert.Equal(2, set.Count);
        Assert.Equal(-1, set.Match(About(set.Elements[0].Shape.Centroid), 0));
        Assert.Equal(1, set.Match(About(set.Elements[1].Shape.Centroid), 1));
        Assert.Equal(0, set.Match(AffineMap.Identity, 0));

        static AffineMap About(Vector centre) => new(Turn, centre - (Turn * centre));
    }

    [Theory]
    [InlineData(0)]
    [InlineData(2)]
    [InlineData(4)]
    public void Of_ARowInWhichTheIdentityStandsAnywhere_SplitsItIntoPowers(int before)
    {
        var step = new AffineMap(Matrix.Rotation(Vector.K, 0.3), new(0.2, 0.1, 0.4));
        var other = new AffineMap(Matrix.Identity, new(0, 7, 1));
        var random = new Random(3);
        var powers = Enumerable.Range(-before, 5).Where(power => power != 0).Select(step.Power).Prepend(AffineMap.Identity).ToArray();
        var maps = powers.SelectMany(power => new[] { power, power * other }).Select((map, index) => index == 0 ? map
            : map with { Translation = map.Translation + (1e-4 * new Vector(random.NextDouble(), random.NextDouble(), 0)) }).ToList();
        var set = new ExactElements(ElementFinder.Find(Mesh(), weldPositions: false), 1e-7, default);
        var hypothesis = Hypothesis.Of(new ElementGrammar(set, [new MapFactor(maps, [AffineMap.Identity], [0])], [0], null), 20);
        Assert.Equal([5, 2], hypothesis.Sets.Select(row => row.Count));
        Assert.All(hypothesis.Sets, row => Assert.Equal(AffineMap.Identity, row[0]));
        Assert.All(hypothesis.Words(), word => Assert.Contains(maps, map => MapRows.AreNear(map, word.Map, 1e-3, 1)));
    }

    private static DamagedModel Model() => DamagedModel.Create(Mesh(), Noise, default);

    private static Mesh Mesh()
    {
        Vector[] octahedron = [new(1.1, 0, 0), new(-1, 0, 0), new(0, 1, 0), new(0, -1, 0), new(0, 0, 1), new(0, 0, -1)];
        int[] corners = [0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5];
        Vector[] points = [.. octahedron, .. octahedron.Select(point => SmallCentre + (0.02 * point))];
        return new(
            [.. points.SelectMany(point => new[] { point.X, point.Y, point.Z })], [.. corners, .. corners.Select(corner => corner + 6)]);
    }
}
