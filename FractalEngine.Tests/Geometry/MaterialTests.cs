using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry;

/// <summary>Materials in frames: textures, several materials on a mesh, highlights, transparency and both kinds of shading.</summary>
[Collection(GlTests.Name)]
public sealed class MaterialTests : IDisposable
{
    private static readonly (byte, byte, byte, byte)[] Quarters =
        [(200, 30, 40, 255), (50, 180, 60, 255), (70, 80, 210, 255), (230, 220, 90, 255)];

    // The square of half size 1 fills a frame of 200 × 200 pixels from edge to edge.
    private static readonly View Square = new(Camera.Default, Projection.Orthographic) { OrthographicHeight = 2 };

    private readonly TexturedScenes _scenes = new();

    public void Dispose() => _scenes.Dispose();

    [SkippableTheory]
    [InlineData(Shading.PerVertex)]
    [InlineData(Shading.PerPixel)]
    public void Texture_InFullLight_HasTheImagesColoursInTheirPlaces(Shading shading)
    {
        var image = Draw(TexturedSquareScene(CreateQuarteredTexture()), shading);
        // Within texels of one colour, filtering mixes nothing. One step is the rounding from sRGB to light and back.
        AssertNear(Quarters[0], image[50, 50]);
        AssertNear(Quarters[1], image[150, 50]);
        AssertNear(Quarters[2], image[50, 150]);
        AssertNear(Quarters[3], image[150, 150]);
    }

    [SkippableTheory]
    [InlineData(false, 0)]
    [InlineData(true, 1)]
    public void Texture_BeyondItsEdges_RepeatsOrClamps(bool isClamped, int quarterBeyond)
    {
        // u runs from 0 to 2 and v stays in the upper row: the texture, and then its continuation.
        var texture = CreateQuarteredTexture() with { Scale = (2, 0), Offset = (0, 0.75), IsClamped = isClamped };
        var image = Draw(TexturedSquareScene(texture), Shading.PerVertex);
        AssertNear(Quarters[0], image[25, 100]);
        AssertNear(Quarters[1], image[75, 100]);
        AssertNear(Quarters[quarterBeyond], image[125, 100]);
        AssertNear(Quarters[1], image[175, 100]);
    }

    [SkippableFact]
    public void Texture_Moved_StartsElsewhere()
    {
        var image = Draw(TexturedSquareScene(CreateQuarteredTexture() with { Offset = (0.5, 0) }), Shading.PerVertex);
        AssertNear(Quarters[1], image[50, 50]);
        AssertNear(Quarters[0], image[150, 50]);
    }

    [SkippableFact]
    public void Texture_FarAway_IsTheMeanOfItsLight()
    {
        var texture = _scenes.CreateTexture("chess.png", 256, 256, (x, y) => (x + y) % 2 == 0
            ? (byte.MaxValue, byte.MaxValue, byte.MaxValue, byte.MaxValue)
            : ((byte)0, (byte)0, (byte)0, byte.MaxValue));
        var view = Square with { OrthographicHeight = 16 };
        var image = RenderScenes.Draw(TexturedSquareScene(texture), view, 200, 200, new() { Samples = 0 });
        for (var x = 90; x < 110; x++)
        {
            // Half of the light is 188 of 255; drivers that average the bytes would give 128, and one without mipmaps 0 or 255.
            Assert.InRange(image[x, 97].Red, 185, 191);
        }
    }

    [SkippableFact]
    public void Texture_TimesDiffuseAndTint_MultipliesInLinearLight()
    {
        var texture = _scenes.CreateTexture("even.png", 4, 4, (_, _) => (200, 200, 200, 255));
        var model = TexturedScenes.CreateSquare(1, new("m") { Texture = texture, Diffuse = new(0.5, 1, 1) });
        var scene = RenderScenes.Scene(FullLightOnBlack, (model, Transformation.Identity, new Colour(1, 0.5, 1)));
        var image = RenderScenes.Draw(scene, Square, 200, 200);
        AssertLinear(Linear(200 / 255.0) * Linear(0.5), image[100, 100].Red);
        AssertLinear(Linear(200 / 255.0) * Linear(0.5), image[100, 100].Green);
        AssertLinear(Linear(200 / 255.0), image[100, 100].Blue);
    }

