using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Scenes.Cameras;

public class CameraNavigationTests
{
    // Angles are written to the camera after each turn and read back: some units in the last place of π.
    private const double Tolerance = 1e-13;

    private static Camera RandomLevelCamera(Random random) =>
        new(random.Vector(10), CameraFraming.LookRotation(random.Vector() + new Vector(0, 0, 1.5)), 60);

    [Fact]
    public void Turn_ToTheRightAndUp_LooksThere()
    {
        Assert.True(CameraNavigation.Turn(Camera.Default, 0.1, 0).LocalAxes.V3.X > 0, "it turns left");
        Assert.True(CameraNavigation.Turn(Camera.Default, 0, 0.1).LocalAxes.V3.Y > 0, "it turns down");
    }

    [Fact]
    public void Controls_OfARightHandedCamera_AreThoseOfTheMirroredLeftHandedOne() => Seeded.Run(100, random =>
    {
        Vector Mirror(Vector v) => Handedness.Right.Mirror(v);
        Camera MirrorCamera(Camera c) => c with { Handedness = Handedness.Right, Position = Mirror(c.Position) };
        var left = RandomLevelCamera(random);
        var right = MirrorCamera(left);
        var pivot = random.Vector(10);
        var (yaw, pitch) = (random.Between(-1, 1), random.Between(-0.3, 0.3));
        // The same operations on the same numbers but for signs.
        Assert.Equal(MirrorCamera(CameraNavigation.Turn(left, yaw, pitch)), CameraNavigation.Turn(right, yaw, pitch));
        AssertNear(MirrorCamera(CameraNavigation.Orbit(left, pivot, yaw, pitch)),
            CameraNavigation.Orbit(right, Mirror(pivot), yaw, pitch));
        AssertNear(MirrorCamera(CameraNavigation.Move(left, new(1, 2, 3))), CameraNavigation.Move(right, new(1, 2, 3)));
        AssertNear(MirrorCamera(CameraNavigation.Zoom(left, pivot, 0.5)), CameraNavigation.Zoom(right, Mirror(pivot), 0.5));
    });

    [Theory]
    [InlineData(Handedness.Left)]
    [InlineData(Handedness.Right)]
    public void Turn_ToTheRightAndUp_MovesThingsToTheLeftAndDown(Handedness handedness)
    {
        var camera = Camera.Default with { Handedness = handedness };
        var ahead = camera.Position + camera.LocalAxes.V3;
        var (right, up, _) = CameraNavigation.Turn(camera, 0.1, 0.1).ToCameraSpace(ahead);
        Assert.True(right < 0 && up < 0, $"{right} {up}");
    }

    private static void AssertNear(Camera expected, Camera actual)
    {
        Near.Equal(expected.Position, actual.Position, 1e-13 * (1 + expected.Position.MaxAbsComponent()));
        Assert.Equal((expected.Rotation, expected.Handedness), (actual.Rotation, actual.Handedness));
    }

    [Fact]
    public void Turn_ToTheRight_RotatesEveryAxisAboutTheWorldsUp() => Seeded.Run(100, random =>
    {
        var camera = RandomLevelCamera(random);
        var angle = random.Between(-3, 3);
        var turned = CameraNavigation.Turn(camera, angle, 0);
        Assert.All(
            new[] { (camera.LocalAxes.V1, turned.LocalAxes.V1), (camera.LocalAxes.V2, turned.LocalAxes.V2),
            (camera.LocalAxes.V3, turned.LocalAxes.V3) },
            axis => Near.Equal(RotateAboutUp(axis.Item1, angle), axis.Item2, Tolerance));
    });

    [Fact]
    public void Turn_Upwards_KeepsTheCamerasOwnRight() => Seeded.Run(100, random =>
    {
        var camera = RandomLevelCamera(random);
        var turned = CameraNavigation.Turn(camera, 0, random.Between(-0.3, 0.3));
        Near.Equal(camera.LocalAxes.V1, turned.LocalAxes.V1, Tolerance);
    });

    [Fact]
    public void Turn_Upwards_RaisesTheViewByTheAngle() =>
        Near.Equal(Math.Sin(0.4), CameraNavigation.Turn(Camera.Default, 0, 0.4).LocalAxes.V3.Y, Tolerance);

    [Fact]
    public void Turn_HundredThousandTimes_NeverRolls() => Seeded.RunOne(1, random =>
    {
        var camera = new Camera(Vector.Zero, Vector.Zero, 60);
        for (var turn = 0; turn < 100_000; turn++)
        {
            camera = CameraNavigation.Turn(camera, random.Between(-0.5, 0.5), random.Between(-0.5, 0.5));
            // Roundings must not add up: a hundred-thousandth of a pixel.
            Assert.True(Math.Abs(camera.LocalAxes.V1.Y) < 1e-9 && camera.LocalAxes.V2.Y > 0, $"rolled in turn {turn}: {camera.LocalAxes}");
        }
    });

