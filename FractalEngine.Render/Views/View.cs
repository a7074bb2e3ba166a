using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;

namespace FractalEngine.Render.Views;

/// <summary>A camera with its projection (paper §4.1.3–4.1.4). Properties that are null follow the scene or the window.</summary>
/// <param name="Camera">Position and orientation of the viewer.</param>
/// <param name="Projection">Perspective or orthographic projection.</param>
public sealed record View(Camera Camera, Projection Projection)
{
    /// <summary>
    /// Minimum of the near depth divided by the far one: a 32-bit depth buffer then separates depths that differ by 1/1000.
    /// </summary>
    private const double MinNearToFarRatio = 1e-4;

    // Natural logarithm of 1e11.
    private const double MaxSectionLogMagnification = 25.3;

    // Clip planes and height where the scene has no bounds to derive them from, scene units.
    private static readonly (double Near, double Far) DefaultClipPlanes = (0.1, 1000);
    private const double DefaultHeight = 10;

    /// <summary>Visible height of an orthographic view, scene units; perspective ignores it.</summary>
    public double OrthographicHeight { get; init; } = DefaultHeight;

    /// <summary>Width divided by height of the viewport, with bars around it where the frame differs; null for the frame's own.</summary>
    /// <exception cref="ArgumentException">The ratio is not positive and finite.</exception>
    public double? Aspect
    {
        get;
        init => field = value is null or (> 0 and < double.PositiveInfinity)
            ? value
            : throw new ArgumentException("expected a positive and finite aspect ratio", nameof(Aspect));
    }

    /// <summary>
    /// How far the middle of the image lies to the right of that of the frame, as a part of the frame's width: above −0.5 and below 0.5. It
    /// moves the image where panels cover a side of the frame. Views with an <see cref="Aspect"/> stay in the middle.
    /// </summary>
    /// <exception cref="ArgumentException">The number is out of its range.</exception>
    public double HorizontalShift
    {
        get;
        init => field = value is > -0.5 and < 0.5
            ? value
            : throw new ArgumentException("expected a shift by less than half of the frame", nameof(HorizontalShift));
    }

    /// <summary>Colour behind the scene; null for the scene's own, or for that of the settings where it has none.</summary>
    public Colour? Background { get; init; }

    /// <summary>Object that the camera is deep inside; null where world space is precise enough for the camera's position.</summary>
    public DeepZoom? DeepZoom { get; init; }

    /// <summary>Plane that cuts the scene open, world space; null for none. It moves with neither camera nor objects.</summary>
    /// <remarks>
    /// Beyond a magnification of 10¹¹ a plane in world space has no exact place beside the camera, and is left out.
    /// </remarks>
    public SectionPlane? Section { get; init; }

    /// <summary>Depths of the near and far clip planes, scene units; null to derive them from the scene's bounds.</summary>
    /// <exception cref="ArgumentException">The depths are not finite, or not 0 &lt; near &lt; far.</exception>
    public (double Near, double Far)? FixedClipPlanes
    {
        get;
        init => field = value is null || (value is { Near: > 0, Far: < double.PositiveInfinity } planes && planes.Near < planes.Far)
            ? value
            : throw new ArgumentException("expected clip planes with 0 < near < far", nameof(FixedClipPlanes));
    }

    /// <summary>The section plane in world axes about the camera, in the unit of a deep zoom; null for none.</summary>
    internal SectionPlane? RelativeSection
    {
        get
        {
            var logUnit = DeepZoom?.LogUnit ?? 0;
            return logUnit < -MaxSectionLogMagnification ? null : Section?.About(Camera.Position, Math.Exp(logUnit));
        }
    }

    /// <summary>Half of the visible height, scene units: at depth 1 in perspective, at any depth in orthographic projection.</summary>
    internal double HalfHeight => Projection == Projection.Perspective ? Camera.HalfHeightAtUnitDepth : 0.5 * OrthographicHeight;

    /// <summary>Returns half the height that the frame shows at a depth, scene units.</summary>
    public double HalfHeightAt(double depth) => Projection == Projection.Perspective ? depth * HalfHeight : HalfHeight;

    /// <summary>
    /// Whether surfaces out of focus are blurred: by a lens, in perspective. Within a deep zoom, scene units are no measure for what is
    /// seen, so that everything is sharp.
    /// </summary>
    public bool HasLens => Camera.Aperture > 0 && Projection == Projection.Perspective && DeepZoom is null;

    /// <summary>Returns a point of the camera's lens.</summary>
    /// <param name="point">A point of the unit square, which is mapped to a disc evenly (P. Shirley and K. Chiu, 1997).</param>
    /// <returns>To the right and upwards of the lens's middle, scene units.</returns>
    internal (double Right, double Up) LensPoint((double U, double V) point)
    {
        var (a, b) = ((2 * point.U) - 1, (2 * point.V) - 1);
        var isWide = Math.Abs(a) > Math.Abs(b);
        var radius = 0.5 * Camera.Aperture * (isWide ? a : b);
        var angle = a == 0 && b == 0 ? 0 : Math.PI / 4 * (isWide ? b / a : 2 - (a / b));
        return (radius * Math.Cos(angle), radius * Math.Sin(angle));
    }

