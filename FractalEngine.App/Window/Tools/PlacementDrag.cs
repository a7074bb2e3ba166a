using FractalEngine.Core.Maths;

namespace FractalEngine.App.Window.Tools;

/// <summary>
/// A drag of a handle: where the object stood when it began, from which each place of the pointer gives another placement.
/// </summary>
/// <param name="Kind">What the handle does.</param>
/// <param name="Axis">0, 1 and 2 for x, y and z; −1 for all of them.</param>
/// <param name="Placement">Placement of the object when the drag began.</param>
/// <param name="Middle">Middle of the object then, world space. It stays where it is unless the object is moved.</param>
internal sealed record PlacementDrag(HandleKind Kind, int Axis, Transformation Placement, Vector Middle)
{
    /// <summary>Degrees in which turns snap.</summary>
    public const double SnapAngle = 15;

    /// <summary>Factors in which scales snap.</summary>
    public const double SnapFactor = 0.1;

    /// <summary>Unit vectors of the world.</summary>
    public static Vector UnitAxis(int axis) => axis switch { 0 => Vector.I, 1 => Vector.J, _ => Vector.K };

    /// <summary>Computes the placement of the moved object.</summary>
    /// <param name="displacement">From where it stood, world space.</param>
    /// <param name="grid">The changed coordinates become multiples of this; 0 to leave them.</param>
    public Transformation Move(Vector displacement, double grid)
    {
        var (x, y, z) = Placement.Position + displacement;
        return Placement with
        {
            Position = new(
                displacement.X == 0 ? x : Round(x, grid), displacement.Y == 0 ? y : Round(y, grid),
                displacement.Z == 0 ? z : Round(z, grid)),
        };
    }

    /// <summary>Turns the object about its middle and an axis of the world.</summary>
    /// <param name="degrees">From x to y about z, from y to z about x, from z to x about y.</param>
    /// <param name="snaps">Whether the angle becomes a multiple of <see cref="SnapAngle"/>.</param>
    public Transformation Turn(double degrees, bool snaps)
    {
        degrees = Round(degrees, snaps ? SnapAngle : 0.1);
        var turn = Matrix.Rotation(UnitAxis(Axis), degrees * Math.PI / 180);
        var rotated = (turn * Placement.Rotation.LocalAxesFromDegrees()).Orthonormalized().EulerAngles();
        var angles = 180 / Math.PI * rotated;
        return Placement with
        {
            Rotation = new(Round(angles.X, 1e-9), Round(angles.Y, 1e-9), Round(angles.Z, 1e-9)),
            Position = Tidy(Middle + (turn * (Placement.Position - Middle))),
        };
    }

    /// <summary>Scales the object about its middle.</summary>
    /// <param name="factor">Of the lengths along the axis of the handle, or of all lengths; kept from 0 and from mirroring.</param>
    /// <param name="snaps">Whether the factor becomes a multiple of <see cref="SnapFactor"/>.</param>
    public Transformation Scale(double factor, bool snaps)
    {
        const double Step = 0.01;
        factor = Math.Max(snaps ? SnapFactor : Step, Round(factor, snaps ? SnapFactor : Step));
        var factors = Axis < 0 ? factor * Vector.One : Vector.One + ((factor - 1) * UnitAxis(Axis));
        var axes = Placement.Rotation.LocalAxesFromDegrees();
        var scale = Placement.Scale.Stretch(factors);
        return Placement with
        {
            Scale = new(Round(scale.X, 1e-9), Round(scale.Y, 1e-9), Round(scale.Z, 1e-9)),
            Position = Tidy(Middle + (axes * Matrix.Diagonal(factors) * axes.Transpose() * (Placement.Position - Middle))),
        };
    }

    /// <summary>Returns the power of ten at or below a length, for grids.</summary>
    public static double PowerOfTen(double length) => length > 0 ? Math.Pow(10, Math.Floor(Math.Log10(length))) : 1;

    /// <summary>Removes the digits that rounding has left of a position.</summary>
    private Vector Tidy(Vector position)
    {
        var grid = 1e-9 * PowerOfTen(1 + Middle.MaxAbsComponent());
        return new(Round(position.X, grid), Round(position.Y, grid), Round(position.Z, grid));
    }

    private static double Round(double value, double grid)
    {
        if (!(grid > 0))
        {
            return value;
        }

        // Dividing by a whole number leaves fewer digits than multiplying by its inverse. The sum has no negative zero.
        var steps = Math.Round(value / grid);
        return (grid < 1 ? steps / Math.Round(1 / grid) : steps * grid) + 0.0;
    }
}
