using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Scenes.Cameras;

public class CameraTests
{
    private static readonly Camera AppendixA = new(new(-48.761894, 25.567242, 64.429054), new(-0.071402885, -2.4999454, 0), 60);

    [Fact]
    public void ToCameraSpace_OfTheOrigin_IsInAppendixAsView()
    {
        var (right, up, depth) = AppendixA.ToCameraSpace(Vector.Zero) switch { var v => (v.X, v.Y, v.Z) };
        Assert.True(depth > 0, "the origin is behind the camera");
        Assert.True(Math.Abs(up) < depth * Math.Tan(Math.PI / 6) && Math.Abs(right) < depth * Math.Tan(Math.PI / 6),
            "the origin is outside the angle of view");
    }

    [Fact]
    public void ToCameraSpace_InALeftHandedWorld_HasRightOnTheRightAndUpAbove() =>
        Assert.Equal(new(2, 3, 6), new Camera(new(0, 0, -5), Vector.Zero, 60).ToCameraSpace(new(2, 3, 1)));

    [Fact]
    public void ToCameraSpace_OfAnyPoint_IsTheInverseAxesTimesTheDifference() => Seeded.Run(100, random =>
    {
        var camera = new Camera(random.Vector(10), random.Vector(4), 60);
        var point = random.Vector(10);
        // Distances up to 35.
        Near.Equal(camera.Rotation.LocalAxes().Inverse() * (point - camera.Position), camera.ToCameraSpace(point), 1e-13);
    });

    [Fact]
    public void ToCameraSpace_OfPositionPlusStretchedAxes_IsTheStretch() => Seeded.Run(100, random =>
    {
        var camera = new Camera(random.Vector(10), random.Vector(4), 60);
        var stretch = random.Vector(10);
        Near.Equal(stretch, camera.ToCameraSpace(camera.Position + (camera.LocalAxes * stretch)), 1e-13);
    });

    [Fact]
    public void RightHanded_WithoutRotation_LooksAlongMinusZ()
    {
        var camera = new Camera(new(0, 0, 5), Vector.Zero, 60) { Handedness = Handedness.Right };
        Assert.Equal(new(2, 3, 4), camera.ToCameraSpace(new(2, 3, 1)));
        Assert.Equal(-Vector.K, camera.LocalAxes.V3);
    }

    [Fact]
    public void RightHanded_OfAnyPoint_SeesTheMirroredOneOfTheLeftHandedCamera() => Seeded.Run(100, random =>
    {
        var camera = new Camera(random.Vector(10), random.Vector(4), 60);
        var point = random.Vector(10);
        var mirrored = camera with { Handedness = Handedness.Right, Position = Handedness.Right.Mirror(camera.Position) };
        Near.Equal(camera.ToCameraSpace(point), mirrored.ToCameraSpace(Handedness.Right.Mirror(point)), 1e-13);
        Near.Equal(-1, mirrored.LocalAxes.Determinant(), 1e-13);
        Assert.Equal(camera.Rotation, mirrored.Rotation);
        Assert.Equal(camera, (mirrored with { Handedness = Handedness.Left }) with { Position = camera.Position });
    });

    [Fact]
    public void Rotation_ChangedInACopy_ChangesItsAxes()
    {
        var turned = Camera.Default with { Rotation = new(0.1, 0.2, 0.3) };
        Assert.Equal(new Vector(0.1, 0.2, 0.3).LocalAxes(), turned.LocalAxes);
        Near.Equal(Matrix.Identity, turned.LocalAxes * turned.LocalAxesInverse, 1e-15);
    }

    [Fact]
    public void HalfHeightAtUnitDepth_IsTheTangentOfHalfTheFullAngle() =>
        Near.Equal(1, new Camera(Vector.Zero, Vector.Zero, 90).HalfHeightAtUnitDepth, 1e-15);

    [Fact]
    public void Equality_IsOfPositionRotationAndAngle()
    {
        Assert.Equal(AppendixA, new Camera(AppendixA.Position, AppendixA.Rotation, 60));
        Assert.NotEqual(AppendixA, AppendixA with { FieldOfView = 61 });
    }
}
