using System.Collections.Immutable;
using System.Text;
using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Exports;
using FractalEngine.Parsing.Exports.Ply;
using FractalEngine.Parsing.Exports.Stl;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Exports;

/// <summary>Tests that PLY and STL files read back as the expansion of what was written.</summary>
public class FlatExportTests
{
    // Of floats, relative to the largest coordinate; areas of many faces are as good.
    private const double FloatTolerance = 1e-6;

    public static TheoryData<string> Endings => [".ply", ".stl"];

    [Theory]
    [MemberData(nameof(Endings))]
    public void Write_OfAnyFractal_ReadsBackAsItsExpansion(string ending) => Seeded.RunMost(60, random =>
    {
        var (fractal, placement) = (RandomFractals.CreateAny(random), random.Transformation());
        var scene = RenderScenes.Scene(
            new() { Handedness = Handedness.Right }, (new FractalModel(fractal), placement, null));
        var expected = scene.Objects.Flatten(100_000);
        // Floats can't tell what is small from what is far away.
        if (expected.SurfaceArea().Equals(0) || (ending == ".stl" && (
            expected.UsedBounds.Minimum.MaxAbsComponent() > 20 * expected.UsedBounds.Size.MaxAbsComponent()
            || expected.SurfaceArea() < 1e-4 * expected.UsedBounds.Diagonal * expected.UsedBounds.Diagonal)))
        {
            return false;
        }

        var settings = new ExportSettings { Up = UpAxis.Y };
        var mesh = ExportedFile.Read(ending, ExportedFile.Write(Format(ending), scene, settings));
        Assert.Equal(expected.FaceCount, mesh.FaceCount);
        var tolerance = FloatTolerance * expected.UsedBounds.Diagonal;
        Near.Equal(expected.UsedBounds.Minimum, mesh.UsedBounds.Minimum, tolerance);
        Near.Equal(expected.UsedBounds.Maximum, mesh.UsedBounds.Maximum, tolerance);
        Near.Equal(1, mesh.SurfaceArea() / expected.SurfaceArea(), ending == ".ply" ? 1e-12 : 20 * FloatTolerance);
        return true;
    }, minShare: 0.6);

    [Theory]
    [MemberData(nameof(Endings))]
    public void Write_OfMirrors_KeepsFacesOutward(string ending) => Seeded.Run(30, random =>
    {
        var fractal = Samples.Repeated(2, random.Transformation(), random.Transformation() with { Scale = new(-1, 1, 2) });
        var handedness = random.Next(2) == 0 ? Handedness.Left : Handedness.Right;
        var scene = RenderScenes.Scene(new() { Handedness = handedness }, (new FractalModel(fractal), random.Transformation(), null));
        var mesh = ExportedFile.Read(ending, ExportedFile.Write(Format(ending), scene));
        for (var first = 0; first < mesh.FaceCount; first += Samples.Tetrahedron.FaceCount)
        {
            Assert.True(ExportedFile.Volume(Enumerable.Range(first, Samples.Tetrahedron.FaceCount).Select(mesh.Face)) > 0);
        }
    });

    [Theory]
    [MemberData(nameof(Endings))]
    public void Write_OfALeftHandedScene_MirrorsIt(string ending)
    {
        var scene = RenderScenes.Scene(new(), (new MeshModel(Samples.Tetrahedron), Transformation.Identity, null));
        var mesh = ExportedFile.Read(ending, ExportedFile.Write(Format(ending), scene, new() { Up = UpAxis.Y }));
        Assert.Equal(new(new(0, 0, -3), new(2, 1, 0)), mesh.UsedBounds);
    }

    [Theory]
    [MemberData(nameof(Endings))]
    public void Write_BeyondTheLimit_WritesNothing(string ending)
    {
        var scene = RenderScenes.Scene(new(), (RenderScenes.Menger(3), Transformation.Identity, null));
        using var stream = new MemoryStream();
        Assert.Equal(
            "menger.fdo has more faces than the limit of 95999: its base has 12, and the fractal has 8,000 instances, more than the limit "
            + "of 7,999; --depth or --instances writes fewer",
            Assert.Throws<FractalLimitException>(() => Format(ending).Write(scene, new() { MaxFaces = 95_999 }, stream)).Message);
        Assert.Equal(0, stream.Length);
        Assert.Equal("96000 faces", Format(ending).Write(scene, new() { MaxFaces = 96_000 }, stream).Contents);
    }

    [Fact]
    public void Stl_OfATriangle_HasTheBytesOfTheFormat()
    {
        var scene = RenderScenes.Scene(
            new() { Handedness = Handedness.Right }, (new MeshModel(Samples.Triangle), Transformation.Identity, null));
        var bytes = ExportedFile.Write(new StlExport(), scene, new() { Up = UpAxis.Y });
        Assert.Equal(134, bytes.Length);
        Assert.Equal(1u, BitConverter.ToUInt32(bytes, 80));
        float[] numbers = [.. Enumerable.Range(0, 12).Select(i => BitConverter.ToSingle(bytes, 84 + (4 * i)))];
        Assert.Equal([0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0], numbers);
        Assert.Equal(0, BitConverter.ToUInt16(bytes, 132));
    }

