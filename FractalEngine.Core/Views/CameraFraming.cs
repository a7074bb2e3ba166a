using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.Core.Views;

/// <summary>Places cameras so that they show a whole box.</summary>
public static class CameraFraming
{
    /// <summary>Fraction of the frame's limiting side that framing fills, in most frames the smaller one.</summary>
    public const double FilledFraction = 0.8;

    // Each halves the error: more than a double has places.
    private const int MaxBisections = 60;

    /// <summary>The rotation of the default camera, radians: it looks from the right, above and before the scene.</summary>
    public static Vector DefaultRotation => LookRotation(new(-0.55, -0.42, 1));

    /// <summary>Computes the angles (radians) that turn the forward axis to a direction, without roll.</summary>
    /// <param name="direction">
    /// In the axes of a camera without rotation: right, up and forward. Of any length but 0; straight up and down are allowed.
    /// </param>
    public static Vector LookRotation(Vector direction) => LookRotation(direction, Vector.J);

    /// <summary>
    /// Computes the angles (radians) that turn the forward axis to a direction, and the up axis to another one as far as that goes.
    /// </summary>
    /// <param name="direction">In the axes of a camera without rotation: right, up and forward. Of any length but 0.</param>
    /// <param name="up">Likewise. Where it is parallel to the direction, the x axis becomes the right one.</param>
    public static Vector LookRotation(Vector direction, Vector up)
    {
        var forward = direction.UnitVector();
        var horizontal = Vector.Cross(up, forward);
        // Looking straight up or down, any direction may be right: the x axis is taken.
        var right = horizontal.Length() > 1e-12 ? horizontal.UnitVector() : Vector.I;
        return new Matrix(right, Vector.Cross(forward, right), forward).EulerAngles();
    }

    /// <summary>Makes a camera that looks from one point to another.</summary>
    /// <param name="position">World space.</param>
    /// <param name="target">A point in the middle of the image, world space; another one than the position.</param>
    /// <param name="up">A direction in world space that is up in the image.</param>
    /// <param name="fieldOfView">The full vertical angle of view in degrees, between 0 and 180.</param>
    /// <param name="handedness">That of the scene.</param>
    /// <exception cref="ArgumentException">A number is NaN or infinite, or the angle of view is out of its range.</exception>
    public static Camera LookAt(Vector position, Vector target, Vector up, double fieldOfView, Handedness handedness)
    {
        var direction = target - position;
        // Points at opposite ends of the range of doubles.
        direction = direction.IsFinite() ? direction : (0.5 * target) - (0.5 * position);
        var rotation = LookRotation(handedness.Mirror(direction), handedness.Mirror(up.UnitVector()));
        return new(position, rotation, fieldOfView) { Handedness = handedness };
    }

    /// <summary>
    /// Moves a camera so that a box fills <see cref="FilledFraction"/> of the frame, in the middle. Its rotation and angle of view are
    /// kept.
    /// </summary>
    /// <param name="camera">Its rotation and angle of view are kept.</param>
    /// <param name="box">World space.</param>
    /// <param name="aspect">Width divided by height of the image.</param>
    public static Camera Frame(Camera camera, BoundingBox box, double aspect)
    {
        if (box.IsEmpty)
        {
            box = new(Vector.Zero, Vector.Zero);
        }
        else if (!box.Size.IsFinite())
        {
            // From nowhere all of it is in view.
            box = new(-Vector.One, Vector.One);
        }

        return Frame(camera, [.. Enumerable.Range(0, 8).Select(box.Corner)], box, aspect);
    }

    /// <summary>
    /// Moves a camera so that what is visible of a scene fills <see cref="FilledFraction"/> of the frame, in the middle. Meshes are framed
    /// by their vertices, and fractals by boxes around their parts.
    /// </summary>
    /// <param name="camera">Its rotation and angle of view are kept.</param>
    /// <param name="scene">The scene with its models.</param>
    /// <param name="aspect">Width divided by height of the image.</param>
    public static Camera FrameScene(Camera camera, LoadedScene scene, double aspect)
    {
        ArgumentNullException.ThrowIfNull(scene);
        var points = FramingPoints.Collect(scene);
        return points.IsEmpty ? Frame(camera, scene.Bounds, aspect) : Frame(camera, points, scene.Bounds, aspect);
    }

