using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>Places cameras so that they show a whole box.</summary>
public static class CameraFraming
{
    private const double Margin = 1.1;

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
        var rotation = LookRotation(handedness.Mirror(target - position), handedness.Mirror(up.UnitVector()));
        return new(position, rotation, fieldOfView) { Handedness = handedness };
    }

    /// <summary>Moves a camera along its forward axis so that it shows the whole box.</summary>
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

        var halfHeight = camera.HalfHeightAtUnitDepth;
        // A point at (right, up, forward) from the box's centre is in view from a distance d before it when
        // |right| ≤ aspect·half·(d + forward) and |up| ≤ half·(d + forward).
        var distance = Corners(box).Max(corner =>
        {
            var (right, up, forward) = camera.LocalAxesInverse * (corner - box.Centre);
            return (Math.Max(Math.Abs(right) / aspect, Math.Abs(up)) / halfHeight) - forward;
        });
        var minDistance = Math.Max(0.5 * box.Diagonal, 1e-9 * (1 + box.Centre.MaxAbsComponent()));
        var position = box.Centre - (Margin * Math.Max(distance, minDistance) * camera.LocalAxes.V3);
        // Of a box that is nearly as large as a double can be, no position shows all.
        return camera with { Position = position.IsFinite() ? position : box.Centre };
    }

    private static IEnumerable<Vector> Corners(BoundingBox box) =>
        from x in (double[])[box.Minimum.X, box.Maximum.X]
        from y in (double[])[box.Minimum.Y, box.Maximum.Y]
        from z in (double[])[box.Minimum.Z, box.Maximum.Z]
        select new Vector(x, y, z);

    /// <summary>Makes the camera of a scene that names none.</summary>
    /// <param name="box">World space.</param>
    /// <param name="aspect">Width divided by height of the image.</param>
    /// <param name="handedness">That of the scene.</param>
    public static Camera Default(BoundingBox box, double aspect, Handedness handedness = Handedness.Left) =>
        Frame(Camera.Default with { Rotation = DefaultRotation, Handedness = handedness }, box, aspect);
}
