using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Wavefront;
using FractalEngine.Parsing.Wavefront.Writing;
using FractalEngine.Render;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;
using static System.FormattableString;

namespace FractalEngine.Tests.Render;

[Collection(GlTests.Name)]
public sealed class DrawingTests
{
    private static readonly Camera ObliqueCamera = new(new(-3.2, 2.6, -4), CameraFraming.LookRotation(new(3.2, -2.6, 4)), 45);

    // Meshes and open bases see other parts of the sky than the fractals that look like them.
    private static readonly RenderSettings PlainLight = new() { AmbientOcclusion = false };

    [SkippableFact]
    public void Fractal_Instanced_LooksLikeItsExport()
    {
        var fractal = RenderScenes.Menger(2);
        var flat = ExportAndParse(fractal);
        var placement = new Transformation(new(0.2, -0.1, 0.3), new(20, 30, 10), new(1, 1.2, 0.9));
        var view = new View(ObliqueCamera, Projection.Perspective);
        var instanced = RenderScenes.Draw(RenderScenes.Scene(new Scene(), (fractal, placement, null)), view, 400, 300, PlainLight);
        var meshed = RenderScenes.Draw(
            RenderScenes.Scene(new Scene(), (RenderScenes.Model(flat), placement, null)), view, 400, 300, PlainLight);

        // Products of floats round differently from those of doubles, so that samples on edges may fall to the other side.
        var (mean, share) = RenderScenes.Difference(instanced, meshed);
        Assert.True(mean < 0.05 && share < 0.002, $"mean difference {mean}, share of different pixels {share}");
    }

    [SkippableTheory]
    [InlineData(1)]
    public void Solid_WithBackFaceCulling_LooksTheSame(double mirror)
    {
        var solid = RenderScenes.Menger(2);
        // The same with an invisible face inside the cubes: no longer a closed surface, so both faces are drawn.
        var cube = RenderScenes.Cube(1);
        var open = new FractalModel(new Fractal(
            solid.Fractal.Description,
            new Mesh([.. cube.Positions, 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0], [.. cube.VertexIndices, 8, 9, 10])))
        {
            SourcePath = "open.fdo",
        };
        var placement = Transformation.Identity with { Scale = new(mirror, 1, 1) };
        var view = new View(ObliqueCamera, Projection.Perspective);
        var solidScene = RenderScenes.Scene(new Scene(), (solid, placement, null));
        var openScene = RenderScenes.Scene(new Scene(), (open, placement, null));
        Assert.Equal(1, DrawableScene.Prepare(solidScene, new()).Models[0].WindingSign);
        Assert.Equal(0, DrawableScene.Prepare(openScene, new()).Models[0].WindingSign);
        // Where cubes touch, faces of both have the same depth along edges, and the first one drawn wins a sample.
        var (mean, share) = RenderScenes.Difference(
            RenderScenes.Draw(openScene, view, 400, 300, PlainLight), RenderScenes.Draw(solidScene, view, 400, 300, PlainLight));
        Assert.True(mean < 0.01 && share < 0.0005, $"mean difference {mean}, share of different pixels {share}");

        // From inside a cube its inner sides are visible in both scenes.
        var inside = new View(Camera.Default with { Position = new(0.9, 0.9, 0.9) }, Projection.Perspective);
        Assert.Equal(
            RenderScenes.Draw(openScene, inside, settings: PlainLight).Pixels,
            RenderScenes.Draw(solidScene, inside, settings: PlainLight).Pixels);
    }

    [SkippableTheory]
    [InlineData(-1)]
    [Trait("Category", "Soak")]
    public void Solid_WithBackFaceCullingInOtherCases_LooksTheSame(double mirror) => Solid_WithBackFaceCulling_LooksTheSame(mirror);

    [SkippableTheory]
    [InlineData(false)]
    [InlineData(true)]
    public void Depth_NearerObject_HidesTheFartherInEitherOrder(bool nearFirst)
    {
        (Model, Transformation, Colour?) near =
            (RenderScenes.Model(RenderScenes.Square(0.5), "near.obj"), RenderScenes.TranslatedTo(0, 0, -1), new Colour(1, 0, 0));
        (Model, Transformation, Colour?) far =
            (RenderScenes.Model(RenderScenes.Square(2), "far.obj"), RenderScenes.TranslatedTo(0, 0, 1), new Colour(0, 0, 1));
        var settings = new Scene { Lights = [RenderScenes.FullLight], Background = Colour.Black };
        var scene = nearFirst ? RenderScenes.Scene(settings, near, far) : RenderScenes.Scene(settings, far, near);
        var image = RenderScenes.Draw(scene, RenderScenes.FrontView);

        Assert.Equal((255, 0, 0, 255), image[100, 75]);
        Assert.Equal((0, 0, 255, 255), image[60, 75]);
    }

