using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Cameras;
using FractalEngine.Render.Images;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Scenes.Cameras;

/// <summary>
/// Tests right-handed scenes: models from other tools are not mirrored, and a right-handed scene looks exactly as the left-handed scene of
/// the mirrored data does.
/// </summary>
[Collection(GlTests.Name)]
public sealed class HandednessTests : IDisposable
{
    private const int Width = 160;
    private const int Height = 120;

    // A unit square in the plane z = 0 that other tools see from +z, counter-clockwise.
    private const string Quad = """
        mtllib a.mtl
        v -1 -1 0
        v 1 -1 0
        v 1 1 0
        v -1 1 0
        vt 0 0
        vt 1 0
        vt 1 1
        vt 0 1
        usemtl m
        f 1/1 2/2 3/3 4/4

        """;

    // From the upper left by rows.
    private static readonly byte[][] Quarters = [[220, 0, 0, 255], [0, 220, 0, 255], [0, 0, 220, 255], [220, 220, 220, 255]];

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [SkippableTheory]
    [InlineData(false)]
    [InlineData(true)]
    public void Texture_OfAMeshFromAnotherTool_IsNotMirrored(bool isSaved)
    {
        var file = LoadQuad();
        if (isSaved)
        {
            SceneFile.Write(_folder["saved.sdo"], file.Scene.Scene);
            file = AssetLoader.Load(_folder["saved.sdo"]);
        }

        // From +z, where the maker of the model looked from.
        var image = Draw(file.Scene, View.Of(file.Scene, 1, new Camera(new(0, 0, 3), Vector.Zero, 40)));
        Assert.Equal("red", NameAt(image, -0.3, 0.3));
        Assert.Equal("green", NameAt(image, 0.3, 0.3));
        Assert.Equal("blue", NameAt(image, -0.3, -0.3));
        Assert.Equal("white", NameAt(image, 0.3, -0.3));
    }

    [SkippableFact]
    public void DefaultCamera_OfAMeshFromAnotherTool_SeesItsFront()
    {
        var scene = LoadQuad().Scene;
        var view = View.Of(scene, (double)Width / Height);
        Assert.True(view.Camera.Position is { X: > 0, Y: > 0, Z: > 0 }, $"the camera stands at {view.Camera.Position}");
        var upperLeft = view.Project(new(-0.5, 0.5, 0), Width, Height)!.Value;
        var image = RenderScenes.Draw(scene, view, Width, Height);
        Assert.Equal("red", NameOf(image[(int)upperLeft.X, (int)upperLeft.Y]));
        Assert.True(upperLeft.X < view.Project(new(0.5, 0.5, 0), Width, Height)!.Value.X);
    }

    [SkippableFact]
    public void Texture_OfTheSameMeshInAScene_IsThatOfTheLeftHandedWorld()
    {
        LoadQuad();
        var scene = AssetLoader.Load(_folder.Write("left.sdo", "o \"quad.obj\" #\n")).Scene;
        // In the left-handed world the camera at −z sees the back, on which left is left.
        var image = Draw(scene, View.Of(scene, 1, new Camera(new(0, 0, -3), Vector.Zero, 40)));
        Assert.Equal("red", NameAt(image, -0.3, 0.3));
        Assert.Equal("green", NameAt(image, 0.3, 0.3));
    }

    [SkippableTheory]
    [InlineData(Projection.Perspective, Shading.PerPixel, 2, true)]
    [InlineData(Projection.Orthographic, Shading.PerPixel, 1, true)]
    public void RightHanded_LooksAsTheMirroredSceneInTheLeftHandedWorld(
        Projection projection, Shading shading, double minProjectedSize, bool hasDefaultLights)
    {
        var settings = new RenderSettings
        {
            Shading = shading,
            Grid = true,
            Culling = minProjectedSize == 0 ? null : new() { MinProjectedSize = minProjectedSize },
        };
        // Mirroring is exact, so that only sums in another order round differently, far below a step of colour.
        AssertMirrored(projection, settings with { AmbientOcclusion = false }, hasDefaultLights, maxMean: 0.02);
        // The 64 directions of ambient occlusion have no mirror images among them.
        AssertMirrored(projection, settings, hasDefaultLights, maxMean: 0.03);
    }

