using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Descriptions;

/// <summary>Rotations as quaternions, against matrices and angles.</summary>
public class OrientationTests
{
    // Some roundings of numbers of about 1.
    private const double Tolerance = 1e-14;

    [Fact]
    public void TurnedBy_ARotation_TurnsAsRodriguesSays() => Seeded.Run(100, random =>
    {
        var (start, axis, angle) = (Draw(random), random.Direction(), random.Between(-7, 7));
        var vector = random.Vector();
        var turned = start.TurnedBy(angle * axis);
        var before = start.Rotate(vector);
        var expected = (Math.Cos(angle) * before) + (Math.Sin(angle) * Vector.Cross(axis, before))
            + ((1 - Math.Cos(angle)) * Vector.Dot(axis, before) * axis);
        Near.Equal(expected, turned.Rotate(vector), Tolerance);
        Near.Equal(vector, turned.RotateBack(turned.Rotate(vector)), Tolerance);
        Near.Equal(expected, turned.ToMatrix() * vector, Tolerance);
        Near.Equal(1, (turned.Cosine * turned.Cosine) + turned.Axis.LengthSquared(), Tolerance);
        Assert.Equal(start, start.TurnedBy(Vector.Zero));
    });

    [Fact]
    public void RotationVector_OfAnyTurn_IsItsAxisAndTheSmallerAngle() => Seeded.Run(100, random =>
    {
        var (axis, angle) = (random.Direction(), random.Between(0, Math.PI));
        Near.Equal(angle * axis, Orientation.Identity.TurnedBy(angle * axis).RotationVector, Tolerance);
        Near.Equal((angle - Math.PI) * axis, Orientation.Identity.TurnedBy((angle + Math.PI) * axis).RotationVector, Tolerance);
        Assert.Equal(Vector.Zero, Orientation.Identity.RotationVector);
    });

    /// <summary>The chord between two quaternions, so that a share s of it has the angle of tan: equal shares at its middle.</summary>
    [Fact]
    public void Interpolate_BetweenTwo_GoesTheShorterWay() => Seeded.Run(100, random =>
    {
        var (start, axis, angle) = (Draw(random), random.Direction(), random.Between(0.1, 3));
        var end = start.TurnedBy(angle * axis);
        // The same rotation, as the opposite quaternion.
        end = random.Next(2) == 0 ? end : new(-end.Cosine, -end.Axis);
        var share = random.NextDouble();
        var way = Math.Atan2(share * Math.Sin(0.5 * angle), 1 - share + (share * Math.Cos(0.5 * angle)));
        foreach (var (alpha, turn) in new[] { (0, 0), (1, angle), (0.5, 0.5 * angle), (share, 2 * way) })
        {
            var vector = random.Vector();
            Near.Equal(start.TurnedBy(turn * axis).Rotate(vector), Orientation.Interpolate(start, end, alpha).Rotate(vector), Tolerance);
        }
    });

    private static Orientation Draw(Random random) => Orientation.Identity.TurnedBy(random.Between(0, 7) * random.Direction());
}
