using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render.Preparation;

[Collection(GlTests.Name)]
public sealed class DegenerateTriangleTests
{
    // A triangle of a square, one of collinear corners, one with two equal corners, a point, and the other half of the square.
    private static readonly Mesh Square = new(
        [-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0, 0, 0, 0],
        [0, 2, 1, 0, 4, 3, 1, 1, 2, 3, 3, 3, 1, 2, 3]);

    [Theory]
    [InlineData(1)]
    [InlineData(1e-200)]
    [InlineData(1e200)]
    public void Test_OfAnySize_FollowsTheShapeAlone(double size)
    {
        var (a, b) = (size * new Vector(1, 2, 3), size * new Vector(-2, 0.1, 0.7));
        Assert.True(DegenerateTriangle.Test(a, a, a));
        Assert.True(DegenerateTriangle.Test(a, b, a));
        Assert.True(DegenerateTriangle.Test(a, b, b));
        Assert.True(DegenerateTriangle.Test(a, a, b));
        Assert.True(DegenerateTriangle.Test(a, b, a + (2 * (b - a))));
        Assert.False(DegenerateTriangle.Test(a, b, size * new Vector(0.3, 0.4, 0.5)));
        // A needle whose width is a millionth of a millionth of its length.
        Assert.False(DegenerateTriangle.Test(Vector.Zero, size * Vector.I, size * new Vector(1, 1e-12, 0)));
    }

    [Fact]
    public void Test_OfExactlyCollinearPoints_IsTrue()
    {
        var random = new Random(7);
        for (var i = 0; i < 1000; i++)
        {
            // Eighths are exact, so that the points lie on the line without rounding.
            var start = RandomEighths(random);
            var step = RandomEighths(random);
            Assert.True(DegenerateTriangle.Test(start, start + (random.Next(-9, 9) * step), start + (random.Next(-9, 9) * step)));
        }
    }

    [Theory]
    [InlineData(double.NaN)]
    [InlineData(double.PositiveInfinity)]
    public void Test_WithAVertexThatIsNotFinite_IsFalse(double x) =>
        Assert.False(DegenerateTriangle.Test(new(x, 0, 0), Vector.I, Vector.J));

    [Theory]
    [InlineData(true, 2, 3)]
    [InlineData(false, 5, 0)]
    public void Prepare_WithDegenerateTriangles_RemovesThemWhereRequested(bool isRemoving, int drawn, int removed)
    {
        var model = Prepare(RenderScenes.Model(Square), new() { RemoveDegenerateTriangles = isRemoving });
        Assert.Equal((3 * drawn, removed), (model.Indices.Length, model.DegenerateTriangleCount));
        Assert.Equal(new DrawableBatch(0, 3 * drawn, null), Assert.Single(model.Batches));
        Assert.Equal(Square.Bounds, model.Bounds);
    }

    [Fact]
    public void Prepare_MaterialOfDegenerateTrianglesOnly_HasNoBatch()
    {
        var mesh = Square.WithGroups([new(0, 1, "", "", "red", 0), new(1, 3, "", "", "none", 0), new(4, 1, "", "", "red", 0)], ["a.mtl"]);
        var materials = ((string[])["red", "none"]).Select(name => new Material(name)).ToArray();
        var meshModel = new MeshModel(mesh)
        {
            SourcePath = "mesh.obj",
            Materials = [.. materials.Select(material => KeyValuePair.Create(material.Name, material))],
        };
        var model = Prepare(meshModel, new());
        var batch = model.Batches.Single();
        Assert.Equal((0, 6, "red"), (batch.FirstIndex, batch.IndexCount, batch.Material!.Material.Name));
        Assert.Equal(3, model.DegenerateTriangleCount);
    }

    [SkippableFact]
    public void Draw_MeshOfDegenerateTrianglesOnly_DrawsTheBackground()
    {
        var mesh = new Mesh([0, 0, 0, 1, 0, 0, 2, 0, 0], [0, 1, 2, 0, 0, 1]);
        Model[] models =
        [
            RenderScenes.Model(mesh),
            TexturedScenes.WithMaterial(mesh, new("m")),
            new FractalModel(new(RenderScenes.Menger(2).Fractal.Description, mesh)) { SourcePath = "a.fdo" },
        ];
        foreach (var model in models)
        {
            Assert.Equal(2, Prepare(model, new()).DegenerateTriangleCount);
            foreach (var settings in (RenderSettings[])[new(), new() { Wireframe = true }, new() { Culling = null }])
            {
                var scene = RenderScenes.Scene(new Scene { Background = Colour.Black }, (model, Transformation.Identity, Colour.White));
                var image = RenderScenes.Draw(scene, RenderScenes.FrontView, settings: settings);
                Assert.Equal(0, RenderScenes.CountDifferent(image, (0, 0, 0, 255)));
            }
        }
    }

    private static Vector RandomEighths(Random random) => new Vector(random.Next(-99, 99), random.Next(-99, 99), random.Next(-99, 99)) / 8;

    private static DrawableModel Prepare(Model model, RenderSettings settings) =>
        DrawableScene.Prepare(RenderScenes.Scene(new Scene(), (model, Transformation.Identity, null)), settings).Models[0];
}