    [SkippableTheory]
    [InlineData(Shading.PerVertex)]
    [InlineData(Shading.PerPixel)]
    public void VertexColours_AreMultipliedInLinearLight(Shading shading)
    {
        var (red, green) = (new Colour(1, 0.25, 0.5), new Colour(0.5, 1, 0));
        var colours = (Colour[])[red, green, red, green];
        var texture = _scenes.CreateTexture("even.png", 4, 4, (_, _) => (200, 200, 200, 255));
        var plain = TexturedScenes.TexturedSquare(1).WithColours([.. colours.SelectMany(c => (double[])[c.Red, c.Green, c.Blue])]);
        foreach (var material in (Material?[])[null, new("m") { Diffuse = new(0.5, 1, 1) }, new("m") { Texture = texture }])
        {
            var model = material is null ? RenderScenes.Model(plain) : TexturedScenes.WithMaterial(plain, material);
            var image = Draw(RenderScenes.Scene(FullLightOnBlack, (model, Transformation.Identity, null)), shading);
            var surface = material is null ? 1 : material.Texture is null ? Linear(0.5) : Linear(200 / 255.0);
            // A quarter and three quarters of the way from the left to the right edge.
            AssertLinear(surface * ((0.75 * 1) + (0.25 * Linear(0.5))), image[50, 100].Red);
            AssertLinear(surface * ((0.25 * 1) + (0.75 * Linear(0.5))), image[150, 100].Red);
        }
    }

    [SkippableFact]
    public void VertexColours_OfAFractalBeyondTheRange_AreLimitedAndTinted()
    {
        var mesh = RenderScenes.Square(1).WithColours([2, -1, 0.5, 2, -1, 0.5, 2, -1, 0.5, 2, -1, 0.5]);
        var set = new TransformationSet([Transformation.Identity with { Scale = new(0.5, 0.5, 0.5) }]);
        var fractal = new FractalModel(new(new([set]), mesh)) { SourcePath = "f.fdo" };
        var image = Draw(
            RenderScenes.Scene(FullLightOnBlack, (fractal, Transformation.Identity, new Colour(0.5, 1, 1))), Shading.PerVertex);
        AssertNear((128, 0, 128, 255), image[100, 100]);
    }

    [SkippableFact]
    public void Texture_Undecodable_IsGreyWithANotice()
    {
        var texture = _scenes.CreateBrokenTexture("broken.png");
        var scene = TexturedSquareScene(texture);
        var notice = Assert.Single(DrawableScene.Prepare(scene, new()).Notices);
        Assert.StartsWith($"{texture.Path}:1:1: warning: the texture can't be decoded, drawn grey: ", notice, StringComparison.Ordinal);
        AssertNear((153, 153, 153, 255), RenderScenes.Draw(scene, Square, 200, 200)[100, 100]);
    }

    [Fact]
    public void Texture_OfManyMaterialsAndObjects_IsDecodedOnce()
    {
        var texture = _scenes.CreateTexture("a.png", 2, 2, (_, _) => (1, 2, 3, 255));
        var scene = DrawableScene.Prepare(
            RenderScenes.Scene(
                FullLightOnBlack,
                (TexturedScenes.CreateSquare(1, new("a") { Texture = texture }), Transformation.Identity, null),
                (TexturedScenes.CreateSquare(1, new("b") { Texture = texture with { IsClamped = true } }), Transformation.Identity, null)),
            new());
        Assert.Same(Assert.Single(scene.Textures), scene.Models[1].Batches[0].Material!.Texture);
        Assert.Same(scene.Textures[0], scene.Models[0].Batches[0].Material!.Texture);
    }

