using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Tests.Render;

namespace FractalEngine.Tests.Scenes.Cameras;

[Collection(GlTests.Name)]
public sealed class ProjectionTests
{
    private const int Width = 320;
    private const int Height = 240;

    // A cube of 6 pixels is drawn with its centroid where its centre projects to, up to the perspective within the cube (below 0.05 pixels)
    // and the sampling at 4 points a pixel (below 0.15).
    private const double Tolerance = 0.25;

    public static TheoryData<double, double, double, double, double, double, double> Views => new()
    {
        // camera position, camera rotation (radians), field of view
        { 0, 0, -5, 0, 0, 0, 60 },
        { 1, 2, -6, 0.3, 0.15, 0, 45 },
        { -3, 1, -4, 0.2, -0.6, 0.5, 70 },
        { 4, 3, 2, -0.4, 2.1, 1.2, 90 },
        { 0, 5, 0.1, -1.5, 0, 0, 50 },
    };

    [SkippableTheory]
    [MemberData(nameof(Views))]
    public void Perspective_SmallCube_AppearsWhereProjectSays(
        double x, double y, double z, double pitch, double yaw, double roll, double fieldOfView)
    {
        var camera = new Camera(new(x, y, z), new(pitch, yaw, roll), fieldOfView);
        foreach (var (right, up) in ((double, double)[])[(0, 0), (0.5, 0.4), (-0.6, 0.7), (0.8, -0.3)])
        {
            const double Depth = 5;
            var half = Depth * Math.Tan(fieldOfView * Math.PI / 360);
            var point = camera.Position + (camera.LocalAxes * new Vector(right * half * Width / Height, up * half, Depth));
            var image = RenderScenes.Draw(
                RenderScenes.WhiteOnBlack(RenderScenes.Cube(3 * half / Height * 2), new(point, Vector.Zero, Vector.One)),
                new(camera, Projection.Perspective), Width, Height);

            AssertAt(RenderScenes.Centroid(image), 0.5 * Width * (1 + right), 0.5 * Height * (1 - up));
        }
    }

    [SkippableTheory]
    [MemberData(nameof(Views))]
    public void Orthographic_SmallCube_AppearsWhereProjectSaysAtEveryDepth(
        double x, double y, double z, double pitch, double yaw, double roll, double fieldOfView)
    {
        var camera = new Camera(new(x, y, z), new(pitch, yaw, roll), fieldOfView);
        const double VisibleHeight = 8;
        foreach (var (right, up, depth) in ((double, double, double)[])[(0, 0, 2), (0.5, 0.4, 5), (-0.6, 0.7, 50)])
        {
            var point = camera.Position + (camera.LocalAxes
                * new Vector(0.5 * right * VisibleHeight * Width / Height, 0.5 * up * VisibleHeight, depth));
            var image = RenderScenes.Draw(
                RenderScenes.WhiteOnBlack(RenderScenes.Cube(0.1), new(point, Vector.Zero, Vector.One)),
                new(camera, Projection.Orthographic) { OrthographicHeight = VisibleHeight }, Width, Height);

            AssertAt(RenderScenes.Centroid(image), 0.5 * Width * (1 + right), 0.5 * Height * (1 - up));
        }
    }

    [SkippableFact]
    public void Perspective_FrameFarFromTheOrigin_IsThatNearTheOrigin()
    {
        var near = RenderScenes.Draw(RenderScenes.WhiteOnBlack(RenderScenes.Sphere(12), Transformation.Identity), RenderScenes.FrontView);
        var translation = new Vector(3e7, -2e7, 5e7);
        var far = RenderScenes.Draw(
            RenderScenes.WhiteOnBlack(RenderScenes.Sphere(12), new(translation, Vector.Zero, Vector.One)),
            new(Camera.Default with { Position = Camera.Default.Position + translation }, Projection.Perspective));

        // Floats have steps of 4 units at that distance. Doubles have steps of 1e-8, far below a pixel.
        Assert.True(RenderScenes.Difference(near, far).Share < 0.001);
    }

    [SkippableFact]
    public void Aspect_FixedByTheScene_LeavesDarkerBarsAndSquarePixels()
    {
        var scene = RenderScenes.WhiteOnBlack(RenderScenes.Square(1), Transformation.Identity);
        scene = scene with { Scene = scene.Scene with { Background = new(0.6, 0.6, 0.6) } };
        var image = RenderScenes.Draw(scene, RenderScenes.FrontView with { Aspect = 1 }, 300, 100);

        Assert.Equal((153, 153, 153, 255), image[101, 2]);
        Assert.True(image[99, 50].Red < 153 && image[200, 50].Red < 153, "bars are darker");
        // The square of 2 units at 5 units' distance, 60°: 100·2/(2·5·tan 30°) = 34.6 pixels in both directions.
        var white = Enumerable.Range(0, 300).Count(x => image[x, 50].Red > 250);
        var whiteDown = Enumerable.Range(0, 100).Count(y => image[150, y].Red > 250);
        Assert.InRange(white, 33, 36);
        Assert.InRange(whiteDown, 33, 36);
    }

    private static void AssertAt((double X, double Y) found, double x, double y)
    {
        Assert.InRange(found.X, x - Tolerance, x + Tolerance);
        Assert.InRange(found.Y, y - Tolerance, y + Tolerance);
    }
}
