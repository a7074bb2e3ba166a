using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Rays;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Fdo.Writing;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Fdo;

/// <summary>What stands at a level by its number, materials of base meshes, and gradients in fractal files.</summary>
public sealed class LevelMaterialTests : IDisposable
{
    private const string Maps = "g. ((0, 1, 0), (0, 60, 9), (0.7))\ns. ((0, 0.7, 0), (0, 0, 40), (0.6))\n";

    private readonly TemporaryFolder _folder = new();

    public LevelMaterialTests()
    {
        File.WriteAllText(_folder["bark.mtl"], "newmtl Bark\nKd 0.4 0.2 0.1\n");
        File.WriteAllText(_folder["leaves.mtl"], "newmtl Leaf\nKd 0.2 0.7 0.2\nnewmtl Twig\nKd 0.7 0.6 0.3\n");
    }

    public void Dispose() => _folder.Dispose();

    private FractalModel Load(string text, string name = "a.fdo")
    {
        File.WriteAllText(_folder[name], text);
        return (FractalModel)AssetLoader.Load(_folder[name]).Scene.Objects[0].Model;
    }

    [Theory]
    [InlineData("level 0..1: box | 2..: cone", 2)]
    [InlineData("level 0: box | 1..: cone", 1)]
    [InlineData("level 0..2: box | 3..4: cone | 5..: cone", 3)]
    [InlineData("level 0..: box", int.MaxValue)]
    [InlineData("level   0..9 :box|10..:  cone", 10)]
    public void ChoiceByLevel_OfAnyDepth_IsThatOfAPlainRecursion(string choice, int firstCone)
    {
        for (var depth = 0; depth <= 6; depth++)
        {
            var expected = new List<(string Shape, AffineMap Map)>();
            Expand(depth, AffineMap.Identity);
            var model = Load($"{Maps}b. ball\nz<b>. [g.] b + [s.] b + ({choice})\n<$>. z {depth}");
            var actual = model.Parts.Cast<FractalModel>().SelectMany(static part =>
                part.Fractal.Expand(10_000).Select(map => (BaseShapes.NameOf(part.Mesh)!, map))).ToList();
            Assert.Equal(expected.Count, actual.Count);
            // Rounding of six products of maps of a size of about 1.
            Assert.All(expected, one => Assert.Contains(
                actual, other => other.Item1 == one.Shape && Near.Difference(other.map, one.Map) < 1e-12));
            Assert.Equal(expected.Count, model.Fractal.InstanceCount);
            Assert.Equal(expected.Count, model.Fractal.CountRange(100_000)?.Exact);

            void Expand(int remaining, AffineMap map)
            {
                var level = depth - remaining;
                expected.Add((remaining == 0 ? "ball" : level < firstCone ? "box" : "cone", map));
                if (remaining > 0)
                {
                    Expand(remaining - 1, map * new Transformation(new(0, 1, 0), new(0, 60, 9), new(0.7, 0.7, 0.7)).ToAffineMap());
                    Expand(remaining - 1, map * new Transformation(new(0, 0.7, 0), new(0, 0, 40), new(0.6, 0.6, 0.6)).ToAffineMap());
                }
            }
        }
    }

    [Theory]
    [InlineData("z 5", 1)]
    [InlineData("z", 2)]
    [InlineData("z 400", 3)]
    public void ChoiceByLevel_OfOneShape_HasTheRaysAndPointsOfThatShape(string result, int seed)
    {
        const string Head = $"{Maps}b. ball\nz<b>. [g.] b + [s.] b + ";
        var chosen = Load($"{Head}(level 0..1: box | 2..3: box material \"bark.mtl\" | 4..: box)\n<$>. {result}").Fractal;
        var plain = Load($"{Head}box\n<$>. {result}").Fractal;
        var random = new Random(seed);
        var (rays, plainRays) = (RayCaster.For(chosen), RayCaster.For(plain));
        var (collider, plainCollider) = (Model.Of(chosen).CreateCollider(), Model.Of(plain).CreateCollider());
        for (var i = 0; i < 200; i++)
        {
            var point = new Vector(random.NextDouble() - 0.5, random.NextDouble(), random.NextDouble() - 0.5) * 4;
            Near.Equal(collider.FindClosest(point).Distance, plainCollider.FindClosest(point).Distance, 1e-12);
            var ray = new Ray(new(3, 1, 2), (point * 0.3) - new Vector(3, 1, 2));
            Assert.Equal(plainRays.FindNearest(ray)?.Distance ?? -1, rays.FindNearest(ray)?.Distance ?? -1, 1e-12);
        }
    }

