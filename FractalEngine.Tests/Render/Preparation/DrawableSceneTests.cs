using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Preparation;

public sealed class DrawableSceneTests
{
    [Fact]
    public void Prepare_FractalBeyondTheBudget_IsDrawnLessDeepWithANotice()
    {
        var scene = Prepare(new() { Culling = null, InstanceBudget = 10_000 }, RenderScenes.Menger(6));
        Assert.Equal(8000, scene.Models[0].InstanceCount);
        const string Notice = "menger.fdo: 64,000,000 instances are more than the budget of 10,000: drawn at depth 3 of 6";
        Assert.Equal(Notice, Assert.Single(scene.Notices));
    }

    [Theory]
    [InlineData(20, "menger.fdo: about 10^26 instances are more than the budget of 8,000: drawn at depth 3 of 20")]
    [InlineData(null, "menger.fdo: infinitely many instances are more than the budget of 8,000: drawn at depth 3 of infinitely many")]
    public void Prepare_HugeOrInfiniteFractal_IsDrawnAtOnce(int? depth, string notice) =>
        Assert.Equal(notice, Assert.Single(Prepare(new() { Culling = null, InstanceBudget = 8000 }, RenderScenes.Menger(depth)).Notices));

    [Fact]
    public void Prepare_FractalOfALargeMesh_KeepsTheTriangleBudget()
    {
        var scene = Prepare(new() { Culling = null, TriangleBudget = 12 * 500 }, RenderScenes.Menger(3));
        Assert.Equal(400, scene.Models[0].InstanceCount);
        Assert.Equal(4800, scene.TriangleCount);
        Assert.Single(scene.Notices);
    }

    [Fact]
    public void Prepare_ComponentwiseFractal_CountsDistinctSumsNotChains()
    {
        // The 20^4 chains exceed the budget, their distinct sums do not.
        var scene = Prepare(new() { Culling = null, InstanceBudget = 5000 }, RenderScenes.Menger(4, Composition.Componentwise));
        Assert.Empty(scene.Notices);
        Assert.InRange(scene.Models[0].InstanceCount, 100, 5000);
    }

    [Fact]
    public void Prepare_ModelUsedTwice_IsPreparedOnce()
    {
        var model = RenderScenes.Model(RenderScenes.Cube(1));
        var scene = DrawableScene.Prepare(
            RenderScenes.Scene(new Scene(), (model, Transformation.Identity, null), (model, RenderScenes.TranslatedTo(5, 0, 0), null)),
            new());
        Assert.Same(scene.Objects[0].Model, scene.Objects[1].Model);
        Assert.NotEqual(scene.Objects[0].Colour, scene.Objects[1].Colour);
    }

    [Fact]
    public void Prepare_Cube_HasSharpEdgesAndUnitNormals()
    {
        var model = Prepare(new(), RenderScenes.Model(RenderScenes.Cube(1))).Models[0];
        Assert.Equal(24, model.Vertices.Length / DrawableModel.FloatsPerVertex);
        Assert.Equal(36, model.Indices.Length);
        AssertUnitNormals(model);
    }

    [Fact]
    public void Prepare_UnusedVertices_AreOmitted()
    {
        var mesh = new Mesh([9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0, 8, 8, 8], [1, 2, 3]);
        Assert.Equal(3, Prepare(new(), RenderScenes.Model(mesh)).Models[0].Vertices.Length / DrawableModel.FloatsPerVertex);
    }

    [Fact]
    public void Prepare_UnusedVertexFarAway_LeavesFacesTheirShape()
    {
        var cube = RenderScenes.Cube(1);
        var mesh = new Mesh([.. cube.Positions, 1e9, -2e9, 3e9], cube.VertexIndices);
        var (model, other) = (Prepare(new(), RenderScenes.Model(cube)).Models[0], Prepare(new(), RenderScenes.Model(mesh)).Models[0]);
        Assert.Equal(model.Vertices.ToArray(), other.Vertices.ToArray());
        Assert.Equal((model.Origin, model.MeshOrigin), (other.Origin, other.MeshOrigin));
    }

    [Fact]
    public void Prepare_NormalsOfTheFile_AreTakenAndFlippedToTheFrontSide()
    {
        var mesh = RenderScenes.Square(1).WithNormals([0, 0.6, -0.8, 0, 0, 5, 0, 0, 0], [0, 0, 0, 1, 1, 2]);
        var model = Prepare(new(), RenderScenes.Model(mesh)).Models[0];
        var normals = model.Vertices.ToArray().Chunk(DrawableModel.FloatsPerVertex)
            .Select(vertex => (vertex[3], vertex[4], vertex[5])).Distinct();
        // As given; negated, since it opposes the winding; without a direction.
        Assert.Equal([(0f, 0.6f, -0.8f), (0f, 0f, -1f), (0f, 0f, 0f)], normals);
    }

