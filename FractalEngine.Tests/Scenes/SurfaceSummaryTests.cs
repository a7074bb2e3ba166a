using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Scenes;

/// <summary>Tests areas and volumes that are summed up over levels against closed forms and the sums over all faces.</summary>
public class SurfaceSummaryTests
{
    [Fact]
    public void Of_ADeepSponge_IsTheClosedForm()
    {
        var summary = SurfaceSummary.Of(RenderScenes.Scene(new(), (RenderScenes.Menger(30), Transformation.Identity, null)));
        // Some roundings a level.
        Near.Equal(1, summary.Area!.Value / (24 * Math.Pow(20.0 / 9, 30)), 1e-12);
        Near.Equal(1, summary.Volume!.Value / (8 * Math.Pow(20.0 / 27, 30)), 1e-12);
        Assert.Null(summary.Open);
    }

    [Fact]
    public void Of_FractalsOfSimilarities_IsTheSumOverTheirFaces() => Seeded.Run(100, random =>
    {
        var maps = Enumerable.Range(0, random.Next(1, 4)).Select(_ =>
        {
            var map = random.Transformation();
            return map with { Scale = random.Between(0.2, 0.8) * new Vector(random.Next(2) == 0 ? 1 : -1, 1, 1) };
        });
        var fractal = Samples.Repeated(random.Next(4), [.. maps]);
        var placement = random.Transformation();
        placement = placement with { Scale = random.Between(0.5, 2) * Vector.One };
        var flat = fractal.Flatten(100_000);
        var summary = SurfaceSummary.Of(RenderScenes.Scene(new(), (new FractalModel(fractal), placement, null)));
        Near.Equal(1, summary.Area!.Value / (Math.Pow(placement.Scale.X, 2) * flat.SurfaceArea()), 1e-11);
        var volume = fractal.Expand(100_000).Sum(map => Math.Abs(map.Linear.Determinant()));
        // The tetrahedron with edges of 2, 1 and 3 has a volume of 1.
        Near.Equal(1, summary.Volume!.Value / (Math.Pow(placement.Scale.X, 3) * volume), 1e-11);
    });

    /// <summary>Equal maps of a set are one, and so is what an identity repeats. Equal chains are several.</summary>
    [Theory]
    [InlineData(1, "<$>. [t.1, t.1] box")]
    [InlineData(1, "<$>. [t.1] box + [t.1] box")]
    [InlineData(3, "z<box>. [#, t.1] box\n<$>. z 2")]
    [InlineData(4, "z<box>. [t.1, t.2] box\n<$>. z 2")]
    public void Of_InstancesThatCoincide_CountsEqualMapsOnceAndEqualChainsEachTime(int count, string text)
    {
        using var folder = new TemporaryFolder();
        var fractal = FractalFile.Read(folder.Write("a.fdo", $"v 1 0 0\nv 2 0 0\nt.a. (a, #, #)\n{text}\n"));
        var summary = SurfaceSummary.Of(RenderScenes.Scene(new(), (new FractalModel(fractal), Transformation.Identity, null)));
        Assert.Equal((6.0 * count, (double)count), (summary.Area, summary.Volume));
    }

    [Fact]
    public void Of_MapsThatStretch_HasTheAreaOfItsExpansion()
    {
        var fractal = Samples.Repeated(2, new Transformation(Vector.I, Vector.Zero, new(0.5, 0.25, 0.5)), Samples.Move(3, 0, 0));
        var summary = SurfaceSummary.Of(RenderScenes.Scene(new(), (new FractalModel(fractal), Transformation.Identity, null)));
        Near.Equal(fractal.Flatten(100).SurfaceArea(), summary.Area!.Value, 1e-12);
        Near.Equal(Math.Pow(1 + (1.0 / 16), 2), summary.Volume!.Value, 1e-12);
    }

    [Fact]
    public void Of_AMeshUnderAnyMap_IsThatOfItsImage()
    {
        var placement = new Transformation(new(1, 2, 3), new(10, 20, 30), new(1, -2, 3));
        var summary = SurfaceSummary.Of(RenderScenes.Scene(new(), (new MeshModel(RenderScenes.Cube(0.5)), placement, null)));
        Near.Equal(2 * (2 + 6 + 3), summary.Area!.Value, 1e-12);
        Near.Equal(6, summary.Volume!.Value, 1e-12);
    }

    [Fact]
    public void Of_AnOpenMesh_NamesItAndAnEdge()
    {
        var summary = SurfaceSummary.Of(RenderScenes.Scene(
            new(), (RenderScenes.Model(RenderScenes.Cube(1)), Transformation.Identity, null),
            (RenderScenes.Model(Samples.Triangle, "sail.obj"), Transformation.Identity, null)));
        Assert.Equal(24.5, summary.Area);
        Assert.Null(summary.Volume);
        Assert.Equal("sail.obj", summary.Open?.Mesh);
        Assert.Equal(new(0.5, 0, 0), summary.Open!.Value.Edge);
    }

    [Fact]
    public void Of_WhatIsInfinite_IsUnknown()
    {
        var summary = SurfaceSummary.Of(RenderScenes.Scene(new(), (RenderScenes.Menger(null), Transformation.Identity, null)));
        Assert.Equal(new SurfaceSummary(null, null, null), summary);
    }
}
