using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Mtl;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Mtl;

public class MtlParserTests
{
    private static ParsedMtl Parse(string text) => MtlParser.Parse(new("test.mtl", text));

    private static Material SingleMaterial(string text) => Assert.Single(Parse(text).Materials).Value;

    [Fact]
    public void Material_WithEveryStatement_HasItsValues()
    {
        var file = Parse("""
            # A comment
            newmtl red paint # another
              Ka 0.1 0.2 0.3
            	Kd 0.4 0.5 0.6
            Ks 0.7 0.8 0.9
            Ns 96.5
            d 0.25
            illum 2
            Ni 1.45
            Tf 0.5 0.25 1
            Ke 0 0.5 2
            map_Kd wood.png
            map_d -clamp on holes.png
            """);
        Assert.Empty(file.Warnings);
        Assert.Equal(
            new Material("red paint")
            {
                Ambient = new(0.1, 0.2, 0.3),
                Diffuse = new(0.4, 0.5, 0.6),
                Specular = new(0.7, 0.8, 0.9),
                SpecularExponent = 96.5,
                Opacity = 0.25,
                RefractiveIndex = 1.45,
                Transmission = new(0.5, 0.25, 1),
                Emission = new(0, 0.5, 2),
                Texture = new("wood.png"),
                OpacityTexture = new("holes.png") { IsClamped = true },
            },
            file.Materials["red paint"]);
    }

    [Theory]
    [InlineData("map_Bump")]
    [InlineData("map_bump")]
    [InlineData("bump")]
    public void PhysicalMaterials_AreParsed_WithAWarningForWhatIsNotShown(string keyword)
    {
        var file = Parse($"newmtl a\n{keyword} -bm 0.25 -s 2 2 2 a\\heights.png\nnorm normals.png\nmap_Ke glow.png\nPr 0.5\nPm 1 # all\n");
        Assert.Equal(
            new Material("a")
            {
                BumpTexture = new("a/heights.png") { BumpFactor = 0.25, Scale = (2, 2) },
                NormalTexture = new("normals.png"),
                EmissionTexture = new("glow.png"),
                Roughness = 0.5,
                Metalness = 1,
            },
            file.Materials["a"]);
        Assert.StartsWith(
            "test.mtl:4:1: warning: map_Ke is kept but not shown\n", Assert.Single(file.Warnings).ToString(), StringComparison.Ordinal);
        Assert.Equal(
            file.Source.Text.IndexOf("normals.png", StringComparison.Ordinal),
            file.TextureNameOffsets[file.Materials["a"].NormalTexture!]);
    }

    [Fact]
    public void Material_WithoutStatements_IsWhiteMattAndOpaque() => Assert.Equal(
        new Material("m")
        {
            Diffuse = Colour.White, Ambient = Colour.White, Specular = Colour.Black, SpecularExponent = 1, Opacity = 1,
            Texture = null
        },
        SingleMaterial("newmtl m"));

    [Fact]
    public void Materials_OfTheSameName_KeepTheFirst()
    {
        var file = Parse("newmtl a\nKd 1 0 0\nmap_Kd a.png\nnewmtl b\nKd 0 1 0\r\nnewmtl a\rKd 0 0 1\nmap_Kd second.png\n");
        Assert.Equal(["a", "b"], file.Materials.Keys.Order());
        Assert.Equal((new Colour(1, 0, 0), "a.png"), (file.Materials["a"].Diffuse, file.Materials["a"].Texture!.Path));
        Assert.Equal("a.png", file.Source.Text.Substring(file.TextureNameOffsets[file.Materials["a"].Texture!], 5));
    }

    [Fact]
    public void Colour_OfOneNumber_IsGrey() => Assert.Equal(new Colour(0.5, 0.5, 0.5), SingleMaterial("newmtl m\nKd .5 # grey").Diffuse);

    [Theory]
    [InlineData("d 0.75", 0.75)]
    [InlineData("d -halo 0.5", 0.5)]
    [InlineData("d 7", 1)]
    [InlineData("d -7", 0)]
    [InlineData("Tr 0.25", 0.75)]
    [InlineData("d 0.75\nTr 0.5", 0.75)]
    [InlineData("Tr 0.5\nd 0.75", 0.75)]
    [InlineData("Tr 1", 1)] // as some programs write what is opaque
    [InlineData("Tr 0", 1)]
    [InlineData("d 0.5\nnewmtl n\nTr 0.25", 0.5, 0.75)] // overridden by a d of its own only
    public void Opacity_ByEitherStatement_IsKept(string statements, double expected, double? expectedOfTheNext = null) =>
        Assert.Equal(
            new double?[] { expected, expectedOfTheNext }.OfType<double>(),
            Parse($"newmtl m\n{statements}\n").Materials.OrderBy(named => named.Key).Select(named => named.Value.Opacity));

