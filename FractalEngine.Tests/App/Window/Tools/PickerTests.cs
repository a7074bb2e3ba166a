using FractalEngine.App.Window.Tools;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Lines;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.Tools;

/// <summary>Tests what a click on a pixel selects.</summary>
public class PickerTests
{
    private static readonly (int Width, int Height) Size = (320, 200);

    [Fact]
    public void RayThrough_OfAPixel_IsTheReverseOfProject() => Seeded.Run(100, random =>
    {
        var camera = new Camera(random.Vector(5), random.Vector(3), random.Between(20, 120))
        {
            Handedness = (Handedness)random.Next(2),
        };
        var view = new View(camera, (Projection)random.Next(2)) { Aspect = random.Next(2) == 0 ? null : random.Between(0.4, 3) };
        var point = camera.Position + (camera.LocalAxes * new Vector(random.Between(-1, 1), random.Between(-1, 1), random.Between(1, 9)));
        var (x, y, depth) = view.Project(point, Size.Width, Size.Height)!.Value;
        var ray = view.RayThrough(x, y, Size.Width, Size.Height);
        var forward = Vector.Dot(ray.Direction.UnitVector(), camera.LocalAxes.V3);
        Near.Equal(point, ray.PointAt(depth / forward), 1e-9);
    });

    [Fact]
    public void Pick_OfAFractal_FindsTheInstanceInAllLevelsAround()
    {
        var scene = Scene(Sponge(depth: 3));
        var view = View.Of(scene, (double)Size.Width / Size.Height);
        var picker = new Picker();
        var count = 0;
        for (var y = 5; y < Size.Height; y += 13)
        {
            for (var x = 5; x < Size.Width; x += 13)
            {
                if (picker.Pick(scene, view, (x, y), Size) is not { } selection)
                {
                    continue;
                }

                count++;
                Assert.Equal(3, selection.Path.Length);
                var (px, py, _) = view.Project(selection.Point, Size.Width, Size.Height)!.Value;
                Near.Equal(new Vector(x, y, 0), new Vector(px, py, 0), 1e-6);
                // Each part around holds the point, and the parts grow.
                var volume = 0.0;
                for (var depth = 3; depth >= 0; depth--, selection = selection.Up())
                {
                    Assert.Equal(depth, selection.Depth);
                    var (box, map) = selection.Outline;
                    var local = map.Inverse() * selection.Point;
                    var outside = (local - box.Centre).Absolute() - (0.5 * box.Size);
                    Assert.True(Math.Max(outside.X, Math.Max(outside.Y, outside.Z)) < 1e-9, $"level {depth}: {local} is not in {box}");
                    var size = Math.Abs(map.Linear.Determinant()) * box.Size.X * box.Size.Y * box.Size.Z;
                    Assert.True(size > volume, $"level {depth}");
                    volume = size;
                }

                Assert.Same(selection, selection.Up());
            }
        }

        Assert.True(count > 60, $"only {count} pixels show the sponge");
    }

    /// <summary>Rays find the cubes of a row by doubled powers of its map; one level for each of them would be too many.</summary>
    [Fact]
    public void Pick_OfAFractalOfTooManySets_SelectsTheInstanceAlone()
    {
        var cube = Fractal.Of(Shapes.Cube());
        var row = Fractal.Recurse(cube, 19_999, self => self.Apply([Samples.Move(2, 0, 0)]) + cube);
        Assert.Throws<FractalLimitException>(() => row.Follow([0]));
        var scene = Scene(row);
        var view = View.Of(scene, (double)Size.Width / Size.Height) with { Camera = new(new(1, 2, -5), Vector.Zero, 90) };
        var x = Enumerable.Range(0, Size.Width).First(x => new Picker().Pick(scene, view, (x, 100), Size) is not null);
        var selection = new Picker().Pick(scene, view, (x, 100), Size)!;
        Assert.Empty(FractalSelection.SetSizes(row, selection.Path));
        Assert.False(selection.Outline.Box.IsEmpty);
        var moved = new PlacedModel(new("f.fdo", Samples.Move(0, 1, 0)), selection.Object.Model);
        Assert.Null(selection.ContinueIn(moved));
        Assert.Null(FractalSelection.SubFractalAt(row, [0], 0, AffineMap.Identity));
        Assert.Equal(BoxLines.OfLevel(scene, 0, Colour.Black), BoxLines.OfLevel(scene, 1, Colour.Black));
    }

    [Fact]
    public void Pick_OfTheBackground_IsNothing()
    {
        var scene = Scene(Sponge(depth: 2));
        Assert.Null(new Picker().Pick(scene, View.Of(scene, 1.6), (1, 1), Size));
    }