    [SkippableFact]
    public void Materials_OnOneMesh_AreEachOnTheirOwnFaces()
    {
        var texture = _scenes.CreateTexture("blue.png", 1, 1, (_, _) => (20, 40, 200, 255));
        // Two triangles of the square, then two above it without texture coordinates. The materials alternate, and one is unknown.
        var mesh = new Mesh(
            [-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0, -1, 3, 0, 1, 3, 0],
            [0, 2, 1, 2, 4, 3, 1, 2, 3, 3, 4, 5])
            .WithTextureCoordinates([0.5, 0.5], [0, 0, 0, -1, -1, -1, -1, -1, -1, -1, -1, -1])
            .WithGroups(
                [new(0, 1, "", "", "blue", 0), new(1, 1, "", "", "red", 0), new(2, 1, "", "", "blue", 0), new(3, 1, "", "", "unknown", 0)],
                []);
        var model = new MeshModel(mesh)
        {
            SourcePath = "m.obj",
            Materials = ImmutableDictionary<string, Material>.Empty
                .Add("blue", new("blue") { Texture = texture, Diffuse = new(1, 1, 0) })
                .Add("red", new("red") { Diffuse = new(1, 0, 0) }),
        };
        var scene = RenderScenes.Scene(FullLightOnBlack, (model, Transformation.Identity, null));
        var drawable = DrawableScene.Prepare(scene, new()).Models[0];
        Assert.Equal(12, drawable.Indices.Length);
        Assert.Equal(
            [(0, 3, "blue"), (3, 3, "red"), (6, 3, "blue"), (9, 3, null)],
            drawable.Batches.Select(batch => (batch.FirstIndex, batch.IndexCount, batch.Material?.Material.Name)));

        var image = RenderScenes.Draw(scene, Square with { OrthographicHeight = 8 }, 200, 200);
        // At 25 pixels a unit, from the centre of the frame.
        Assert.Equal(0, image[90, 110].Blue); // the texture's blue times 0
        AssertLinear(Linear(20 / 255.0), image[90, 110].Red);
        AssertNear((255, 0, 0, 255), image[88, 60]);
        AssertNear((255, 255, 0, 255), image[115, 85]); // of the same material, without texture coordinates
        AssertNear(Bytes(ObjectPalette.ColourOf(0)), image[110, 35]);
    }

    [Fact]
    public void Faces_OfInterleavedMaterials_AreOneBatchAMaterial()
    {
        var mesh = RenderScenes.Cube(1).WithGroups(
            [.. Enumerable.Range(0, 12).Select(face => new MeshGroup(face, 1, "", "", face % 2 == 0 ? "even" : "odd", 0))], []);
        var model = new MeshModel(mesh)
        {
            SourcePath = "m.obj",
            Materials = ImmutableDictionary<string, Material>.Empty.Add("even", new("even")).Add("odd", new("odd")),
        };
        var scene = RenderScenes.Scene(FullLightOnBlack, (model, Transformation.Identity, null));
        var batches = DrawableScene.Prepare(scene, new()).Models[0].Batches;
        Assert.Equal(
            [(0, 18, "even"), (18, 18, "odd")],
            batches.Select(batch => (batch.FirstIndex, batch.IndexCount, batch.Material!.Material.Name)));
    }

    [SkippableTheory]
    [InlineData(Shading.PerVertex)]
    [InlineData(Shading.PerPixel)]
    public void Ambient_Factor_ActsOnAmbientLightOnly(Shading shading)
    {
        var model = TexturedScenes.CreateSquare(1, new("m") { Ambient = new(0.5, 0, 1) });
        var lights = new Scene { Lights = [new AmbientLight(Colour.White, 0.4), new DirectionalLight(Vector.K, Colour.White, 0.3)] };
        var centre = Draw(RenderScenes.Scene(lights, (model, Transformation.Identity, null)), shading)[100, 100];
        AssertLinear(0.5, centre.Red);
        AssertLinear(0.3, centre.Green);
        AssertLinear(0.7, centre.Blue);
    }

