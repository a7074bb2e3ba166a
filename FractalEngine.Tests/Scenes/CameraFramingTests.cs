using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Scenes;

public class CameraFramingTests
{
    [Fact]
    public void LookRotation_InAnyDirection_LooksThereWithoutRoll() => Seeded.Run(500, random =>
    {
        var direction = random.Direction();
        var axes = CameraFraming.LookRotation(random.Between(0.001, 1000) * direction).LocalAxes();
        // Angles of a few roundings each.
        Near.Equal(direction, axes.V3, 1e-14);
        Near.Equal(0, axes.V1.Y, 1e-14);
        Assert.True(axes.V2.Y >= 0, "upside down");
    });

    [Theory]
    [InlineData(1)]
    [InlineData(-1)]
    public void LookRotation_StraightUpOrDown_LooksThere(double y) =>
        Near.Equal(new(0, y, 0), CameraFraming.LookRotation(new(0, y, 0)).LocalAxes().V3, 1e-15);

    [Theory]
    [InlineData(0.5)]
    [InlineData(1)]
    [InlineData(2.5)]
    public void Frame_OfAnyBox_ShowsAllItsCorners(double aspect) => Seeded.Run(200, random =>
    {
        var box = RandomBox(random);
        var camera = CameraFraming.Frame(new(random.Vector(100), random.Vector(3), random.Between(5, 150)), box, aspect);
        Assert.All(Corners(box), corner => AssertVisible(camera, corner, aspect));
    });

    [Fact]
    public void Frame_OfAnyBox_FillsTheView() => Seeded.Run(100, random =>
    {
        var box = RandomBox(random);
        var camera = CameraFraming.Frame(new(Vector.Zero, random.Vector(3), 60), box, 1);
        var maxExtent = Corners(box).Select(camera.ToCameraSpace)
            .Max(v => Math.Max(Math.Abs(v.X), Math.Abs(v.Y)) / v.Z / camera.HalfHeightAtUnitDepth);
        // A third of the frame at least, whatever margin is left.
        Assert.InRange(maxExtent, 1.0 / 3, 1);
    });

    [Fact]
    public void Frame_KeepsTheRotationAndTheAngle()
    {
        var camera = new Camera(Vector.Zero, new(0.1, 0.2, 0.3), 45);
        var framed = CameraFraming.Frame(camera, new(-Vector.One, Vector.One), 1);
        Assert.Equal((camera.Rotation, 45), (framed.Rotation, framed.FieldOfView));
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1e-150)]
    [InlineData(1e150)]
    public void Frame_OfPointsAndExtremeBoxes_IsFinite(double size)
    {
        var box = new BoundingBox(-size * Vector.One, size * Vector.One);
        var camera = CameraFraming.Frame(Camera.Default, box, 1);
        Assert.True(camera.Position.IsFinite());
        Assert.True(camera.ToCameraSpace(box.Centre).Z > 0, "the box is not before the camera");
    }

    [Fact]
    public void Frame_OfNothing_IsFinite() =>
        Assert.True(CameraFraming.Frame(Camera.Default, BoundingBox.Empty, 1).Position.IsFinite());

    [Fact]
    public void Default_OfAnyBox_ShowsItFromAboveAndTheRightWithoutRoll() => Seeded.Run(100, random =>
    {
        var box = RandomBox(random);
        var camera = CameraFraming.Default(box, 1.5);
        Assert.All(Corners(box), corner => AssertVisible(camera, corner, 1.5));
        Assert.True(camera.Position.Y > box.Centre.Y && camera.Position.X > box.Centre.X && camera.Position.Z < box.Centre.Z);
        Near.Equal(0, camera.LocalAxes.V1.Y, 1e-15);
    });

    private static BoundingBox RandomBox(Random random) => (random.Vector(10), random.Vector(5).Absolute()) switch
    {
        var (centre, half) => new(centre - half, centre + half),
    };

    private static IEnumerable<Vector> Corners(BoundingBox box) => Enumerable.Range(0, 8).Select(i => new Vector(
        i % 2 == 0 ? box.Minimum.X : box.Maximum.X, i / 2 % 2 == 0 ? box.Minimum.Y : box.Maximum.Y, i / 4 == 0
        ? box.Minimum.Z
        : box.Maximum.Z));

    private static void AssertVisible(Camera camera, Vector corner, double aspect)
    {
        var mapped = camera.ToCameraSpace(corner);
        // A corner may lie on the frame's edge, to rounding.
        var half = camera.HalfHeightAtUnitDepth * mapped.Z * (1 + 1e-12);
        Assert.True(mapped.Z > 0 && Math.Abs(mapped.Y) <= half && Math.Abs(mapped.X) <= half * aspect, $"{corner} is at {mapped}");
    }
}
