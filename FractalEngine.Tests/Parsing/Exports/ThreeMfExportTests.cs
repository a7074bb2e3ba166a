using System.Collections.Immutable;
using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Exports.ThreeMf;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Exports;

/// <summary>Tests 3MF files by expanding their components as the specification says.</summary>
public class ThreeMfExportTests
{
    [Fact]
    public void Write_OfAnyFractalWithMirrors_IsItsExpansionOutward() => Seeded.Run(60, random =>
    {
        var fractal = Samples.Repeated(
            random.Next(4), random.Transformation(), random.Transformation() with { Scale = new(-0.5, 0.7, 0.6) });
        var scene = RenderScenes.Scene(new(), (new FractalModel(fractal), random.Transformation(), null));
        var faces = ExportedFile.ReadThreeMf(ExportedFile.Write(new ThreeMfExport(), scene));
        var expected = scene.Objects.Flatten(100_000);
        Assert.Equal(expected.FaceCount, faces.Count);
        // Turned to z up and mirrored, since scenes are left-handed: (x, y, z) becomes (x, z, y).
        var bounds = expected.UsedBounds;
        var found = faces.SelectMany(static face => new[] { face.A, face.B, face.C }).ToArray();
        var tolerance = 1e-12 * (1 + bounds.Diagonal + bounds.Minimum.MaxAbsComponent());
        Near.Equal(new(bounds.Minimum.X, bounds.Minimum.Z, bounds.Minimum.Y), found.Aggregate(Vector.Min), tolerance);
        Near.Equal(new(bounds.Maximum.X, bounds.Maximum.Z, bounds.Maximum.Y), found.Aggregate(Vector.Max), tolerance);
        var volume = scene.Objects[0].ObjectToWorld.Linear.Determinant()
            * fractal.Expand(1000).Sum(static map => Math.Abs(map.Linear.Determinant()));
        Near.Equal(1, ExportedFile.Volume(faces.Select(static face => (face.A, face.B, face.C))) / Math.Abs(volume), 1e-9);
    });

    [Fact]
    public void Write_OfASpongeOfThirtyLevels_TakesThreeKilobytes()
    {
        var bytes = ExportedFile.Write(
            new ThreeMfExport(), RenderScenes.Scene(new(), (RenderScenes.Menger(30), Transformation.Identity, null)));
        Assert.InRange(bytes.Length, 1000, 4000);
        Assert.Equal(31, ExportedFile.ReadModel(bytes).Descendants().Count(static element => element.Name.LocalName == "object"));
    }

    [Fact]
    public void Write_Twice_IsTheSameBytes()
    {
        var scene = RenderScenes.Scene(new(), (RenderScenes.Menger(2), Transformation.Identity, null));
        Assert.Equal(ExportedFile.Write(new ThreeMfExport(), scene), ExportedFile.Write(new ThreeMfExport(), scene));
    }

    [Theory]
    [InlineData(false, 1000, null)]
    [InlineData(true, 1, null)]
    [InlineData(false, 1, 20L)]
    public void Write_OfOneModelTwice_KeepsLevelsUnlessFlat(bool isFlat, int maxItems, long? maxInstances)
    {
        var model = RenderScenes.Menger(1);
        var scene = RenderScenes.Scene(
            new(), (model, Transformation.Identity, null), (model, Samples.Move(5, 0, 0), null));
        var bytes = ExportedFile.Write(new ThreeMfExport(), scene, new() { IsFlat = isFlat, MaxInstances = maxInstances * 2 });
        var names = ExportedFile.ReadModel(bytes).Descendants().Select(static element => element.Name.LocalName).ToArray();
        Assert.InRange(names.Count(static name => name == "item"), 1, maxItems);
        Assert.Equal(isFlat || maxInstances is not null ? 0 : 20, names.Count(static name => name == "component"));
        Assert.Equal(480, ExportedFile.ReadThreeMf(bytes).Count);
    }