    [Theory]
    [InlineData("level 0..1: box | 2..: cone")]
    [InlineData("level 0..: box + cone")]
    [InlineData("level 0: [s.] b | 1..4: [g.] b + box | 5..: cone")]
    public void ChoiceByLevel_WrittenAndReadAgain_IsTheSame(string choice)
    {
        var parsed = FractalParser.Parse(new("a.fdo", $"{Maps}b. ball\nz<b>. [g.] b + ({choice})\n<$>. z 7"));
        string[] bases = [.. parsed.Bases.Select(static one => one.File)];
        var written = FractalWriter.Write(parsed.Description, [.. bases]);
        Assert.Contains("level 0..", written, StringComparison.Ordinal);
        Assert.DoesNotContain("seed", written, StringComparison.Ordinal);
        Assert.Equal(parsed.Description, FractalParser.Parse(new("b.fdo", written)).Description);
    }

    [Fact]
    public void Choice_OfLevelsThatDoNotAscendFromZero_IsRefused()
    {
        Assert.Equal([0, 1, 1, 2], new long[] { 0, 3, 8, 9 }.Select(Choice.OfLevels([0, 3, 9]).SelectAt));
        Assert.Equal(Choice.OfLevels([0, 3]), Choice.OfLevels([0, 3]).WithSeed(7));
        Assert.NotEqual(Choice.OfLevels([0, 3]), Choice.OfLevels([0, 4]));
        var choice = Choice.OfLevels([0, 3, 9]);
        Assert.Equal(0, Allocation.Measure(() => choice.SelectAt(7)));
        foreach (var levels in (ImmutableArray<int>[])[[], default, [1], [0, 0], [0, 3, 2], [.. Enumerable.Range(0, 65)]])
        {
            Assert.ThrowsAny<ArgumentException>(() => Choice.OfLevels(levels));
        }
    }

    [Fact]
    public void Materials_OfBases_AreThoseOfTheirInstances()
    {
        File.WriteAllText(_folder["two.obj"], "v 0 0 0\nv 1 0 0\nv 0 1 0\ng one\nf 1 2 3\ng two\nusemtl Leaf\nf 3 2 1\n");
        var model = Load($$"""
            {{Maps}}
            b. "two.obj" material "leaves.mtl" "Twig"
            z<b>. [g.] b + (level 0: box material "bark.mtl" | 1..: box material "leaves.mtl" "Leaf") + box
            <$>. z 4
            """);
        var found = model.Parts.Cast<FractalModel>().Select(static part => (
            Faces: part.Mesh.FaceCount, Groups: string.Join(' ', part.Mesh.Groups.Select(static group => group.Material)),
            Colour: part.Materials.Values.SingleOrDefault()?.Diffuse, Count: (int)part.InstanceCount!.Value)).ToList();
        Assert.Equal(
            [(2, "Twig Twig", 1), (12, "", 4), (12, "Bark", 1), (12, "Leaf", 3)],
            found.Select(static one => (one.Faces, one.Groups, one.Count)).Order());
        Assert.Equal(new Colour(0.4, 0.2, 0.1), found.Single(static one => one.Groups == "Bark").Colour);
        Assert.Null(found.Single(static one => one.Groups.Length == 0).Colour);
    }

    [Theory]
    [InlineData("box", true)]
    [InlineData("tetrahedron", true)]
    [InlineData("\"uv.obj\"", false)]
    public void Material_WithATexture_GivesCoordinatesByPositionToMeshesWithout(string mesh, bool isProjected)
    {
        File.WriteAllText(_folder["uv.obj"], "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.75\nf 1/1 2/1 3/1\n");
        File.Copy(Path.Combine(Repository.Root, "assets", "models", "crate.png"), _folder["crate.png"]);
        File.WriteAllText(_folder["tiles.mtl"], "newmtl Tiles\nmap_Kd crate.png\n");
        var shown = Load($"<$>. {mesh} material \"tiles.mtl\"").Mesh;
        Assert.Equal(isProjected ? 3 * shown.FaceCount : 3, shown.TextureIndices.Length);
        for (var face = 0; face < shown.FaceCount && isProjected; face++)
        {
            var (a, b, c) = shown.Face(face);
            // The projection of a face onto the side that it looks at most has at least the part 1 / √3 of its area.
            var (ua, ub, uc) = (Uv(face, 0), Uv(face, 1), Uv(face, 2));
            var projected = Math.Abs(((ub.X - ua.X) * (uc.Y - ua.Y)) - ((uc.X - ua.X) * (ub.Y - ua.Y)));
            Assert.InRange(projected / Vector.Cross(b - a, c - a).Length(), 0.577, 1.000001);
        }

        Vector Uv(int face, int corner)
        {
            var index = shown.TextureIndices[(3 * face) + corner];
            return new(shown.TextureCoordinates[2 * index], shown.TextureCoordinates[(2 * index) + 1], 0);
        }
    }

