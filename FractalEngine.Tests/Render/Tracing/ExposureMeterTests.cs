using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Tracing;

namespace FractalEngine.Tests.Render.Tracing;

/// <summary>The exposure that images find by themselves.</summary>
public sealed class ExposureMeterTests
{
    [Theory]
    [InlineData(1e-6)]
    [InlineData(1)]
    [InlineData(3e5)]
    public void Exposure_OfAnEvenScene_ShowsMiddleGrey(double light)
    {
        // A white square before a background that does not count.
        var scene = RenderScenes.Scene(
            new Scene { Background = new(1, 0, 1), Lights = [new AmbientLight(Colour.White, light)], HasAutoExposure = true, Exposure = 2 },
            (RenderScenes.Model(RenderScenes.Square(1)), Transformation.Identity, Colour.White));
        var exposed = ExposureMeter.Expose(scene, RenderScenes.FrontView, 300, 200, new()).Scene;
        Assert.False(exposed.HasAutoExposure);
        Assert.Equal(scene.Scene with { HasAutoExposure = false, Exposure = exposed.Exposure }, exposed);
        // Pixels at the edge are darker, and shift the mean a little.
        Assert.InRange(exposed.Exposure * light, 2 * 0.18 * 0.999, 2 * 0.18 * 1.3);
        Assert.Equal(exposed, ExposureMeter.Expose(scene, RenderScenes.FrontView, 300, 200, new()).Scene);
    }

    [Fact]
    public void Exposure_OfAFixedScene_IsKept()
    {
        var scene = RenderScenes.WhiteOnBlack(RenderScenes.Square(1), Transformation.Identity);
        Assert.Same(scene, ExposureMeter.Expose(scene, RenderScenes.FrontView, 30, 20, new()));
    }

    [Fact]
    public void ExposureOf_AnyLuminances_IsThatOfTheMiddleOnes()
    {
        Assert.Equal(1, ExposureMeter.ExposureOf([]));
        Assert.Equal(1, ExposureMeter.ExposureOf([0, 0]));
        Assert.Equal(0.18 / 4, ExposureMeter.ExposureOf([0, 2, 8]), 1e-15);
        // Of twenty, the two darkest and the brightest are left out.
        double[] many = [1e-30, 1e-20, .. Enumerable.Repeat(0.5, 17), 1e9];
        Assert.Equal(0.36, ExposureMeter.ExposureOf(many.Reverse()), 1e-15);
    }
}