    [SkippableTheory]
    [InlineData(Projection.Perspective, 1, 4.5, 0)]
    [InlineData(Projection.Perspective, 5.5, 9, 0)]
    [InlineData(Projection.Perspective, 4.5, 5.5, 1)]
    [InlineData(Projection.Orthographic, 1, 4.5, 0)]
    [InlineData(Projection.Orthographic, 5.5, 9, 0)]
    [InlineData(Projection.Orthographic, 4.5, 5.5, 1)]
    public void ClipPlanes_ObjectAtDepthFive_IsDrawnBetweenThemOnly(Projection projection, double near, double far, int drawn)
    {
        var view = new View(Camera.Default, projection) { FixedClipPlanes = (near, far) };
        var image = RenderScenes.Draw(RenderScenes.WhiteOnBlack(RenderScenes.Square(1), Transformation.Identity), view);
        Assert.Equal(drawn, Math.Sign(RenderScenes.CountDifferent(image, (0, 0, 0, 255))));
    }

    [SkippableTheory]
    [InlineData(-1, 1, 1)]
    [InlineData(1, -1, 1)]
    [InlineData(1, 1, -1)]
    [InlineData(-1, -1, -1)]
    public void Mirror_SymmetricSphere_IsLitLikeTheUnmirroredOne(double x, double y, double z)
    {
        var view = new View(ObliqueCamera, Projection.Perspective);
        var unmirrored = RenderScenes.Draw(
            RenderScenes.Scene(new Scene(), (RenderScenes.Model(RenderScenes.Sphere(16)), Transformation.Identity, null)), view);
        var mirrored = RenderScenes.Draw(
            RenderScenes.Scene(
                new Scene(), (RenderScenes.Model(RenderScenes.Sphere(16)), Transformation.Identity with { Scale = new(x, y, z) }, null)),
            view);
        var set = new TransformationSet([Transformation.Identity with { Scale = new(x, y, z) }]);
        var fractal = new FractalModel(new(new([set]), RenderScenes.Sphere(16))) { SourcePath = "mirror.fdo" };
        var instance = RenderScenes.Draw(RenderScenes.Scene(new Scene(), (fractal, Transformation.Identity, null)), view);

        // The diagonals of the faces are mirrored, which changes silhouettes and interpolated colours a little.
        Assert.True(RenderScenes.Difference(unmirrored, mirrored) is { Mean: < 0.3, Share: < 0.01 });
        Assert.True(RenderScenes.Difference(unmirrored, instance) is { Mean: < 0.3, Share: < 0.01 });
    }

    [SkippableFact]
    public void Scale_WithZeros_DrawsTheFlattenedMeshWithoutInvalidColours()
    {
        var scene = RenderScenes.Scene(
            new Scene { Background = Colour.Black },
            (RenderScenes.Model(RenderScenes.Sphere(12)), Transformation.Identity with { Scale = new(1, 1, 0) }, Colour.White));
        var image = RenderScenes.Draw(scene, RenderScenes.FrontView);
        // The disc faces the camera and the key light: it is bright throughout, without dark specks.
        Assert.True(image[100, 75].Red > 100 && image[85, 75].Red > 100 && image[100, 60].Red > 100);

        var point = new SceneObject("x.obj", Transformation.Identity with { Scale = Vector.Zero });
        var gone = RenderScenes.Draw(scene with { Objects = [new(point, scene.Objects[0].Model)] }, RenderScenes.FrontView);
        Assert.Equal(0, RenderScenes.CountDifferent(gone, (0, 0, 0, 255)));
    }

    [SkippableTheory]
    [InlineData(0)]
    [InlineData(4)]
    public void Background_EveryGrey_IsExactAndUniform(int samples)
    {
        using var context = new SharedContext();
        using var frame = new FrameRenderer(context);
        for (var grey = 0; grey < 256; grey += 5)
        {
            var colour = new Colour(grey / 255.0, (255 - grey) / 255.0, grey / 255.0);
            frame.Draw(null, RenderScenes.FrontView, 16, 8, new() { Background = colour, Samples = samples });
            Assert.Equal(0, RenderScenes.CountDifferent(frame.Capture(), ((byte)grey, (byte)(255 - grey), (byte)grey, 255)));
        }
    }