    [Fact]
    public void Write_OfMaterials_ColoursTheirFaces()
    {
        var mesh = Samples.Tetrahedron.WithGroups([new(0, 1, "", "", "red", 0), new(1, 3, "", "", "", 0)], []);
        var model = new MeshModel(mesh)
        {
            Materials = ImmutableDictionary<string, Material>.Empty.Add("red", new("red") { Diffuse = new(1, 0, 0) }),
        };
        var scene = RenderScenes.Scene(
            new(), (model, Transformation.Identity, new(0, 0, 1)), (model, Samples.Move(9, 0, 0), Colour.White));
        var faces = ExportedFile.ReadThreeMf(ExportedFile.Write(new ThreeMfExport(), scene));
        Assert.Equal(
            ["#000000", "#0000FF", "#0000FF", "#0000FF", "#FF0000", "#FFFFFF", "#FFFFFF", "#FFFFFF"], faces.Select(face => face.Colour));
    }

    [Fact]
    public void Write_OfTints_KeepsThemWhereFlat()
    {
        var set = new TransformationSet(
            [AffineMap.Identity, AffineMap.Translate(new(5, 0, 0))], [default, new MapColour(new(0, 0, 1), 1)]);
        var scene = RenderScenes.Scene(
            new(), (new FractalModel(new Fractal(new([set]), Samples.Tetrahedron)), Transformation.Identity, Colour.White));
        using var stream = new MemoryStream();
        Assert.Equal(
            ["colours of maps and gradients are written with --flat only"],
            new ThreeMfExport().Write(scene, new(), stream).Losses.ToArray());
        var faces = ExportedFile.ReadThreeMf(ExportedFile.Write(new ThreeMfExport(), scene, new() { IsFlat = true }));
        Assert.Equal(["#0000FF", "#FFFFFF"], faces.Select(face => face.Colour).Distinct().Order());
    }

    /// <summary>The format knows neither meshes without faces nor objects without components.</summary>
    [Fact]
    public void Write_OfNothing_HasNoObjects()
    {
        var needle = new Mesh([0, 0, 0, 1, 0, 0], [0, 1, 1, 0, 0, 0]);
        var nothing = new FractalModel(Fractal.Of(needle).Apply([Samples.Move(1, 0, 0), Samples.Move(2, 0, 0)]));
        var none = new FractalModel(Fractal.Of(Samples.Tetrahedron).Apply([]));
        var scene = RenderScenes.Scene(
            new(), (new MeshModel(needle), Transformation.Identity, null), (nothing, Transformation.Identity, null),
            (none, Transformation.Identity, null), (RenderScenes.Model(Samples.Tetrahedron, "a.obj"), Transformation.Identity, null));
        var bytes = ExportedFile.Write(new ThreeMfExport(), scene);
        Assert.Single(ExportedFile.ReadModel(bytes).Descendants(), static element => element.Name.LocalName == "object");
        Assert.Equal(4, ExportedFile.ReadThreeMf(bytes).Count);
    }

    [Fact]
    public void Write_OfAnOpenMesh_NamesItAndAnEdge() => AssertRefused(
        "sail.obj is not closed, as .3mf files need meshes to be: an edge at (0.5, 0, 0) has no face beyond it",
        RenderScenes.Model(Samples.Triangle, "sail.obj"));

    [Fact]
    public void Write_OfAnInfiniteFractal_SaysWhatToChoose() =>
        AssertRefused("menger.fdo is infinite: choose a depth, or a number of instances", RenderScenes.Menger(null));

    private static void AssertRefused(string message, Model model)
    {
        using var stream = new MemoryStream();
        var scene = RenderScenes.Scene(new(), (model, Transformation.Identity, null));
        Assert.Equal(message, Assert.Throws<FractalEngineException>(() => new ThreeMfExport().Write(scene, new(), stream)).Message);
        Assert.Equal(0, stream.Length);
    }
}
