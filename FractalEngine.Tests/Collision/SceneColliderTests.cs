using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Collision;

/// <summary>Queries on whole scenes, against every face of every object in world space.</summary>
public class SceneColliderTests
{
    [Fact]
    public void Find_OnRandomScenes_EqualsEveryFace() => Seeded.Run(60, random =>
    {
        var scene = Scene(random);
        var collider = new SceneCollider(scene);
        var oracles = scene.Objects.Select(placed => new SimpleCollider(FlattenInWorld(placed))).ToArray();
        for (var query = 0; query < 10; query++)
        {
            var position = random.Vector(6);
            var except = random.Next(-1, scene.Objects.Length);
            var nearest = oracles.Select((oracle, index) => index != except
                && oracle.TryFindClosest(position, double.PositiveInfinity, new(), out var closest)
                ? closest.Distance : double.PositiveInfinity).Min();
            var found = collider.TryFindClosest(position, double.PositiveInfinity, new(), out var answer, out var index, except);
            Assert.Equal(!double.IsPositiveInfinity(nearest), found);
            if (found)
            {
                // Rounded to the last places of the coordinates of a scene of some units, through a chain of a few maps.
                Assert.Equal(nearest, answer.Distance, 1e-12 * 20);
                Assert.Equal(answer.Distance, (answer.Point - position).Length(), 1e-12 * 20);
                Assert.NotEqual(except, index);
                Assert.Equal(1, answer.Normal.Length(), 1e-12);
            }
        }
    });

    [Fact]
    public void Find_NamesTheNearestObjectAndItsInstance()
    {
        var model =
            new FractalModel(Samples.Repeated(2, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(5, 0, 0, 0.5))) { SourcePath = "/f.fdo" };
        var scene = new LoadedScene(new(),
        [
            new(new("f.fdo", Samples.Move(0, 0, 0)), model),
            new(new("f.fdo", Samples.Move(0, 40, 0)), model),
        ]);
        var record = new QueryContext();
        // Instance 1 at both levels starts at 5 + ½·5.
        Assert.True(new SceneCollider(scene).TryFindClosest(new(7.5, 40, 0), double.PositiveInfinity, record, out var closest,
            out var index));
        Assert.Equal((0.0, 1), (closest.Distance, index));
        Assert.Equal([1, 1], record.InstancePath.ToArray());
    }

    [Fact]
    public void Find_InAnEmptyScene_FindsNothing() =>
        Assert.False(new SceneCollider(new Scene()).TryFindClosest(Vector.Zero, double.PositiveInfinity, new(), out _, out _));

    [Fact]
    public void Find_WithTheGreedyColliderOnAMesh_SaysWhichFit()
    {
        var scene = new LoadedScene(new(), [new(new("m.obj", Transformation.Identity), new MeshModel(Samples.Tetrahedron) { SourcePath = "/m.obj" })]);
        Assert.Contains("expected exact, hierarchy",
            Assert.Throws<ColliderMismatchException>(() => new SceneCollider(scene, ColliderKind.Fractal).Build()).Message,
            StringComparison.Ordinal);
    }

    private static LoadedScene Scene(Random random)
    {
        Model[] models =
        [
            new MeshModel(Samples.Tetrahedron) { SourcePath = "/mesh.obj" },
            new FractalModel(RandomFractals.Draw(random)) { SourcePath = "/fractal.fdo" },
            new FractalModel(RandomFractals.Draw(random, Composition.Componentwise)) { SourcePath = "/sums.fdo" },
        ];
        return new(new(),
            [.. Enumerable.Range(0, 5)
            .Select(i => new PlacedModel(new($"{i}.fdo", Placement(random)), models[random.Next(models.Length)]))]);
    }

    /// <summary>Similar, mirrored or skewing.</summary>
    private static Transformation Placement(Random random) => random.Next(2) == 0 ? random.Transformation()
        : new(random.Vector(4), random.Degrees(), random.Between(0.3, 2) * (random.Next(2) == 0 ? Vector.One : new(-1, 1, 1)));

    private static Core.Geometry.Mesh FlattenInWorld(PlacedModel placed) => FractalGenerator.Flatten(
        placed.Model.Mesh,
        placed.Model is FractalModel { Fractal: var fractal }
            ? [.. FractalGenerator.Expand(fractal, 1_000_000).Select(map => placed.ObjectToWorld * map)]
            : [placed.ObjectToWorld]);
}
