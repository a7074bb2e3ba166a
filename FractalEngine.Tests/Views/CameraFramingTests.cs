using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Views;

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

    /// <summary>Below 1e-9 a box was seen from afar, as a dot.</summary>
    [Theory]
    [InlineData(1e-9)]
    [InlineData(1e-15)]
    [InlineData(1e-100)]
    public void Frame_OfASmallBox_FillsTheFrameAsALargeOneDoes(double scale)
    {
        var box = new BoundingBox(-Vector.One, Vector.One);
        var expected = CameraFraming.Default(box, 1.5).Position;
        Near.Equal(expected, CameraFraming.Default(new BoundingBox(scale * box.Minimum, scale * box.Maximum), 1.5).Position / scale, 1e-12);
    }

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

    [Theory]
    [InlineData(0.5)]
    [InlineData(1)]
    [InlineData(2.5)]
    public void Frame_OfAScene_FillsFourFifthsInTheMiddle(double aspect) => Seeded.Run(50, random =>
    {
        var placement = random.Transformation();
        var mesh = Shapes.Cube();
        var scene = LoadedScene.Of(new() { Objects = [new SceneObject(mesh) { Placement = placement }, new SceneObject(mesh)] });
        var vertices = Enumerable.Range(0, mesh.VertexCount).Select(mesh.Vertex).ToArray();
        vertices = [.. vertices, .. vertices.Select(vertex => placement.ToAffineMap() * vertex)];
        var start = new Camera(random.Vector(9), random.Vector(3), random.Between(20, 90));
        var camera = CameraFraming.FrameScene(start, scene, aspect);
        AssertFills(vertices.Select(vertex => Project(camera, vertex, aspect)));
        var (orthographic, height) = CameraFraming.FrameSceneOrthographic(camera, scene, aspect);
        AssertFills(vertices.Select(orthographic.ToCameraSpace).Select(v => (2 * v.X / (height!.Value * aspect), 2 * v.Y / height.Value)));
    });

    [Fact]
    public void Frame_OfAFractal_GoesByItsPartsAndNotItsBox()
    {
        // Four cubes of half the size in the corners of a tetrahedron, and so on: its box is much larger than what is seen of it.
        Vector[] corners = [new(1, 1, 1), new(1, -1, -1), new(-1, 1, -1), new(-1, -1, 1)];
        var maps = corners.Select(corner => new Transformation(0.5 * corner, Vector.Zero, 0.5 * Vector.One));
        var fractal = Fractal.Of(Shapes.Cube()).Repeat(maps, 12);
        var scene = LoadedScene.Of(new() { Objects = [new SceneObject(fractal)] });
        var camera = CameraFraming.FrameScene(Camera.Default with { Rotation = CameraFraming.LookRotation(-Vector.One) }, scene, 1);
        var points = FractalGenerator.Expand(fractal.WithDepth(6), 1 << 13).Select(map => Project(camera, map.Translation, 1)).ToArray();
        // The parts that are framed are boxes around sub-fractals, which are a few hundredths larger than those.
        Assert.InRange(points.Max(point => Math.Max(Math.Abs(point.X), Math.Abs(point.Y))), 0.7, 0.8);
    }

    [Theory]
    [InlineData(null)]
    [InlineData(1_000_000)]
    public void Frame_OfAFractalWithoutAnEnd_Ends(int? depth)
    {
        Vector[] corners = [new(1, 1, 1), new(1, -1, -1), new(-1, 1, -1), new(-1, -1, 1)];
        var maps = corners.Select(corner => new Transformation(0.5 * corner, Vector.Zero, 0.5 * Vector.One));
        var scene = LoadedScene.Of(new() { Objects = [new SceneObject(Fractal.Of(Shapes.Cube()).Repeat(maps, depth))] });
        var camera = CameraFraming.Default(scene, 1.5);
        Assert.True(camera.ToCameraSpace(scene.Bounds.Centre).Z > 0, "the fractal is not before the camera");
    }

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

    /// <summary>Projects a point into a frame from −1 to 1.</summary>
    private static (double X, double Y) Project(Camera camera, Vector point, double aspect)
    {
        var (x, y, depth) = camera.ToCameraSpace(point);
        Assert.True(depth > 0, $"{point} is behind the camera");
        return (x / (depth * camera.HalfHeightAtUnitDepth * aspect), y / (depth * camera.HalfHeightAtUnitDepth));
    }

    private static void AssertFills(IEnumerable<(double X, double Y)> projected)
    {
        var points = projected.ToArray();
        var (left, right) = (points.Min(point => point.X), points.Max(point => point.X));
        var (bottom, top) = (points.Min(point => point.Y), points.Max(point => point.Y));
        // A vertex behind a farther one in the same direction is not framed, and may stick out by that direction's width.
        Near.Equal(0, left + right, 0.02);
        Near.Equal(0, bottom + top, 0.02);
        Near.Equal(0.8, Math.Max(right, top), 0.02);
    }

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
