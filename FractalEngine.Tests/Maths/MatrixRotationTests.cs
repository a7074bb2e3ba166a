using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Maths;

public class MatrixRotationTests
{
    private const double Angle = 0.7;
    private static readonly double Sine = Math.Sin(Angle);
    private static readonly double Cosine = Math.Cos(Angle);

    [Fact]
    public void Pitch_ByRows_IsThePapersMatrix() =>
        Assert.Equal(Matrix.FromRows(new(1, 0, 0), new(0, Cosine, Sine), new(0, -Sine, Cosine)), Matrix.Pitch(Angle));

    [Fact]
    public void Yaw_ByRows_IsThePapersMatrix() =>
        Assert.Equal(Matrix.FromRows(new(Cosine, 0, -Sine), new(0, 1, 0), new(Sine, 0, Cosine)), Matrix.Yaw(Angle));

    [Fact]
    public void Roll_ByRows_IsThePapersMatrix() =>
        Assert.Equal(Matrix.FromRows(new(Cosine, Sine, 0), new(-Sine, Cosine, 0), new(0, 0, 1)), Matrix.Roll(Angle));

    [Fact]
    public void LocalAxes_ArePitchTimesYawTimesRoll() =>
        Assert.Equal(Matrix.Pitch(0.1) * Matrix.Yaw(0.2) * Matrix.Roll(0.3), new Vector(0.1, 0.2, 0.3).LocalAxes());

    [Fact]
    public void LocalAxes_OfNoRotation_AreRightUpAndForward() =>
        Assert.Equal(new(Vector.I, Vector.J, Vector.K), Vector.Zero.LocalAxes());

    [Fact]
    public void LocalAxes_OfAnyAngles_AreARotation() => Seeded.Run(200, random =>
    {
        var axes = random.Vector(10).LocalAxes();
        // The rounding of two products of entries up to 1.
        Near.Equal(Matrix.Identity, axes.Transpose() * axes, 2e-15);
        Near.Equal(1, axes.Determinant(), 2e-15);
    });

    [Fact]
    public void LocalAxesFromDegrees_AgreeWithRadians() => Seeded.Run(200, random =>
    {
        var degrees = random.Vector(720);
        // The angle in radians is off by half a unit in the last place of 4π: 9e-16.
        Near.Equal((Math.PI / 180 * degrees).LocalAxes(), degrees.LocalAxesFromDegrees(), 1e-14);
    });

    [Theory]
    [InlineData(90)]
    [InlineData(-90)]
    [InlineData(180)]
    [InlineData(270)]
    [InlineData(360)]
    [InlineData(-450)]
    [InlineData(90 * 1e15)]
    public void LocalAxesFromDegrees_OfQuarterTurns_AreExact(double angle)
    {
        Vector[] rotations = [new(angle, 0, 0), new(0, angle, 0), new(0, 0, angle), new(angle, angle, angle)];
        Assert.All(rotations.SelectMany(rotation => Entries(rotation.LocalAxesFromDegrees())),
            entry => Assert.Contains(Math.Abs(entry), new[] { 0.0, 1.0 }));
    }

    [Fact]
    public void LocalAxesFromDegrees_OfThirtyDegrees_HaveSineOneHalf() =>
        // sin 30° rounds to ½ or its neighbour.
        Near.Equal(0.5, new Vector(30, 0, 0).LocalAxesFromDegrees().V3.Y, 1.2e-16);

    [Fact]
    public void Rotation_AboutAnAxis_KeepsTheAxisAndRotatesIToJAboutK()
    {
        Near.Equal(Vector.J, Matrix.Rotation(Vector.K, Math.PI / 2) * Vector.I, 1e-16);
        Seeded.Run(100, random =>
        {
            var axis = random.Direction();
            var rotation = Matrix.Rotation(axis, random.Between(-7, 7));
            // The rounding of a dozen numbers up to 1.
            Near.Equal(axis, rotation * axis, 2e-15);
            Near.Equal(1, rotation.Determinant(), 4e-15);
        });
    }

    [Fact]
    public void Rotation_AboutI_IsTheOppositePitch() => Near.Equal(Matrix.Pitch(-Angle), Matrix.Rotation(Vector.I, Angle), 1e-15);

    private static double[] Entries(Matrix m) => [m.V1.X, m.V1.Y, m.V1.Z, m.V2.X, m.V2.Y, m.V2.Z, m.V3.X, m.V3.Y, m.V3.Z];
}