    [Fact]
    public void Prepare_ModelFarFromItsOrigin_KeepsItsShape()
    {
        var far = RenderScenes.Cube(1).Transform(vertex => vertex + new Vector(1e9, 0, 0));
        var near = Prepare(new(), RenderScenes.Model(RenderScenes.Cube(1))).Models[0];
        var moved = Prepare(new(), RenderScenes.Model(far)).Models[0];
        Assert.Equal(near.Vertices.ToArray(), moved.Vertices.ToArray());
        Assert.Equal(new(1e9, 0, 0), moved.Origin);
    }

    [Fact]
    public void Prepare_MeshWithoutMaterials_IsOneBatchWithoutTextureCoordinates()
    {
        var mesh = TexturedScenes.TexturedSquare(1).WithGroups([new(0, 1, "", "", "a", 0), new(1, 1, "", "", "b", 0)], []);
        var model = Prepare(new(), RenderScenes.Model(mesh)).Models[0];
        Assert.Equal(new DrawableBatch(0, 6, null), Assert.Single(model.Batches));
        Assert.True(model.TextureCoordinates.IsEmpty);
        Assert.Equal((4, 6), (model.Vertices.Length / DrawableModel.FloatsPerVertex, model.Indices.Length));
    }

    [Fact]
    public void Prepare_SeamInATexture_MakesTwoVerticesOfOnePosition()
    {
        var mesh = RenderScenes.Square(1).WithTextureCoordinates([0, 0, 1, 0, 0, 1, 1, 1, 0.5, 0.5], [0, 2, 1, 4, 2, 3]);
        using var scenes = new TexturedScenes();
        var texture = scenes.CreateTexture("a.png", 1, 1, (_, _) => (1, 2, 3, 255));
        var model = Prepare(new(), TexturedScenes.WithMaterial(mesh, new("m") { Texture = texture })).Models[0];
        Assert.Equal(5, model.Vertices.Length / DrawableModel.FloatsPerVertex);
        Assert.Equal([0f, 0, 0, 1, 1, 0, 0.5f, 0.5f, 1, 1], model.TextureCoordinates.ToArray());
    }

    [Theory]
    [InlineData(1, 1)]
    [InlineData(0.5, 0)]
    public void Prepare_SolidOfGlass_KeepsItsInnerSides(double opacity, int sign)
    {
        var menger = RenderScenes.Menger(2);
        var cube = TexturedScenes.WithMaterial(menger.Mesh, new("m") { Opacity = opacity });
        var glass = new FractalModel(new Fractal(menger.Fractal.Description, cube.Mesh))
        {
            SourcePath = "glass.fdo",
            Materials = cube.Materials,
        };
        Assert.Equal(sign, Prepare(new(), glass).Models[0].WindingSign);
    }

    [Fact]
    public void Prepare_OfEveryModelOfTheAssets_DrawsEachFaceOnce() =>
        Assert.All(Directory.GetFiles(Repository.Full("assets/models"), "*.obj"), file =>
        {
            var loaded = AssetLoader.Load(file).Scene;
            var scene = DrawableScene.Prepare(loaded, new());
            Assert.Empty(scene.Notices);
            var next = 0;
            var model = scene.Models[0];
            foreach (var batch in model.Batches)
            {
                Assert.Equal(next, batch.FirstIndex);
                next += batch.IndexCount;
            }

            var drawn = 3 * (loaded.Models.Single().Mesh.FaceCount - model.DegenerateTriangleCount);
            Assert.Equal((drawn, drawn), (next, model.Indices.Length));
        });

    [Fact]
    public void Prepare_Cancelled_Stops()
    {
        using var source = new CancellationTokenSource();
        source.Cancel();
        var scene = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(2), Transformation.Identity, null));
        Assert.Throws<OperationCanceledException>(() => DrawableScene.Prepare(scene, new(), null, source.Token));
    }

    private static DrawableScene Prepare(RenderSettings settings, Model model) =>
        DrawableScene.Prepare(RenderScenes.Scene(new Scene(), (model, Transformation.Identity, null)), settings);

    private static void AssertUnitNormals(DrawableModel model)
    {
        foreach (var vertex in model.Vertices.ToArray().Chunk(DrawableModel.FloatsPerVertex))
        {
            Assert.Equal(1, Math.Sqrt((vertex[3] * vertex[3]) + (vertex[4] * vertex[4]) + (vertex[5] * vertex[5])), 1e-6);
        }
    }
}
