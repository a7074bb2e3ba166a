using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Colliders;

namespace FractalEngine.Tests.Benchmarks;

public class QueryPositionsTests
{
    private const int Positions = 1000;

    private static readonly BoundingBox Box = new(new(-3, 5, 100), new(4, 5.5, 102));
    private static readonly Mesh Soup = CollisionMeshes.TriangleSoup(1, 50, 0.5);
    private static readonly Fractal Sponge = FractalCase.Load("sierpinski", 2).Fractal;

    [Fact]
    public void Uniform_IsInTheBoxAndEverywhereInIt()
    {
        var positions = Generate(random => QueryPositions.Uniform(random, Box));
        Assert.All(positions, position => Assert.Equal(0, Box.DistanceSquared(position)));
        AssertInAllOctants(positions, Box.Centre);
    }

    [Fact]
    public void NearSurface_OfAMesh_IsUpToOnePercentAwayAlongEachAxis() =>
        AssertNear(Generate(random => QueryPositions.NearSurface(random, Soup)), Soup);

    [Fact]
    public void NearSurface_OfAFractal_IsUpToOnePercentAwayAlongEachAxis() =>
        AssertNear(Generate(random => QueryPositions.NearSurface(random, Sponge)), FractalGenerator.Flatten(Sponge, 10_000));

    [Fact]
    public void OnSurface_OfAFractal_IsOnAFaceOfEveryInstance()
    {
        var mesh = FractalGenerator.Flatten(Sponge, 10_000);
        var (simple, context, instances) = (new SimpleCollider(mesh), new QueryContext(), new HashSet<int>());
        foreach (var position in Generate(random => QueryPositions.OnSurface(random, Sponge)))
        {
            simple.TryFindClosest(position, double.PositiveInfinity, context, out var closest);
            // Rounding of a few coordinates.
            Assert.InRange(closest.Distance, 0, 1e-14 * mesh.Bounds.Diagonal);
            instances.Add(closest.FaceIndex / Sponge.BaseMesh.FaceCount);
        }

        Assert.Equal(49, instances.Count);
    }

    [Fact]
    public void OnSurface_OfADeepFractal_EndsWhereCoordinatesDo()
    {
        var deep = FractalCase.Load("sierpinski", 1_000_000).Fractal;
        Assert.All(Generate(random => QueryPositions.OnSurface(random, deep)),
            position => Assert.InRange(deep.Bounds.DistanceSquared(position), 0, 1e-20 * deep.Bounds.Diagonal));
    }

    [Fact]
    public void Far_IsAtLeastHalfADiagonalAwayToAllSides()
    {
        var positions = Generate(random => QueryPositions.Far(random, Box));
        Assert.All(positions, position =>
        {
            Assert.InRange((position - Box.Centre).Length() / Box.Diagonal, 1 - 1e-12, 1.5 + 1e-12);
            Assert.True(Math.Sqrt(Box.DistanceSquared(position)) >= (0.5 - 1e-12) * Box.Diagonal);
        });
        AssertInAllOctants(positions, Box.Centre);
    }

    [Fact]
    public void Positions_OfOneSeed_AreTheSame()
    {
        foreach (var make in (Func<Random, Vector>[])
        [
            random => QueryPositions.Uniform(random, Box), random => QueryPositions.Far(random, Box),
            random => QueryPositions.NearSurface(random, Soup), random => QueryPositions.NearSurface(random, Sponge),
        ])
        {
            Assert.Equal(Generate(make), Generate(make));
            Assert.Empty(Generate(make).Intersect(Generate(make, seed: 2)));
        }
    }

    private static Vector[] Generate(Func<Random, Vector> createPosition, int seed = 1)
    {
        var random = new Random(seed);
        return [.. Enumerable.Range(0, Positions).Select(_ => createPosition(random))];
    }

    private static void AssertNear(Vector[] positions, Mesh mesh)
    {
        var (simple, context) = (new SimpleCollider(mesh), new QueryContext());
        var maxOffset = 0.01 * mesh.Bounds.Diagonal;
        var distances = positions.Select(position => simple.ClosestDistance(position, context)).ToArray();
        // A cube's corner is the farthest from its centre. Positions that are all on the surface, or all far, are not near.
        Assert.All(distances, distance => Assert.InRange(distance, 0, 1.7320508075688774 * maxOffset));
        Assert.InRange(distances.Average(), 0.1 * maxOffset, maxOffset);
    }

    private static void AssertInAllOctants(Vector[] positions, Vector centre)
    {
        var octants = positions.Select(position => position - centre).GroupBy(v => (v.X > 0, v.Y > 0, v.Z > 0))
            .Select(group => group.Count()).ToArray();
        Assert.Equal(8, octants.Length);
        // Each has 125 of 1000 on average, with a deviation of 10.
        Assert.All(octants, count => Assert.InRange(count, 85, 165));
    }
}