    [SkippableTheory]
    [InlineData(Projection.Perspective, Shading.PerVertex, 0, true)]
    [InlineData(Projection.Perspective, Shading.PerVertex, 2, false)]
    [Trait("Category", "Soak")]
    public void RightHanded_LooksAsTheMirroredSceneInTheLeftHandedWorldInOtherCases(
        Projection projection, Shading shading, double minProjectedSize, bool hasDefaultLights) =>
        RightHanded_LooksAsTheMirroredSceneInTheLeftHandedWorld(projection, shading, minProjectedSize, hasDefaultLights);

    private static void AssertMirrored(Projection projection, RenderSettings settings, bool hasDefaultLights, double maxMean)
    {
        var camera = new Camera(new(1.4, 0.9, 5), new(0.15, 0.2, 0.1), 50);
        var right = DrawScene(CreateScene(Handedness.Right, isMirrored: false, hasDefaultLights), camera, projection, settings);
        var mirroredCamera = camera with { Position = MirrorZ(camera.Position) };
        var left = DrawScene(CreateScene(Handedness.Left, isMirrored: true, hasDefaultLights), mirroredCamera, projection, settings);
        Assert.True(RenderScenes.CountDifferent(right, right[0, 0]) > 3000, "nothing is visible");
        var (mean, share) = RenderScenes.Difference(left, right);
        Assert.True(mean < maxMean && share < 0.001, $"mean {mean}, share {share}");
    }

    [SkippableFact]
    public void RightHanded_WithoutOptimisations_LooksTheSame()
    {
        var scene = CreateScene(Handedness.Right, isMirrored: false, hasDefaultLights: true);
        var camera = new Camera(new(1.4, 0.9, 5), new(0.15, 0.2, 0.1), 50);
        var plain = DrawScene(scene, camera, Projection.Perspective, new() { Culling = null, BackFaceCulling = false });
        var optimised = DrawScene(scene, camera, Projection.Perspective, new() { Culling = new() { MinProjectedSize = 1e-9 } });
        Assert.True(RenderScenes.Difference(plain, optimised).Share < 0.001);
    }

    [SkippableFact]
    public void DeepZoom_RightHanded_LooksAsTheMirroredOne()
    {
        var right = DrawDive(Handedness.Right, out var rightDepth);
        var left = DrawDive(Handedness.Left, out var leftDepth);
        Assert.True(rightDepth > 20);
        Assert.Equal(leftDepth, rightDepth);
        Assert.True(RenderScenes.CountDifferent(right, right[0, 0]) > 1000, "nothing is visible");
        // Thousands of zooms round differently, and move some edges over a sample.
        Assert.True(RenderScenes.Difference(left, right) is { Mean: < 0.5, Share: < 0.02 });
    }

    /// <summary>Dives to a corner of the sponge, which is its own mirror image.</summary>
    private static PixelImage DrawDive(Handedness handedness, out int depth)
    {
        // All that is seen lies in a shadow.
        var settings = new RenderSettings { Samples = 0, Shadows = false, AmbientOcclusion = false };
        var model = RenderScenes.Menger(null);
        var scene = RenderScenes.Scene(
            new() { Handedness = handedness, Lights = [RenderScenes.FullLight, new DirectionalLight(new(1, -2, 0), Colour.White, 0.5)] },
            (model, Transformation.Identity, null));
        var start = handedness.Mirror(new(-3, 3, -3.2));
        var direction = handedness.Mirror(handedness.Mirror(new(-1, 1, -1)) - start);
        var camera = new Camera(start, CameraFraming.LookRotation(direction), 50) { Handedness = handedness };
        var prepared = DrawableScene.Prepare(scene, settings);
        var flying = new FlyingCamera(
            scene.Bounds, camera, Projection.Perspective, null, new(0, prepared.Models[0].LodHierarchy!, AffineMap.Identity));
        for (var i = 0; i < 200; i++)
        {
            flying.Zoom(0.88);
        }

        flying.Turn(0.2, 0.1);
        flying.Move(0.2 * flying.FocusDistance * new Vector(1, 0.5, 0));
        depth = flying.Depth;
        var view = flying.WithDeepZoom(View.Of(scene, (double)Width / Height, flying.Camera));
        Assert.NotNull(view.DeepZoom);
        return RenderScenes.Draw(scene, view, Width, Height, settings);
    }

    private static Vector MirrorZ(Vector v) => v with { Z = -v.Z };

