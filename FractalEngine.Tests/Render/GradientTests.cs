using System.Globalization;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility;

namespace FractalEngine.Tests.Render;

/// <summary>Instances that differ in colour: in light from everywhere each has a mixture of both colours, in linear light.</summary>
[Collection(GlTests.Name)]
public sealed class GradientTests
{
    private static readonly Colour Near = new(1, 0, 0);
    private static readonly Colour Far = new(0, 0.2, 1);

    // Of linear light: half a step of 8 bits, and interpolation.
    private const double Tolerance = 0.01;

    [SkippableTheory]
    [InlineData(true)]
    [InlineData(false)]
    public void Level_OfSetsWithTheIdentity_CountsTheOtherMaps(bool hasSamples)
    {
        // x + t x + t t x: from the first colour to the second.
        var t = Samples.MoveAndScale(2, 0, 0, 0.5);
        var fractal = Of(new Repetition([new TransformationSet([Transformation.Identity, t])], 2));
        Check(fractal, GradientKind.Level, hasSamples, (new(0, 0, 0), 0), (new(2, 0, 0), 0.5), (new(3, 0, 0), 1));
    }

    [SkippableFact]
    public void Level_OfSetsWithoutTheIdentity_IsTheSameForAll()
    {
        var fractal =
            Of(new Repetition([new TransformationSet([Samples.MoveAndScale(-2, 0, 0, 0.5), Samples.MoveAndScale(2, 0, 0, 0.5)])], 2));
        Check(fractal, GradientKind.Level, false, (new(-3, 0, 0), 1), (new(-1, 0, 0), 1), (new(1, 0, 0), 1), (new(3, 0, 0), 1));
    }

    [SkippableFact]
    public void Level_WhereASetHasOneMap_CountsIt()
    {
        // GradientKind.Level: how many maps other than the identity lead to an instance. Here always two, of two levels.
        var fractal = Of(new TransformationSet([Samples.MoveAndScale(-2, 0, 0, 0.5), Samples.MoveAndScale(2, 0, 0, 0.5)]),
            new TransformationSet([Samples.MoveAndScale(0, 1, 0, 0.5)]));
        Check(fractal, GradientKind.Level, false, (new(-2, 0.5, 0), 1), (new(2, 0.5, 0), 1));
    }

    [SkippableFact]
    public void Path_OfTwoLevels_IsAHalfOfTheFirstAndAQuarterOfTheSecond()
    {
        var fractal =
            Of(new Repetition(
                [new TransformationSet(
                    [Samples.MoveAndScale(-2, 0, 0, 0.5), Samples.MoveAndScale(0, 2, 0, 0.5), Samples.MoveAndScale(2, 0, 0, 0.5)])], 2));
        // Places 0, 1/2 and 1 in the set.
        Check(fractal, GradientKind.Path, true, (new(-3, 0, 0), 0), (new(-2, 1, 0), 0.125), (new(-1, 0, 0), 0.25), (new(0, 3, 0), 0.375),
            (new(1, 2, 0), 0.5), (new(3, 0, 0), 0.75));
    }

    [SkippableFact]
    public void NoGradient_HasTheColourOfTheObject()
    {
        var fractal =
            Of(new Repetition([new TransformationSet([Samples.MoveAndScale(-2, 0, 0, 0.5), Samples.MoveAndScale(2, 0, 0, 0.5)])], 2));
        Check(fractal, GradientKind.None, false, (new(-3, 0, 0), 0), (new(3, 0, 0), 0));
    }

    [SkippableFact]
    public void Gradient_BesideFractalsWithout_IsDrawn()
    {
        // In any order of distance, and where nothing of the one with the gradient is in the picture, or in some strips of it.
        var fractal =
            Of(new Repetition([new TransformationSet([Samples.MoveAndScale(-2, 0, 0, 0.5), Samples.MoveAndScale(2, 0, 0, 0.5)])], 2));
        var model = new FractalModel(fractal) { SourcePath = "a.fdo" };
        foreach (var place in (Vector[])[new(5, 0, 2), new(5, 0, -2), new(0, 0, -100), new(0, 0, 5)])
        {
            var scene = new LoadedScene(new() { Background = Colour.Black, Lights = [RenderScenes.FullLight] },
            [
                new(new SceneObject("a.fdo", Transformation.Identity) { Colour = new(0, 1, 0) }, model),
                new(new SceneObject("a.fdo", RenderScenes.At(place.X, place.Y, place.Z)) { Colour = Near,
                Gradient = new(GradientKind.Level, Far) }, model),
            ]);
            var view = new View(new(new(0, 0, -14), Vector.Zero, 60), Projection.Perspective);
            var picture = RenderScenes.Draw(scene, view, 400, 300, new() { Samples = 0 });
            AssertColour(picture, view, new(-3, 0, 0), new(0, 1, 0), 0, "without");
            if (place.X > 0)
            {
                AssertColour(picture, view, place + new Vector(3, 0, 0), Near, 1, Invariant($"with, at {place}"));
            }
        }
    }