    [Fact]
    public void Turn_OfARolledCamera_KeepsItsRoll() => Seeded.Run(100, random =>
    {
        // Appendix A's own camera is one: its right axis is not quite level.
        var camera = new Camera(Vector.Zero, new(-0.071402885, -2.4999454, 0), 60);
        var turned = CameraNavigation.Turn(camera, random.Between(-3, 3), random.Between(-0.3, 0.3));
        Near.Equal(camera.LocalAxes.V1.Y, turned.LocalAxes.V1.Y, Tolerance);
    });

    [Theory]
    [InlineData(10)]
    [InlineData(-10)]
    public void Turn_FarBeyondTheZenith_EndsJustShortOfIt(double up)
    {
        var turned = CameraNavigation.Turn(Camera.Default, 0.3, up);
        Assert.InRange(Math.Abs(turned.LocalAxes.V3.Y), 0.99, 1);
        Assert.True(turned.LocalAxes.V2.Y > 0, "it hangs upside down");
    }

    [Fact]
    public void Turn_ByNothing_ChangesNothing() => Seeded.Run(100, random =>
    {
        var camera = RandomLevelCamera(random);
        Near.Equal(camera.LocalAxes, CameraNavigation.Turn(camera, 0, 0).LocalAxes, Tolerance);
    });

    [Theory]
    [InlineData(90)]
    [InlineData(-90)]
    public void Turn_ToTheSideOfAViewFromTheTop_KeepsItThere(double degrees)
    {
        var camera = new Camera(Vector.Zero, new(degrees * Math.PI / 180, 0, 0), 60);
        Near.Equal(camera.LocalAxes.V3, CameraNavigation.Turn(camera, 0.5, 0).LocalAxes.V3, Tolerance);
    }

    [Fact]
    public void Turn_KeepsThePosition() => Assert.Equal(Camera.Default.Position, CameraNavigation.Turn(Camera.Default, 1, 0.5).Position);

    [Fact]
    public void Orbit_KeepsTheDistanceAndThePivotsPositionInTheFrame() => Seeded.Run(200, random =>
    {
        var (camera, pivot) = (RandomLevelCamera(random), random.Vector(10));
        var orbited = CameraNavigation.Orbit(camera, pivot, random.Between(-3, 3), random.Between(-0.5, 0.5));
        // Distances up to 35.
        Near.Equal((pivot - camera.Position).Length(), (pivot - orbited.Position).Length(), 1e-12);
        Near.Equal(camera.ToCameraSpace(pivot), orbited.ToCameraSpace(pivot), 1e-12);
    });

    [Fact]
    public void Orbit_TenThousandTimes_StaysOnTheSphere() => Seeded.RunOne(1, random =>
    {
        var camera = Camera.Default;
        for (var turn = 0; turn < 10_000; turn++)
        {
            camera = CameraNavigation.Orbit(camera, Vector.Zero, random.Between(-0.5, 0.5), random.Between(-0.5, 0.5));
        }

        // Ten thousand roundings of a distance of 5, were they all the same way.
        Near.Equal(5, camera.Position.Length(), 1e-10);
        Near.Equal(new(0, 0, 5), camera.ToCameraSpace(Vector.Zero), 1e-10);
    });

    [Fact]
    public void Move_IsAlongTheCamerasAxes() => Seeded.Run(100, random =>
    {
        var (camera, distances) = (RandomLevelCamera(random), random.Vector(5));
        var moved = CameraNavigation.Move(camera, distances);
        Assert.Equal(camera.Rotation, moved.Rotation);
        Near.Equal(distances, camera.ToCameraSpace(moved.Position), Tolerance);
    });

    [Fact]
    public void Zoom_ChangesTheDistanceByTheFactor() => Seeded.Run(100, random =>
    {
        var (camera, pivot, factor) = (RandomLevelCamera(random), random.Vector(10), random.Between(0.1, 4));
        var zoomed = CameraNavigation.Zoom(camera, pivot, factor);
        Near.Equal(factor * (camera.Position - pivot), zoomed.Position - pivot, Tolerance);
        Assert.Equal(camera.Rotation, zoomed.Rotation);
    });

    private static Vector RotateAboutUp(Vector v, double angle) => new(
        (Math.Cos(angle) * v.X) + (Math.Sin(angle) * v.Z), v.Y, (Math.Cos(angle) * v.Z) - (Math.Sin(angle) * v.X));
}
