using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Visibility;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Parsing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;
using static System.FormattableString;

namespace FractalEngine.Tests.Scenes;

/// <summary>Colours of instances with a gradient: in light from everywhere, mixtures of both colours in linear light.</summary>
[Collection(GlTests.Name)]
public sealed class GradientTests
{
    private static readonly Colour FirstColour = new(1, 0, 0);
    private static readonly Colour SecondColour = new(0, 0.2, 1);

    // In linear light: half a step of 8 bits, and interpolation.
    private const double Tolerance = 0.01;

    [SkippableTheory]
    [InlineData(true)]
    [InlineData(false)]
    public void Level_OfSetsWithTheIdentity_CountsTheOtherMaps(bool hasSamples)
    {
        // x + t x + t t x: from the first colour to the second.
        var t = Samples.MoveAndScale(2, 0, 0, 0.5);
        var fractal = CreateFractal(new Repetition([new TransformationSet([Transformation.Identity, t])], 2));
        CheckColours(fractal, GradientKind.Level, hasSamples, (new(0, 0, 0), 0), (new(2, 0, 0), 0.5), (new(3, 0, 0), 1));
    }

    [SkippableFact]
    public void Level_OfSetsWithoutTheIdentity_IsTheSameForAll()
    {
        var fractal = CreateFractal(new Repetition([TwoHalves], 2));
        CheckColours(fractal, GradientKind.Level, false, (new(-3, 0, 0), 1), (new(-1, 0, 0), 1), (new(1, 0, 0), 1), (new(3, 0, 0), 1));
    }

    [SkippableFact]
    public void Level_WhereASetHasOneMap_CountsIt()
    {
        // GradientKind.Level: how many maps other than the identity lead to an instance. Here always two, of two levels.
        var fractal = CreateFractal(TwoHalves, new TransformationSet([Samples.MoveAndScale(0, 1, 0, 0.5)]));
        CheckColours(fractal, GradientKind.Level, false, (new(-2, 0.5, 0), 1), (new(2, 0.5, 0), 1));
    }

    [SkippableFact]
    public void Path_OfTwoLevels_IsAHalfOfTheFirstAndAQuarterOfTheSecond()
    {
        var set = new TransformationSet(
            [Samples.MoveAndScale(-2, 0, 0, 0.5), Samples.MoveAndScale(0, 2, 0, 0.5), Samples.MoveAndScale(2, 0, 0, 0.5)]);
        var fractal = CreateFractal(new Repetition([set], 2));
        // Positions 0, 1/2 and 1 in the set.
        CheckColours(
            fractal, GradientKind.Path, true,
            (new(-3, 0, 0), 0), (new(-2, 1, 0), 0.125), (new(-1, 0, 0), 0.25),
            (new(0, 3, 0), 0.375), (new(1, 2, 0), 0.5), (new(3, 0, 0), 0.75));
    }

    [SkippableFact]
    public void NoGradient_HasTheColourOfTheObject()
    {
        var fractal = CreateFractal(new Repetition([TwoHalves], 2));
        CheckColours(fractal, GradientKind.None, false, (new(-3, 0, 0), 0), (new(3, 0, 0), 0));
    }

    [SkippableFact]
    public void Gradient_BesideFractalsWithout_IsDrawn()
    {
        // In any order of distance, and where the fractal with the gradient is outside the frame, or in only some strips of it.
        var fractal = CreateFractal(new Repetition([TwoHalves], 2));
        var model = new FractalModel(fractal) { SourcePath = "a.fdo" };
        foreach (var position in (Vector[])[new(5, 0, 2), new(5, 0, -2), new(0, 0, -100), new(0, 0, 5)])
        {
            var plain = new SceneObject("a.fdo", Transformation.Identity) { Colour = new(0, 1, 0) };
            var graded = new SceneObject("a.fdo", RenderScenes.TranslatedTo(position.X, position.Y, position.Z))
            {
                Colour = FirstColour,
                Gradient = new(GradientKind.Level, SecondColour),
            };
            var scene = new LoadedScene(
                new() { Background = Colour.Black, Lights = [RenderScenes.FullLight] }, [new(plain, model), new(graded, model)]);
            var view = new View(new(new(0, 0, -14), Vector.Zero, 60), Projection.Perspective);
            var image = RenderScenes.Draw(scene, view, 400, 300, new() { Samples = 0 });
            AssertColour(image, view, new(-3, 0, 0), new(0, 1, 0), 0, "without");
            if (position.X > 0)
            {
                AssertColour(image, view, position + new Vector(3, 0, 0), FirstColour, 1, Invariant($"with, at {position}"));
            }
        }
    }

