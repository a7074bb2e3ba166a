using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Cameras;

/// <summary>
/// The position, rotation and angle of view from which a scene is seen (paper §4.1.3). The inverse of its axes is computed once, when the
/// camera is made, never per frame or vertex.
/// </summary>
public sealed record Camera
{
    /// <summary>Makes a camera from its position, rotation and angle of view.</summary>
    /// <param name="position">World space, scene units.</param>
    /// <param name="rotation">Euler angles in radians, see <see cref="Vector.LocalAxes"/>.</param>
    /// <param name="fieldOfView">The full vertical angle of view in degrees, between 0 and 180.</param>
    /// <exception cref="ArgumentException">
    /// A number is NaN or infinite, or the angle of view is not more than 0 and less than 180 degrees.
    /// </exception>
    public Camera(Vector position, Vector rotation, double fieldOfView) =>
        (Position, Rotation, FieldOfView) = (position, rotation, fieldOfView);

    /// <summary>A camera of a left-handed scene, five units before the origin and looking along the z axis.</summary>
    public static Camera Default { get; } = new(new(0, 0, -5), Vector.Zero, 60);

    /// <summary>Position in world space, scene units.</summary>
    /// <exception cref="ArgumentException">A coordinate is NaN or infinite.</exception>
    public Vector Position
    {
        get;
        init => field = value.IsFinite() ? value : throw new ArgumentException("expected a finite position", nameof(Position));
    }

    /// <summary>Euler angles in radians, see <see cref="Vector.LocalAxes"/>.</summary>
    /// <exception cref="ArgumentException">An angle is NaN or infinite.</exception>
    public Vector Rotation
    {
        get;
        init
        {
            field = value.IsFinite() ? value : throw new ArgumentException("expected a finite rotation", nameof(Rotation));
            (LocalAxes, LocalAxesInverse) = ComputeAxes(value, Handedness);
        }
    }

    /// <summary>How the scene's coordinates are shown; left unless stated otherwise. A scene sets it for its own camera.</summary>
    /// <remarks>
    /// A right-handed camera sees the scene mirrored in z, as a left-handed camera of the same rotation would see the mirrored scene.
    /// Without rotation it looks along −z.
    /// </remarks>
    public Handedness Handedness
    {
        get;
        init
        {
            field = value;
            (LocalAxes, LocalAxesInverse) = ComputeAxes(Rotation, value);
        }
    }

    /// <summary>The full vertical angle of view in degrees, between 0 and 180.</summary>
    /// <exception cref="ArgumentException">The angle is not more than 0 and less than 180 degrees.</exception>
    public double FieldOfView
    {
        get;
        init => field = value is > 0 and < 180
            ? value
            : throw new ArgumentException("expected an angle of view between 0 and 180 degrees", nameof(FieldOfView));
    }

    /// <summary>Diameter of the lens in scene units: 0, as unless stated otherwise, shows everything sharp.</summary>
    /// <exception cref="ArgumentException">The diameter is negative or not finite.</exception>
    public double Aperture
    {
        get;
        init => field = value is >= 0 and < double.PositiveInfinity
            ? value
            : throw new ArgumentException("expected a finite diameter that is not negative", nameof(Aperture));
    }

    /// <summary>Depth of the plane that a lens shows sharp, scene units; 1 unless stated otherwise.</summary>
    /// <exception cref="ArgumentException">The depth is not positive and finite.</exception>
    public double FocusDepth
    {
        get;
        init => field = value is > 0 and < double.PositiveInfinity
            ? value
            : throw new ArgumentException("expected a positive and finite depth", nameof(FocusDepth));
    } = 1;

    /// <summary>Columns: the camera's right, up and forward axes in world space. The determinant is −1 in a right-handed scene.</summary>
    public Matrix LocalAxes { get; private init; }

    /// <summary>The inverse of <see cref="LocalAxes"/>: maps world directions to (right, up, depth).</summary>
    public Matrix LocalAxesInverse { get; private init; }

    /// <summary>The tangent of half the angle of view: half the visible height at depth 1.</summary>
    public double HalfHeightAtUnitDepth => Math.Tan(FieldOfView * Math.PI / 360);

    /// <summary>
    /// Maps a world point to camera space, the paper's map(v) = LocalAxes⁻¹·(v − position): its distances to the right of, above and before
    /// the camera.
    /// </summary>
    public Vector ToCameraSpace(Vector point) => LocalAxesInverse * (point - Position);

    private static (Matrix Axes, Matrix Inverse) ComputeAxes(Vector rotation, Handedness handedness)
    {
        var (right, up, forward) = rotation.LocalAxes();
        var axes = new Matrix(handedness.Mirror(right), handedness.Mirror(up), handedness.Mirror(forward));
        return (axes, axes.Inverse());
    }
}
