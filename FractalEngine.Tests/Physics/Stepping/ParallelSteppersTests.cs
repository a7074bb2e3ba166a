using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Solving;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Physics.Stepping;
using FractalEngine.Core.Queries;

namespace FractalEngine.Tests.Physics.Stepping;

/// <summary>How bodies are shared out among steppers.</summary>
public sealed class ParallelSteppersTests
{
    [Theory]
    [InlineData(255, false)]
    [InlineData(256, true)]
    public void AreMany_OfBodies_IsSoFrom256On(int count, bool areMany) => Assert.Equal(areMany, ParallelSteppers.AreMany(count));

    /// <summary>Groups of 32 bodies at least, and at most 32 groups; each has a stepper of its own.</summary>
    [Theory]
    [InlineData(256, 8)]
    [InlineData(257, 9)]
    [InlineData(1024, 32)]
    [InlineData(1025, 32)]
    [InlineData(3000, 32)]
    public void Run_OverBodies_LetsEachActOnce(int count, int groups)
    {
        var created = 0;
        var steppers = new ParallelSteppers(
            context =>
            {
                created++;
                return CreateStepper(context);
            },
            maxThreads: 1);
        steppers.Reserve(255);
        Assert.Equal(0, created);
        steppers.Reserve(count);
        Assert.Equal(groups, created);
        steppers.Reserve(count);
        Assert.Equal((groups, 1), (created, steppers.MaxThreads));
        var order = new List<(BodyStepper Stepper, int Index)>();
        steppers.Run(count, (stepper, index) => order.Add((stepper, index)));
        Assert.Equal(Enumerable.Range(0, count), order.Select(static one => one.Index));
        var size = Math.Max(32, (count + 31) / 32);
        Assert.Equal((count + size - 1) / size, order.Select(static one => one.Stepper).Distinct().Count());
        Assert.All(order, one => Assert.Equal(order[one.Index / size * size].Stepper, one.Stepper));
        order.Clear();
        steppers.Run(33, (stepper, index) => order.Add((stepper, index)));
        Assert.Equal(Enumerable.Range(0, 33), order.Select(static one => one.Index));
        Assert.NotEqual(order[31].Stepper, order[32].Stepper);
        Assert.Equal(order[0].Stepper, order[31].Stepper);
        Assert.Equal((0L, 0L), steppers.CountTests());
    }

    private static BodyStepper CreateStepper(QueryContext context)
    {
        List<Body> bodies = [new(new(Vector.Zero, 1), 0)];
        var grid = new BodyGrid();
        var nearby = new NearbyBodies(grid, bodies);
        var log = new ContactLog(bodies, new StaticObjectSet(static _ => { }, null));
        var obstacles = new Obstacles(
            bodies, nearby, context, new KinematicSet(), new BodySurfaces([], new(static _ => { }, null)));
        var planner = new IslandPlanner(bodies, nearby, log, new(), 1);
        return new(new(), bodies, grid, nearby, obstacles, new SleepIslands(bodies, nearby), planner, context, log);
    }
}
