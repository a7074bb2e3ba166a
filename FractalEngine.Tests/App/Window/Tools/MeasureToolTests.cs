using FractalEngine.App.Window.Tools;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.Tools;

/// <summary>Tests that measured distances follow what they were measured between.</summary>
public class MeasureToolTests
{
    private static readonly (int Width, int Height) Size = (320, 200);
    private static readonly MeshModel Cube = new(RenderScenes.Cube(0.5)) { SourcePath = "cube.obj" };

    [Theory]
    [InlineData(MeasureKind.Points, 3, 4)]
    [InlineData(MeasureKind.PointToObject, 2.5, 3.5)]
    [InlineData(MeasureKind.Objects, 2, 3)]
    public void Follow_OfAMovedObject_MeasuresAgain(object kind, double before, double after)
    {
        var tool = Measured((MeasureKind)kind, Scene(3));
        Assert.Equal(before, Assert.Single(tool.Dimensions).Length, 1e-9);
        tool.Follow(Scene(4), isMoving: false);
        Assert.Equal(after, Assert.Single(tool.Dimensions).Length, 1e-9);
    }

    [Fact]
    public void Follow_OfMovingBodies_WaitsForWholeObjects()
    {
        var tool = Measured(MeasureKind.Objects, Scene(3));
        tool.Follow(Scene(4), isMoving: true);
        Assert.Equal(2, Assert.Single(tool.Dimensions).Length, 1e-9);
        tool.Follow(Scene(4), isMoving: false);
        Assert.Equal(3, Assert.Single(tool.Dimensions).Length, 1e-9);
    }

    [Fact]
    public void Follow_OfARemovedObject_RemovesTheDistance()
    {
        var tool = Measured(MeasureKind.Points, Scene(3));
        tool.Follow(Scene(), isMoving: false);
        Assert.Empty(tool.Dimensions);
    }

    [Fact]
    public void AddLines_AfterTheFirstClick_MarkThePoint()
    {
        var scene = Scene(3);
        var tool = new MeasureTool();
        tool.Toggle();
        Assert.Empty(LinesOf(tool));
        tool.Click(Select(scene, 0), scene);
        Assert.True(tool.HasFirstPoint);
        var lines = LinesOf(tool);
        Assert.Equal(3, lines.Count);
        Assert.All(lines, line => Near.Equal(new Vector(0, 0, -0.5), 0.5 * (line.From + line.To), 1e-9));
        tool.Click(Select(scene, 1), scene);
        Assert.Single(LinesOf(tool));
    }

    [Fact]
    public void Follow_OfAChangedFractal_MovesThePointAlong()
    {
        var tool = new MeasureTool();
        tool.Toggle();
        var scene = Pair(2);
        tool.Click(Select(scene, new Vector(0, 0, -0.5)), scene);
        tool.Click(Select(scene, new Vector(2, 0, -0.5)), scene);
        Assert.Equal(2, Assert.Single(tool.Dimensions).Length, 1e-9);
        tool.Follow(Pair(3), isMoving: false);
        Assert.Equal(3, Assert.Single(tool.Dimensions).Length, 1e-9);
    }

    private static MeasureTool Measured(MeasureKind kind, LoadedScene scene)
    {
        var tool = new MeasureTool { Kind = kind };
        tool.Toggle();
        tool.Click(Select(scene, 0), scene);
        tool.Click(Select(scene, 1), scene);
        return tool;
    }

    private static List<LineSegment> LinesOf(MeasureTool tool)
    {
        var lines = new List<LineSegment>();
        tool.AddLines(lines, static _ => static point => point);
        return lines;
    }

    private static Selection Select(LoadedScene scene, int index) =>
        Select(scene, scene.Objects[index].ObjectToWorld.Translation - (0.5 * Vector.K));

    private static Selection Select(LoadedScene scene, Vector point)
    {
        // Straight from the front, so that the middle of a side is met.
        var camera = new Camera(point - (8 * Vector.K), Vector.Zero, 40);
        return new Picker().Pick(scene, new(camera, Projection.Perspective), (0.5 * Size.Width, 0.5 * Size.Height), Size)!;
    }

    /// <summary>Cubes of side 1 at the origin and at these places on the x axis.</summary>
    private static LoadedScene Scene(params double[] places)
    {
        SceneObject At(double x) => new(Cube) { Placement = Transformation.Identity with { Position = new(x, 0, 0) } };
        return LoadedScene.Of(new() { Objects = [At(0), .. places.Select(At)] });
    }

    /// <summary>A fractal of two cubes, so far apart.</summary>
    private static LoadedScene Pair(double distance)
    {
        var maps = new[] { Transformation.Identity, Transformation.Identity with { Position = new(distance, 0, 0) } };
        var fractal = Fractal.Of(RenderScenes.Cube(0.5)).Repeat(maps, 1);
        return LoadedScene.Of(new() { Objects = [new SceneObject(new FractalModel(fractal) { SourcePath = "pair.fdo" })] });
    }
}
