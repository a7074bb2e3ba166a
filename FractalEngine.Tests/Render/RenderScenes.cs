using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render;

/// <summary>Small scenes to draw, and measures of their images.</summary>
internal static class RenderScenes
{
    /// <summary>Light from everywhere at full strength, in which surfaces have exactly their own colour.</summary>
    public static readonly Light FullLight = new AmbientLight(Colour.White, 1);

    public static Mesh Cube(double half) => new(
        [
            -half, -half, -half, half, -half, -half, -half, half, -half, half, half, -half,
            -half, -half, half, half, -half, half, -half, half, half, half, half, half,
        ],
        [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 4, 2, 4, 6, 2, 1, 3, 5, 3, 7, 5, 2, 6, 3, 3, 6, 7, 0, 1, 4, 1, 5, 4]);

    /// <summary>A square in the plane z = 0 whose front face points towards −z.</summary>
    public static Mesh Square(double half) => new(
        [-half, -half, 0, half, -half, 0, -half, half, 0, half, half, 0], [0, 2, 1, 1, 2, 3]);

    /// <summary>A sphere of radius 1 about the origin, with its poles on the y axis.</summary>
    public static Mesh Sphere(int rings)
    {
        var positions = ImmutableArray.CreateBuilder<double>();
        var faces = ImmutableArray.CreateBuilder<int>();
        for (var i = 0; i <= rings; i++)
        {
            for (var j = 0; j < 2 * rings; j++)
            {
                // Exactly 0 at both poles.
                var (sine, cosine) = double.SinCosPi((double)i / rings);
                var (acrossSine, acrossCosine) = double.SinCosPi((double)j / rings);
                positions.AddRange(sine * acrossCosine, cosine, sine * acrossSine);
                if (i < rings)
                {
                    var (a, b) = ((i * 2 * rings) + j, (i * 2 * rings) + ((j + 1) % (2 * rings)));
                    faces.AddRange(a, b, a + (2 * rings), b, b + (2 * rings), a + (2 * rings));
                }
            }
        }

        return new(positions.ToImmutable(), faces.ToImmutable());
    }

    public static Model Model(Mesh mesh, string file = "mesh.obj") => new MeshModel(mesh) { SourcePath = file };

    public static FractalModel Menger(int? depth, Composition composition = Composition.Affine) =>
        new(new Fractal(
            new FractalDescription([new Repetition([new TransformationSet(MengerSet())], depth)], composition), Cube(1)))
        { SourcePath = "menger.fdo" };

    public static Transformation TranslatedTo(double x, double y, double z) => Transformation.Identity with { Position = new(x, y, z) };

    public static LoadedScene Scene(Scene scene, params ReadOnlySpan<(Model Model, Transformation Placement, Colour? Colour)> objects) =>
        new(scene, [.. objects.ToArray().Select(item =>
            new PlacedModel(new SceneObject(item.Model.Name, item.Placement) { Colour = item.Colour }, item.Model))]);

    /// <summary>A white mesh in full light on a black background.</summary>
    public static LoadedScene WhiteOnBlack(Mesh mesh, Transformation placement) => Scene(
        new Scene { Background = Colour.Black, Lights = [FullLight] }, (Model(mesh), placement, Colour.White));

    public static PixelImage Draw(LoadedScene scene, View view, int width = 200, int height = 150, RenderSettings? settings = null)
    {
        using var context = new SharedContext();
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, settings ?? new()));
        using var frame = new FrameRenderer(context);
        frame.Draw(renderer, view, width, height, settings ?? new());
        context.Resources.ThrowOnError("drawing");
        return frame.Capture();
    }

    /// <summary>A perspective view from five units before the origin.</summary>
    public static View FrontView => new(Camera.Default, Projection.Perspective);

    /// <summary>Counts the pixels that differ from a colour.</summary>
    public static int CountDifferent(PixelImage image, (byte, byte, byte, byte) colour)
    {
        var count = 0;
        for (var y = 0; y < image.Height; y++)
        {
            for (var x = 0; x < image.Width; x++)
            {
                count += image[x, y] == colour ? 0 : 1;
            }
        }

        return count;
    }

    /// <summary>Returns the centroid of an image on black, weighted by linear light, in pixels from the upper left corner.</summary>
    public static (double X, double Y) Centroid(PixelImage image)
    {
        var (sum, sumX, sumY) = (0.0, 0.0, 0.0);
        for (var y = 0; y < image.Height; y++)
        {
            for (var x = 0; x < image.Width; x++)
            {
                var light = new Colour(image[x, y].Green / 255.0, 0, 0).ToLinear().Red;
                sum += light;
                sumX += light * (x + 0.5);
                sumY += light * (y + 0.5);
            }
        }

        return (sumX / sum, sumY / sum);
    }

    /// <summary>
    /// Returns the mean absolute difference of all components, and the share of pixels with a component that differs by more than 8.
    /// </summary>
    public static (double Mean, double Share) Difference(PixelImage image1, PixelImage image2)
    {
        Assert.Equal((image1.Width, image1.Height), (image2.Width, image2.Height));
        var sum = 0L;
        var different = 0;
        for (var i = 0; i < image1.Pixels.Length; i += 4)
        {
            var maxDifference = 0;
            for (var j = i; j < i + 4; j++)
            {
                var difference = Math.Abs(image1.Pixels[j] - image2.Pixels[j]);
                sum += difference;
                maxDifference = Math.Max(maxDifference, difference);
            }

            different += maxDifference > 8 ? 1 : 0;
        }

        return ((double)sum / image1.Pixels.Length, 4.0 * different / image1.Pixels.Length);
    }

    private static ImmutableArray<Transformation> MengerSet() =>
    [
        .. from x in (int[])[-1, 0, 1]
           from y in (int[])[-1, 0, 1]
           from z in (int[])[-1, 0, 1]
           where Math.Abs(x) + Math.Abs(y) + Math.Abs(z) >= 2
           select new Transformation(2.0 / 3 * new Vector(x, y, z), Vector.Zero, Vector.One / 3),
    ];
}