    /// <summary>Creates the view that a scene declares, with defaults for what it leaves open.</summary>
    /// <param name="scene">Scene that gives projection, clip planes, aspect ratio and bounds.</param>
    /// <param name="frameAspect">Width divided by height of the window or image. A default camera frames the scene for it.</param>
    /// <param name="camera">Camera that replaces the scene's own, and takes its handedness; null for none.</param>
    /// <exception cref="ArgumentException">The scene's aspect ratio or clip planes are out of range.</exception>
    public static View Of(LoadedScene scene, double frameAspect, Camera? camera = null)
    {
        var settings = scene.Scene;
        camera ??= settings.Camera ?? CameraFraming.Default(scene, settings.Aspect ?? frameAspect);
        if (camera.Handedness != settings.Handedness)
        {
            camera = camera with { Handedness = settings.Handedness };
        }

        return new(camera, settings.Projection)
        {
            OrthographicHeight = settings.OrthographicHeight ?? DefaultOrthographicHeight(camera, scene.Bounds),
            Aspect = settings.Aspect,
            FixedClipPlanes = settings.Clip,
        };
    }

    /// <summary>Returns the part of a frame that shows the scene: all of it, or the largest centred part of the requested aspect.</summary>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    /// <returns>
    /// A rectangle in whole pixels, from the upper left corner. With a <see cref="HorizontalShift"/> it reaches beyond one side of the
    /// frame, as far as that takes to have the middle of the image in its own.
    /// </returns>
    public (int X, int Y, int Width, int Height) Viewport(int width, int height)
    {
        if (Aspect is null && HorizontalShift != 0)
        {
            var shift = ShiftInPixels(width);
            return (Math.Min(0, 2 * shift), 0, width + (2 * Math.Abs(shift)), height);
        }

        var aspect = EffectiveAspect(width, height);
        var viewportWidth = Math.Clamp((int)Math.Round(height * aspect), 1, width);
        var viewportHeight = Math.Clamp((int)Math.Round(width / aspect), 1, height);
        return ((width - viewportWidth) / 2, (height - viewportHeight) / 2, viewportWidth, viewportHeight);
    }

    /// <summary>Projects a point of the world into a frame.</summary>
    /// <param name="point">Point in world space.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    /// <returns>
    /// Pixels from the upper left corner, with the centre of the first pixel at (0.5, 0.5), and the depth in scene units. Null for a point
    /// behind a perspective camera.
    /// </returns>
    public (double X, double Y, double Depth)? Project(Vector point, int width, int height)
    {
        var (right, up, depth) = Camera.ToCameraSpace(point);
        if (Projection == Projection.Perspective && depth <= 0)
        {
            return null;
        }

        var viewport = Viewport(width, height);
        var halfHeight = HalfHeightAt(depth);
        var aspect = EffectiveAspect(width, height);
        return (
            viewport.X + (0.5 * viewport.Width * (1 + (right / (halfHeight * aspect)))),
            viewport.Y + (0.5 * viewport.Height * (1 - (up / halfHeight))),
            depth);
    }

    /// <summary>Returns the ray through a point of a frame: the reverse of <see cref="Project"/>.</summary>
    /// <param name="x">Pixels from the left edge; the centre of the first pixel is at 0.5.</param>
    /// <param name="y">Pixels from the upper edge.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    /// <returns>A ray from the camera, or from its plane in orthographic projection. World space.</returns>
    public Ray RayThrough(double x, double y, int width, int height)
    {
        var viewport = Viewport(width, height);
        var right = ((2 * (x - viewport.X) / viewport.Width) - 1) * HalfHeight * EffectiveAspect(width, height);
        var up = (1 - (2 * (y - viewport.Y) / viewport.Height)) * HalfHeight;
        return Projection == Projection.Perspective
            ? new(Camera.Position, Camera.LocalAxes * new Vector(right, up, 1))
            : new(Camera.Position + (Camera.LocalAxes * new Vector(right, up, 0)), Camera.LocalAxes.V3);
    }

    /// <summary>Moves the camera so that an orthographic image moves on the screen.</summary>
    /// <param name="offset">Pixels to the right and upwards.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    internal View MovedBy((double X, double Y) offset, int width, int height)
    {
        var pixel = 2 * HalfHeight / Viewport(width, height).Height;
        return WithEyeAt((-pixel * offset.X, -pixel * offset.Y));
    }