    [SkippableFact]
    public void Highlight_AtTheCentreOfALargeFace_IsVisiblePerPixelOnly()
    {
        var model = TexturedScenes.CreateSquare(1, new("m") { Diffuse = Colour.Black, Specular = Colour.White, SpecularExponent = 60 });
        var scene = RenderScenes.Scene(
            new() { Lights = [new PointLight(new(0, 0, -0.5), Colour.White, 1, 5)] }, (model, Transformation.Identity, null));
        var perPixel = RenderScenes.Draw(scene, Square, 200, 200, new() { Shading = Shading.PerPixel });
        Assert.Equal(byte.MaxValue, perPixel[100, 100].Red);
        Assert.InRange(perPixel[10, 10].Red, 0, 60);
        Assert.InRange(RenderScenes.Draw(scene, Square, 200, 200, new() { Shading = Shading.PerVertex })[100, 100].Red, 0, 60);
    }

    [SkippableFact]
    public void Shading_OfAFlatFaceInParallelLight_IsTheSameAtVerticesAndPixels()
    {
        var lights = new Scene
        {
            Lights = [new AmbientLight(new(0.4, 0.5, 0.9), 0.3), new DirectionalLight(new(0.3, -0.5, 0.7), new(1, 0.8, 0.6), 0.8)],
        };
        var model = TexturedScenes.CreateSquare(1, new("m") { Texture = CreateQuarteredTexture(), Diffuse = new(0.9, 0.8, 0.7) });
        var scene = RenderScenes.Scene(lights, (model, new(Vector.Zero, new(20, 30, 10), new(1, 0.7, 1)), null));
        var perVertex = RenderScenes.Draw(scene, RenderScenes.FrontView, settings: new() { Shading = Shading.PerVertex });
        var perPixel = RenderScenes.Draw(scene, RenderScenes.FrontView, settings: new() { Shading = Shading.PerPixel, Shadows = false });
        // Interpolation and normalisation round differently.
        Assert.All(perVertex.Pixels.Zip(perPixel.Pixels), pair => Assert.InRange(pair.First - pair.Second, -1, 1));
        Assert.True(RenderScenes.CountDifferent(perPixel, perPixel[0, 0]) > 1000);
    }

    [SkippableTheory]
    [InlineData(1, 1, 1)]
    [InlineData(-1, 1, 1)]
    [InlineData(1, -1, -1)]
    public void Shading_OfAFineSphere_IsTheSameAtVerticesAndPixels_AlsoSkewedAndMirrored(double x, double y, double z)
    {
        // A scale, a rotation and another scale: a map that skews. The visible face is the outer one under any map.
        var set = new TransformationSet([new(Vector.Zero, new(30, 40, 20), new(x, 0.6 * y, z))]);
        var model = new FractalModel(new(new([set]), RenderScenes.Sphere(48))) { SourcePath = "sphere.fdo" };
        var placement = new Transformation(Vector.Zero, new(10, 20, 70), new(1.2, 0.8, 1));
        var scene = RenderScenes.Scene(new(), (model, placement, null));
        var perVertex = RenderScenes.Draw(scene, RenderScenes.FrontView, 400, 300, new() { Shading = Shading.PerVertex });
        var perPixel = RenderScenes.Draw(scene, RenderScenes.FrontView, 400, 300, new() { Shading = Shading.PerPixel, Shadows = false });
        Assert.True(RenderScenes.Difference(perVertex, perPixel) is { Mean: < 0.3, Share: < 0.002 });

        // The same surface with mapped vertices and newly generated normals has no map that could spoil them.
        var moved = RenderScenes.Sphere(48).Transform(vertex => placement.ToAffineMap() * (model.Fractal.LevelAt(0).Maps[0] * vertex));
        var expected = RenderScenes.Draw(
            RenderScenes.Scene(new(), (RenderScenes.Model(moved), Transformation.Identity, null)), RenderScenes.FrontView, 400, 300,
            new() { Shading = Shading.PerPixel, Shadows = false });
        var difference = RenderScenes.Difference(expected, perPixel);
        Assert.True(difference is { Mean: < 0.5, Share: < 0.005 }, $"{difference}");
    }

