using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render;

/// <summary>How a scene is looked at: camera and projection (paper §4.1.3–4.1.4). What is null follows the scene or the window.</summary>
/// <param name="Camera">Where from.</param>
/// <param name="Projection">How depth becomes size.</param>
public sealed record View(Camera Camera, Projection Projection)
{
    /// <summary>
    /// The least near plane, as a fraction of the far one: a 32-bit depth buffer then tells apart depths that differ by 1/1000.
    /// </summary>
    private const double MinNearToFarRatio = 1e-4;

    /// <summary>The height that an orthographic picture shows, scene units; not used by perspective.</summary>
    public double OrthographicHeight { get; init; } = 10;

    /// <summary>Width divided by height of what is shown; null for the picture's own, else bars fill the rest.</summary>
    public double? Aspect { get; init; }

    /// <summary>The object that the camera is deep in; null where world space tells where it is.</summary>
    public DeepZoom? DeepZoom { get; init; }

    /// <summary>The depths between which things are drawn; null to take them from the bounds of what there is.</summary>
    public (double Near, double Far)? Clip { get; init; }

    /// <summary>The view that a scene asks for, where it asks for one.</summary>
    /// <param name="scene">Gives projection, planes, aspect and its bounds.</param>
    /// <param name="frameAspect">Width divided by height of the window or file: decides how far away a default camera stands.</param>
    /// <param name="camera">Takes the place of the scene's camera, for one that the user moves.</param>
    public static View Of(LoadedScene scene, double frameAspect, Camera? camera = null)
    {
        var (settings, bounds) = (scene.Scene, scene.Bounds);
        camera ??= settings.Camera ?? CameraFraming.Default(bounds, settings.Aspect ?? frameAspect);
        return new(camera, settings.Projection)
        {
            OrthographicHeight = settings.OrthographicHeight ?? DefaultOrthographicHeight(camera, bounds),
            Aspect = settings.Aspect,
            Clip = settings.Clip,
        };
    }

    /// <summary>
    /// The part of a picture that shows the scene, in whole pixels from the upper left corner: all of it, or the largest middle part
    /// with the aspect asked for.
    /// </summary>
    public (int X, int Y, int Width, int Height) Viewport(int width, int height)
    {
        var aspect = Aspect ?? ((double)width / height);
        var viewportWidth = Math.Clamp((int)Math.Round(height * aspect), 1, width);
        var viewportHeight = Math.Clamp((int)Math.Round(width / aspect), 1, height);
        return ((width - viewportWidth) / 2, (height - viewportHeight) / 2, viewportWidth, viewportHeight);
    }

    /// <summary>Where a point of the world appears in a picture.</summary>
    /// <param name="point">World space.</param>
    /// <param name="width">Of the picture, pixels.</param>
    /// <param name="height">Of the picture, pixels.</param>
    /// <returns>
    /// Pixels from the upper left corner, so that (0.5, 0.5) is the middle of the first pixel, and the depth. Null where there
    /// is no such place: perspective shows nothing behind the camera.
    /// </returns>
    public (double X, double Y, double Depth)? Project(Vector point, int width, int height)
    {
        var (right, up, depth) = Camera.ToCameraSpace(point);
        if (Projection == Projection.Perspective && depth <= 0)
        {
            return null;
        }

        var viewport = Viewport(width, height);
        var halfHeight = Projection == Projection.Perspective ? depth * Camera.HalfHeightAtUnitDepth : 0.5 * OrthographicHeight;
        var aspect = EffectiveAspect(width, height);
        return (
            viewport.X + (0.5 * viewport.Width * (1 + (right / (halfHeight * aspect)))),
            viewport.Y + (0.5 * viewport.Height * (1 - (up / halfHeight))),
            depth);
    }

