using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render;

/// <summary>Drawn ambient occlusion of small fractals, whose parts of the sky are known in closed form.</summary>
[Collection(GlTests.Name)]
public sealed class OcclusionDrawingTests
{
    // A mask has 64 directions, of which the 32 of a half count by their cosine, 1/16 at most, and rounds each that is cut by half of that.
    private const double Tolerance = 0.03;

    // Nothing but the last places of eight bits: what is shown is the same each time.
    private const double RecordedTolerance = 0.005;

    // So dark that next to nothing is reflected twice, and shown so many times brighter.
    private const double Exposure = 25;
    private static readonly Colour Dark = new(0.22, 0.22, 0.22);

    [SkippableFact]
    public void Top_OfACubeUnderAnother_IsAsBrightAsItsPartOfTheSky()
    {
        // A square of the half size a at the height c hides 4 / 2π · 2 · s · atan(s) of a point below its middle, with s = a / √(a² + c²).
        var s = 1 / Math.Sqrt(2);
        var view = TowardsTheTop(1.8, -4);
        Assert.Equal(1 - (4 / Math.PI * s * Math.Atan(s)), PartAtTheMiddle(view, Cube(0, 0), Cube(0, 3)), Tolerance);
    }

    [SkippableFact]
    public void Top_OfACubeInACorner_IsAsBrightAsItsPartOfTheSky()
    {
        // A long wall of the height h over the top, at the distance w from its middle, hides (1 − w / √(w² + h²)) / 2 of the sky.
        var wall = new Transformation(new(1.5, 1, 0), Vector.Zero, new(0.5, 4, 6));
        var expected = 1 - (0.5 * (1 - (1 / Math.Sqrt(17))));
        var part = PartAtTheMiddle(TowardsTheTop(8, -1), Cube(0, 0), wall);
        // Masks show this side too bright: 0.767 for 0.621. They may not come further from the sky, and a change of them is seen.
        Assert.InRange(part, expected - Tolerance, 0.767 + RecordedTolerance);
    }

    [SkippableFact]
    public void Floor_OfASlot_IsAsBrightAsTheSineOfItsOpening()
    {
        // Between two long walls of the height h at the distance w on both sides, sin(atan(w / h)) of the sky is left.
        Transformation Wall(double x) => new(new(x, 0, 0), Vector.Zero, new(0.5, 3, 6));
        var view = TowardsTheTop(8, -1);
        Assert.Equal(Math.Sin(Math.Atan(1 / 2.0)), PartAtTheMiddle(view, Cube(0, 0), Wall(-1.5), Wall(1.5)), Tolerance);
    }

    private static Transformation Cube(double x, double y) => RenderScenes.TranslatedTo(x, y, 0);

    /// <summary>A narrow view of the middle of the top of the first cube, from a height before it.</summary>
    private static View TowardsTheTop(double y, double z) =>
        new(new Camera(new(0, y, z), new(Math.Atan2(1 - y, -z), 0, 0), 1), Projection.Perspective);

    /// <summary>Draws cubes under a white sky, and returns the part of it that the surface in the middle of the image sees.</summary>
    private static double PartAtTheMiddle(View view, params ImmutableArray<Transformation> cubes)
    {
        var fractal = new Fractal(
            new FractalDescription([new Repetition([new TransformationSet(cubes)], 1)], Composition.Affine), RenderScenes.Cube(1));
        var scene = RenderScenes.Scene(
            new() { Lights = [RenderScenes.FullLight], Background = Colour.Black, Exposure = Exposure },
            (new FractalModel(fractal) { SourcePath = "cubes.fdo" }, Transformation.Identity, Dark));
        // Without occlusion, all of the sky is seen.
        Assert.Equal(1, Part(new() { AmbientOcclusion = false }), 0.01);
        return Part(new());

        double Part(RenderSettings settings)
        {
            var shown = RenderScenes.Draw(scene, view, 16, 16, settings)[8, 8].Green / 255.0;
            return new Colour(shown, 0, 0).ToLinear().Red / (Exposure * Dark.ToLinear().Green);
        }
    }
}