    /// <summary>Moves the camera to the right and upwards, scene units.</summary>
    internal View WithEyeAt((double Right, double Up) place) => this with
    {
        Camera = Camera with { Position = Camera.Position + (Camera.LocalAxes * new Vector(place.Right, place.Up, 0)) },
    };

    /// <summary>Returns the depths of the near and far clip planes.</summary>
    /// <param name="bounds">Bounds of all that is drawn, world space; may be empty.</param>
    /// <returns>
    /// <see cref="FixedClipPlanes"/>, or planes that enclose the part of the bounds before the camera, with a margin of a hundredth. The
    /// near depth is positive in perspective and not negative otherwise.
    /// </returns>
    public (double Near, double Far) ClipPlanes(BoundingBox bounds)
    {
        if (FixedClipPlanes is { } fixedPlanes)
        {
            return fixedPlanes;
        }

        if (bounds.IsEmpty || !bounds.Minimum.IsFinite() || !bounds.Maximum.IsFinite())
        {
            return DefaultClipPlanes;
        }

        var (centreDepth, halfExtent) = DepthExtent(bounds);
        var margin = (0.01 * halfExtent) + (1e-6 * Math.Abs(centreDepth));
        var far = centreDepth + halfExtent + margin;
        if (far <= 0)
        {
            // Everything lies behind the camera.
            return DefaultClipPlanes;
        }

        var near = centreDepth - halfExtent - margin;
        return Projection == Projection.Perspective ? (Math.Max(near, MinNearToFarRatio * far), far) : (Math.Max(near, 0), far);
    }

    /// <summary>
    /// Tests a box against the view frustum, conservatively: false if it is certainly behind the camera or beyond an edge of the frame.
    /// </summary>
    /// <remarks>
    /// This frustum test serves objects as wholes: meshes that physics moves, in every frame, and models that are prepared on first sight.
    /// Sub-fractals are tested by <see cref="Core.Visibility.VisibleSet"/>. The planes of depth are not tested, besides the camera's own.
    /// </remarks>
    /// <param name="box">Box in world space. An infinite box is visible from everywhere.</param>
    /// <param name="aspect">Width divided by height of the frame.</param>
    public bool MayIntersectFrustum(BoundingBox box, double aspect)
    {
        if (box.IsEmpty || !box.Size.IsFinite())
        {
            return !box.IsEmpty;
        }

        var centre = Camera.ToCameraSpace(box.Centre);
        var halfSize = Camera.LocalAxesInverse.Absolute() * (0.5 * box.Size);
        var farthestDepth = centre.Z + halfSize.Z;
        var depthScale = Projection == Projection.Perspective ? farthestDepth : 1;
        var halfHeight = HalfHeight;
        var widthToHeight = Aspect ?? (aspect * (1 + (2 * Math.Abs(HorizontalShift))));
        return farthestDepth > 0 && Math.Abs(centre.X) - halfSize.X < halfHeight * widthToHeight * depthScale
            && Math.Abs(centre.Y) - halfSize.Y < halfHeight * depthScale;
    }

    /// <summary>Tests whether a whole box is deeper than a plane, so that this plane cuts through none of it.</summary>
    internal bool IsBeyondDepth(BoundingBox box, double depth) => DepthsOf(box).Nearest > depth;

    /// <summary>Returns the smallest and the largest depth of a box; negative behind the camera.</summary>
    internal (double Nearest, double Farthest) DepthsOf(BoundingBox box)
    {
        var (centreDepth, halfExtent) = DepthExtent(box);
        return (centreDepth - halfExtent, centreDepth + halfExtent);
    }

    /// <summary>Returns width divided by height of the viewport, exact where the view requests an aspect.</summary>
    internal double EffectiveAspect(int width, int height) =>
        Aspect ?? ((double)(width + (2 * Math.Abs(ShiftInPixels(width)))) / height);

    private int ShiftInPixels(int width) => (int)Math.Round(HorizontalShift * width);

    /// <summary>Returns the depth of a box's centre, and half of its extent along the viewing direction.</summary>
    private (double CentreDepth, double HalfExtent) DepthExtent(BoundingBox box)
    {
        var axes = Camera.LocalAxesInverse.Absolute();
        return (Camera.ToCameraSpace(box.Centre).Z, 0.5 * Vector.Dot(new(axes.V1.Z, axes.V2.Z, axes.V3.Z), box.Size));
    }

    /// <summary>Returns the height that perspective shows at the scene's centre, or the scene's size if that lies behind.</summary>
    private static double DefaultOrthographicHeight(Camera camera, BoundingBox bounds)
    {
        var depth = camera.ToCameraSpace(bounds.Centre).Z;
        return depth is > 0 and < double.PositiveInfinity
            ? 2 * camera.HalfHeightAtUnitDepth * depth
            : bounds.FiniteDiagonalOr(DefaultHeight);
    }
}