    [SkippableTheory]
    [InlineData(Tone.None)]
    [InlineData(Tone.Filmic)]
    public void Highlight_OnClearGlass_IsAsBrightAsOnAnOpaqueSurface(Tone tone)
    {
        // The light stands behind the camera, so that the middle of the square mirrors it into the eye.
        var declared = new Scene
        {
            Background = Colour.Black, Lights = [new DirectionalLight(new(0, 0, 1), Colour.White, 1)], Tone = tone, Exposure = 4,
        };
        byte Middle(double opacity)
        {
            var material = new Material("m") { Diffuse = Colour.Black, Specular = Colour.White, SpecularExponent = 50, Opacity = opacity };
            var model = TexturedScenes.WithMaterial(RenderScenes.Square(1), material);
            var scene = RenderScenes.Scene(declared, (model, Transformation.Identity, null));
            return RenderScenes.Draw(scene, RenderScenes.FrontView, 100, 100)[50, 50].Red;
        }

        Assert.InRange(Middle(1), 200, 255);
        Assert.InRange(Middle(0.1), Middle(1) - 3, 255);
    }

    [SkippableTheory]
    [InlineData(0, 1, 2)]
    [InlineData(2, 1, 0)]
    [InlineData(1, 2, 0)]
    public void Transparent_InAnyOrderOfTheScene_BlendsBackToFront(params int[] order)
    {
        var near = TexturedScenes.CreateSquare(1, new("red") { Diffuse = new(1, 0, 0), Opacity = 0.25 }, "near.obj");
        var middle = TexturedScenes.CreateSquare(1, new("green") { Diffuse = new(0, 1, 0), Opacity = 0.5 }, "middle.obj");
        var far = TexturedScenes.CreateSquare(1, new("white"), "far.obj");
        (Model, Transformation, Colour?)[] objects =
        [
            (near, RenderScenes.TranslatedTo(0, 0, -1), null),
            (middle, Transformation.Identity, null),
            (far, RenderScenes.TranslatedTo(0, 0, 1), null),
        ];
        var image = RenderScenes.Draw(RenderScenes.Scene(FullLightOnBlack, [.. order.Select(i => objects[i])]), Square, 200, 200);
        // White, half covered by green, of that a quarter by red.
        AssertLinear((0.75 * 0.5) + 0.25, image[100, 100].Red);
        AssertLinear(0.75, image[100, 100].Green);
        AssertLinear(0.75 * 0.5, image[100, 100].Blue);
        Assert.Equal(255, image[100, 100].Alpha);
    }

    [SkippableFact]
    public void Transparent_Solid_ShowsItsBackThroughItsFront()
    {
        // Twice half covered, whatever the order of the faces and whether the object is mirrored or not.
        foreach (var mirror in (double[])[1, -1])
        {
            var model = TexturedScenes.WithMaterial(RenderScenes.Cube(0.5), new("m") { Diffuse = Colour.Black, Opacity = 0.5 });
            var scene = RenderScenes.Scene(
                new() { Lights = [RenderScenes.FullLight], Background = Colour.White },
                (model, Transformation.Identity with { Scale = new(1, 1, mirror) }, null));
            AssertLinear(0.25, RenderScenes.Draw(scene, Square, 200, 200)[100, 100].Red);
        }
    }

    [SkippableFact]
    public void Transparent_BehindAnOpaqueOne_IsHidden()
    {
        var glass = TexturedScenes.CreateSquare(1, new("glass") { Diffuse = new(1, 0, 0), Opacity = 0.5 });
        var wall = TexturedScenes.CreateSquare(0.5, new("wall") { Diffuse = new(0, 0, 1) });
        var scene = RenderScenes.Scene(
            FullLightOnBlack, (glass, RenderScenes.TranslatedTo(0, 0, 1), null), (wall, Transformation.Identity, null));
        var image = RenderScenes.Draw(scene, Square, 200, 200);
        AssertNear((0, 0, 255, 255), image[100, 100]);
        AssertLinear(0.5, image[20, 20].Red);
    }

