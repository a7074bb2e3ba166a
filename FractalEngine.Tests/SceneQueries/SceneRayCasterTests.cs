using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Physics;
using FractalEngine.Tests.Queries.Regions;
using FractalEngine.Tests.Rays;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.SceneQueries;

/// <summary>Tests rays at whole scenes against every face of every object in world space.</summary>
public class SceneRayCasterTests
{
    private const int RaysPerScene = 40;

    [Fact]
    public void TryFindNearest_OnRandomScenes_EqualsEveryFace() => CheckAll(1, 60);

    [Fact]
    [Trait("Category", "Soak")]
    public void TryFindNearest_OnManyRandomScenes_EqualsEveryFace() => CheckAll(1_000_000, 20_000);

    [Fact]
    public void WithObjectAndWithScene_OfAnObjectThatMoves_EqualTheSceneMadeAnew()
    {
        var different = 0;
        Seeded.Run(30, random => different += CountDifferences(random));
        Assert.InRange(different, 10, 30 * 200);
    }

    [Fact]
    public void WithObject_OfManyObjectsThatChangePlaces_StaysAsFastAsTheSceneMadeAnew()
    {
        // Each goes to the other end of a row: boxes of what was near would then be as long as the row.
        const int Count = 256;
        var model = Model.Of(Samples.Tetrahedron);
        var places = Enumerable.Range(0, Count).Select(i => (i * 97) % Count).ToArray();
        SceneObject At(int place) => new(model) { Placement = Samples.Move(2 * place, 0, 0) };
        var caster = new SceneRayCaster(new Scene { Objects = [.. Enumerable.Range(0, Count).Select(At)] });
        for (var i = 0; i < Count; i++)
        {
            caster = caster.WithObject(i, new(At(places[i]), model));
        }

        var anew = new SceneRayCaster(new Scene { Objects = [.. places.Select(At)] });
        var (moved, built) = (new QueryContext(), new QueryContext());
        Seeded.Run(200, random =>
        {
            var ray = new Ray(new(random.Between(0, 2 * Count), 0.1, -2), new(random.Between(-0.1, 0.1), 0, 1));
            var isHit = anew.TryFindNearest(ray, built, out var expected, out var expectedIndex);
            Assert.Equal(isHit, caster.TryFindNearest(ray, moved, out var hit, out var index));
            Assert.Equal((expectedIndex, expected), (index, hit));
        });
        Assert.InRange(moved.Statistics.BoundTests, 1, 3 * built.Statistics.BoundTests);
    }

    [Fact]
    public void WithObject_OfWrongArguments_IsRefused()
    {
        var scene = LoadedScene.Of(new Scene { Objects = [new(Samples.Tetrahedron)] });
        var caster = new SceneRayCaster(scene);
        var placed = scene.Objects[0];
        Assert.Throws<ArgumentOutOfRangeException>(() => caster.WithObject(1, placed));
        Assert.Throws<ArgumentOutOfRangeException>(() => caster.WithObject(-1, placed));
        var error = Assert.Throws<ArgumentException>("placed", () => caster.WithObject(0, new(new SceneObject(Samples.Triangle))));
        Assert.StartsWith("expected the model of an object of the scene", error.Message, StringComparison.Ordinal);
        var flat = new SceneObject(placed.Model) { Placement = Transformation.Identity with { Scale = new(1, 0, 1) } };
        Assert.Throws<SingularMatrixException>(() => caster.WithObject(0, new(flat, placed.Model)));
        Assert.Throws<SingularMatrixException>(() => caster.WithScene(scene with { Objects = [new(flat, placed.Model)] }));
    }

    [Fact]
    public void TryFindNearest_NamesTheObjectAndItsInstance()
    {
        var fractal = Samples.Repeated(2, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(5, 0, 0, 0.5));
        SceneObject[] objects = [new(fractal), new(fractal) { Placement = Samples.Move(0, 40, 0) }];
        var caster = new SceneRayCaster(new Scene { Objects = [.. objects] });
        var context = new QueryContext();
        // Instance 1 at both levels starts at 5 + ½·5.
        Assert.True(caster.TryFindNearest(new(new(7.55, 40.05, -2), Vector.K), context, out var hit, out var index));
        Assert.Equal((2.0, 1, 0), (hit.Distance, index, hit.FaceIndex));
        Assert.Equal([1, 1], context.InstancePath.ToArray());
        Assert.Equal(-Vector.K, hit.Normal);
        Assert.True(hit.IsFrontFace);
        Assert.False(caster.TryFindNearest(new(new(7.55, 20, -2), Vector.K), context, out _, out index));
        Assert.Equal(-1, index);
    }