    [Theory]
    [InlineData("wood.png", "wood.png")]
    [InlineData("  my wood 01.png  ", "my wood 01.png")]
    [InlineData("wood#2.png", "wood#2.png")]
    [InlineData("wood.png # oak", "wood.png")]
    [InlineData("textures\\wood.png", "textures/wood.png")]
    [InlineData("-texres 512 wood.png", "wood.png")]
    [InlineData("-blendu on -blendv off -cc on wood.png", "wood.png")]
    [InlineData("-bm 2 -boost 1.5 -mm 0.1 0.3 wood.png", "wood.png")]
    [InlineData("-t 0.1 wood.png", "wood.png")]
    [InlineData("-t 0.1 0.2 0.3 wood.png", "wood.png")]
    [InlineData("-imfchan r -type sphere -colorspace sRGB wood.png", "wood.png")]
    [InlineData("-s 1 1 1 2k wood.png", "2k wood.png")]
    [InlineData("-o 1 2 3.png", "3.png")]
    public void Texture_BehindOptions_HasItsName(string statement, string name)
    {
        var file = Parse($"newmtl m\nmap_Kd {statement}\n");
        Assert.Empty(file.Warnings);
        Assert.Equal(name, file.Materials["m"].Texture!.Path);
    }

    [Theory]
    [InlineData("-clamp on a.png", true)]
    [InlineData("-clamp off a.png", false)]
    [InlineData("a.png", false)]
    public void Texture_WithClampOption_IsClamped(string statement, bool isClamped) =>
        Assert.Equal(isClamped, SingleMaterial($"newmtl m\nmap_Kd {statement}").Texture!.IsClamped);

    [Fact]
    public void Texture_MovedAndScaled_KeepsDefaultsOfOmittedNumbers()
    {
        Assert.Equal(
            new MaterialTexture("a.png") { Offset = (0.1, 0), Scale = (2, 3) },
            SingleMaterial("newmtl m\nmap_Kd -o 0.1 -s 2 3 a.png").Texture);
        Assert.Equal(new MaterialTexture("a.png") { Scale = (2, 1) }, SingleMaterial("newmtl m\nmap_Kd -s 2 a.png").Texture);
    }

    [Theory]
    [InlineData("Kd 1 x 1", 6, "unexpected 'x', expected a number")]
    [InlineData("Kd 1 1", 7, "unexpected end of line, expected a number")]
    [InlineData("Kd", 3, "unexpected end of line, expected a number")]
    [InlineData("Kd 1,5 0 0", 5, "unexpected ',', expected a number")]
    [InlineData("Ks 1 1 1 1", 10, "unexpected '1', expected the end of the line")]
    [InlineData("Ka nan", 4, "unexpected 'nan', expected a number")]
    [InlineData("Ns 1e999", 4, "the number 1e999 is beyond the range of a double")]
    [InlineData("newmtl", 7, "unexpected end of line, expected a name")]
    [InlineData("map_Kd", 7, "unexpected end of line, expected a file name")]
    [InlineData("map_Kd -clamp maybe a.png", 15, "unexpected 'maybe', expected 'on' or 'off'")]
    [InlineData("map_Kd -glow 1 a.png", 8, "unexpected '-', expected an option of a texture or a file name")]
    public void Statement_ThatIsWrong_IsIgnoredWithAWarning(string statement, int column, string message)
    {
        var file = Parse($"newmtl m\n{statement}\nd 0.5\n");
        Assert.Equal(
            $"test.mtl:2:{column}: warning: {message}: the statement is ignored\n  {statement}\n  {new string(' ', column - 1)}^",
            Assert.Single(file.Warnings).ToString());
        Assert.Equal(new Material("m") { Opacity = 0.5 }, file.Materials["m"]);
    }

