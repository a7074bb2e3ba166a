using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Visibility.SkyBaking;

/// <summary>A point just before the surface of a node, as it is found by a line of sight.</summary>
internal sealed class SkySample
{
    private readonly List<SkyStep> _steps = [];
    private readonly List<SkyStep> _nearestSteps = [];

    /// <summary>The point, in the frame of the node that the line of sight was cast at.</summary>
    public Vector Point { get; set; }

    /// <summary>Unit normal of the surface, towards the side that the point is on.</summary>
    public Vector Normal { get; set; }

    /// <summary>Direction of the line of sight.</summary>
    public Vector Direction { get; private set; }

    /// <summary>Distance along the line of sight, in its unit; infinite while nothing is found.</summary>
    public double Distance { get; private set; }

    /// <summary>Index of the triangle of the base mesh.</summary>
    public int Triangle { get; private set; }

    /// <summary>Node whose proxy is seen; null while nothing is found.</summary>
    public LodNode? Leaf { get; private set; }

    /// <summary>Map from the base mesh that is seen.</summary>
    public AffineMap FromMesh { get; private set; }

    /// <summary>The children that lead to the surface.</summary>
    public IReadOnlyList<SkyStep> Steps => _nearestSteps;

    /// <summary>Number of nodes that the line of sight has entered.</summary>
    public int VisitCount { get; set; }

    /// <summary>Resets the sample for a new line of sight.</summary>
    public void Begin(Vector direction)
    {
        Direction = direction;
        Leaf = null;
        VisitCount = 0;
        Distance = double.PositiveInfinity;
    }

    /// <summary>Stores a step of the traversal, and removes deeper ones.</summary>
    public void SetStep(int depth, SkyStep step)
    {
        _steps.RemoveRange(depth, _steps.Count - depth);
        _steps.Add(step);
    }

    /// <summary>Stores the nearest surface so far.</summary>
    public void SetNearest(double distance, int triangle, LodNode leaf, int depth, AffineMap fromMesh)
    {
        (Distance, Triangle, Leaf, FromMesh) = (distance, triangle, leaf, fromMesh);
        _nearestSteps.Clear();
        _nearestSteps.AddRange(CollectionsMarshal.AsSpan(_steps)[..depth]);
    }
}
