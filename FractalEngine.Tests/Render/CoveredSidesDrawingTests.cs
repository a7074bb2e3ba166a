using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render;

/// <summary>Leaving out sides that neighbours cover shows in no image, wherever the camera and a section are.</summary>
[Collection(GlTests.Name)]
public sealed class CoveredSidesDrawingTests
{
    private const int Width = 240;
    private const int Height = 180;

    [SkippableTheory]
    [InlineData(-2.0, 1.4, -2.6, null, -1)]
    [InlineData(-0.4, 0.6, -2.1, 1 / 27.0, 1)]
    [InlineData(0.01, -0.02, -0.9, null, 1)]
    public void Sponge_LooksAsWithAllSides(double x, double y, double z, double? section, int mirror)
    {
        var scene = new Scene
        {
            Lights = [new SunLight(new(0.4, -0.7, 0.6), Colour.White, 1), new AmbientLight(Colour.White, 0.3)],
            Background = new(0.9, 0.1, 0.1),
        };
        var loaded = RenderScenes.Scene(scene, (RenderScenes.Menger(3), Transformation.Identity with { Scale = new(mirror, 1, 1) }, null));
        var view = new View(CameraFraming.LookAt(new(x, y, z), new(0.1, 0, 0.05), Vector.J, 50, Handedness.Left), Projection.Perspective)
        {
            Section = section is { } offset ? SectionPlane.Of(new(0, 0, -1), offset) : null,
        };
        var settings = new RenderSettings { Samples = 4, Shadows = true };
        ImageComparison.AssertSame(
            RenderScenes.Draw(loaded, view, Width, Height, settings with { BackFaceCulling = false }),
            RenderScenes.Draw(loaded, view, Width, Height, settings), "a sponge");
    }

    [SkippableTheory]
    [InlineData(-2.0, 1.4, -2.6, null, 1)]
    [InlineData(-2.0, 1.4, -2.6, 1 / 3.0, 1)]
    [InlineData(-0.9, 0.88, -0.94, null, 1)]
    [Trait("Category", "Soak")]
    public void Sponge_InOtherCases_LooksAsWithAllSides(double x, double y, double z, double? section, int mirror) =>
        Sponge_LooksAsWithAllSides(x, y, z, section, mirror);

    /// <summary>Filled gaps have the size of rounding, in any units of the mesh, and along each axis of a flat object.</summary>
    [SkippableTheory]
    [InlineData(1e-4, 1, 1, 1)]
    [InlineData(1e4, 1, 1, 1)]
    [InlineData(1, 1, 1e-4, 1)]
    public void Sponge_OfAnyUnitsAndShape_LooksAsWithAllSides(double unit, double x, double y, double z)
    {
        var sponge = RenderScenes.Menger(1).Fractal;
        var set = sponge.LevelAt(0).Transformations.Select(map => map with { Position = unit * map.Position });
        var model = new FractalModel(Fractal.Of(RenderScenes.Cube(unit)).Repeat(set, 3)) { SourcePath = "menger.fdo" };
        var placement = Transformation.Identity with { Scale = new Vector(x, y, z) / unit };
        var scene = RenderScenes.Scene(
            new Scene { Lights = [RenderScenes.FullLight], Background = new(0.9, 0.1, 0.1) }, (model, placement, Colour.White));
        var view = new View(
            CameraFraming.LookAt(new(-1.9, 1.5, -2.1), Vector.Zero, Vector.J, 50, Handedness.Left), Projection.Perspective);
        var settings = new RenderSettings { Samples = 0 };
        ImageComparison.AssertSame(
            RenderScenes.Draw(scene, view, Width, Height, settings with { BackFaceCulling = false }),
            RenderScenes.Draw(scene, view, Width, Height, settings), "a sponge");
    }

    [SkippableTheory]
    [InlineData(1, 1e-4, 1, 1)]
    [InlineData(1, 1, 1, 1e-4)]
    [Trait("Category", "Soak")]
    public void Sponge_OfOtherUnitsAndShapes_LooksAsWithAllSides(double unit, double x, double y, double z) =>
        Sponge_OfAnyUnitsAndShape_LooksAsWithAllSides(unit, x, y, z);

    /// <summary>A file may give its faces any normals, which then don't tell sides apart.</summary>
    [Fact]
    public void Cubes_WithNormalsOfOtherSides_KeepAllSides()
    {
        var cube = RenderScenes.Cube(1);
        Assert.True(HasCoveredSides(cube));
        Assert.False(HasCoveredSides(cube.WithNormals([0, 1, 0], [.. cube.VertexIndices.Select(static _ => 0)])));

        static bool HasCoveredSides(Mesh mesh)
        {
            var sponge = RenderScenes.Menger(2).Fractal;
            var model = new FractalModel(new Fractal(sponge.Description, mesh)) { SourcePath = "menger.fdo" };
            var scene = RenderScenes.Scene(new Scene(), (model, Transformation.Identity, null));
            return DrawableScene.Prepare(scene, new()).Objects[0].Model.HasCoveredSides;
        }
    }
}
