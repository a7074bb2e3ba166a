using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Wavefront.Writing;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests;

/// <summary>Tests that public entry points refuse what can't work, with the exception that they document.</summary>
public sealed class InvalidArgumentTests
{
    private static readonly Transformation[] Halves = [Transformation.At(Vector.I, 0.5), Transformation.At(-Vector.I, 0.5)];

    public static TheoryData<double> NonFiniteNumbers => [double.NaN, double.PositiveInfinity, double.NegativeInfinity];

    [Theory]
    [MemberData(nameof(NonFiniteNumbers))]
    public void Mesh_WithACoordinateThatIsNotFinite_IsRefused(double number)
    {
        Assert.Throws<ArgumentException>(() => new Mesh([0, 0, 0, 1, 0, 0, 0, number, 0], [0, 1, 2]));
        Assert.Throws<ArgumentException>(() => Shapes.Cube().Transform(vertex => number * vertex));
    }

    [Fact]
    public void Flatten_BeyondTheRangeOfADouble_IsOverTheLimit() => Assert.Throws<FractalLimitException>(
        () => FractalGenerator.Flatten(Shapes.Cube(), [new AffineMap(Matrix.Diagonal(1e308 * Vector.One), 1.7e308 * Vector.One)]));

    [Fact]
    public void FindClosest_WhereNothingIsFound_SaysWhatMayHold()
    {
        var tooFar = Assert.Throws<FractalLimitException>(
            () => Collider.For(Shapes.Cube()).FindClosest(new(1.7e308, 1.7e308, 1.7e308)));
        Assert.Equal("the distance is beyond the range of a double", tooFar.Message);
        Assert.Throws<InvalidOperationException>(() => Collider.For(Mesh.Empty).FindClosest(Vector.Zero));
    }

    [Fact]
    public void WithDepth_OutOfRange_NamesTheLimit()
    {
        var fractal = Fractal.Of(Shapes.Cube()).Repeat(Halves, 3);
        Assert.Throws<ArgumentOutOfRangeException>(() => fractal.WithDepth(-1));
        var error = Assert.Throws<ArgumentOutOfRangeException>(() => fractal.WithDepth((int)FractalLimits.Depth.Value + 1));
        Assert.Contains($"{FractalLimits.Depth.Value}", error.Message, StringComparison.Ordinal);
        Assert.Equal((int)FractalLimits.Depth.Value, fractal.WithDepth((int)FractalLimits.Depth.Value).LevelCount);
    }

    [Theory]
    [InlineData(-1)]
    [InlineData(1_000_001)]
    public void Load_AtADepthOutOfRange_IsRefused(int depth) => Assert.Throws<ArgumentOutOfRangeException>(
        () => AssetLoader.Load(Repository.Full("assets/fractals/menger-3.fdo"), new() { Depth = depth }));

    [Fact]
    public void RepeatAndApply_BeyondALimit_NameIt()
    {
        var fractal = Fractal.Of(Shapes.Cube());
        var steps = Enumerable.Range(0, (int)FractalLimits.Steps.Value).Aggregate(fractal, (sum, _) => sum.Apply(Halves));
        AssertLimit($"{FractalLimits.Steps.Value} steps", () => steps.Apply(Halves));
        FractalStep nested = TransformationSet.Of(Halves);
        for (var depth = 0; depth < FractalLimits.Nesting.Value; depth++)
        {
            nested = new Repetition([nested], 1);
        }

        AssertLimit($"{FractalLimits.Nesting.Value} repetitions inside each other", () => fractal.Repeat([nested], 1));
        FractalStep huge = new Repetition([TransformationSet.Of(Halves)], (int)FractalLimits.Depth.Value);
        AssertLimit($"{FractalLimits.Levels.Value} levels", () => fractal.Repeat([huge], 3));
        for (var depth = 0; depth < 4; depth++)
        {
            // More levels than a long counts.
            huge = new Repetition([huge], (int)FractalLimits.Depth.Value);
        }

        AssertLimit($"{FractalLimits.Levels.Value} levels", () => fractal.Repeat([huge], 3));
        FractalStep set = TransformationSet.Of(Halves);
        var threeLevels = fractal.Repeat([set, set, set], 3);
        AssertLimit($"{FractalLimits.Levels.Value} levels", () => threeLevels.WithDepth((int)FractalLimits.Depth.Value));
    }