    [Fact]
    public void Statement_BeforeAnyMaterial_IsIgnoredWithAWarning() => Assert.Equal(
        "test.mtl:1:1: warning: no material is declared above: the statement is ignored\n  Kd 1 1 1\n  ^",
        Assert.Single(Parse("Kd 1 1 1\nnewmtl m\n").Warnings).ToString());

    [Fact]
    public void Statements_WrongInSeveralPlaces_GiveOneWarning()
    {
        Assert.Equal(
            "test.mtl:2:4: warning: unexpected 'x', expected a number: the statement is ignored (3 such statements in all)\n  Kd x\n     ^",
            Assert.Single(Parse("newmtl m\nKd x\nKs y\nd z\n").Warnings).ToString());
    }

    [Fact]
    public void Statements_WrongWithoutEnd_AreNotAllParsed()
    {
        var text = "newmtl m\n" + string.Concat(Enumerable.Repeat("Ns 1e999\n", 1_000_000)) + "d 0.5\n";
        // A message for each of the million lines would take hundreds of megabytes.
        var file = Allocation.RunWithin(20_000_000, () => Parse(text));
        Assert.Equal(
            "the number 1e999 is beyond the range of a double: the statement is ignored "
                + "(after 100 such statements the rest of the file is, too)",
            Assert.Single(file.Warnings).Message);
        Assert.Equal(1, file.Materials["m"].Opacity);
    }

    [Theory]
    [InlineData("")]
    [InlineData("\n\n# Blender\n")]
    [InlineData("illum\nmap_Ks -foo\ndisp -bm 2 x.png\n$ 1\n123\nrefl -")]
    public void File_WithoutMaterials_IsEmptyWithoutAWarning(string text)
    {
        var file = Parse(text);
        Assert.Empty(file.Materials);
        Assert.Empty(file.Warnings);
    }

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void Numbers_InAnyCulture_AreTheSame(string culture) =>
        Assert.Equal(new Colour(0.5, 0.25, 1), InCulture.Run(culture, () => SingleMaterial("newmtl m\nKd 0.5 .25 1e0")).Diffuse);

    [Fact]
    public void Parse_OfAnyText_NeverFails() => Seeded.Run(2000, random =>
    {
        var text =
            new System.Text.StringBuilder(
                "newmtl a\nKd 1 1 1\nKa 0 0 0\nKs 1 1 1\nNs 10\nd 1\nTr 0\nmap_Kd -clamp on -o 1 1 -s 2 a b.png # c\n"
                + "map_d -o 1 d.png\nKe 1 1 1\n");
        for (var change = random.Next(1, 6); change > 0; change--)
        {
            const string characters = "\0\t\n\r #,-.019\\KTadesmnpw_§\uD83D";
            var offset = random.Next(text.Length);
            _ = random.Next(2) switch
            {
                0 => text.Remove(offset, Math.Min(random.Next(1, 10), text.Length - offset)),
                _ => text.Insert(offset, characters[random.Next(characters.Length)]),
            };
        }

        var file = Parse(text.ToString());
        Assert.All(file.Warnings, warning => Assert.Matches(@"^test\.mtl:[1-9]\d*:[1-9]\d*: warning: \S", warning.ToString()));
        Assert.All(file.Materials.Values,
            material => Assert.True(material.OpacityTexture is null || file.TextureNameOffsets.ContainsKey(material.OpacityTexture)));
        Assert.All(file.Materials.Values,
            material => Assert.True(material.Texture is null || file.TextureNameOffsets.ContainsKey(material.Texture)));
        Assert.All(file.Materials.Values, material => Assert.InRange(material.Opacity, 0, 1));
    });

    [Fact]
    public void Parse_OfEveryAsset_GivesTheMaterialsThatItDeclares()
    {
        var files = Directory.GetFiles(Repository.Full("assets"), "*.mtl", SearchOption.AllDirectories);
        Assert.NotEmpty(files);
        Assert.All(files, path =>
        {
            var file = MtlParser.Parse(SourceText.Read(path, path, 1 << 20, acceptLatin1: true));
            var declared = File.ReadLines(path).Select(line => line.Split('#')[0].Trim())
                .Where(line => line.StartsWith("newmtl ", StringComparison.Ordinal)).Select(line => line[7..].Trim()).Distinct();
            Assert.Equal(declared.Order(StringComparer.Ordinal), file.Materials.Keys.Order(StringComparer.Ordinal));
        });
    }
}