    /// <summary>Finds the height of an orthographic view that a camera frames a scene with.</summary>
    /// <param name="camera">The camera, which <see cref="FrameScene"/> has moved.</param>
    /// <param name="scene">The scene with its models.</param>
    /// <param name="aspect">Width divided by height of the image.</param>
    /// <returns>The camera in the middle of what is visible, and the visible height in scene units; null for a point.</returns>
    public static (Camera Camera, double? Height) FrameSceneOrthographic(Camera camera, LoadedScene scene, double aspect)
    {
        ArgumentNullException.ThrowIfNull(scene);
        var points = FramingPoints.Collect(scene);
        if (points.IsEmpty)
        {
            return (camera, null);
        }

        var (left, right, bottom, top) = (double.MaxValue, double.MinValue, double.MaxValue, double.MinValue);
        foreach (var point in points)
        {
            var (x, y, _) = camera.ToCameraSpace(point);
            (left, right, bottom, top) = (Math.Min(left, x), Math.Max(right, x), Math.Min(bottom, y), Math.Max(top, y));
        }

        var height = Math.Max(top - bottom, (right - left) / aspect) / FilledFraction;
        var centred = CameraNavigation.Move(camera, new(0.5 * (left + right), 0.5 * (bottom + top), 0));
        return height > 0 ? (centred, height) : (centred, null);
    }

    /// <summary>Frames points. The box that holds them gives a scale, for points that coincide.</summary>
    private static Camera Frame(Camera camera, ImmutableArray<Vector> points, BoundingBox box, double aspect)
    {
        // The points in the axes of the camera: right, up and forward from the box's centre.
        var inverse = camera.LocalAxesInverse;
        var local = points.Select(point => inverse * (point - box.Centre)).ToArray();
        var slopeY = FilledFraction * camera.HalfHeightAtUnitDepth;
        var slopeX = aspect * slopeY;
        // A point is inside the planes through the camera at (x, y, z) when |right − x| ≤ slope·(forward − z).
        var depth = Math.Min(
            DepthThatShows(local.Select(static point => (point.X, point.Z)), slopeX),
            DepthThatShows(local.Select(static point => (point.Y, point.Z)), slopeY));
        var minDistance = Math.Max(1e-3 * box.Diagonal, 1e-9 * ((box.Diagonal > 0 ? 0 : 1) + box.Centre.MaxAbsComponent()));
        depth = Math.Min(depth, local.Min(static point => point.Z) - minDistance);
        var position = new Vector(
            FindCentre(local.Select(static point => (point.X, point.Z)), depth),
            FindCentre(local.Select(static point => (point.Y, point.Z)), depth), depth);
        position = box.Centre + (camera.LocalAxes * position);
        // No position shows all of a box that is nearly as large as a double can be.
        return camera with { Position = position.IsFinite() ? position : box.Centre };
    }

    /// <summary>Finds the forwardmost place from which points are inside two planes through it, in the middle between them.</summary>
    private static double DepthThatShows(IEnumerable<(double Across, double Forward)> points, double slope)
    {
        var right = double.MinValue;
        var left = double.MaxValue;
        foreach (var (across, forward) in points)
        {
            right = Math.Max(right, across - (slope * forward));
            left = Math.Min(left, across + (slope * forward));
        }

        return (left - right) / (2 * slope);
    }

    /// <summary>Finds the place across the view from which the outermost points appear equally far from the middle.</summary>
    private static double FindCentre(IEnumerable<(double Across, double Forward)> points, double depth)
    {
        var all = points.ToArray();
        var low = all.Min(static point => point.Across);
        var high = all.Max(static point => point.Across);
        // The sum of both extremes falls as the place moves across.
        for (var i = 0; i < MaxBisections && low < high; i++)
        {
            var middle = low + (0.5 * (high - low));
            var (least, greatest) = (double.MaxValue, double.MinValue);
            foreach (var (across, forward) in all)
            {
                var slope = (across - middle) / (forward - depth);
                (least, greatest) = (Math.Min(least, slope), Math.Max(greatest, slope));
            }

            if (least + greatest > 0)
            {
                low = middle;
            }
            else
            {
                high = middle;
            }
        }

        return low + (0.5 * (high - low));
    }

    /// <summary>Makes the camera of a scene that names none.</summary>
    /// <param name="box">World space.</param>
    /// <param name="aspect">Width divided by height of the image.</param>
    /// <param name="handedness">That of the scene.</param>
    public static Camera Default(BoundingBox box, double aspect, Handedness handedness = Handedness.Left) =>
        Frame(Camera.Default with { Rotation = DefaultRotation, Handedness = handedness }, box, aspect);

    /// <summary>Makes the camera that shows all of a scene, from the right, above and before it.</summary>
    /// <param name="scene">With its models loaded; a camera of its own is ignored.</param>
    /// <param name="aspect">Width divided by height of the image.</param>
    /// <exception cref="FractalEngineException">An object names a file that is not loaded.</exception>
    public static Camera Default(Scene scene, double aspect = 16 / 9.0) => Default(LoadedScene.Of(scene), aspect);

    /// <summary>Makes the camera of a scene that names none, by what is visible of it.</summary>
    /// <param name="scene">The scene with its models.</param>
    /// <param name="aspect">Width divided by height of the image.</param>
    public static Camera Default(LoadedScene scene, double aspect)
    {
        ArgumentNullException.ThrowIfNull(scene);
        return FrameScene(Camera.Default with { Rotation = DefaultRotation, Handedness = scene.Scene.Handedness }, scene, aspect);
    }
}
