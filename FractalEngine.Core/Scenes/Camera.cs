using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>
/// Where the scene is seen from (paper §4.1.3). The inverse of its axes is computed once, when the camera is turned
/// (each turn makes a new camera), never per frame or vertex.
/// </summary>
public sealed record Camera
{
    private readonly Vector _rotation;

    /// <summary>A camera.</summary>
    /// <param name="position">World space, scene units.</param>
    /// <param name="rotation">Euler angles in radians, see <see cref="Vector.LocalAxes"/>.</param>
    /// <param name="fieldOfView">The full vertical angle of view in degrees, between 0 and 180.</param>
    public Camera(Vector position, Vector rotation, double fieldOfView) =>
        (Position, Rotation, FieldOfView) = (position, rotation, fieldOfView);

    /// <summary>Five units before the origin, looking along the z axis.</summary>
    public static Camera Default { get; } = new(new(0, 0, -5), Vector.Zero, 60);

    /// <summary>World space, scene units.</summary>
    public Vector Position { get; init; }

    /// <summary>Euler angles in radians.</summary>
    public Vector Rotation
    {
        get => _rotation;
        init
        {
            _rotation = value;
            LocalAxes = value.LocalAxes();
            LocalAxesInverse = LocalAxes.Inverse();
        }
    }

    /// <summary>The full vertical angle of view in degrees.</summary>
    public double FieldOfView { get; init; }

    /// <summary>Columns: the camera's right, up and forward axes in world space.</summary>
    public Matrix LocalAxes { get; private init; }

    /// <summary>Sends world directions to (right, up, depth).</summary>
    public Matrix LocalAxesInverse { get; private init; }

    /// <summary>The tangent of half the angle of view: half the visible height at depth 1.</summary>
    public double HalfHeightAtUnitDepth => Math.Tan(FieldOfView * Math.PI / 360);

    /// <summary>
    /// The paper's map(v) = LocalAxes⁻¹·(v − position): how far right of, above and before the camera a point is.
    /// </summary>
    public Vector ToCameraSpace(Vector point) => LocalAxesInverse * (point - Position);

    /// <inheritdoc/>
    public bool Equals(Camera? other) =>
        other is not null && Position == other.Position && Rotation == other.Rotation && FieldOfView.Equals(other.FieldOfView);

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Position, Rotation, FieldOfView);
}