    [Fact]
    public void Expand_OfMoreThanAnArrayHolds_IsRefusedAtOnce()
    {
        var fractal = Fractal.Of(Shapes.Cube()).Repeat(Halves, 40);
        Assert.Throws<FractalLimitException>(() => FractalGenerator.Expand(fractal, long.MaxValue));
        Assert.Throws<FractalLimitException>(() => FractalGenerator.Flatten(fractal.WithDepth(29), long.MaxValue));
        Assert.Empty(FractalGenerator.Expand(Fractal.Of(Shapes.Cube()).Apply([]).Repeat(Halves, 40), long.MaxValue));
    }

    [Theory]
    [InlineData(null)]
    [InlineData(2000)]
    public void Prepare_OfAFractalThatGrowsBeyondADouble_IsOverTheLimit(int? depth)
    {
        var growing = Fractal.Of(Shapes.Cube()).Repeat([Transformation.At(Vector.I, 2)], depth);
        Assert.Throws<FractalLimitException>(
            () => DrawableScene.Prepare(LoadedScene.Of(new() { Objects = [new(growing)] }), new()));
    }

    [Fact]
    public void Lights_WithoutADirection_AreRefused()
    {
        Assert.Throws<ArgumentException>(() => new DirectionalLight(Vector.Zero, Colour.White, 1));
        Assert.Throws<ArgumentException>(() => new DirectionalLight(Vector.I, Colour.White, 1) with { Direction = Vector.Zero });
        Assert.Throws<ArgumentException>(() => new SpotLight(Vector.Zero, new(double.NaN, 0, 0), 30, Colour.White, 1, 1));
    }

    [Fact]
    public void Camera_ThatSeesNothing_IsRefused()
    {
        Assert.All((double[])[double.NaN, 0, 180, -1], angle =>
        {
            Assert.Throws<ArgumentException>(() => new Camera(Vector.Zero, Vector.Zero, angle));
            Assert.Throws<ArgumentException>(() => Camera.Default with { FieldOfView = angle });
        });
        Assert.Throws<ArgumentException>(() => new Camera(new(double.NaN, 0, 0), Vector.Zero, 60));
        Assert.Throws<ArgumentException>(() => new Camera(Vector.Zero, new(double.PositiveInfinity, 0, 0), 60));
    }

    [Fact]
    public void View_WithImpossibleNumbers_IsRefused()
    {
        var view = new View(Camera.Default, Projection.Perspective);
        Assert.All((double[])[double.NaN, 0, -1], aspect =>
        {
            Assert.Throws<ArgumentException>(() => view with { Aspect = aspect });
            Assert.Throws<ArgumentException>(() => View.Of(LoadedScene.Of(new() { Aspect = aspect }), 1));
        });
        Assert.All(((double, double)[])[(2, 1), (0, 1), (double.NaN, 1), (1, double.PositiveInfinity)],
            planes => Assert.Throws<ArgumentException>(() => view with { FixedClipPlanes = planes }));
        Assert.Throws<ArgumentOutOfRangeException>("Samples", () => new RenderSettings { Samples = -1 });
        Assert.Throws<ArgumentOutOfRangeException>("InstanceBudget", () => new RenderSettings { InstanceBudget = -1 });
        Assert.Throws<ArgumentOutOfRangeException>("TriangleBudget", () => new RenderSettings { TriangleBudget = -1 });
        Assert.All((double[])[-1, 181, double.NaN],
            angle => Assert.Throws<ArgumentOutOfRangeException>("CreaseAngle", () => new RenderSettings { CreaseAngle = angle }));
    }

    [Fact]
    public void Numbers_OutOfRange_AreRefused()
    {
        var fractal = Fractal.Of(Shapes.Cube());
        Assert.Throws<ArgumentOutOfRangeException>(() => new FractalTrail(fractal, -1));
        Assert.Throws<ArgumentOutOfRangeException>(() => new FractalTrail(fractal, 0));
        Assert.Throws<ArgumentOutOfRangeException>(() => MeshCountHeader.Update("missing.obj", -1));
    }