    [Fact]
    public void GradientFactors_OfWhatSpansStrips_AreThoseOfTheSameInstances()
    {
        // The same instances from three positions, in frames of different widths, so that they fall into different strips.
        var fractal = CullingViews.Menger(2);
        foreach (var kind in (GradientKind[])[GradientKind.Level, GradientKind.Path])
        {
            var item = CullingViews.CreateObject(fractal) with { GradientKind = kind };
            var factors = new Dictionary<(double X, double Y, double Z), float>();
            foreach (var (from, width) in
                from eye in (Vector[])[new(0, 0, -4), new(-3, 2, -2.5), new(0.1, 0.2, 0.05)]
                from width in (int[])[4, 40, 400]
                select (eye, width))
            {
                var set = new VisibleSet();
                set.Cull(CullingViews.CreateView(from, new(0.1, 0.1, 0.1), width: width, height: width), [item], CullingViews.NoCulling);
                var count = 0;
                var distinct = new HashSet<(double X, double Y, double Z)>();
                for (var chunk = 0; chunk < VisibleSet.ChunkCount; chunk++)
                {
                    var rows = set.Instances(0, chunk);
                    var found = set.GradientFactors(0, chunk);
                    Assert.Equal(rows.Length / VisibleSet.FloatsPerInstance, found.Length);
                    for (var i = 0; i < found.Length; i++)
                    {
                        var row = rows[(i * VisibleSet.FloatsPerInstance)..];
                        // The position in steps of the smallest cube.
                        var gridPosition = (
                            Math.Round(9 * (row[3] + from.X)), Math.Round(9 * (row[7] + from.Y)), Math.Round(9 * (row[11] + from.Z)));
                        Assert.True(factors.TryAdd(gridPosition, found[i]) || factors[gridPosition] == found[i],
                            Invariant($"{kind}, {width} columns, {gridPosition}: {found[i]} and {factors[gridPosition]}"));
                        distinct.Add(gridPosition);
                        count++;
                    }
                }

                Assert.Equal((400, 400), (count, distinct.Count));
            }

            // i/2 + j/4 with i and j from 0 to 19 nineteenths.
            Assert.Equal(kind == GradientKind.Level ? 1 : 58, factors.Values.Select(factor => Math.Round(factor, 4)).Distinct().Count());
            Assert.All(factors.Values, factor => Assert.InRange(factor, 0, 1));
        }
    }