    [SkippableFact]
    public void Wireframe_Sphere_DrawsFewerPixelsThanTheFilledOneAndSome()
    {
        var scene = RenderScenes.WhiteOnBlack(RenderScenes.Sphere(6), Transformation.Identity);
        var filled = RenderScenes.CountDifferent(RenderScenes.Draw(scene, RenderScenes.FrontView, 400, 300), (0, 0, 0, 255));
        var lines = RenderScenes.CountDifferent(
            RenderScenes.Draw(scene, RenderScenes.FrontView, 400, 300, new() { Wireframe = true }), (0, 0, 0, 255));
        Assert.InRange(lines, filled / 20, filled * 3 / 4);
    }

    [SkippableFact]
    public void Samples_None_GivesNoIntermediateColours()
    {
        var image = RenderScenes.Draw(
            RenderScenes.WhiteOnBlack(RenderScenes.Sphere(12), Transformation.Identity), RenderScenes.FrontView,
            settings: new() { Samples = 0 });
        Assert.DoesNotContain(image.Pixels, component => component is not 0 and not 255);
        var smooth = RenderScenes.Draw(RenderScenes.WhiteOnBlack(RenderScenes.Sphere(12), Transformation.Identity), RenderScenes.FrontView);
        Assert.Contains(smooth.Pixels, component => component is not 0 and not 255);
    }

    [SkippableFact]
    public void GridAndAxes_Requested_AreDrawnWithoutAnyObject()
    {
        var empty = RenderScenes.Scene(new Scene { Background = Colour.Black });
        var view = new View(ObliqueCamera, Projection.Perspective);
        Assert.Equal(0, RenderScenes.CountDifferent(RenderScenes.Draw(empty, view), (0, 0, 0, 255)));
        var lines = RenderScenes.Draw(empty, view, settings: new() { Grid = true, Axes = true });
        Assert.InRange(RenderScenes.CountDifferent(lines, (0, 0, 0, 255)), 200, 30_000);
    }

    [SkippableFact]
    public void EmptyMesh_IsPreparedAndDrawnAsNothing()
    {
        var scene = RenderScenes.WhiteOnBlack(Mesh.Empty, Transformation.Identity);
        Assert.Equal(0, RenderScenes.CountDifferent(RenderScenes.Draw(scene, View.Of(scene, 1)), (0, 0, 0, 255)));
    }

    [SkippableFact]
    public void Move_Object_IsDrawnAtItsNewPosition()
    {
        using var context = new SharedContext();
        var scene = DrawableScene.Prepare(RenderScenes.WhiteOnBlack(RenderScenes.Cube(0.2), Transformation.Identity), new());
        using var renderer = new SceneRenderer(context, scene);
        using var frame = new FrameRenderer(context);
        renderer.Move(0, AffineMap.Translate(new(1, 0.5, 20)));
        frame.Draw(renderer, RenderScenes.FrontView, 200, 150, new());
        var expected = RenderScenes.FrontView.Project(new(1, 0.5, 20), 200, 150)!.Value;
        var found = RenderScenes.Centroid(frame.Capture());
        Assert.Equal(expected.X, found.X, 0.3);
        Assert.Equal(expected.Y, found.Y, 0.3);
    }

