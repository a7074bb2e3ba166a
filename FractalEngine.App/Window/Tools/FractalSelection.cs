using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Rays;
using FractalEngine.Core.Scenes;

namespace FractalEngine.App.Window.Tools;

/// <summary>Finds the parts of a fractal in affine composition that a path leads to.</summary>
internal static class FractalSelection
{
    /// <summary>The model, or what of it shows the mesh that was hit.</summary>
    public static Model PartOf(Model model, RayHit? hit) =>
        model.Parts is [var only] ? only : model.Parts[hit is { } clicked ? clicked.MeshIndex : 0];

    /// <summary>Numbers of maps of the sets on a path.</summary>
    public static ImmutableArray<int> SetSizes(Fractal fractal, ImmutableArray<int> path) =>
        [.. (Follow(fractal, path) ?? []).Select(static step => step.SetSize)];

    /// <summary>The map of the instance at the end of a path; null where there is none.</summary>
    /// <param name="fractal">The fractal.</param>
    /// <param name="path">The path. An infinite fractal is hit at any of its levels.</param>
    /// <param name="map">From the frame of the fractal to that of the result.</param>
    public static AffineMap? MapOfInstance(Fractal fractal, ImmutableArray<int> path, AffineMap map) =>
        Follow(fractal, path) is { } steps && (fractal.Description.IsInfinite || steps is [] or [.., { IsInstance: true }])
            ? MapOf(steps, map)
            : null;

    /// <summary>The box of the sub-fractal that a path leads to, and the map from there; null where there is none.</summary>
    /// <param name="fractal">The fractal.</param>
    /// <param name="path">The path.</param>
    /// <param name="firstStep">Number of its steps whose maps are known.</param>
    /// <param name="map">From the frame of the sub-fractal that these lead to, to that of the result.</param>
    public static (BoundingBox Box, AffineMap Map)? SubFractalAt(
        Fractal fractal, ImmutableArray<int> path, int firstStep, AffineMap map) =>
        Follow(fractal, path, firstStep) is [.., var last] steps ? (last.Box, MapOf(steps, map)) : null;

    /// <summary>Follows a path; null where there is none, or the sub-fractals on it can't be told.</summary>
    private static IReadOnlyList<PathStep>? Follow(Fractal fractal, ImmutableArray<int> path, int firstStep = 0)
    {
        try
        {
            return fractal.Follow(path.AsSpan(), firstStep);
        }
        catch (FractalLimitException)
        {
            // Rays find instances in hierarchies with fewer levels than sets, and some fractals have no other.
            return null;
        }
    }

    private static AffineMap MapOf(IReadOnlyList<PathStep> steps, AffineMap map) =>
        steps.Aggregate(map, static (product, step) => product * step.Map);
}
