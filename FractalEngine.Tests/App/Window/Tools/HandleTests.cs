using FractalEngine.App.Window.Tools;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.Tools;

/// <summary>Tests what drags of handles make of placements, without a window.</summary>
public class HandleTests
{
    private static readonly (int Width, int Height) Size = (640, 480);

    [Fact]
    public void Move_AlongAnAxis_RoundsThatCoordinateOnly()
    {
        var drag = new PlacementDrag(HandleKind.Move, 0, new(new(1.2345, 2.345, 3.456), Vector.Zero, Vector.One), Vector.Zero);
        Assert.Equal(new Vector(1.7, 2.345, 3.456), drag.Move(new(0.481, 0, 0), 0.1).Position);
        Assert.Equal(new Vector(1.7155, 2.345, 3.456), drag.Move(new(0.481, 0, 0), 0.0001).Position);
        Assert.Equal(new Vector(200, 2.345, 3.456), drag.Move(new(180, 0, 0), 100).Position);
    }

    [Fact]
    public void Turn_AboutTheMiddle_LeavesItInPlace() => Seeded.Run(200, random =>
    {
        var start = new Transformation(random.Vector(4), 80 * random.Vector(), Vector.One + (0.5 * random.Vector()));
        var local = random.Vector(2);
        var middle = start.ToAffineMap() * local;
        var drag = new PlacementDrag(HandleKind.Turn, random.Next(3), start, middle);
        var degrees = Math.Round(random.Between(-170, 170), 1);
        var turned = drag.Turn(degrees, snaps: false);
        Near.Equal(middle, turned.ToAffineMap() * local, 1e-6);
        var expected = Matrix.Rotation(PlacementDrag.UnitAxis(drag.Axis), degrees * Math.PI / 180) * start.ToAffineMap().Linear;
        Near.Equal(expected.V1, turned.ToAffineMap().Linear.V1, 1e-6);
        Near.Equal(expected.V2, turned.ToAffineMap().Linear.V2, 1e-6);
        Near.Equal(expected.V3, turned.ToAffineMap().Linear.V3, 1e-6);
    });

    [Fact]
    public void Turn_WithCtrl_SnapsToFifteenDegrees()
    {
        var drag = new PlacementDrag(HandleKind.Turn, 1, Transformation.Identity, Vector.Zero);
        Assert.Equal(45, Math.Abs(drag.Turn(41, snaps: true).Rotation.Y));
        Assert.Equal(new Vector(0, 0, 0), drag.Turn(7, snaps: true).Rotation);
    }

    [Fact]
    public void Scale_AboutTheMiddle_LeavesItInPlace() => Seeded.Run(200, random =>
    {
        var start = new Transformation(random.Vector(4), 80 * random.Vector(), Vector.One + (0.5 * random.Vector()));
        var local = random.Vector(2);
        var middle = start.ToAffineMap() * local;
        var axis = random.Next(4) - 1;
        var scaled = new PlacementDrag(HandleKind.Scale, axis, start, middle).Scale(1.5, snaps: false);
        Near.Equal(middle, scaled.ToAffineMap() * local, 1e-6);
        var factors = axis < 0 ? 1.5 * Vector.One : Vector.One + (0.5 * PlacementDrag.UnitAxis(axis));
        Near.Equal(start.Scale.Stretch(factors), scaled.Scale, 1e-8);
    });

    [Fact]
    public void Scale_ToNothing_StaysAboveZero()
    {
        var drag = new PlacementDrag(HandleKind.Scale, -1, Transformation.Identity, Vector.Zero);
        Assert.Equal(0.01, drag.Scale(-3, snaps: false).Scale.X);
        Assert.Equal(0.1, drag.Scale(0.01, snaps: true).Scale.Y);
        Assert.Equal(1.3, drag.Scale(1.27, snaps: true).Scale.Z);
    }

    [Fact]
    public void AlongAxis_OfAPixel_IsTheReverseOfProject() => Seeded.Run(200, random =>
    {
        var camera = new Camera(random.Vector(2), random.Vector(3), random.Between(30, 90)) { Handedness = (Handedness)random.Next(2) };
        var view = new View(camera, (Projection)random.Next(2)) { OrthographicHeight = 5 };
        var pointer = new PointerMath(view, Size.Width, Size.Height);
        var point = camera.Position + (camera.LocalAxes * new Vector(random.Between(-1, 1), random.Between(-1, 1), random.Between(3, 9)));
        var axis = random.Direction();
        var along = random.Between(-0.5, 0.5);
        var (x, y) = pointer.Project(point + (along * axis))!.Value;
        if (pointer.AlongAxis(x, y, point, axis) is { } found)
        {
            Assert.Equal(along, found, 1e-6);
        }
        else
        {
            Assert.True(Math.Abs(Vector.Dot(axis, pointer.DirectionTo(point))) > 0.9);
        }

        var normal = random.Direction();
        if (pointer.OnPlane(x, y, point + (along * axis), normal) is { } met)
        {
            Near.Equal(point + (along * axis), met, 1e-6);
        }
    });

    [Theory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void LengthOf_Pixels_IsProjectedBack(Projection projection)
    {
        var view = new View(new(new(0, 0, -5), Vector.Zero, 60), projection) { OrthographicHeight = 7 };
        var pointer = new PointerMath(view, Size.Width, Size.Height);
        var length = pointer.LengthOf(80, Vector.Zero);
        Assert.Equal(80, pointer.Project(length * Vector.I)!.Value.X - pointer.Project(Vector.Zero)!.Value.X, 1e-9);
    }
}