    [Theory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void Pick_WithClipPlanes_FindsWhatIsBetweenTheirDepths(Projection projection)
    {
        // A wall at depths 4 to 4.5, and a cube behind it from 9.5 to 10.5.
        var scene = LoadedScene.Of(new()
        {
            Camera = new(new(0, 0, -10), Vector.Zero, 60),
            Projection = projection,
            Clip = (5, 100),
            Objects = [new(Shapes.Box(new(new(-20, -20, -6), new(20, 20, -5.5)))), new(Shapes.Cube())],
        });
        var view = View.Of(scene, 1.6);
        var picker = new Picker();
        Assert.Equal(1, picker.Pick(scene, view, (160, 100), Size)!.ObjectIndex);
        // Along the ray, the wall is farther there than the plane's depth.
        Assert.Null(picker.Pick(scene, view, (1, 1), Size));
        Assert.Null(picker.Pick(scene, view with { FixedClipPlanes = (5, 9.4) }, (160, 100), Size));
        // And farther than this far plane, which is behind it.
        Assert.Equal(0, picker.Pick(scene, view with { FixedClipPlanes = (1, 4.2) }, (1, 1), Size)!.ObjectIndex);
    }

    [Theory]
    [InlineData(-1, 0)]
    [InlineData(0, 1)]
    [InlineData(1, 20)]
    [InlineData(2, 400)]
    [InlineData(3, 1000)]
    [InlineData(4, 0)]
    public void Boxes_OfALevel_AreThoseOfItsSubFractals(int level, int expected) =>
        Assert.Equal(expected, BoxLines.OfLevel(Scene(Sponge(depth: 3)), level, Colour.White).Count / 12);

    [Fact]
    public void Text_OfASelection_NamesWhatWasClicked()
    {
        var scene = Scene(Sponge(depth: 2));
        var selection = new Picker().Pick(scene, View.Of(scene, 1.6), (160, 60), Size)!;
        var text = selection.ToText();
        foreach (var name in (string[])["object: ", "instance: ", "face: ", "point: (", "normal: (", "material: none", "distance: "])
        {
            Assert.Contains(name, text, StringComparison.Ordinal);
        }
    }

    [Theory]
    [InlineData(0, 3)]
    [InlineData(1, 2)]
    [InlineData(2, 2)]
    public void Measure_OfTwoClicks_KeepsTheDistance(int kindNumber, double expected)
    {
        var kind = (MeasureKind)kindNumber;
        // Two cubes of side 1 whose sides are 2 apart, clicked in the middles of their front faces.
        var scene = LoadedScene.Of(new()
        {
            Camera = new(new(1.5, 0, -8), Vector.Zero, 60),
            Objects = [new(Shapes.Cube()), new(Shapes.Cube()) { Placement = Samples.Move(3, 0, 0) }],
        });
        var view = View.Of(scene, 1.6);
        var tool = new MeasureTool { Kind = kind };
        tool.Toggle();
        foreach (var point in (Vector[])[new(kind == MeasureKind.PointToObject ? 0.499999 : 0, 0, -0.5), new(3, 0, -0.5)])
        {
            var (x, y, _) = view.Project(point, Size.Width, Size.Height)!.Value;
            tool.Click(new Picker().Pick(scene, view, (x, y), Size)!, scene);
        }

        var dimension = Assert.Single(tool.Dimensions);
        Assert.Equal(expected, dimension.Length, 4);
        tool.Remove(dimension);
        Assert.Empty(tool.Dimensions);
    }

    [Fact]
    public void Measure_OfTheSameObjectTwice_SaysSo()
    {
        var scene = Scene(Sponge(depth: 2));
        var selection = new Picker().Pick(scene, View.Of(scene, 1.6), (160, 60), Size)!;
        var tool = new MeasureTool { Kind = MeasureKind.Objects };
        tool.Toggle();
        tool.Click(selection, scene);
        Assert.Equal("both clicks were at the same object", tool.Click(selection, scene));
        Assert.Empty(tool.Dimensions);
    }

    private static LoadedScene Scene(Fractal fractal) =>
        LoadedScene.Of(new() { Objects = [new SceneObject(fractal) { Placement = new(new(1, 2, 3), new(10, 20, 30), 2 * Vector.One) }] });

    private static Fractal Sponge(int depth)
    {
        var places = from x in Enumerable.Range(-1, 3)
                     from y in Enumerable.Range(-1, 3)
                     from z in Enumerable.Range(-1, 3)
                     where Math.Abs(x) + Math.Abs(y) + Math.Abs(z) > 1
                     select Transformation.At(new(2 * x / 3.0, 2 * y / 3.0, 2 * z / 3.0), 1 / 3.0);
        return Fractal.Of(Shapes.Cube()).Repeat(places, depth);
    }
}
