using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Shadows;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render;

/// <summary>Which depth maps lights get, without drawing.</summary>
public class ShadowFitTests
{
    private static readonly BoundingBox Bounds = new(-Vector.One, Vector.One);

    [Fact]
    public void Fit_OfMoreLightsThanMaps_LeavesTheOthersAsTheyAreAlone()
    {
        // Lamps within what they light have six maps each: five have 30, a sixth has no place, and a sun has one, the largest.
        Light[] lamps = [.. Enumerable.Range(-2, 5).Select(static i => new PointLight(new(0, 0.1, 0.2 * i), Colour.White, 0.3, 20))];
        var sun = new DirectionalLight(new(0.2, -1, 0.3), Colour.White, 1);
        var without = Fit([.. lamps, sun]);
        var with = Fit([.. lamps, new PointLight(new(0.5, 0, 0), Colour.White, 0.2, 20), sun]);

        Assert.Equal(without.Views, with.Views);
        Assert.Equal((0, 6), with.Ranges[0]);
        Assert.Equal((30, 0), with.Ranges[5]);
        Assert.Equal((30, 1), with.Ranges[6]);
        Assert.True(with.Views[30].Size > with.Views[0].Size);
    }

    [Theory]
    [InlineData(19, 1)]
    [InlineData(5, 0)]
    public void Fit_OfALampWithoutReach_HasNoMap(double range, int count)
    {
        // One of the sides of the cube around it sees what it lights, unless its range ends before that.
        var fit = Fit([new PointLight(new(0, 8, 0), Colour.White, 1, range)]);
        Assert.Equal(count, fit.Views.Count);
        Assert.Equal(6 - count, fit.SkippedCount);
    }

    private static ShadowFit Fit(ImmutableArray<Light> lights)
    {
        var fit = new ShadowFit();
        var view = new View(new(new(0, 1, -6), Vector.Zero, 50), Projection.Perspective);
        var frame = new FrameView(view, 0, 0, 640, 480, 640 / 480.0, 0.1, 20);
        ImmutableArray<Emitter> emitters = [.. lights.Select(static light => light.ToEmitter()!)];
        fit.Fit(emitters, in frame, view.Camera.Position, 1, Bounds, Bounds, fitsToView: false);
        return fit;
    }
}
