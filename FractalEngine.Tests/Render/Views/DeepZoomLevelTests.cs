using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Views;

/// <summary>Roots of a deep zoom are sub-fractals of as many levels as they say, whatever the maps are.</summary>
public sealed class DeepZoomLevelTests
{
    [Fact]
    public void TryFindNearest_OnAStaircase_HasOneStepForEachLevelOfTheRoot()
    {
        // Each level adds a step above the others.
        var staircase = new Fractal(
            new([new Repetition([new TransformationSet([Samples.Move(0, 0, 1), Transformation.Identity])], 20)]), Samples.Triangle);
        for (var levels = 0; levels <= 20; levels++)
        {
            var caster = new DeepZoomRayCaster(staircase, [new(levels, AffineMap.Identity, ColourPath.Start)]);
            var context = new QueryContext();
            Assert.True(caster.TryFindNearest(new(new(0.2, 0.2, 50), -Vector.K), context, out var hit, out var index));
            Assert.Equal(0, index);
            Near.Equal(50 - levels, hit.Distance, 1e-12);
            Assert.True(caster.TryFindNearest(new(new(0.2, 0.2, -50), Vector.K), context, out hit, out _));
            Near.Equal(50, hit.Distance, 1e-12);
        }
    }

    [Fact]
    public void GradientFactorOf_OfSetsThatDiffer_TakesTheMapsOfEachLevel()
    {
        Transformation[] outer = [Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(10, 0, 0, 0.5)];
        Transformation[] inner = [Samples.Move(0, 0, 0.5), Samples.Move(0, 4, 0), Samples.Move(0, 8, 0)];
        var fractal = Fractal.Of(Samples.Triangle).Apply(inner).Apply(outer);
        var caster = new DeepZoomRayCaster(fractal, [new(2, AffineMap.Identity, ColourPath.Start)]);
        var context = new QueryContext();
        // The image of the base by the second map of the outer set and the third of the inner one.
        Assert.True(caster.TryFindNearest(new(new(10.1, 4.1, 50), -Vector.K), context, out _, out var index));
        Assert.Equal(new[] { 1, 2 }, context.InstancePath.ToArray());
        foreach (var gradient in Enum.GetValues<GradientKind>())
        {
            Assert.Equal(
                ColourPath.GradientFactorOf(fractal, gradient, context.InstancePath), caster.GradientFactorOf(gradient, index, context), 6);
        }
    }
}