    [Fact]
    public void Stl_OfWhatIsTooFarForFloats_SaysSo()
    {
        var scene = RenderScenes.Scene(new(), (new MeshModel(Samples.Triangle), Samples.Move(1e39, 0, 0), null));
        Assert.StartsWith(
            "a coordinate is beyond the range of a float",
            Assert.Throws<FractalEngineException>(() => ExportedFile.Write(new StlExport(), scene)).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Ply_OfASceneWithoutColours_HasNone()
    {
        var bytes = ExportedFile.Write(
            new PlyExport(), RenderScenes.Scene(new(), (new MeshModel(Samples.Triangle), Transformation.Identity, null)));
        Assert.StartsWith(
            "ply\nformat binary_little_endian 1.0\ncomment FractalEngine\nelement vertex 3\nproperty double x\nproperty double y\n"
            + "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n",
            Encoding.ASCII.GetString(bytes), StringComparison.Ordinal);
        Assert.Empty(ExportedFile.Read(".ply", bytes).Colours);
    }

    /// <summary>Colours of vertices and of the object are multiplied as light, as they are drawn.</summary>
    [Fact]
    public void Ply_OfColoursOfVertices_MultipliesLight()
    {
        var mesh = Samples.Triangle.WithColours([0.5, 0.5, 0.5, 1, 1, 1, 0, 0, 0]);
        var read = ExportedFile.Read(".ply", ExportedFile.Write(
            new PlyExport(), RenderScenes.Scene(new(), (RenderScenes.Model(mesh), Transformation.Identity, new(0.5, 1, 1)))));
        // 0.2140 · 0.2140 of linear light is 0.0458, which is 0.2370 of sRGB.
        Near.Equal(new Vector(0.2370, 0.5, 0.5), ColourOf(read, 0), 0.6 / 255);
        Near.Equal(new Vector(0.5, 1, 1), ColourOf(read, 1), 0.6 / 255);
        Assert.Equal(Vector.Zero, ColourOf(read, 2));
    }

    [Fact]
    public void Ply_OfMaterials_HasAColourForEachCorner()
    {
        var mesh = Samples.Tetrahedron.WithGroups([new(0, 1, "", "", "red", 0), new(1, 3, "", "", "", 0)], []);
        var model = new MeshModel(mesh)
        {
            Materials = ImmutableDictionary<string, Material>.Empty.Add("red", new("red") { Diffuse = new(1, 0, 0) }),
        };
        var read = ExportedFile.Read(".ply", ExportedFile.Write(
            new PlyExport(), RenderScenes.Scene(new(), (model, Transformation.Identity, null))));
        // Three corners of the first face are there once more for the others.
        Assert.Equal(7, read.VertexCount);
        Assert.All(read.VertexIndices.Take(3), vertex => Assert.Equal(new(1, 0, 0), ColourOf(read, vertex)));
        var sand = ObjectPalette.ColourOf(0);
        Assert.All(read.VertexIndices.Skip(3), vertex => Near.Equal(
            new Vector(sand.Red, sand.Green, sand.Blue), ColourOf(read, vertex), 0.5 / 255));
    }

    [Fact]
    public void Ply_OfTints_MixesThemAsLight()
    {
        var set = new TransformationSet(
            [AffineMap.Identity, AffineMap.Translate(new(5, 0, 0))], [default, new MapColour(new(0, 0, 1), 0.5)]);
        var fractal = new Fractal(new([set]), Samples.Triangle);
        var read = ExportedFile.Read(".ply", ExportedFile.Write(
            new PlyExport(), RenderScenes.Scene(new(), (new FractalModel(fractal), Transformation.Identity, Colour.White))));
        // What the identity leaves comes last. Half of white light is 0.7354 of sRGB.
        Assert.Equal([5, 6, 5, 0, 1, 0], read.Positions.Where(static (_, index) => index % 3 == 0));
        Near.Equal(new Vector(0.7354, 0.7354, 1), ColourOf(read, 0), 0.5 / 255);
        Assert.Equal(new(1, 1, 1), ColourOf(read, 3));
    }

    [Fact]
    public void Ply_OfVertexColours_KeepsThem()
    {
        var mesh = Samples.Triangle.WithColours([1, 0, 0, 0, 1, 0, 0, 0, 1]);
        var read = ExportedFile.Read(".ply", ExportedFile.Write(
            new PlyExport(), RenderScenes.Scene(new(), (new MeshModel(mesh), Transformation.Identity, null))));
        Assert.Equal(mesh.Colours.ToArray(), read.Colours.ToArray());
    }

    private static Vector ColourOf(Mesh mesh, int vertex) =>
        new(mesh.Colours[3 * vertex], mesh.Colours[(3 * vertex) + 1], mesh.Colours[(3 * vertex) + 2]);

    private static SceneExport Format(string ending) => ending == ".ply" ? new PlyExport() : new StlExport();
}
