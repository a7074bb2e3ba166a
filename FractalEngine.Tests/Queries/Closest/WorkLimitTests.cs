using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Queries.Closest;

/// <summary>Fractals that don't shrink, with more parts around a position than any search visits.</summary>
public class WorkLimitTests
{
    [Fact]
    public void FindClosest_OnAWalkOfAThousandSteps_FindsThePoint()
    {
        // The places are 1.5·k − 1000 for k steps forward, so that one cube reaches from 0 to 1.
        var collider = Collider.For(Walk(Step(new(0.5, 0, 0), Vector.Zero), Step(new(-1, 0, 0), Vector.Zero)));
        Assert.Equal(4.5, collider.FindClosest(new(0.5, 0, 5)).Distance, 1e-9);
        Assert.Equal(0, collider.FindClosest(new(0.5, 0, 0.5)).Distance, 1e-9);
        Assert.Equal(0.25, collider.FindClosest(new(-0.25, 0, 0)).Distance, 1e-9);
    }

    /// <summary>By default, <see cref="App.Commands.RecordedProcessTests"/> has the distance and the bound from height 5.</summary>
    [Theory]
    [InlineData(5)]
    [InlineData(0.5)]
    [InlineData(0)]
    [Trait("Category", "Soak")]
    public void FindClosest_BeyondTheLimitOfWork_HasAPointAndAnHonestBound(double height)
    {
        Assert.True(Collider.For(TurningWalk()).TryFindClosest(new(0, 0, height), double.PositiveInfinity, new(), out var closest));
        Assert.InRange(closest.Distance, 0, 1);
        Assert.InRange(closest.ErrorBound, 0, closest.Distance + 1e-9);
    }

    [Fact]
    public void TryFindClosest_BeyondTheLimitOfWorkWithoutAPoint_DoesNotSayThatThereIsNone() =>
        Assert.Throws<FractalLimitException>(
            () => Collider.For(TurningWalk()).TryFindClosest(new(0, 0, 5), 0.01, new(), out _));

    private static Fractal TurningWalk() => Walk(Step(new(1, 0, 0), new(0, 13, 7)), Step(new(-1, 0.3, 0), new(0, 13, 7)));

    private static Transformation Step(Vector translation, Vector rotation) => new(translation, rotation, Vector.One);

    private static Fractal Walk(params Transformation[] steps) =>
        new(new([new Repetition([new TransformationSet([.. steps])], 1000)]), Shapes.Cube());
}