    [SkippableTheory]
    [InlineData(false)]
    [InlineData(true)]
    public void OpacityTexture_WithSharpEdges_CutsOutInAnyOrder(bool hasColours)
    {
        // The left half is a hole, given by lightness. The nearer leaf is drawn first, and must not hide the farther one behind its hole.
        var opacity = _scenes.CreateTexture("leaf.png", 16, 16, (x, _) => x < 8 ? ((byte)0, (byte)0, (byte)0, byte.MaxValue)
            : (byte.MaxValue, byte.MaxValue, byte.MaxValue, byte.MaxValue));
        var colours = hasColours ? _scenes.CreateTexture("green.png", 4, 4, (_, _) => (0, 255, 0, 255)) : null;
        var leaf = TexturedScenes.CreateSquare(1, new("leaf")
        {
            Diffuse = new(0, 1, 0), Texture = colours, OpacityTexture = opacity, Specular = new(0, 0.04, 0), SpecularExponent = 5000,
        });
        var wall = TexturedScenes.CreateSquare(1, new("wall") { Diffuse = new(0, 0, 1) });
        var scene = RenderScenes.Scene(
            FullLightOnBlack, (leaf, RenderScenes.TranslatedTo(0, 0, -1), null), (leaf, RenderScenes.TranslatedTo(-1, 0, 0), null),
            (wall, RenderScenes.TranslatedTo(0, 0, 1), null));
        var drawable = DrawableScene.Prepare(scene, new());
        Assert.True(drawable.Models[0].Batches[0].Material is { IsCutOut: true, IsTransparent: false });
        Assert.True(drawable.Models[0] is { HasTransparentBatches: false, IsSeeThrough: true });
        var image = RenderScenes.Draw(scene, Square, 200, 200);
        AssertNear((0, 255, 0, 255), image[150, 100]);
        AssertNear((0, 255, 0, 255), image[50, 100]); // the farther leaf, whose own hole is beyond the left edge
        var far = RenderScenes.Scene(
            FullLightOnBlack, (leaf, RenderScenes.TranslatedTo(0, 0, -1), null), (wall, RenderScenes.TranslatedTo(0, 0, 1), null));
        AssertNear((0, 0, 255, 255), RenderScenes.Draw(far, Square, 200, 200)[50, 100]);
    }

    [SkippableFact]
    public void OpacityTexture_WithAHole_HidesNothingBehindIt()
    {
        var opacity = _scenes.CreateTexture("hole.png", 16, 16, (x, _) => (255, 255, 255, (byte)(x < 8 ? 0 : 255)));
        var leaf = TexturedScenes.CreateSquare(1, new("leaf") { Diffuse = new(0, 1, 0), OpacityTexture = opacity });
        var scene = RenderScenes.Scene(
            FullLightOnBlack, (leaf, RenderScenes.TranslatedTo(0, 0, -2), null), (RenderScenes.Menger(3), Transformation.Identity, null));
        var culled = RenderScenes.Draw(scene, Square, 200, 200, new() { Culling = new() { MinProjectedSize = 1e-9 } });
        var whole = RenderScenes.Draw(scene, Square, 200, 200, new() { Culling = null });
        Assert.Equal(whole.Pixels, culled.Pixels);
        AssertNear((0, 255, 0, 255), culled[150, 100]);
        Assert.NotEqual(0, culled[3, 3].Red);
    }

    [SkippableTheory]
    [InlineData(1)]
    [InlineData(0.5)]
    public void OpacityTexture_ThatIsSoft_Blends(double opacity)
    {
        // An opacity of 128 of 255 by the alpha of the image, whose colours don't count.
        var soft = _scenes.CreateTexture("smoke.png", 4, 4, (_, _) => (255, 0, 0, 128));
        var smoke = TexturedScenes.CreateSquare(1, new("smoke") { OpacityTexture = soft, Opacity = opacity });
        var scene = RenderScenes.Scene(FullLightOnBlack, (smoke, Transformation.Identity, null));
        Assert.True(DrawableScene.Prepare(scene, new()).Models[0].HasTransparentBatches);
        AssertLinear(opacity * 128 / 255, RenderScenes.Draw(scene, Square, 200, 200)[100, 100].Green);
    }

