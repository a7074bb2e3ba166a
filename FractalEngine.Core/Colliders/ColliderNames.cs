using System.Collections.Immutable;

namespace FractalEngine.Core.Colliders;

/// <summary>The names of colliders in scene files, on the command line and in messages.</summary>
public static class ColliderNames
{
    /// <summary>All kinds with their names, in the order in which lists show them.</summary>
    public static ImmutableArray<(ColliderKind Kind, string Name)> All { get; } =
    [
        (ColliderKind.Exact, "exact"),
        (ColliderKind.Fractal, "fractal"),
        (ColliderKind.Hierarchy, "hierarchy"),
        (ColliderKind.BoundingBox, "bounding-box"),
        (ColliderKind.Simple, "simple"),
    ];

    /// <summary>Returns the name of a kind.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There is no such kind.</exception>
    public static string Of(ColliderKind kind)
    {
        foreach (var known in All)
        {
            if (known.Kind == kind)
            {
                return known.Name;
            }
        }

        throw new ArgumentOutOfRangeException(nameof(kind), kind, "expected one of the kinds of colliders");
    }
}
