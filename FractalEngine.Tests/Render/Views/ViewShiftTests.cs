using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Tracing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Views;

/// <summary>Tests images whose middle is beside that of the frame.</summary>
[Collection(GlTests.Name)]
public sealed class ViewShiftTests
{
    private const int Width = 200;
    private const int Height = 120;

    [Theory]
    [InlineData(0, 0, 200)]
    [InlineData(0.2, 0, 280)]
    [InlineData(-0.2, -80, 280)]
    public void Viewport_Shifted_HasItsMiddleThere(double shift, int x, int width)
    {
        var view = RenderScenes.FrontView with { HorizontalShift = shift };
        Assert.Equal((x, 0, width, Height), view.Viewport(Width, Height));
        var (middle, _, _) = view.Project(Vector.Zero, Width, Height)!.Value;
        Assert.Equal((0.5 + shift) * Width, middle, 1e-9);
        var ray = view.RayThrough(middle, 0.5 * Height, Width, Height);
        Near.Equal(Vector.K, ray.Direction.UnitVector(), 1e-12);
    }

    [Fact]
    public void Viewport_OfAFixedAspect_StaysInTheMiddle() => Assert.Equal(
        (RenderScenes.FrontView with { Aspect = 1 }).Viewport(Width, Height),
        (RenderScenes.FrontView with { Aspect = 1, HorizontalShift = 0.2 }).Viewport(Width, Height));

    [Theory]
    [InlineData(0.5)]
    [InlineData(-0.5)]
    [InlineData(double.NaN)]
    public void HorizontalShift_OutOfItsRange_Throws(double shift) =>
        Assert.Throws<ArgumentException>(() => RenderScenes.FrontView with { HorizontalShift = shift });

    [Fact]
    public void MayIntersectFrustum_Shifted_KnowsTheWiderSide()
    {
        // At the depth of 5 the frame of aspect 5/3 ends at 4.8 to the right, and shifted to the left at 6.7.
        var box = new BoundingBox(new(5.5, -1, -1), new(6, 1, 1));
        Assert.False((RenderScenes.FrontView with { HorizontalShift = 0 }).MayIntersectFrustum(new(new(6, -1, -1), new(7, 1, 0)), 5 / 3.0));
        Assert.True((RenderScenes.FrontView with { HorizontalShift = -0.2 }).MayIntersectFrustum(box, 5 / 3.0));
        var wider = new BoundingBox(new(6.2, -1, -1), new(6.4, 1, 0));
        Assert.True((RenderScenes.FrontView with { HorizontalShift = -0.2 }).MayIntersectFrustum(wider, 5 / 3.0));
        Assert.False((RenderScenes.FrontView with { HorizontalShift = -0.02 }).MayIntersectFrustum(wider, 5 / 3.0));
    }

    /// <summary>A shifted image is a part of a wider one, to the pixel.</summary>
    [SkippableTheory]
    [InlineData(0.2)]
    public void Draw_Shifted_IsAPartOfAWiderImage(double shift)
    {
        var scene = RenderScenes.Scene(
            new() { Lights = [RenderScenes.FullLight], Background = Colour.Black },
            (RenderScenes.Menger(3), Transformation.Identity, new(0.8, 0.6, 0.4)));
        var view = RenderScenes.FrontView with { Camera = RenderScenes.FrontView.Camera with { Rotation = new(0.2, 0.3, 0) } };
        var wide = RenderScenes.Draw(scene, view, 280, Height);
        var shifted = RenderScenes.Draw(scene, view with { HorizontalShift = shift }, Width, Height);
        var left = shift > 0 ? 0 : 80;
        Assert.All(
            Enumerable.Range(0, Width * Height),
            i => Assert.Equal(wide[left + (i % Width), i / Width], shifted[i % Width, i / Width]));
        Assert.Contains(Enumerable.Range(0, Width * Height), i => wide[left + (i % Width), i / Width].Red > 50);
    }

    [SkippableTheory]
    [InlineData(-0.2)]
    [Trait("Category", "Soak")]
    public void Draw_ShiftedInOtherCases_IsAPartOfAWiderImage(double shift) => Draw_Shifted_IsAPartOfAWiderImage(shift);

    [Theory]
    [InlineData(0.2)]
    [InlineData(-0.2)]
    public void TracedCamera_Shifted_HasTheRaysOfThePixelsWithinTheFrame(double shift)
    {
        var view = RenderScenes.FrontView with { HorizontalShift = shift };
        var camera = new TracedCamera(view, Width, Height, 0.5);
        Assert.Equal((0, 0, Width, Height), camera.Viewport);
        var ray = camera.CreateRay(30, 40, (0.5, 0.5), out _, out _);
        Near.Equal(view.RayThrough(30.5, 40.5, Width, Height).Direction.UnitVector(), ray.Direction, 1e-12);
    }
}