    [Fact]
    public void Materials_OfOneShapeByChance_AreSeveralMeshes()
    {
        var model = Load(
            "<$>. [((1, 0, 0), #, #)^0..99] (1: box material \"bark.mtl\" | 1: box material \"leaves.mtl\" \"Leaf\" | 1: box)");
        var counts = model.Parts.Select(static part => (int)((FractalModel)part).Fractal.Expand(1000).Length).ToArray();
        Assert.Equal((3, 100), (counts.Length, counts.Sum()));
        Assert.All(counts, static count => Assert.InRange(count, 15, 55));
    }

    [Theory]
    [InlineData("<$>. box material \"no.mtl\"", 19, "the file \"no.mtl\" is not found")]
    [InlineData("<$>. box material \"leaves.mtl\"", 19, "the file declares 2 materials: name one of them behind it")]
    [InlineData("<$>. box material \"leaves.mtl\" \"Lea\"", 19, "the file declares no material 'Lea': did you mean 'Leaf'?")]
    [InlineData("<$>. box material \"a.png\"", 19, "expected the name of a material file (.mtl)")]
    [InlineData("<$>. box material bark", 19, "unexpected 'bark', expected the name of a material file in quotes")]
    [InlineData("<$>. \"b.fdo\" material \"bark.mtl\"", 6, "a fractal has the materials of its meshes: give one to these")]
    [InlineData("<$>. level 0..2: box | 3..: ball", 6, "a choice by level stands in the body of a recursive, whose levels it counts")]
    [InlineData("z<box>. level 0..2: [#] box | 4..: ball", 31, "the levels of a choice follow each other: expected 3 here, not 4")]
    [InlineData("z<box>. level 0..2: [#] box | 3: ball", 9, "the last alternative of a choice by level has no end, as in '3..: box'")]
    [InlineData("z<box>. level 0..: [#] box | 3: ball", 30, "the levels before have no end, so that nothing comes behind them")]
    [InlineData("z<box>. level 0..2: box | 3..1: ball", 30, "the last level of an alternative is not before its first one")]
    [InlineData("z<box>. level 1..: box", 15, "the levels of a choice follow each other: expected 0 here, not 1")]
    [InlineData("z<box>. level 0..2147483647: box | 1: ball", 15, "a level is less than 2147483647")]
    [InlineData("gradient hight \"moss\"", 10, "unexpected 'hight': did you mean 'height'?")]
    [InlineData("gradient level \"moss\" \"ice\"", 23, "unexpected '\"', expected the end of the line")]
    public void Fault_InAMaterialLevelOrGradient_IsToldWithItsColumn(string text, int column, string message)
    {
        File.WriteAllText(_folder["b.fdo"], "<$>. box\n");
        var fault = Assert.Throws<SourceException>(() => Load(text)).Diagnostic;
        Assert.Equal((1, column, message), (fault.Line, fault.Column, fault.Message));
    }

    [Fact]
    public void LevelAndGradient_AsNamesOfObjects_StayNames()
    {
        var fractal = Load("level. box\ngradient. ball\nz<level>. [((1, 0, 0), #, #)] level + gradient\n<$>. z 3").Fractal;
        Assert.Equal(4, fractal.InstanceCount);
    }

    [Fact]
    public void Gradient_OfAFile_IsThatOfObjectsWithoutColours()
    {
        const string Text = "gradient height \"ember\" roughness 0.2 0.5 // red\n<$>. [((1, 2, 0), #, (0.5))^0..3] box\n";
        var model = Load(Text);
        var expected = Gradient.Of(GradientKind.Height, NamedPalettes.Find("ember")!) with { Roughness = new(0.2, 0.5) };
        Assert.Equal(expected, model.Gradient);
        File.WriteAllText(_folder["s.sdo"], """
            o "a.fdo" #
            o "a.fdo" # colour (1, 0, 0)
            o "a.fdo" # gradient level "moss"
            """);
        var objects = AssetLoader.Load(_folder["s.sdo"]).Scene.Objects;
        Assert.Equal([expected, null, Gradient.Of(GradientKind.Level, NamedPalettes.Find("moss")!)], objects.Select(one => one.Gradient));
    }

    [Fact]
    public void Gradient_OfAnInnerFile_IsNotThatOfTheWhole()
    {
        File.WriteAllText(_folder["inner.fdo"], "gradient height \"ember\"\n<$>. box\n");
        Assert.Null(Load("<$>. [((1, 2, 0), #, (0.5))^0..3] \"inner.fdo\"").Gradient);
    }

    [Fact]
    public void Gradient_DeclaredTwice_IsAFault()
    {
        var fault = Assert.Throws<SourceException>(() => Load("gradient level \"moss\"\n\ngradient path \"ice\"\n<$>. box")).Diagnostic;
        Assert.Equal((3, 1, "the gradient is declared twice, first in line 1"), (fault.Line, fault.Column, fault.Message));
    }
}
