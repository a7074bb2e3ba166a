using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Preparation;

namespace FractalEngine.Render.Passes;

/// <summary>
/// The box that a scene's planes are made for. What moves all the time changes it in coarse steps only, since other planes mean that
/// everything is chosen again; and what falls out of the scene does not take the planes with it.
/// </summary>
internal static class SceneBounds
{
    // Of the scene's size: bodies within this of it are drawn wherever they are.
    private const double DynamicMargin = 0.5;

    // Of the scene's size: balls farther out do not matter, and places of others are rounded to this.
    private const double SphereLimit = 2;
    private const double SphereGrid = 0.25;

    /// <summary>World space.</summary>
    /// <param name="scene">As it was loaded.</param>
    /// <param name="objectBounds">Of its objects, where they are now.</param>
    /// <param name="spheres">Beside them.</param>
    public static BoundingBox Compute(DrawableScene scene, ReadOnlySpan<BoundingBox> objectBounds, IReadOnlyList<SphereInstance> spheres)
    {
        var (bounds, hasDynamicObjects) = (BoundingBox.Empty, false);
        for (var i = 0; i < objectBounds.Length; i++)
        {
            hasDynamicObjects |= scene.Objects[i].IsDynamic;
            bounds = scene.Objects[i].IsDynamic ? bounds : BoundingBox.Union(bounds, objectBounds[i]);
        }

        var sceneBounds = scene.Source.Bounds;
        bounds = hasDynamicObjects ? BoundingBox.Union(bounds, Enlarge(sceneBounds, DynamicMargin)) : bounds;
        var (sphereLimits, grid) = (Enlarge(sceneBounds, SphereLimit), SphereGrid * sceneBounds.Diagonal);
        foreach (var (centre, radius) in spheres)
        {
            var extent = radius * Vector.One;
            bounds = sphereLimits.DistanceSquared(centre) > 0 || !(grid > 0)
                ? bounds
                : BoundingBox.Union(bounds, new(RoundDown(centre - extent, grid), -RoundDown(-centre - extent, grid)));
        }

        return bounds;
    }

    private static BoundingBox Enlarge(BoundingBox box, double factor) =>
        new(box.Minimum - (factor * box.Size), box.Maximum + (factor * box.Size));

    private static Vector RoundDown(Vector v, double grid) =>
        new(grid * Math.Floor(v.X / grid), grid * Math.Floor(v.Y / grid), grid * Math.Floor(v.Z / grid));
}
