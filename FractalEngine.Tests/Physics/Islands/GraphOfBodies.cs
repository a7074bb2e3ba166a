using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Separation;

namespace FractalEngine.Tests.Physics.Islands;

/// <summary>Bodies outside of a world, and the islands that they form in a step.</summary>
internal sealed class GraphOfBodies
{
    public GraphOfBodies(params BodyDescription[] descriptions)
    {
        Bodies = [.. descriptions.Select(static (one, i) => new Body(one, i) { IsOverlapResolved = true })];
        Grid.Build(Bodies);
        Nearby = new(Grid, Bodies);
        Sleep = new(Bodies, Nearby);
        Islands = new(Bodies, Nearby, 1);
        Islands.Reserve(Bodies.Count, 8 * Bodies.Count);
        Mover = new(Bodies, Islands, Grid, Nearby);
        Mover.Reserve(Bodies.Count);
    }

    public List<Body> Bodies { get; }

    public BodyGrid Grid { get; } = new();

    public NearbyBodies Nearby { get; }

    public SleepIslands Sleep { get; }

    public IslandSet Islands { get; }

    public ContactGraph Graph => Islands.Graph;

    public IslandMover Mover { get; }

    /// <summary>Begins the planned ways of all bodies where they are.</summary>
    public void BeginMove()
    {
        foreach (var body in Bodies)
        {
            (body.PlannedStart, body.Target, body.PlannedStartOrientation) = (body.Position, body.Position, body.Orientation);
            body.IsHeld = false;
        }
    }

    /// <summary>Finds the islands of a step, whose bodies then know their island.</summary>
    /// <returns>False where a body had to be woken first.</returns>
    public bool TryGroup(double stepLength)
    {
        if (Graph.CollectTouching(Sleep, stepLength))
        {
            return false;
        }

        Graph.JoinTouching();
        Graph.JoinForStep();
        Islands.Group(onlyImpacts: false);
        foreach (var body in Bodies)
        {
            body.IslandIndex = Islands.IslandOf(body.Index);
        }

        return true;
    }
}