    [SkippableFact]
    public void OpacityTexture_Undecodable_IsOpaqueWithANotice()
    {
        var broken = _scenes.CreateBrokenTexture("broken.png");
        var model = TexturedScenes.CreateSquare(1, new("m") { OpacityTexture = broken });
        var scene = RenderScenes.Scene(FullLightOnBlack, (model, Transformation.Identity, null));
        Assert.StartsWith(
            $"{broken.Path}:1:1: warning: the texture can't be decoded, drawn opaque: ",
            Assert.Single(DrawableScene.Prepare(scene, new()).Notices), StringComparison.Ordinal);
        AssertNear((255, 255, 255, 255), RenderScenes.Draw(scene, Square, 200, 200)[100, 100]);
    }

    [SkippableFact]
    public void OpacityTexture_BesideAnUndecodableTexture_CutsOutOfGrey()
    {
        var opacity = _scenes.CreateTexture("mask.png", 16, 16, (x, _) => (255, 255, 255, (byte)(x < 8 ? 0 : 255)));
        var broken = _scenes.CreateBrokenTexture("leaf.png");
        var leaf = TexturedScenes.CreateSquare(1, new("leaf") { Texture = broken, OpacityTexture = opacity });
        var scene = RenderScenes.Scene(FullLightOnBlack, (leaf, Transformation.Identity, null));
        Assert.StartsWith(
            $"{broken.Path}:1:1: warning: the texture can't be decoded, drawn grey: ",
            Assert.Single(DrawableScene.Prepare(scene, new()).Notices), StringComparison.Ordinal);
        var image = RenderScenes.Draw(scene, Square, 200, 200);
        AssertNear((0, 0, 0, 255), image[50, 100]);
        AssertNear((153, 153, 153, 255), image[150, 100]);
        var tracer = new PathTracer(scene, Square, 20, 20);
        tracer.AddSample();
        Assert.Equal(0, tracer.RadianceAt(5, 10).X);
        Assert.Equal(Linear(0.6), tracer.RadianceAt(15, 10).X, 1e-3);
    }

    [SkippableTheory]
    [InlineData(Shading.PerVertex)]
    [InlineData(Shading.PerPixel)]
    public void Emission_IsAddedToTheLight_AlsoInTheDark(Shading shading)
    {
        var glowing = TexturedScenes.CreateSquare(1, new("m") { Diffuse = new(0.5, 0.5, 0.5), Emission = new(0.25, 0, 7) });
        foreach (var intensity in (double[])[0, 1])
        {
            var scene = RenderScenes.Scene(
                new() { Lights = [new AmbientLight(Colour.White, intensity)], Background = Colour.Black },
                (glowing, Transformation.Identity, null));
            var (red, green, blue, _) = Draw(scene, shading)[100, 100];
            AssertLinear((intensity * Linear(0.5)) + 0.25, red);
            AssertLinear(intensity * Linear(0.5), green);
            Assert.Equal(255, blue);
        }
    }

    [SkippableFact]
    public void Transparent_TexelsOfATexture_ShowTheBackground()
    {
        var texture = _scenes.CreateTexture("holes.png", 16, 1, (x, _) => (255, 255, 255, x < 8 ? (byte)0 : (byte)255));
        var image = RenderScenes.Draw(
            RenderScenes.Scene(
                new() { Lights = [RenderScenes.FullLight], Background = new(0, 0, 1) },
                (TexturedScenes.CreateSquare(1, new("m") { Texture = texture, Specular = Colour.White }), Transformation.Identity, null)),
            Square, 200, 200);
        AssertNear((0, 0, 255, 255), image[50, 100]);
        AssertNear((255, 255, 255, 255), image[150, 100]);
    }

    [SkippableFact]
    public void Wireframe_OfMaterials_IsThatOfTheMeshAlone()
    {
        var sphere = RenderScenes.Sphere(6);
        var settings = new RenderSettings { Wireframe = true, Shading = Shading.PerPixel };
        PixelImage DrawEdges(Model model) => RenderScenes.Draw(
            RenderScenes.Scene(FullLightOnBlack, (model, Transformation.Identity, null)), RenderScenes.FrontView, settings: settings);
        var glass = TexturedScenes.WithMaterial(sphere, new("m") { Opacity = 0.1, Specular = Colour.White });
        Assert.Equal(DrawEdges(RenderScenes.Model(sphere)).Pixels, DrawEdges(glass).Pixels);
    }