    private static Mesh MirrorZ(Mesh mesh) => new(
        [.. Enumerable.Range(0, mesh.VertexCount).Select(mesh.Vertex).SelectMany(v => (double[])[v.X, v.Y, -v.Z])],
        [.. mesh.VertexIndices.Chunk(3).SelectMany(face => (int[])[face[0], face[2], face[1]])]);

    /// <summary>Creates a scene without any symmetry: a mesh, a dynamic mesh, and fractals of which one mirrors.</summary>
    private static LoadedScene CreateScene(Handedness handedness, bool isMirrored, bool hasDefaultLights)
    {
        Vector At(double x, double y, double z) => isMirrored ? new(x, y, -z) : new(x, y, z);
        Mesh Shape(Mesh mesh) => isMirrored ? MirrorZ(mesh) : mesh;
        var tetrahedron = Shape(Samples.Tetrahedron);
        ImmutableArray<Transformation> set =
        [
            new(At(0.9, 0, 0.2), Vector.Zero, new(0.5, 0.5, 0.5)),
            new(At(0, 0.9, -0.3), Vector.Zero, new(-0.5, 0.4, 0.5)),
            new(At(-0.8, -0.5, 0.6), Vector.Zero, new(0.4, 0.5, 0.5)),
        ];
        var fractal = new FractalModel(new(new([new Repetition([new TransformationSet(set)], 4)]), tetrahedron)) { SourcePath = "f.fdo" };
        var cube = RenderScenes.Model(RenderScenes.Cube(0.4));
        ImmutableArray<Light> lights =
        [
            new AmbientLight(Colour.White, 0.2),
            new DirectionalLight(At(0.3, -0.8, -0.5), new(1, 0.8, 0.6), 0.6),
            new SpotLight(At(0, 3, 2), At(0.1, -1, -0.6), 60, new(0.5, 0.7, 1), 2, 30),
        ];
        return new(
            new() { Handedness = handedness, Lights = hasDefaultLights ? [] : lights },
            [
                Place(RenderScenes.Model(tetrahedron), At(-1.5, -0.5, 0.8)),
                Place(fractal, At(0.6, 0, 0)),
                Place(fractal, At(-0.4, 0.6, -2)),
                new(new PhysicsObject("cube.obj", new(At(1.6, -0.8, 1), Vector.Zero, Vector.One), 0.5), cube),
            ]);
    }

    private static PlacedModel Place(Model model, Vector position) =>
        new(new SceneObject(model.Name, new(position, Vector.Zero, Vector.One)), model);

    private static PixelImage DrawScene(LoadedScene scene, Camera camera, Projection projection, RenderSettings settings)
    {
        using var context = new SharedContext();
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, settings));
        using var frame = new FrameRenderer(context);
        var mirror = scene.Scene.Handedness == Handedness.Right ? 1 : -1;
        renderer.Lines = [new(new(-2, 1.5, 0), new(1, -1, 2 * mirror), new(1, 0.2, 0.2))];
        var withProjection = scene with { Scene = scene.Scene with { Projection = projection } };
        frame.Draw(renderer, View.Of(withProjection, (double)Width / Height, camera), Width, Height, settings);
        context.Resources.ThrowOnError("drawing");
        return frame.Capture();
    }

    private LoadedFile LoadQuad()
    {
        // Large enough that filtering mixes nothing within a quarter.
        var pixels = Enumerable.Range(0, 256).SelectMany(i => Quarters[(2 * (i / 128)) + (i % 16 / 8)]);
        ImageFile.SavePng(new(16, 16, [.. pixels]), _folder["a.png"]);
        _folder.Write("a.mtl", "newmtl m\nmap_Kd a.png\n");
        return AssetLoader.Load(_folder.Write("quad.obj", Quad));
    }

    private static PixelImage Draw(LoadedScene scene, View view) => RenderScenes.Draw(scene, view, 100, 100);

    /// <summary>Names the colour at a place of an image of the square, from −1 to 1.</summary>
    private static string NameAt(PixelImage image, double right, double up) =>
        NameOf(image[(int)(50 + (50 * right)), (int)(50 - (50 * up))]);

    private static string NameOf((byte Red, byte Green, byte Blue, byte Alpha) colour) => colour switch
    {
        ( > 60, < 60, < 60, _) => "red",
        ( < 60, > 60, < 60, _) => "green",
        ( < 60, < 60, > 60, _) => "blue",
        ( > 60, > 60, > 60, _) => "white",
        _ => $"{colour}",
    };
}
