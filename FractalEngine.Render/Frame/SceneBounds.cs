using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Preparation;

namespace FractalEngine.Render.Frame;

/// <summary>
/// Computes the bounds that clip planes are derived from. Moving bodies change them only in coarse steps, since other planes discard the
/// culled instances. A body that falls out of the scene does not change them: <see cref="SceneClipPlanes"/> follow it
/// while it is in view.
/// </summary>
internal static class SceneBounds
{
    // All three are fractions of the scene's size. Dynamic objects within this distance are always between the planes.
    private const double DynamicMargin = 0.5;

    // Spheres farther out are ignored. Corners of what moves are rounded to the grid.
    private const double SphereLimit = 2;
    private const double Grid = 0.25;

    /// <summary>Computes the bounds in world space.</summary>
    /// <param name="scene">Scene as it was loaded.</param>
    /// <param name="objectBounds">Current bounds of its objects.</param>
    /// <param name="spheres">Spheres beside the objects.</param>
    public static BoundingBox Compute(DrawableScene scene, ReadOnlySpan<BoundingBox> objectBounds, IReadOnlyList<SphereInstance> spheres)
    {
        var bounds = BoundingBox.Empty;
        var hasDynamicObjects = false;
        for (var i = 0; i < objectBounds.Length; i++)
        {
            if (scene.Objects[i].IsDynamic)
            {
                hasDynamicObjects = true;
            }
            else
            {
                bounds = BoundingBox.Union(bounds, objectBounds[i]);
            }
        }

        var sceneBounds = scene.Source.Bounds;
        if (hasDynamicObjects)
        {
            bounds = BoundingBox.Union(bounds, Enlarge(sceneBounds));
        }

        // Relative to the diagonal: flat scenes have no height, but balls above them.
        var margin = SphereLimit * sceneBounds.Diagonal * Vector.One;
        var sphereLimits = new BoundingBox(sceneBounds.Minimum - margin, sceneBounds.Maximum + margin);
        var grid = GridOf(scene);
        foreach (var sphere in spheres)
        {
            if (grid > 0 && !(sphereLimits.DistanceSquared(sphere.Centre) > 0))
            {
                bounds = BoundingBox.Union(bounds, RoundOut(sphere.Bounds, grid));
            }
        }

        return bounds;
    }

    /// <summary>Returns the width of the steps in which what moves changes bounds, scene units.</summary>
    public static double GridOf(DrawableScene scene) => Grid * scene.Source.Bounds.Diagonal;

    /// <summary>Returns the smallest box around another one whose corners lie on a grid.</summary>
    public static BoundingBox RoundOut(BoundingBox box, double grid) =>
        new(RoundDown(box.Minimum, grid), -RoundDown(-box.Maximum, grid));

    private static BoundingBox Enlarge(BoundingBox box) =>
        new(box.Minimum - (DynamicMargin * box.Size), box.Maximum + (DynamicMargin * box.Size));

    private static Vector RoundDown(Vector v, double grid) =>
        new(grid * Math.Floor(v.X / grid), grid * Math.Floor(v.Y / grid), grid * Math.Floor(v.Z / grid));
}