    [SkippableFact]
    public void Fractal_OfAMeshWithMaterials_LooksLikeItsInstances()
    {
        var texture = CreateQuarteredTexture();
        var square = TexturedScenes.CreateSquare(1, new("m") { Texture = texture });
        var pair = new FractalModel(new(new([new TransformationSet([Half(-0.5), Half(0.5)])]), square.Mesh))
        {
            SourcePath = "pair.fdo",
            Materials = square.Materials,
        };
        var instanced = RenderScenes.Draw(RenderScenes.Scene(FullLightOnBlack, (pair, Transformation.Identity, null)), Square, 200, 200);
        var placed = RenderScenes.Draw(
            RenderScenes.Scene(FullLightOnBlack, (square, Half(-0.5), null), (square, Half(0.5), null)), Square, 200, 200);
        Assert.Equal(placed.Pixels, instanced.Pixels);
        AssertNear(Quarters[0], instanced[25, 75]);

        static Transformation Half(double x) => new(new(x, 0, 0), Vector.Zero, new(0.5, 0.5, 0.5));
    }

    [SkippableTheory]
    [InlineData(Shading.PerVertex)]
    [InlineData(Shading.PerPixel)]
    public void Draw_NothingChanged_AllocatesNothing(Shading shading)
    {
        using var context = new SharedContext();
        var glass = TexturedScenes.WithMaterial(RenderScenes.Sphere(4), new("m") { Opacity = 0.5, Specular = Colour.White });
        var textured = TexturedScenes.CreateSquare(1, new("t") { Texture = CreateQuarteredTexture() });
        var scene = RenderScenes.Scene(
            new() { Lights = [new PointLight(new(0, 3, -3), Colour.White, 1, 30)] },
            (glass, Transformation.Identity, null), (textured, Transformation.Identity, null),
            (glass, RenderScenes.TranslatedTo(1, 0, 0), Colour.Black));
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, new()));
        using var frame = new FrameRenderer(context);
        var (view, settings) = (RenderScenes.FrontView, new RenderSettings { Shading = shading });
        for (var warmUp = 0; warmUp < 3; warmUp++)
        {
            frame.Draw(renderer, view, 64, 64, settings);
        }

        Assert.Equal(0, Allocation.Measure(() => frame.Draw(renderer, view, 64, 64, settings)));
    }

    private static Scene FullLightOnBlack => new() { Lights = [RenderScenes.FullLight], Background = Colour.Black };

    private MaterialTexture CreateQuarteredTexture() =>
        _scenes.CreateTexture("quarters.png", 16, 16, (x, y) => Quarters[(2 * (y / 8)) + (x / 8)]);

    private static LoadedScene TexturedSquareScene(MaterialTexture texture) => RenderScenes.Scene(
        FullLightOnBlack, (TexturedScenes.CreateSquare(1, new("m") { Texture = texture }), Transformation.Identity, null));

    private static PixelImage Draw(LoadedScene scene, Shading shading) =>
        RenderScenes.Draw(scene, Square, 200, 200, new() { Shading = shading });

    private static double Linear(double component) => new Colour(component, 0, 0).ToLinear().Red;

    private static (byte, byte, byte, byte) Bytes(Colour colour) =>
        ((byte)Math.Round(255 * colour.Red), (byte)Math.Round(255 * colour.Green), (byte)Math.Round(255 * colour.Blue), byte.MaxValue);

    /// <summary>Allows half a step of 8 bits where steps are largest, and the error of a driver's interpolation.</summary>
    private static void AssertLinear(double expected, byte found) =>
        Assert.InRange(Linear(found / 255.0), expected - 0.006, expected + 0.006);

    private static void AssertNear(
        (byte Red, byte Green, byte Blue, byte Alpha) expected, (byte Red, byte Green, byte Blue, byte Alpha) found) => Assert.True(
            Math.Abs(expected.Red - found.Red) <= 1 && Math.Abs(expected.Green - found.Green) <= 1
            && Math.Abs(expected.Blue - found.Blue) <= 1 && expected.Alpha == found.Alpha,
            $"expected {expected}, found {found}");
}