    [SkippableFact]
    public void Draw_NothingChanged_AllocatesNothing()
    {
        using var context = new SharedContext();
        var scene = RenderScenes.Scene(
            new Scene { Lights = [new PointLight(new(0, 3, -3), Colour.White, 1, 30)] },
            (RenderScenes.Menger(1), Transformation.Identity, null));
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, new()));
        using var frame = new FrameRenderer(context);
        var (view, settings) = (RenderScenes.FrontView, new RenderSettings { Grid = true });
        for (var warmUp = 0; warmUp < 3; warmUp++)
        {
            frame.Draw(renderer, view, 64, 64, settings);
        }

        Assert.Equal(0, Allocation.Measure(() => frame.Draw(renderer, view, 64, 64, settings)));
    }

    [SkippableFact]
    public void Size_BeyondTheDriver_IsRefusedWithTheLimit()
    {
        using var context = GlTests.OpenContext();
        using var frame = new FrameRenderer(context);
        var error = Assert.Throws<GlException>(() => frame.Draw(null, RenderScenes.FrontView, 1_000_000, 10, new()));
        Assert.Equal(
            $"a frame of 1000000×10 pixels cannot be drawn: this driver allows 1 to {context.MaxFrameSize} pixels a side", error.Message);
    }

    /// <summary>Larger pixels have one sample, whatever the settings ask for: culling must not go by the places of four.</summary>
    [SkippableFact]
    public void LargerPixels_OfManySamples_ShowWhatIsAtTheirCentres()
    {
        Transformation[] corners =
        [
            .. Enumerable.Range(0, 8).Select(static i => new Transformation(
                new((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, (i >> 2) - 0.5), new(20, 10, 0), 0.35 * Vector.One)),
        ];
        var dust = Fractal.Of(Shapes.Cube()).Repeat(corners, 3);
        var scene = RenderScenes.Scene(new Scene(), (new FractalModel(dust), Transformation.Identity, new Colour(0.9, 0.6, 0.1)));
        var view = new View(ObliqueCamera, Projection.Perspective);
        var settings = PlainLight with { Samples = 4, PixelSize = 2, Culling = new() { MinProjectedSize = 0 } };
        var everything = RenderScenes.Draw(scene, view, 96, 72, settings with { Culling = null });
        Assert.Equal(everything.Pixels, RenderScenes.Draw(scene, view, 96, 72, settings).Pixels);
    }

    [SkippableTheory]
    [InlineData(2, 200, 150)]
    [InlineData(3, 201, 151)]
    [InlineData(3, 1, 1)]
    public void LargerPixels_AreThoseOfASmallerImage_EnlargedInLinearLight(int pixelSize, int width, int height)
    {
        var scene = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(2), Transformation.Identity, new Colour(0.9, 0.6, 0.1)));
        var view = new View(ObliqueCamera, Projection.Perspective);
        var settings = PlainLight with { Samples = 0 };
        var (smallWidth, smallHeight) = ((width + pixelSize - 1) / pixelSize, (height + pixelSize - 1) / pixelSize);
        var small = RenderScenes.Draw(scene, view, smallWidth, smallHeight, settings);
        var large = RenderScenes.Draw(scene, view, width, height, settings with { PixelSize = pixelSize });
        Assert.Equal((width, height), (large.Width, large.Height));
        for (var y = 0; y < height; y++)
        {
            for (var x = 0; x < width; x++)
            {
                var expected = Interpolate((x + 0.5) * smallWidth / width, (y + 0.5) * smallHeight / height);
                var (red, green, blue, _) = large[x, y];
                Assert.True(
                    Math.Max(Math.Abs(red - expected.X), Math.Max(Math.Abs(green - expected.Y), Math.Abs(blue - expected.Z))) <= 3,
                    Invariant($"({x}, {y}): {red} {green} {blue}, expected {expected}"));
            }
        }

        Vector Interpolate(double x, double y)
        {
            var (left, top) = (Math.Floor(x - 0.5), Math.Floor(y - 0.5));
            var (right, down) = (x - 0.5 - left, y - 0.5 - top);
            var light = (((1 - right) * (1 - down)) * Light(left, top)) + ((right * (1 - down)) * Light(left + 1, top))
                + (((1 - right) * down) * Light(left, top + 1)) + ((right * down) * Light(left + 1, top + 1));
            var colour = new Colour(light.X, light.Y, light.Z).FromLinear();
            return new(255 * colour.Red, 255 * colour.Green, 255 * colour.Blue);
        }

        Vector Light(double x, double y)
        {
            var (red, green, blue, _) = small[(int)Math.Clamp(x, 0, smallWidth - 1), (int)Math.Clamp(y, 0, smallHeight - 1)];
            return new Colour(red / 255.0, green / 255.0, blue / 255.0).ToLinearVector();
        }
    }

    /// <summary>Writes a fractal as <c>export</c> does, and parses the result.</summary>
    private static Mesh ExportAndParse(FractalModel fractal)
    {
        using var stream = new MemoryStream();
        ObjSceneWriter.Write(RenderScenes.Scene(new Scene(), (fractal, Transformation.Identity, null)), stream, 1_000_000);
        return ObjParser.Parse(SourceText.Decode(stream.ToArray(), "export.obj")).Mesh;
    }
}
