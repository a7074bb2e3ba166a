using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Robustness;

/// <summary>Queries under maps, and of objects that move, at the end of the range of a double end, with an answer or a refusal.</summary>
public sealed class TransformedRangeTests
{
    private static readonly ColliderKind[] MeshKinds = [ColliderKind.Simple, ColliderKind.Hierarchy, ColliderKind.Exact];

    [Theory]
    [InlineData(double.PositiveInfinity)]
    [InlineData(double.NegativeInfinity)]
    [InlineData(double.NaN)]
    public void FindClosestTransformed_OfANumberThatIsNone_Refuses(double coordinate) => Assert.All(
        Colliders(1),
        collider => Assert.Throws<ArgumentOutOfRangeException>(() => Find(collider, new(0, coordinate, 1), AffineMap.Identity)));

    [Theory]
    [InlineData(double.PositiveInfinity)]
    [InlineData(double.NaN)]
    public void FindClosestTransformed_UnderAMapThatIsNone_Refuses(double entry)
    {
        AffineMap[] maps =
        [
            new(AffineMap.Identity.Linear, new(entry, 0, 0)), new(entry * AffineMap.Identity.Linear, Vector.Zero),
        ];
        Assert.All(
            from collider in Colliders(1)
            from map in maps
            select (collider, map),
            query => Assert.Throws<FractalLimitException>(() => Find(query.collider, Vector.One, query.map)));
    }

    /// <summary>Units that make one factor small enough may leave the product too large, or make another one infinite.</summary>
    [Fact]
    public void FindClosestTransformed_OfExtremeShapesMapsAndPositions_EndsWithAnAnswerOrARefusal()
    {
        double[] numbers = [0, 1e-320, 1e-300, 1e-200, 1, 1e200, 1e300, double.MaxValue];
        var answers = 0;
        foreach (var size in numbers[1..])
        {
            foreach (var collider in Colliders(size))
            {
                foreach (var (scale, shift) in numbers[1..].SelectMany(scale => numbers.Select(shift => (scale, shift))))
                {
                    foreach (var coordinate in numbers)
                    {
                        AffineMap map = new(scale * Matrix.Identity, new(-shift, shift, shift));
                        try
                        {
                            _ = Find(collider, new(coordinate, -coordinate, coordinate), map);
                            answers++;
                        }
                        catch (Exception exception) when (exception is FractalLimitException or SingularMatrixException)
                        {
                            // A placement beyond the range, or one whose determinant is too small for a double.
                        }
                    }
                }
            }
        }

        Assert.True(answers > 5000, $"{answers} answers");
    }

    [Fact]
    public void World_WithABodyBeyondTheRangeOfAnObjectThatTurns_RefusesBoth()
    {
        var cube = new SceneObject(Shapes.Cube()) { Placement = Samples.Move(-2, 0.5, 0), Motion = new() { Spin = new(0, 20, 0) } };
        var world = new PhysicsWorld(new Scene { Objects = [cube] });
        _ = world.Add(new(new(0, 0, 1e308), 0.7) { Name = "far" });
        var exception = Assert.Throws<FractalEngineException>(() => PhysicsLimits.RequireRange(world));
        Assert.Equal("the position of body far is beyond the limit of 1e150 of physics", exception.Message);
        world.Step();
        Assert.All(
            (Vector[])[new(0, 0, 1e308), double.MaxValue * Vector.One, new(double.MaxValue, 0, -double.MaxValue)],
            position => AssertRefuses(() => world.TryFindClosest(position, ColliderKind.Exact, out _)));
    }

    [Theory]
    [InlineData(1e150, true)]
    [InlineData(1e151, false)]
    public void RequireRange_OfAnObjectThatTurnsFarAway_NamesIt(double coordinate, bool isAccepted)
    {
        var cube = new SceneObject(Shapes.Cube())
        {
            Name = "mill", Placement = Samples.Move(0, coordinate, 0), Motion = new() { Spin = new(0, 20, 0) },
        };
        var exception = Record.Exception(() => PhysicsLimits.RequireRange(LoadedScene.Of(new Scene { Objects = [cube] })));
        Assert.Equal(isAccepted ? null : "the position of mill is beyond the limit of 1e150 of physics", exception?.Message);
    }

    private static void AssertRefuses(Func<bool> query)
    {
        try
        {
            _ = query();
        }
        catch (Exception exception) when (exception is ArgumentOutOfRangeException or FractalLimitException)
        {
            // Where the turned position is still a double, so may the distance be.
        }
    }

    private static IEnumerable<Collider> Colliders(double size)
    {
        var mesh = Shapes.Cube().Transform(v => size * v);
        var fractal = Fractal.Of(mesh).Repeat([Samples.MoveAndScale(0, 0, 0, 0.5)], 2);
        return [.. MeshKinds.Select(kind => Collider.For(mesh, kind)), Collider.For(fractal)];
    }

    private static ClosestPoint Find(Collider collider, Vector position, AffineMap map)
    {
        _ = collider.FindClosestTransformed(position, map, double.PositiveInfinity, 0, new(), out var closest);
        return closest;
    }
}
