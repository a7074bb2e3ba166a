using System.Collections.Immutable;
using System.Globalization;
using System.Text;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Exports.Csv;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Exports;

/// <summary>Tests that rows of a table of instances read back to the same bits.</summary>
public class CsvExportTests
{
    [Theory]
    [InlineData("")]
    [InlineData("de-DE")]
    public void Write_OfAnyFractal_ReadsBackEqual(string culture) => Seeded.Run(50, random =>
    {
        var (fractal, placement) = (RandomFractals.CreateAny(random), random.Transformation());
        var rows = InCulture.Run(culture, () => Rows(RenderScenes.Scene(new(), (new FractalModel(fractal), placement, null))));
        var (instances, _) = fractal.Enumerate(100_000, hasPaths: true);
        var expected = instances.ToArray();
        Assert.Equal(expected.Length, rows.Length);
        foreach (var (row, instance) in rows.Zip(expected))
        {
            var n = row[3..15].Select(text => double.Parse(text, CultureInfo.InvariantCulture)).ToArray();
            Assert.Equal(
                placement.ToAffineMap() * instance.Map,
                new(Matrix.FromRows(new(n[0], n[1], n[2]), new(n[4], n[5], n[6]), new(n[8], n[9], n[10])), new(n[3], n[7], n[11])));
            Assert.Equal(instance.Path?.ToString() ?? "", row[1]);
            // The first object's own colour.
            Assert.Equal(["0.91", "0.79", "0.6"], row[15..]);
        }
    });

    [Fact]
    public void Write_OfObjects_NamesThemAndTheirMeshes()
    {
        var scene = RenderScenes.Scene(
            new(), (RenderScenes.Model(Samples.Triangle, "a,b.obj"), Samples.Move(1, 2, 3), new(0.1, 0.2, 0.3)),
            (RenderScenes.Menger(1), Transformation.Identity, null));
        var text = Encoding.UTF8.GetString(ExportedFile.Write(new CsvExport(), scene));
        Assert.StartsWith(
            $"{CsvExport.Header}\n\"a,b\",,\"a,b.obj\",1,0,0,1,0,1,0,2,0,0,1,3,0.1,0.2,0.3\nmenger,0,mesh 0,", text,
            StringComparison.Ordinal);
        Assert.Equal(22, text.Count(static letter => letter == '\n'));
    }

    [Fact]
    public void Write_OfMaterials_HasTheColourOfTheFirst()
    {
        var model = new MeshModel(Samples.Tetrahedron.WithGroups([new(0, 4, "", "", "red", 0)], []))
        {
            Materials = ImmutableDictionary<string, Material>.Empty.Add("red", new("red") { Diffuse = new(1, 0, 0) }),
        };
        Assert.Equal(["1", "0", "0"], Assert.Single(Rows(RenderScenes.Scene(new(), (model, Transformation.Identity, null))))[15..]);
    }

    [Fact]
    public void Write_OfTheLargestInstances_HasEachWithItsMesh()
    {
        var fractal = Fractal.Of(Samples.Tetrahedron) + Fractal.Of(Samples.Triangle).Apply([Samples.Move(1, 0, 0), Samples.Move(2, 0, 0)]);
        var scene = RenderScenes.Scene(new(), (new FractalModel(fractal), Transformation.Identity, null));
        var text = Encoding.UTF8.GetString(ExportedFile.Write(new CsvExport(), scene, new() { MaxInstances = 9 }));
        Assert.Equal(1, text.Split(",mesh 0,").Length - 1);
        Assert.Equal(2, text.Split(",mesh 1,").Length - 1);
    }

    private static string[][] Rows(LoadedScene scene)
    {
        var lines = Encoding.UTF8.GetString(ExportedFile.Write(new CsvExport(), scene)).Split('\n');
        Assert.Equal((CsvExport.Header, ""), (lines[0], lines[^1]));
        return [.. lines[1..^1].Select(static line => line.Split(','))];
    }
}
