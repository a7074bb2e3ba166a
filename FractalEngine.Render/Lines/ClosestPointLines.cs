using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Lines;

/// <summary>Visualises the closest points that bodies find, as lines in world space.</summary>
public static class ClosestPointLines
{
    private const int MaxBodies = 100;

    // Length of a normal divided by the radius of its body.
    private const double NormalLengthRatio = 2;

    private static readonly Colour ClosestPointColour = new(1, 0.75, 0.2);
    private static readonly Colour NormalColour = new(0.3, 0.9, 1);

    /// <summary>Creates two lines per body: one to its closest point, and the normal there. Awake bodies come first.</summary>
    /// <remarks>Bodies beyond the limit of physics, or of their collider, have no lines.</remarks>
    /// <param name="world">The world whose bodies are shown.</param>
    /// <param name="alpha">The fraction of a step since the last one, from 0 to 1.</param>
    public static IReadOnlyList<LineSegment> Create(PhysicsWorld world, double alpha)
    {
        ArgumentNullException.ThrowIfNull(world);
        var lines = new List<LineSegment>();
        foreach (var body in world.Bodies.OrderBy(static body => body.IsAsleep).Take(MaxBodies))
        {
            var centre = body.PreviousPosition + (alpha * (body.Position - body.PreviousPosition));
            if (TryFindClosest(world, body, centre, out var closest))
            {
                lines.Add(new(centre, closest.Point, ClosestPointColour));
                lines.Add(new(closest.Point, closest.Point + (NormalLengthRatio * body.Radius * closest.Normal), NormalColour));
            }
        }

        return lines;
    }

    private static bool TryFindClosest(PhysicsWorld world, Body body, Vector centre, out ClosestPoint closest)
    {
        closest = default;
        try
        {
            return centre.MaxAbsComponent() <= PhysicsLimits.MaxCoordinate
                && world.TryFindClosest(centre, world.ColliderOverride ?? body.Description.Collider, out closest);
        }
        catch (FractalLimitException)
        {
            // No line is as long as the distance, or the collider does not search so far away.
            return false;
        }
    }
}
