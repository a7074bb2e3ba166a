using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Frame;

/// <summary>
/// The clip planes of a frame: those of the scene's bounds, unless these would cut away an object in view. It may be near
/// the camera while another one is very far away, or it may have left the bounds.
/// </summary>
internal static class SceneClipPlanes
{
    // Relative to a depth: how much nearer or farther the plane is.
    private const double DepthMargin = 0.01;

    /// <summary>
    /// Smallest near depth divided by the far one. With reversed depth each depth is known to a ten-millionth of itself at any ratio;
    /// without it, distant surfaces are drawn through one another, which is better than near ones that are not drawn.
    /// </summary>
    private const double MinNearToFarRatio = 1e-12;

    // Relative to an object's far depth: surfaces that are nearer end at the plane.
    private const double MinNearOfObject = 1e-7;

    // Relative to half the image's height: what appears smaller covers no sample.
    private const double MinVisibleSize = 1e-5;

    /// <summary>Returns the depths of the near and far clip planes.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="aspect">Width divided by height of the frame.</param>
    /// <param name="bounds">Bounds of all that is drawn, world space; may be empty.</param>
    /// <param name="hasLines">True where the bounds hold grid or axes, which reach beyond the objects.</param>
    /// <param name="objects">Boxes of the objects, world space.</param>
    /// <param name="spheres">Spheres beside the objects.</param>
    /// <param name="grid">Objects in view beyond the bounds widen them to its multiples; 0 where none has moved.</param>
    /// <remarks>
    /// Cost O(n) for n objects where one has moved, or the camera is within the bounds or near them, else O(1). Planes
    /// that follow objects lie on a grid or at powers of two, so that they stay while objects move a little.
    /// </remarks>
    public static (double Near, double Far) Of(
        View view, double aspect, BoundingBox bounds, bool hasLines, ReadOnlySpan<BoundingBox> objects,
        IReadOnlyList<SphereInstance> spheres, double grid = 0)
    {
        foreach (var box in grid > 0 ? objects : [])
        {
            // What stands is within. What falls for ever counts until it is out of view, or too small to be seen.
            if (BoundingBox.Union(bounds, box) != bounds && IsVisible(view, aspect, box))
            {
                bounds = BoundingBox.Union(bounds, SceneBounds.RoundOut(box, grid));
            }
        }

        var planes = view.ClipPlanes(bounds);
        if (view.FixedClipPlanes is not null || view.Projection != Projection.Perspective || !(view.DepthsOf(bounds).Nearest < planes.Near))
        {
            return planes;
        }

        var depths = new VisibleDepths(view, aspect, planes.Near);
        foreach (var box in objects)
        {
            depths.AddNear(box);
        }

        for (var i = 0; i < spheres.Count; i++)
        {
            depths.AddNear(spheres[i].Bounds);
        }

        if (!(depths.Near < planes.Near))
        {
            return planes;
        }

        foreach (var box in objects)
        {
            depths.AddFar(box);
        }

        for (var i = 0; i < spheres.Count; i++)
        {
            depths.AddFar(spheres[i].Bounds);
        }

        var far = hasLines ? planes.Far : Math.Min(planes.Far, 2 * PowerOfTwo(depths.Far));
        return (Math.Max(PowerOfTwo(depths.Near), MinNearToFarRatio * far), far);
    }

    /// <summary>The largest power of two up to a positive number.</summary>
    private static double PowerOfTwo(double number) => Math.ScaleB(1, Math.ILogB(number));

    private static bool IsVisible(View view, double aspect, BoundingBox box) => box.Size.IsFinite() && view.MayIntersectFrustum(box, aspect)
        && box.Diagonal > MinVisibleSize * view.HalfHeight * (view.Projection == Projection.Perspective ? view.DepthsOf(box).Nearest : 1);

    /// <summary>The nearest and the farthest depth of what is in view.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="aspect">Width divided by height of the frame.</param>
    /// <param name="near">Depth of interest: nearer ones are looked for.</param>
    private ref struct VisibleDepths(View view, double aspect, double near)
    {
        // The smallest depth of a point in view, divided by its distance, is found at the corners of the frame.
        private readonly double _cornerCosine = 1 / Math.Sqrt(1 + (view.HalfHeight * view.HalfHeight * (1 + (aspect * aspect))));

        /// <summary>The smallest depth that is needed to show what is in view.</summary>
        public double Near { get; private set; } = near;

        /// <summary>The largest depth of what is in view and large enough to be seen, with a margin.</summary>
        public double Far { get; private set; }

        /// <summary>Takes in the nearest depth of a box, if it is in view.</summary>
        public void AddNear(BoundingBox box)
        {
            // Most boxes are too far away.
            var reach = Near / _cornerCosine;
            var distanceSquared = box.DistanceSquared(view.Camera.Position);
            if (distanceSquared < reach * reach && IsVisible(view, aspect, box))
            {
                // How near the surface is that the camera is within the box of, is not known: it has the plane that it has alone.
                var (nearest, farthest) = view.DepthsOf(box);
                var bound = (1 - DepthMargin) * Math.Max(nearest, _cornerCosine * Math.Sqrt(distanceSquared));
                Near = Math.Min(
                    Near, distanceSquared > 0 ? Math.Max(bound, MinNearOfObject * farthest) : view.ClipPlanes(box).Near);
            }
        }

        /// <summary>Takes in the farthest depth of a box, if it is in view and appears large enough.</summary>
        public void AddFar(BoundingBox box)
        {
            if (IsVisible(view, aspect, box))
            {
                Far = Math.Max(Far, (1 + DepthMargin) * view.DepthsOf(box).Farthest);
            }
        }
    }
}
