using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;

namespace FractalEngine.Tests.Physics.Bodies;

/// <summary>A known distance bounds others, and a known point is recalled only where it was found.</summary>
public class SafeDistanceTests
{
    private static readonly Vector Position = new(1, 2, 3);

    [Fact]
    public void TryRecall_AtThePositionOfTheLastQuery_GivesItsPoint()
    {
        var safeDistance = new SafeDistance();
        safeDistance.StoreClosest(Position, 0.5, new(1, 2, 2.5), isFlat: true);
        Assert.True(safeDistance.TryRecall(Position, out var distance, out var point, out var isFlat));
        Assert.Equal((0.5, new Vector(1, 2, 2.5), true), (distance, point, isFlat));
        Assert.Equal(0.25, safeDistance.LowerBoundAt(Position + new Vector(0.25, 0, 0)));
        Assert.False(safeDistance.TryRecall(Position + new Vector(0, 1e-15, 0), out _, out _, out _));
    }

    [Fact]
    public void IsKnownNear_TellsHowFarAwayTheClosestPointWasSearchedFor()
    {
        var safeDistance = new SafeDistance();
        Assert.False(safeDistance.IsKnownNear(Position, 1));
        safeDistance.StoreClosest(Position, 0.5, new(1, 2, 2.5), isFlat: true);
        Assert.True(safeDistance.IsKnownNear(Position + new Vector(0.25, 0, 0), 0.25));
        Assert.False(safeDistance.IsKnownNear(Position + new Vector(0.25, 0, 0), 0.2));
        safeDistance.Store(Position, 0.7);
        Assert.False(safeDistance.IsKnownNear(Position, 1));
    }

    [Fact]
    public void TryRecall_AfterAnotherQueryOrAMove_GivesNothing()
    {
        var safeDistance = new SafeDistance();
        safeDistance.StoreClosest(Position, 0.5, new(1, 2, 2.5), isFlat: true);
        safeDistance.Store(Position, 0.7);
        Assert.False(safeDistance.TryRecall(Position, out _, out _, out _));
        safeDistance.StoreClosest(Position, 0.5, new(1, 2, 2.5), isFlat: false);
        safeDistance.Invalidate();
        Assert.False(safeDistance.TryRecall(Position, out _, out _, out _));
        Assert.Equal(double.NegativeInfinity, safeDistance.LowerBoundAt(Position));
    }
}