    [Fact]
    public void TryFindNearest_OfADeepObjectBehindAnother_FindsTheNearest()
    {
        var deep = Samples.Repeated(1_000_000, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.5));
        SceneObject[] objects = [new(deep), new(Samples.Tetrahedron) { Placement = Samples.Move(0.2, 0.05, -3) }];
        var caster = new SceneRayCaster(new Scene { Objects = [.. objects] });
        Assert.True(caster.TryFindNearest(new(new(0.3, 0.1, -9), Vector.K), new(), out var hit, out var index));
        Assert.Equal((6.0, 1), (hit.Distance, index));
    }

    /// <summary>A scale by a power of two changes no digit of what rays hit, and no cost: levels end in the object's own size.</summary>
    [Theory]
    [InlineData(-60)]
    [InlineData(-40)]
    [InlineData(-20)]
    [InlineData(40)]
    public void TryFindNearest_OfAnObjectOfAnotherSize_IsTheSame(int exponent)
    {
        var scale = Math.ScaleB(1, exponent);
        var fractal = PhysicsMeshes.CreateSponge(12);
        SceneRayCaster Of(double size) => new(LoadedScene.Of(new()
        {
            Objects = [new SceneObject(fractal) { Placement = Transformation.Identity with { Scale = size * Vector.One } }],
        }));
        var (plain, scaled) = (Of(1), Of(scale));
        var (context, scaledContext) = (new QueryContext(), new QueryContext());
        var hits = 0;
        var reach = fractal.Bounds.Maximum.MaxAbsComponent();
        Seeded.Run(200, random =>
        {
            var origin = 3 * reach * random.Direction();
            var direction = (reach * random.Vector()) - origin;
            var isHit = plain.TryFindNearest(new(origin, direction), context, out var hit, out _);
            Assert.Equal(isHit, scaled.TryFindNearest(new(scale * origin, direction), scaledContext, out var scaledHit, out _));
            if (isHit)
            {
                hits++;
                Assert.Equal((scale * hit.Distance, hit.FaceIndex), (scaledHit.Distance, scaledHit.FaceIndex));
                Assert.Equal(context.InstancePath, scaledContext.InstancePath);
            }
        });
        Assert.InRange(hits, 20, 200);
        var (costs, scaledCosts) = (context.Statistics, scaledContext.Statistics);
        Assert.Equal((costs.BoundTests, costs.FaceTests), (scaledCosts.BoundTests, scaledCosts.FaceTests));
    }

    /// <summary>A search that has stopped early leaves nothing to the next one with its context.</summary>
    [Fact]
    public void TryFindNearest_AfterASearchThatStopped_FindsWhatANewContextFinds()
    {
        SceneObject At(double x, double y, double z) => new(Shapes.Cube()) { Placement = Samples.MoveAndScale(x, y, z, 0.8) };
        var random = new Random(4);
        var many = new SceneRayCaster(LoadedScene.Of(new()
        {
            Objects = [.. Enumerable.Range(0, 60).Select(_ => At(random.Next(-5, 6), random.Next(-5, 6), random.Next(-5, 6)))],
        }));
        var one = new SceneRayCaster(LoadedScene.Of(new() { Objects = [At(0, 0, 40), At(0, 40, 0), At(40, 0, 0)] }));
        var context = new QueryContext();
        Seeded.Run(300, turn =>
        {
            var origin = 12 * turn.Direction();
            var ray = new Ray(origin, turn.Vector(3) - origin);
            many.HitsAny(ray, context);
            foreach (var caster in (SceneRayCaster[])[one, many])
            {
                var isFound = caster.TryFindNearest(ray, context, out var hit, out var index);
                Assert.Equal(isFound, caster.TryFindNearest(ray, new(), out var expected, out var expectedIndex));
                Assert.Equal((expected.Distance, expectedIndex), (hit.Distance, index));
            }
        });
    }

    /// <summary>Each instance of the sums has its own map, under that of the object.</summary>
    [Fact]
    public void TryFindNearest_OfAComponentwiseFractalThatIsPlaced_TellsTheMapOfItsInstance()
    {
        var fractal = Fractal.Of(Shapes.Cube()).Apply([Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(3, 0, 0, 0.25)])
            .WithComposition(Composition.Componentwise);
        var placement = new Transformation(new(10, 20, 30), new(0, 90, 0), 2 * Vector.One);
        var map = placement.ToAffineMap();
        var caster = new SceneRayCaster(LoadedScene.Of(new() { Objects = [new(fractal) { Placement = placement }] }));
        foreach (var (centre, scale) in new[] { (Vector.Zero, 0.5), (new Vector(3, 0, 0), 0.25) })
        {
            var target = map * centre;
            Assert.True(caster.TryFindNearest(new(target + (9 * Vector.J), -Vector.J), new(), out var hit, out _));
            Near.Equal(map * new AffineMap(scale * Matrix.Identity, centre), hit.InstanceMap, 1e-13);
            Near.Equal(9 - scale, hit.Distance, 1e-12);
        }
    }

    [Fact]
    public void Rays_InAnEmptyScene_HitNothing()
    {
        var caster = new SceneRayCaster(new Scene());
        Assert.False(caster.TryFindNearest(new(Vector.Zero, Vector.I), new(), out var hit, out var index));
        Assert.Equal((default(RayHit), -1), (hit, index));
        Assert.False(caster.HitsAny(new(Vector.Zero, Vector.I), new()));
    }

    [Fact]
    public void Scene_WithASingularPlacement_IsRefused()
    {
        var flat = new SceneObject(Samples.Tetrahedron) { Placement = Transformation.Identity with { Scale = new(1, 0, 1) } };
        Assert.Throws<SingularMatrixException>(() => new SceneRayCaster(new Scene { Objects = [flat] }));
    }

    [Fact]
    public void Scene_WithAFileThatIsNotLoaded_IsRefused() =>
        Assert.ThrowsAny<FractalEngineException>(() => new SceneRayCaster(new Scene { Objects = [new("a.obj", Transformation.Identity)] }));

    [Fact]
    public void Rays_OfWrongArguments_AreRefused()
    {
        var caster = new SceneRayCaster(new Scene { Objects = [new(Samples.Tetrahedron)] });
        var context = new QueryContext();
        Ray[] rays = [default, new(new(0, double.NaN, 0), Vector.I), new(Vector.Zero, new(double.PositiveInfinity, 0, 0))];
        foreach (var ray in rays)
        {
            Assert.ThrowsAny<ArgumentException>(() => caster.HitsAny(ray, context));
            Assert.ThrowsAny<ArgumentException>(() => caster.TryFindNearest(ray, context, out _, out _));
        }

        Assert.ThrowsAny<ArgumentException>(() => caster.HitsAny(new(Vector.Zero, Vector.I), context, -1));
        Assert.ThrowsAny<ArgumentException>(() => caster.HitsAny(new(Vector.Zero, Vector.I), context, 0, double.NaN));
    }

    /// <summary>Moves an object, compares with the scene made anew, and counts the rays that the move matters to.</summary>
    private static int CountDifferences(Random random)
    {
        var scene = RandomScene(random);
        var index = random.Next(scene.Objects.Length);
        var placed = new PlacedModel(
            scene.Objects[index].Declaration with { Placement = random.Transformation() }, scene.Objects[index].Model);
        var moved = scene with { Objects = scene.Objects.SetItem(index, placed) };
        var anew = new SceneRayCaster(moved);
        var before = new SceneRayCaster(scene);
        var caster = before.WithObject(index, placed);
        var other = before.WithScene(moved);
        var different = 0;
        var context = new QueryContext();
        for (var i = 0; i < 200; i++)
        {
            var ray = new Ray(random.Vector(5), random.Vector(2));
            var isFound = anew.TryFindNearest(ray, context, out var expected, out var expectedIndex);
            Assert.Equal(isFound, caster.TryFindNearest(ray, context, out var actual, out var actualIndex));
            Assert.Equal((expectedIndex, expected), (actualIndex, actual));
            Assert.Equal(isFound, caster.HitsAny(ray, context));
            Assert.Equal(isFound, other.TryFindNearest(ray, context, out actual, out actualIndex));
            Assert.Equal((expectedIndex, expected), (actualIndex, actual));
            different += before.TryFindNearest(ray, context, out var old, out _) != isFound || old != expected ? 1 : 0;
        }

        return different;
    }

    private static void CheckAll(int firstSeed, int scenes)
    {
        var certain = 0;
        Parallel.For(firstSeed, firstSeed + scenes, seed => Seeded.RunOne(seed, random => Interlocked.Add(ref certain, CheckOne(random))));
        // Most rays pass outliers and thin shapes.
        Seeded.AssertMost(certain, scenes * RaysPerScene, 0.05);
    }

    /// <summary>Checks rays at one scene, and counts those that had to hit.</summary>
    private static int CheckOne(Random random)
    {
        var scene = RandomScene(random);
        var caster = new SceneRayCaster(scene);
        var shapes = scene.Objects.Select(placed => new ShapeExpansion(FractalOf(placed.Model))).ToArray();
        var oracle = new RayOracle(scene.Objects.Zip(shapes).SelectMany(
            pair => pair.Second.Triangles.Select(triangle => Place(triangle, pair.First.ObjectToWorld))));
        var source = new RandomRays(random, oracle);
        var context = new QueryContext();
        var certain = 0;
        for (var i = 0; i < RaysPerScene; i++)
        {
            var ray = random.Next(4) == 0 ? source.DrawAtEdge(random, oracle) : source.Draw(random, oracle);
            var minDistance = random.Next(2) * random.NextDouble();
            var maxDistance = random.Next(2) == 0 ? double.PositiveInfinity : minDistance + (5 * random.NextDouble());
            var projected = new ProjectedRay(ray);
            var expected = oracle.CertainDistance(in projected, minDistance, maxDistance);
            var isFound = caster.TryFindNearest(ray, context, out var hit, out var index, minDistance, maxDistance);
            Assert.True(isFound || double.IsPositiveInfinity(expected), FormattableString.Invariant($"{ray}: no hit within {expected:R}"));
            if (isFound)
            {
                Assert.InRange(hit.Distance, minDistance, Math.Min(maxDistance, expected));
                var triangle = Place(
                    shapes[index].Resolve(context.InstancePath, hit.FaceIndex), scene.Objects[index].ObjectToWorld);
                var problem = RayHitCheck.FindProblem(in projected, in hit, oracle.WithReach(in triangle));
                Assert.True(problem is null, FormattableString.Invariant($"{ray}: object {index}, {problem}"));
            }

            Assert.Equal(isFound, caster.HitsAny(ray, context, minDistance, maxDistance));
            certain += double.IsPositiveInfinity(expected) ? 0 : 1;
        }

        return certain;
    }

    private static ExpandedTriangle Place(ExpandedTriangle triangle, AffineMap map)
    {
        var placed = triangle.Transform(map);
        var largest = Math.Max(placed.A.MaxAbsComponent(), Math.Max(placed.B.MaxAbsComponent(), placed.C.MaxAbsComponent()));
        return placed with { Reach = Math.Max(Math.Max(triangle.Reach, map.Translation.MaxAbsComponent()), largest) };
    }

    private static Fractal FractalOf(Model model) => model is FractalModel fractal ? fractal.Fractal : Fractal.Of(model.Mesh);

    private static LoadedScene RandomScene(Random random)
    {
        Model[] models =
            [Model.Of(RandomMeshes.Create(random)), Model.Of(RandomFractals.Create(random)), Model.Of(RandomShapes.Create(random))];
        var objects = Enumerable.Range(0, random.Next(1, 8)).Select(_ => new SceneObject(models[random.Next(models.Length)])
        {
            Placement = random.Transformation() with { Position = random.Vector(4) },
        });
        return LoadedScene.Of(new Scene { Objects = [.. objects] });
    }
}
