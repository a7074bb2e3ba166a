using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.SceneQueries;

/// <summary>Queries on whole scenes against every face of every object in world space.</summary>
public class SceneColliderTests
{
    [Fact]
    public void TryFindClosest_OnRandomScenes_EqualsEveryFace() => Seeded.Run(60, random =>
    {
        var scene = RandomScene(random);
        var collider = new SceneCollider(scene);
        var oracles = scene.Objects.Select(placed => new SimpleCollider(FlattenInWorld(placed))).ToArray();
        for (var query = 0; query < 10; query++)
        {
            var position = random.Vector(6);
            var excludedObject = random.Next(-1, scene.Objects.Length);
            var expected = oracles.Select((oracle, index) => index != excludedObject
                && oracle.TryFindClosest(position, double.PositiveInfinity, new(), out var closest)
                ? closest.Distance : double.PositiveInfinity).Min();
            var found = collider.TryFindClosest(position, double.PositiveInfinity, new(), out var actual, out var index, excludedObject);
            Assert.Equal(!double.IsPositiveInfinity(expected), found);
            if (found)
            {
                // Coordinates of a scene of some units are rounded in their last places, through a chain of a few maps.
                Assert.Equal(expected, actual.Distance, 1e-12 * 20);
                Assert.Equal(actual.Distance, (actual.Point - position).Length(), 1e-12 * 20);
                Assert.NotEqual(excludedObject, index);
                Assert.Equal(1, actual.Normal.Length(), 1e-12);
            }
        }
    });

    [Fact]
    public void TryFindClosest_NamesTheClosestObjectAndItsInstance()
    {
        var fractal = Samples.Repeated(2, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(5, 0, 0, 0.5));
        var model = new FractalModel(fractal) { SourcePath = "/f.fdo" };
        var scene = new LoadedScene(new(),
        [
            new(new("f.fdo", Samples.Move(0, 0, 0)), model),
            new(new("f.fdo", Samples.Move(0, 40, 0)), model),
        ]);
        var context = new QueryContext();
        // Instance 1 at both levels starts at 5 + ½·5.
        Assert.True(new SceneCollider(scene).TryFindClosest(new(7.5, 40, 0), double.PositiveInfinity, context, out var closest,
            out var index));
        Assert.Equal((0.0, 1), (closest.Distance, index));
        Assert.Equal([1, 1], context.InstancePath.ToArray());
        Assert.False(new SceneCollider(scene).TryFindClosest(new(0, 1e6, 0), 1, context, out _, out index));
        Assert.Equal((0, -1), (context.InstancePath.Length, index));
    }

    /// <summary>The box of the second object comes nearer than the point of the first one, its faces do not.</summary>
    [Fact]
    public void FindClosest_NamesTheMeshOfTheClosestObject_WhateverWasTestedAfterIt()
    {
        var fractal = Fractal.Of(Shapes.Cube()) + Fractal.Of(Samples.Tetrahedron).Apply([Samples.Move(6, 0, 0)]);
        var diagonal = new Vector(0, 0, -45);
        var first = new Scene { Objects = [new(fractal) { Placement = new(Vector.Zero, diagonal, Vector.One) }] };
        var both = new Scene { Objects = [first.Objects[0], new(fractal) { Placement = new(new(4.5, 3, 0), diagonal, Vector.One) }] };
        var position = new Vector(3.5, 4.2, 0);
        var expected = new SceneCollider(first).FindClosest(position);
        Assert.Equal(1, expected.MeshIndex);
        Assert.Equal(expected, new SceneCollider(both).FindClosest(position));
    }

    [Fact]
    public void TryFindClosest_InAnEmptyScene_FindsNothing() =>
        Assert.False(new SceneCollider(new Scene()).TryFindClosest(Vector.Zero, double.PositiveInfinity, new(), out _, out _));

    [Fact]
    public void Build_WithTheFractalColliderOnAMesh_SaysWhichFit()
    {
        var model = new MeshModel(Samples.Tetrahedron) { SourcePath = "/m.obj" };
        var scene = new LoadedScene(new(), [new(new("m.obj", Transformation.Identity), model)]);
        var error = Assert.Throws<ColliderMismatchException>(() => new SceneCollider(scene, ColliderKind.Fractal).Build());
        Assert.Contains("expected exact, hierarchy", error.Message, StringComparison.Ordinal);
    }

    // The paper's car on a fractal terrain (§4.4.3): its descent takes the fractal, and the hierarchy the mesh, wherever they stand.
    [Theory]
    [InlineData(1, 1)]
    [InlineData(1, 0.5)]
    public void FindClosest_WithTheFractalColliderBesideAMesh_FindsTheMeshExactly(double width, double height)
    {
        var placement = new Transformation(new(50, 0, 0), new(0, 30, 0), new(width, height, 1));
        var mesh = new MeshModel(Samples.Tetrahedron) { SourcePath = "/m.obj" };
        var fractal = new FractalModel(Samples.AppendixBAt(2)) { SourcePath = "/f.fdo" };
        var scene = new LoadedScene(new(), [new(new("m.obj", placement), mesh), new(new("f.fdo", Transformation.Identity), fractal)]);
        var collider = new SceneCollider(scene, ColliderKind.Fractal);
        var exact = new SceneCollider(scene);
        collider.Build();
        Seeded.Run(50, random =>
        {
            var position = new Vector(50, 0, 0) + random.Vector(3);
            Assert.Equal(exact.FindClosest(position), collider.FindClosest(position));
        });
        var moved = collider.WithObject(0, new(new("m.obj", placement with { Position = new(70, 0, 0) }), mesh));
        Assert.Equal(0, moved.FindClosest(new(70, 0, 0)).ObjectIndex);
        // Skewed anew, so that its collider is made anew.
        var skewed = collider.WithObject(0, new(new("m.obj", placement with { Scale = new(width, 0.3, 2) }), mesh));
        Assert.Equal(0, skewed.FindClosest(new(50, 0, 0)).ObjectIndex);
        var skewedAgain = moved.WithObject(0, new(new("m.obj", placement with { Scale = new(width, 0.3, 2) }), mesh));
        Assert.Equal(skewed.FindClosest(new(50, 0, 0)), skewedAgain.FindClosest(new(50, 0, 0)));
    }

    private static LoadedScene RandomScene(Random random)
    {
        Model[] models =
        [
            new MeshModel(Samples.Tetrahedron) { SourcePath = "/mesh.obj" },
            new FractalModel(RandomFractals.CreateAny(random)) { SourcePath = "/fractal.fdo" },
            new FractalModel(RandomFractals.Create(random, Composition.Componentwise)) { SourcePath = "/sums.fdo" },
        ];
        var objects = Enumerable.Range(0, 5)
            .Select(i => new PlacedModel(new($"{i}.fdo", RandomPlacement(random)), models[random.Next(models.Length)]));
        return new(new(), [.. objects]);
    }

    /// <summary>Draws a placement that is a similarity, a mirror or skews.</summary>
    private static Transformation RandomPlacement(Random random) => random.Next(2) == 0 ? random.Transformation()
        : new(random.Vector(4), random.Degrees(), random.Between(0.3, 2) * (random.Next(2) == 0 ? Vector.One : new(-1, 1, 1)));

    private static Core.Geometry.Mesh FlattenInWorld(PlacedModel placed) => FractalGenerator.Flatten(
        placed.Model.Mesh,
        placed.Model is FractalModel { Fractal: var fractal }
            ? [.. FractalGenerator.Expand(fractal, 1_000_000).Select(map => placed.ObjectToWorld * map)]
            : [placed.ObjectToWorld]);
}