    [Fact]
    public void Tints_OfWhatReachesAcrossStrips_AreThoseOfTheSameInstances()
    {
        // The same instances in a picture of many strips and, turned by a quarter, in others; a small and a large picture.
        var fractal = DetailViews.Menger(2);
        foreach (var kind in (GradientKind[])[GradientKind.Level, GradientKind.Path])
        {
            var item = DetailViews.Object(fractal) with { GradientKind = kind };
            var tints = new Dictionary<string, float>();
            foreach (var (from, width) in from eye in (Vector[])[new(0, 0, -4), new(-3, 2, -2.5),
                new(0.1, 0.2, 0.05)] from width in (int[])[4, 40, 400] select (eye, width))
            {
                var set = new VisibleSet();
                set.Cull(DetailViews.Look(from, new(0.1, 0.1, 0.1), width: width, height: width), [item], DetailViews.Everything);
                var (count, distinct) = (0, new HashSet<string>());
                for (var part = 0; part < VisibleSet.ChunkCount; part++)
                {
                    var rows = set.Instances(0, part);
                    var found = set.GradientFactors(0, part);
                    Assert.Equal(rows.Length / VisibleSet.FloatsPerInstance, found.Length);
                    for (var i = 0; i < found.Length; i++)
                    {
                        var row = rows[(i * VisibleSet.FloatsPerInstance)..];
                        // The place in steps of the smallest cube.
                        var place =
                            Invariant(
                                $"{Math.Round(9 * (row[3] + from.X)) + 0.0} {Math.Round(9 * (row[7] + from.Y)) + 0.0} {Math.Round(9 * (row[11] + from.Z)) + 0.0}");
                        Assert.True(tints.TryAdd(place, found[i]) || tints[place] == found[i],
                            $"{kind}, {width} columns, {place}: {found[i]} and {tints[place]}");
                        distinct.Add(place);
                        count++;
                    }
                }

                Assert.Equal((400, 400), (count, distinct.Count));
            }

            // i/2 + j/4 with i and j from 0 to 19 nineteenths.
            Assert.Equal(kind == GradientKind.Level ? 1 : 58, tints.Values.Select(tint => Math.Round(tint, 4)).Distinct().Count());
            Assert.All(tints.Values, tint => Assert.InRange(tint, 0, 1));
        }
    }

    private static Fractal Of(params ReadOnlySpan<FractalStep> steps) => new(new([.. steps]), RenderScenes.Square(0.5));

    /// <summary>Draws it from before, and looks at the middles of instances.</summary>
    private static void Check(Fractal fractal, GradientKind kind, bool hasSamples,
        params ReadOnlySpan<(Vector Place, double Tint)> expected)
    {
        var scene = new LoadedScene(
            new() { Background = Colour.Black, Lights = [RenderScenes.FullLight] },
            [new(new SceneObject("a.fdo", Transformation.Identity) { Colour = Near, Gradient = kind == GradientKind.None
            ? null
            : new(kind, Far) }, new FractalModel(fractal) { SourcePath = "a.fdo" })]);
        var view = new View(new(new(0, 0.5, -8), Vector.Zero, 60), Projection.Perspective);
        var picture = RenderScenes.Draw(scene, view, 800, 600, new() { Samples = hasSamples ? 4 : 0 });
        foreach (var (place, tint) in expected)
        {
            AssertColour(picture, view, place, Near, tint, Invariant($"at {place}"));
        }
    }

    private static void AssertColour(PixelImage picture, View view, Vector place, Colour near, double tint, string what)
    {
        var (x, y, _) = view.Project(place, picture.Width, picture.Height)!.Value;
        var pixel = picture[(int)x, (int)y];
        var found = new Colour(pixel.Red / 255.0, pixel.Green / 255.0, pixel.Blue / 255.0).ToLinear();
        var ((red1, green1, blue1), (red2, green2, blue2)) = (near.ToLinear(), Far.ToLinear());
        Vector Of(double part) => new(red1 + (part * (red2 - red1)), green1 + (part * (green2 - green1)), blue1 + (part * (blue2 - blue1)));
        var difference = (Of(tint) - new Vector(found.Red, found.Green, found.Blue)).MaxAbsComponent();
        Assert.True(difference < Tolerance, Invariant($"{what}: {found}, expected {Of(tint)}"));
    }

    private static string Invariant(FormattableString text) => text.ToString(CultureInfo.InvariantCulture);
}