    /// <summary>The planes between which things are drawn.</summary>
    /// <param name="bounds">Of everything there is, world space; may be empty.</param>
    /// <returns>
    /// The scene's own, or planes that hold all of the bounds before the camera, with a margin of a hundredth. Near is positive in
    /// perspective and not negative otherwise.
    /// </returns>
    public (double Near, double Far) ClipPlanes(BoundingBox bounds)
    {
        if (Clip is { } fixedPlanes)
        {
            return fixedPlanes;
        }

        if (bounds.IsEmpty || !bounds.Minimum.IsFinite() || !bounds.Maximum.IsFinite())
        {
            return (0.1, 1000);
        }

        var (centreDepth, halfExtent) = DepthExtent(bounds);
        var margin = (0.01 * halfExtent) + (1e-6 * Math.Abs(centreDepth));
        var far = centreDepth + halfExtent + margin;
        if (far <= 0)
        {
            // Everything lies behind the camera.
            return (0.1, 1000);
        }

        var near = centreDepth - halfExtent - margin;
        return Projection == Projection.Perspective ? (Math.Max(near, MinNearToFarRatio * far), far) : (Math.Max(near, 0), far);
    }

    /// <summary>False for a box that certainly lies outside the picture: behind the camera, or beyond one of the picture's edges.</summary>
    /// <param name="box">World space; infinite ones are seen from everywhere.</param>
    /// <param name="aspect">Width divided by height of the picture.</param>
    public bool MayIntersectFrustum(BoundingBox box, double aspect)
    {
        if (box.IsEmpty || !box.Size.IsFinite())
        {
            return !box.IsEmpty;
        }

        var axes = Camera.LocalAxesInverse;
        var (centre, halfSize) = (Camera.ToCameraSpace(box.Centre), axes.Absolute() * (0.5 * box.Size));
        var effectiveAspect = Aspect ?? aspect;
        if (Projection == Projection.Orthographic)
        {
            return centre.Z + halfSize.Z > 0 && Math.Abs(centre.X) - halfSize.X < 0.5 * OrthographicHeight * effectiveAspect
                && Math.Abs(centre.Y) - halfSize.Y < 0.5 * OrthographicHeight;
        }

        var halfHeightAtUnitDepth = Camera.HalfHeightAtUnitDepth;
        var farthestDepth = centre.Z + halfSize.Z;
        return farthestDepth > 0 && Math.Abs(centre.X) - halfSize.X < halfHeightAtUnitDepth * effectiveAspect * farthestDepth
            && Math.Abs(centre.Y) - halfSize.Y < halfHeightAtUnitDepth * farthestDepth;
    }

    /// <summary>True when no part of a box is nearer than the near plane: then it is seen from outside, and whole.</summary>
    internal bool IsBeyondNearPlane(BoundingBox box, BoundingBox bounds) =>
        DepthExtent(box) is var (centreDepth, halfExtent) && centreDepth - halfExtent > ClipPlanes(bounds).Near;

    /// <summary>Width divided by height of what is shown, exact where it was asked for.</summary>
    internal double EffectiveAspect(int width, int height) => Aspect ?? ((double)width / height);

    /// <summary>The depth of a box's middle, and how far it reaches from there to both sides.</summary>
    private (double Middle, double Reach) DepthExtent(BoundingBox box)
    {
        var axes = Camera.LocalAxesInverse.Absolute();
        return (Camera.ToCameraSpace(box.Centre).Z, 0.5 * Vector.Dot(new(axes.V1.Z, axes.V2.Z, axes.V3.Z), box.Size));
    }

    /// <summary>What perspective shows at the depth of the middle of things; their size where that lies behind the camera.</summary>
    private static double DefaultOrthographicHeight(Camera camera, BoundingBox bounds) => camera.ToCameraSpace(bounds.Centre).Z switch
    {
        > 0 and < double.PositiveInfinity and var depth => 2 * camera.HalfHeightAtUnitDepth * depth,
        _ when bounds.Diagonal is > 0 and < double.PositiveInfinity => bounds.Diagonal,
        _ => 10,
    };
}