    [Fact]
    public void EntryPoints_WithNull_NameTheArgument()
    {
        Assert.Throws<ArgumentNullException>("fractal", () => Collider.For((Fractal)null!));
        Assert.Throws<ArgumentNullException>("mesh", () => Collider.For((Mesh)null!));
        Assert.Throws<ArgumentNullException>("mesh", () => Model.Of((Mesh)null!));
        Assert.Throws<ArgumentNullException>("fractal", () => Model.Of((Fractal)null!));
        Assert.Throws<ArgumentNullException>("baseMesh", () => Fractal.Of(null!));
        Assert.Throws<ArgumentNullException>("description", () => Fractal.Of(null!, []));
        Assert.Throws<ArgumentException>("bases", () => Fractal.Of(new([]), []));
        var collider = Collider.For(Shapes.Cube());
        Assert.Throws<ArgumentNullException>("context", () => collider.TryFindClosest(Vector.Zero, 1, null!, out _));
        var scene = new SceneCollider(new Scene { Objects = [new(Shapes.Cube())] });
        Assert.Throws<ArgumentNullException>("context", () => scene.TryFindClosest(Vector.Zero, 1, null!, out _, out _));
    }

    [Fact]
    public void Colliders_OfNoKind_AreRefused()
    {
        const ColliderKind none = (ColliderKind)99;
        Assert.Throws<ArgumentOutOfRangeException>(() => Collider.For(Shapes.Cube(), none));
        Assert.Throws<ArgumentOutOfRangeException>(() => Collider.For(Fractal.Of(Shapes.Cube()), none));
        Assert.Throws<ArgumentOutOfRangeException>("kind", () => Model.Of(Shapes.Cube()).CreateCollider(none));
        Assert.Throws<ArgumentOutOfRangeException>("kind", () => new PlacedModel(new SceneObject(Shapes.Cube())).CreateCollider(none));
        Assert.Throws<ArgumentOutOfRangeException>(() => new SceneCollider(new Scene(), none));
    }

    [Fact]
    public void WithObject_ThatTheSceneHasNot_IsRefused()
    {
        var placed = new PlacedModel(new SceneObject(Shapes.Cube()));
        var collider = new SceneCollider(new LoadedScene(new(), [placed]));
        Assert.Throws<ArgumentOutOfRangeException>(() => collider.WithObject(9, placed));
        Assert.Throws<ArgumentOutOfRangeException>(() => collider.WithObject(-1, placed));
        Assert.Throws<ArgumentException>(() => collider.WithObject(0, new(new SceneObject(Shapes.Cube()))));
    }

    [Fact]
    public void Prepare_OfMoreLightsThanAreDrawn_SaysSo()
    {
        Light[] lights = [new AmbientLight(Colour.White, 1), .. Enumerable.Repeat(new DirectionalLight(Vector.I, Colour.White, 1), 17)];
        var scene = LoadedScene.Of(new() { Lights = [.. lights], Objects = [new(Shapes.Cube())] });
        Assert.Equal(
            "of 17 lights besides ambient ones, only the first 16 shine", Assert.Single(DrawableScene.Prepare(scene, new()).Notices));
        scene = LoadedScene.Of(scene.Scene with { Lights = [.. lights.SkipLast(1)] });
        Assert.Empty(DrawableScene.Prepare(scene, new()).Notices);
    }

    [Theory]
    [InlineData(1e-17, null)]
    [InlineData(1e37, null)]
    [InlineData(1e-19, "the scene is 1.73E-19 units large, and drawn frames show 1E-18 to 8E+37: trace it, or scale it")]
    [InlineData(1e38, "the scene is 1.73E+38 units large, and drawn frames show 1E-18 to 8E+37: trace it, or scale it")]
    public void Prepare_OfAScene_SaysWhereFloatsCannotDrawIt(double scale, string? notice)
    {
        var scene = LoadedScene.Of(new() { Objects = [new(Shapes.Cube()) { Placement = Samples.MoveAndScale(0, 0, 0, scale) }] });
        Assert.Equal(notice is null ? [] : [notice], DrawableScene.Prepare(scene, new()).Notices.ToArray());
    }

    private static void AssertLimit(string limit, Func<object> make) => Assert.Equal(
        $"the fractal has more than the limit of {limit}", Assert.Throws<FractalLimitException>(make).Message);
}