    /// <summary>What is drawn of an instance is what queries say of its path: with identities, duplicates, and several meshes.</summary>
    [Theory]
    [InlineData("z<box>. [#, ((1.5, 0.2, 0), (0, 20, 0), (0.7)), ((-2, 1, 0), #, (0.6))] box\n<$>. z 4")]
    [InlineData("z<box>. [((3, 0, 0), #, (0.5)), ((-3, 0, 0), #, (0.5)), ((3, 0, 0), #, (0.5)), ((0, 3, 0), #, (0.5))] box\n<$>. z 3")]
    [InlineData("<$>. [((9, 0, 0), #, #)^0..3] [#, ((2, 0, 0), #, #), #, ((0, 3, 0), #, (0.5))] ball")]
    [InlineData(
        "l. ball\nb. box\ns. ((1, 0.9, 0), (0, 0, 40), (0.6))\n"
        + "z<l>. [((0, 1.2, 0), (0, 60, 9), (0.7))] l + [(#, (0, 120, 0), #)^0..2] [s.] l + b\n<$>. z 4")]
    [InlineData(
        "x<box>, y<ball>. [((3, 0, 0), #, (0.5))] box + [((0, 4, 0), #, (0.4))] ball + cone, "
        + "box + [((2, 1, 2), #, (0.5))] ball\n<$>. x 4")]
    [InlineData(
        "h. ((2, 0, 0), #, (0.5))\nup. ((0, 3, 0), #, #)\n"
        + "z<box>. [#, h.] box + [] [h.] box + [up.] (ball + [up. * h.] box)\n<$>. z 3")]
    public void GradientFactors_OfInstances_AreThoseOfTheirPaths(string text)
    {
        using var folder = new TemporaryFolder();
        var fractal = FractalFile.Read(folder.Write("a.fdo", text + "\n"));
        var collider = new ExactFractalCollider(fractal);
        var context = new QueryContext();
        var (count, checkedCount) = (0, 0);
        var factors = new HashSet<float>();
        var from = fractal.Bounds.Centre - (3 * fractal.Bounds.Diagonal * Vector.K);
        foreach (var (mesh, part) in fractal.ByMesh.Index())
        {
            var (corner, _, _) = fractal.BaseMeshes[mesh].Face(0);
            var item = new CulledObject(LodHierarchy.Build(part), AffineMap.Identity, Vector.Zero, 0) { GradientKind = GradientKind.Path };
            var set = new VisibleSet();
            set.Cull(CullingViews.CreateView(from, fractal.Bounds.Centre), [item], CullingViews.NoCulling);
            for (var chunk = 0; chunk < VisibleSet.ChunkCount; chunk++)
            {
                var rows = set.Instances(0, chunk);
                var found = set.GradientFactors(0, chunk);
                for (var i = 0; i < found.Length; i++, count++)
                {
                    var row = rows[(i * VisibleSet.FloatsPerInstance)..];
                    var map = new AffineMap(
                        new(new(row[0], row[4], row[8]), new(row[1], row[5], row[9]), new(row[2], row[6], row[10])),
                        from + new Vector(row[3], row[7], row[11]));
                    Assert.True(collider.TryFindClosest(map * corner, double.PositiveInfinity, context, out _));
                    var path = fractal.Follow(context.InstancePath)!;
                    var ofPath = path.Aggregate(AffineMap.Identity, static (outer, step) => outer * step.Map);
                    // Another instance may be as close to this corner.
                    if (context.MeshIndex == mesh && (ofPath * corner - (map * corner)).Length() < 1e-4
                        && (ofPath.Translation - map.Translation).Length() < 1e-4)
                    {
                        checkedCount++;
                        factors.Add(found[i]);
                        Assert.Equal(ColourPath.GradientFactorOf(fractal, GradientKind.Path, context.InstancePath), found[i], 5);
                    }
                }
            }
        }

        Assert.True(factors.Count > 3 && checkedCount > 0.6 * count, Invariant($"{checkedCount} of {count}, {factors.Count} colours"));
    }

    private static Fractal CreateFractal(params ReadOnlySpan<FractalStep> steps) => new(new([.. steps]), RenderScenes.Square(0.5));

    /// <summary>Draws a fractal from the front, and compares the colours at the centres of instances.</summary>
    private static void CheckColours(
        Fractal fractal, GradientKind kind, bool hasSamples, params ReadOnlySpan<(Vector Position, double Factor)> expected)
    {
        var declaration = new SceneObject("a.fdo", Transformation.Identity)
        {
            Colour = FirstColour,
            Gradient = kind == GradientKind.None ? null : new(kind, SecondColour),
        };
        var scene = new LoadedScene(
            new() { Background = Colour.Black, Lights = [RenderScenes.FullLight] },
            [new(declaration, new FractalModel(fractal) { SourcePath = "a.fdo" })]);
        var view = new View(new(new(0, 0.5, -8), Vector.Zero, 60), Projection.Perspective);
        var image = RenderScenes.Draw(scene, view, 800, 600, new() { Samples = hasSamples ? 4 : 0 });
        foreach (var (position, factor) in expected)
        {
            AssertColour(image, view, position, FirstColour, factor, Invariant($"at {position}"));
        }
    }

    private static void AssertColour(PixelImage image, View view, Vector position, Colour firstColour, double factor, string description)
    {
        var (x, y, _) = view.Project(position, image.Width, image.Height)!.Value;
        var pixel = image[(int)x, (int)y];
        var found = new Colour(pixel.Red / 255.0, pixel.Green / 255.0, pixel.Blue / 255.0).ToLinear();
        var (red1, green1, blue1) = firstColour.ToLinear();
        var (red2, green2, blue2) = SecondColour.ToLinear();
        var mixture = new Vector(
            red1 + (factor * (red2 - red1)), green1 + (factor * (green2 - green1)), blue1 + (factor * (blue2 - blue1)));
        var difference = (mixture - new Vector(found.Red, found.Green, found.Blue)).MaxAbsComponent();
        Assert.True(difference < Tolerance, Invariant($"{description}: {found}, expected {mixture}"));
    }

    private static TransformationSet TwoHalves => new([Samples.MoveAndScale(-2, 0, 0, 0.5), Samples.MoveAndScale(2, 0, 0, 0.5)]);
}
