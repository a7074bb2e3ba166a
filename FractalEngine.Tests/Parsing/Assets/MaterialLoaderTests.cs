using System.Buffers.Binary;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Assets;

/// <summary>Materials and textures that files name are found and shared; missing ones give a warning only.</summary>
public sealed class MaterialLoaderTests : IDisposable
{
    private const string Triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Load_OfAMeshWithMaterials_HasThoseThatItUses()
    {
        WritePngHeader("wood.png", 4, 3);
        _folder.Write("a.mtl", "newmtl wood\nmap_Kd wood.png\nnewmtl unused\nmap_Kd missing.png\n");
        var loaded = Load("mtllib a.mtl\nusemtl wood\nf 1 2 3\n");
        Assert.Empty(loaded.Warnings);
        Assert.Equal(new Material("wood") { Texture = new(_folder["wood.png"]) },
            Assert.Single(loaded.Scene.Objects[0].Model.Materials).Value);
        Assert.Equal(new[] { "a.obj", "a.mtl", "wood.png" }.Sum(file => new FileInfo(_folder[file]).Length), loaded.StorageBytes);
    }

    [Fact]
    public void Load_OfAFractal_HasTheMaterialsOfItsBase()
    {
        _folder.Write("a.mtl", "newmtl red\nKd 1 0 0\n");
        _folder.Write("base.obj", $"mtllib a.mtl\n{Triangle}usemtl red\nf 1 2 3\n");
        var loaded = AssetLoader.Load(_folder.Write("f.fdo", "<$>. \"base.obj\""));
        Assert.Equal(new Colour(1, 0, 0), Assert.IsType<FractalModel>(loaded.Scene.Objects[0].Model).Materials["red"].Diffuse);
    }

    [Fact]
    public void Load_OfOneMaterialFileForManyMeshes_ReadsItOnce()
    {
        _folder.Write("a.mtl", "newmtl red\nKd x\n");
        _folder.Write("a.obj", $"mtllib a.mtl\n{Triangle}usemtl red\nf 1 2 3\n");
        _folder.Write("b.obj", $"mtllib a.mtl\n{Triangle}usemtl red\nf 1 3 2\n");
        var loaded = AssetLoader.Load(_folder.Write("s.sdo", "o \"a.obj\" #\no \"b.obj\" #\no \"a.obj\" #"));
        Assert.Single(loaded.Warnings);
        Assert.Same(loaded.Scene.Objects[0].Model.Materials["red"], loaded.Scene.Objects[1].Model.Materials["red"]);
    }

    [Fact]
    public void Load_OfAnImageInAnotherFolder_IsRelativeToTheMaterialFile()
    {
        WritePngHeader("sub/images/wood.png", 2, 2);
        _folder.Write("sub/a.mtl", "newmtl wood\nmap_Kd images/wood.png\n");
        Assert.Equal(_folder["sub/images/wood.png"], MaterialOf(Load("mtllib sub/a.mtl\nusemtl wood\nf 1 2 3\n")).Texture!.Path);
    }

    [Theory]
    [InlineData("mtllib a.mtl b.mtl")]
    [InlineData("mtllib a.mtl\nmtllib b.mtl")]
    [InlineData("mtllib two words.mtl b.mtl")]
    [InlineData("mtllib two\\ words.mtl b.mtl")]
    [InlineData("mtllib two words.mtl\nmtllib b.mtl")]
    public void Load_OfSeveralMaterialFiles_FindsTheMaterialsOfAll(string statements)
    {
        _folder.Write("a.mtl", "newmtl red\n");
        _folder.Write("two words.mtl", "newmtl red\n");
        _folder.Write("b.mtl", "newmtl blue\n");
        var loaded = Load($"{statements}\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\n");
        Assert.Empty(loaded.Warnings);
        Assert.Equal(["blue", "red"], loaded.Scene.Objects[0].Model.Materials.Keys.Order());
    }

    [Theory]
    [InlineData("images\\wood.png")]
    [InlineData(".\\images\\WOOD.PNG")]
    [InlineData("\"images/wood.png\"")]
    [InlineData("'Images/Wood.png'")]
    [InlineData("../sub/Images/./wood.png")]
    [InlineData("C:\\Users\\me\\My models\\Beside.png")]
    [InlineData("/home/me/beside.png")]
    [InlineData("//server/textures/beside.png")]
    [InlineData("textures/beside.png")]
    [InlineData("../../beside.png")]
    public void Load_OfAnImageNamedAsOnAnotherSystem_FindsIt(string name)
    {
        WritePngHeader("sub/images/wood.png", 2, 2);
        WritePngHeader("sub/beside.png", 2, 2);
        _folder.Write("sub/a.mtl", $"newmtl wood\nmap_Kd {name}\n");
        var loaded = Load("mtllib sub/a.mtl\nusemtl wood\nf 1 2 3\n");
        Assert.Empty(loaded.Warnings);
        Assert.Equal(_folder[name.Contains("eside", StringComparison.Ordinal) ? "sub/beside.png" : "sub/images/wood.png"],
            MaterialOf(loaded).Texture!.Path);
    }

    [Theory]
    [InlineData("mtllib Sub\\A.mtl")]
    [InlineData("mtllib \"sub/a.mtl\"")]
    [InlineData("mtllib \"gone.mtl\" \"sub/a.MTL\"")]
    public void Load_OfAMaterialFileNamedAsOnAnotherSystem_FindsIt(string library)
    {
        _folder.Write("sub/a.mtl", "newmtl red\n");
        Assert.Equal("red", MaterialOf(Load($"{library}\nusemtl red\nf 1 2 3\n")).Name);
    }

    [SkippableFact]
    public void Load_OfANameInTwoCases_TakesTheExactOneThenTheFirstInOrdinalOrder()
    {
        WritePngHeader("WOOD.png", 2, 2);
        WritePngHeader("Wood.png", 2, 2);
        WritePngHeader("wood.png", 2, 2);
        Elsewhere.SkipIf(Directory.GetFiles(Path.GetDirectoryName(_folder["wood.png"])!, "*.png").Length < 3, "names have no case here");
        foreach (var (name, expected) in new[] { ("wood.png", "wood.png"), ("Wood.png", "Wood.png"), ("wooD.png", "WOOD.png") })
        {
            _folder.Write("a.mtl", $"newmtl wood\nmap_Kd {name}\n");
            Assert.Equal(_folder[expected], MaterialOf(Load("mtllib a.mtl\nusemtl wood\nf 1 2 3\n")).Texture!.Path);
        }
    }

    [Theory]
    [InlineData("../Outside.png")]
    [InlineData("..\\outside.png")]
    [InlineData("../scene/../OUTSIDE.png")]
    public void Load_OfANameInAnotherCaseOutsideTheFolder_DoesNotFindIt(string name)
    {
        WritePngHeader("outside.png", 2, 2);
        _folder.Write("scene/a.mtl", $"newmtl m\nmap_Kd {name}\n");
        var path = _folder.Write("scene/a.obj", $"mtllib a.mtl\n{Triangle}usemtl m\nf 1 2 3\n");
        Assert.Null(MaterialOf(AssetLoader.Load(path)).Texture);
        Assert.Equal(_folder["outside.png"], MaterialOf(AssetLoader.Load(path, new() { AllowOutsideFiles = true })).Texture!.Path);
    }

    [Fact]
    public void Load_OfALinkToAFolderOutside_DoesNotListIt()
    {
        WritePngHeader("outside/wood.png", 2, 2);
        _folder.Write("scene/a.mtl", "newmtl m\nmap_Kd link/WOOD.png\n");
        Directory.CreateSymbolicLink(_folder["scene/link"], _folder["outside"]);
        var path = _folder.Write("scene/a.obj", $"mtllib a.mtl\n{Triangle}usemtl m\nf 1 2 3\n");
        Assert.Null(MaterialOf(AssetLoader.Load(path)).Texture);
    }

    [Theory]
    [InlineData("a.mtl")]
    [InlineData("A.MTL")]
    public void Load_OfAMeshThatNamesNoMaterialFile_TriesItsOwnName(string file)
    {
        _folder.Write(file, "newmtl red\n");
        var loaded = Load("usemtl red\nf 1 2 3\n");
        Assert.Empty(loaded.Warnings);
        Assert.Equal("red", MaterialOf(loaded).Name);
    }

    [Fact]
    public void Load_OfAMeshThatNamesNoMaterialFile_WithoutOne_IsSilent()
    {
        var loaded = Load("usemtl red\nf 1 2 3\n");
        Assert.Empty(loaded.Warnings);
        Assert.Empty(loaded.Scene.Objects[0].Model.Materials);
    }

    [Fact]
    public void Load_OfTexturesThatAreNotDrawn_FindsThemOrForgetsThem()
    {
        WritePngHeader("images/heights.png", 2, 2);
        _folder.Write("images/glow.png", "any file");
        _folder.Write("a.mtl", "newmtl m\nmap_Bump Images\\Heights.png\nPr 0.5\nmap_Ke images/glow.png\nnewmtl other\nmap_Ke gone.png\n");
        var loaded = Load("mtllib a.mtl\nusemtl m\nf 1 2 3\n");
        Assert.Equal(
            new Material("m")
            {
                BumpTexture = new(_folder["images/heights.png"]),
                EmissionTexture = new(_folder["images/glow.png"]),
                Roughness = 0.5,
            },
            MaterialOf(loaded));
        Assert.Equal("map_Ke is kept but not shown (2 such statements in all)", Assert.Single(loaded.Warnings).Message);
    }

    [Theory]
    [InlineData("map_Bump", 8193, 1, "the image \"a.png\" has 8193×1 pixels, more than the limit of 8192 per side")]
    [InlineData("norm", 8193, 1, "the image \"a.png\" has 8193×1 pixels, more than the limit of 8192 per side")]
    [InlineData("bump", 0, 5, "\"a.png\" is not a PNG, JPEG, BMP or TGA image")]
    [InlineData("norm -clamp on", null, null, "the file \"a.png\" is not found")]
    [InlineData("map_bump -bm 2", null, null, "the file \"a.png\" is not found")]
    public void Load_WithABumpOrNormalMapThatCantBeUsed_WarnsAndIsSmooth(string statement, int? width, int? height, string message)
    {
        if (width is not null && height is not null)
        {
            WritePngHeader("a.png", (uint)width, (uint)height);
        }

        AssertMapIsRefused(statement, message);
    }

    [SkippableTheory]
    [InlineData("map_Bump")]
    [InlineData("norm")]
    public void Load_WithAPipeForABumpOrNormalMap_DoesNotWait(string statement)
    {
        Elsewhere.SkipOnWindows("there are no pipes in the file system");
        System.Diagnostics.Process.Start("mkfifo", _folder["a.png"]).WaitForExit();
        AssertMapIsRefused(statement, "\"a.png\" is empty, expected an image");
    }

    [Fact]
    public void Load_WithBumpAndNormalMaps_CountsTheirPixels()
    {
        foreach (var name in (string[])["a", "b", "c"])
        {
            WritePngHeader($"{name}.png", 8192, 8192, fileBytes: 8192 * 8192 / 8 / 1032);
        }

        _folder.Write("a.mtl", "newmtl m\nmap_Kd a.png\nmap_Bump b.png\nnorm c.png\n");
        var loaded = Load("mtllib a.mtl\nusemtl m\nf 1 2 3\n");
        Assert.Equal("with \"c.png\" all images have more than the limit of 134217728 pixels: shown without it",
            Assert.Single(loaded.Warnings).Message);
        Assert.Equal((true, true, false), MaterialOf(loaded) is { } material
            ? (material.Texture is not null, material.BumpTexture is not null, material.NormalTexture is not null)
            : default);
    }

    [Fact]
    public void Load_WithoutItsMaterialFile_WarnsOnceAndLoads()
    {
        var loaded = Load("mtllib gone.mtl\nmtllib gone too.mtl\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\n");
        Assert.Empty(loaded.Scene.Objects[0].Model.Materials);
        Assert.Equal("a.obj:1:8: warning: the file \"gone.mtl\" is not found (2 such files in all)\n  mtllib gone.mtl\n         ^",
            SingleWarning(loaded));
    }

    [Fact]
    public void Load_WithAMaterialThatNoFileDeclares_Warns()
    {
        _folder.Write("a.mtl", "newmtl red\n");
        Assert.Equal(
            "a.obj:7:8: warning: no material file declares \"blue\": drawn in the object's own colour\n  usemtl blue\n         ^",
            SingleWarning(Load("mtllib a.mtl\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\n", before: Triangle)));
    }

    [Theory]
    [InlineData("newmtl a\0b", "a.mtl:1:9: warning: the file is binary (it has a NUL byte), expected UTF-8 text")]
    [InlineData("\uFEFF\0", "a.mtl:1:1: warning: the file is binary (it has a NUL byte), expected UTF-8 text")]
    public void Load_WithAMaterialFileThatIsNoText_Warns(string text, string expected)
    {
        _folder.Write("a.mtl", text);
        Assert.Equal(expected, SingleWarning(Load("mtllib a.mtl\nusemtl red\nf 1 2 3\n")));
    }

    [Fact]
    public void Load_WithAMaterialFileBeyondTheLimit_Warns()
    {
        using (var stream = File.Create(_folder["a.mtl"]))
        {
            stream.SetLength(ParsingLimits.MaterialBytes.Value + 1);
        }

        Assert.Equal("a.mtl:1:1: warning: the file has 16777217 bytes, more than the limit of 16777216",
            SingleWarning(Load("mtllib a.mtl\nusemtl red\nf 1 2 3\n")));
    }

    [Fact]
    public void Load_WithAMissingImage_WarnsOnceAndIsGrey()
    {
        _folder.Write("a.mtl", "newmtl red\nKd 1 0.5 0\nmap_Kd gone.png\nnewmtl blue\nmap_Kd gone.png\n");
        var loaded = Load("mtllib a.mtl\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\n");
        Assert.Equal("a.mtl:3:8: warning: the file \"gone.png\" is not found: drawn grey\n  map_Kd gone.png\n         ^",
            SingleWarning(loaded));
        var materials = loaded.Scene.Objects[0].Model.Materials;
        Assert.Equal((new Colour(0.6, 0.3, 0), null), (materials["red"].Diffuse, materials["red"].Texture));
        Assert.Equal((new Colour(0.6, 0.6, 0.6), null), (materials["blue"].Diffuse, materials["blue"].Texture));
    }

    [Fact]
    public void Load_WithThousandsOfMissingImages_WarnsOfTwenty()
    {
        var names = Enumerable.Range(0, 3000).ToArray();
        _folder.Write("a.mtl", string.Concat(names.Select(name => $"newmtl m{name}\nmap_Kd {name}.png\n")));
        var loaded = Load("mtllib a.mtl\n" + string.Concat(names.Select(name => $"usemtl m{name}\nf 1 2 3\n")));
        Assert.Equal(20, loaded.Warnings.Length);
        Assert.Equal("the file \"19.png\" is not found: drawn grey; further unusable textures are not reported",
            loaded.Warnings[^1].Message);
        Assert.All(loaded.Scene.Objects[0].Model.Materials.Values, material => Assert.Null(material.Texture));
    }

    [Theory]
    [InlineData("no image", "\"a.png\" is not a PNG, JPEG, BMP or TGA image")]
    [InlineData("", "\"a.png\" is empty, expected an image")]
    public void Load_WithAFileThatIsNoImage_WarnsAndIsGrey(string contents, string message)
    {
        _folder.Write("a.png", contents);
        AssertImageIsRefused(message);
    }

    [SkippableFact]
    public void Load_WithAPipeForAnImage_DoesNotWait()
    {
        Elsewhere.SkipOnWindows("there are no pipes in the file system");
        System.Diagnostics.Process.Start("mkfifo", _folder["a.png"]).WaitForExit();
        AssertImageIsRefused("\"a.png\" is empty, expected an image");
    }

    [Theory]
    [InlineData(8193, 1, "the image \"a.png\" has 8193×1 pixels, more than the limit of 8192 per side")]
    [InlineData(4, 4_000_000_000, "the image \"a.png\" has 4×4000000000 pixels, more than the limit of 8192 per side")]
    [InlineData(0, 5, "\"a.png\" is not a PNG, JPEG, BMP or TGA image")]
    public void Load_WithAnImageBeyondTheLimit_WarnsAndIsGrey(uint width, uint height, string message)
    {
        WritePngHeader("a.png", width, height);
        AssertImageIsRefused(message);
    }

    [Theory]
    [InlineData("a.tga", 201_326_610, new byte[] { 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 32, 0, 32, 24, 0 })]
    [InlineData("a.tga", 3_145_763, new byte[] { 5, 1, 10, 0, 0, 4, 0, 24, 0, 0, 0, 0, 0, 32, 0, 32, 40, 0 })]
    [InlineData("a.bmp", 201_326_646, new byte[]
        { 0x42, 0x4D, 0, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40, 0, 0, 0, 0, 32, 0, 0, 0, 32, 0, 0, 1, 0, 24, 0, 0, 0, 0, 0 })]
    [InlineData("a.bmp", 4_182, new byte[]
        { 0x42, 0x4D, 0, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40, 0, 0, 0, 0, 32, 0, 0, 0, 32, 0, 0, 1, 0, 8, 0, 1, 0, 0, 0 })]
    [InlineData("a.jpg", 32_768, new byte[] { 0xFF, 0xD8, 0xFF, 0xC0, 0, 17, 8, 32, 0, 32, 0, 3, 1 })]
    [InlineData("a.png", 195_083, new byte[]
        { 0x89, 0x50, 0x4E, 0x47, 13, 10, 26, 10, 0, 0, 0, 13, 0x49, 0x48, 0x44, 0x52, 0, 0, 32, 0, 0, 0, 32, 0, 8, 2, 0, 0, 0 })]
    public void Load_WithAnImageThatItsFileCantHold_WarnsAndIsGrey(string name, int bytes, byte[] header)
    {
        File.WriteAllBytes(_folder[name], header);
        _folder.Write("a.mtl", $"newmtl m\nmap_Kd {name}\n");
        var warning = SingleWarning(Load("mtllib a.mtl\nusemtl m\nf 1 2 3\n"));
        Assert.Contains(
            $"the image \"{name}\" is cut off: 8192×8192 pixels need at least {bytes} bytes, and it has {header.Length}: drawn grey",
            warning, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(1, 0, 0, 2, new byte[] { 0, 1, 2, 0 }, null)]
    [InlineData(1, 0, 0, 2, new byte[] { 0, 1, 1, 0 }, null)]
    [InlineData(9, 0, 0, 2, new byte[] { 0x82, 1, 0, 7 }, null)]
    [InlineData(9, 0, 1, 2, new byte[] { 0x82, 1, 0, 7 }, "has a palette that begins with colour 1, expected 0")]
    [InlineData(1, 3, 0, 2, new byte[] { 9, 9, 9, 0, 1, 1, 0 }, null)]
    [InlineData(1, 0, 1, 2, new byte[] { 1, 1, 2, 1 }, "has a palette that begins with colour 1, expected 0")]
    public void Load_WithATgaPalette_TestsItsFirstColour(byte type, byte textBytes, byte first, byte colours, byte[] rest, string? fault)
    {
        // Four pixels of 8 bits; colours of 24 bits stand behind a text.
        byte[] header = [textBytes, 1, type, first, 0, colours, 0, 24, 0, 0, 0, 0, 2, 0, 2, 0, 8, 0];
        File.WriteAllBytes(_folder["a.tga"], [.. header, .. rest[..textBytes], .. new byte[3 * colours], .. rest[textBytes..]]);
        _folder.Write("a.mtl", "newmtl m\nmap_Kd a.tga\n");
        var loaded = Load("mtllib a.mtl\nusemtl m\nf 1 2 3\n");
        Assert.Equal(fault is null, MaterialOf(loaded).Texture is not null);
        if (fault is null)
        {
            Assert.Empty(loaded.Warnings);
            return;
        }

        Assert.Contains($"the image \"a.tga\" {fault}: drawn grey", SingleWarning(loaded), StringComparison.Ordinal);
    }

    [Fact]
    public void Load_WithAnImageFileBeyondTheLimit_WarnsAndIsGrey()
    {
        WritePngHeader("a.png", 1, 1);
        using (var stream = File.OpenWrite(_folder["a.png"]))
        {
            stream.SetLength(ParsingLimits.ImageBytes.Value + 1);
        }

        AssertImageIsRefused("the image \"a.png\" is larger than the limit of 67108864 bytes");
    }

    [Fact]
    public void Load_WithImagesBeyondTheTotalPixelLimit_OmitsTheLast()
    {
        var names = new[] { "a", "b", "c" };
        foreach (var name in names)
        {
            // What an image of one bit a pixel takes at least.
            WritePngHeader($"{name}.png", 8192, 8192, fileBytes: 8192 * 8192 / 8 / 1032);
        }

        _folder.Write("a.mtl", string.Concat(names.Select(name => $"newmtl {name}\nmap_Kd {name}.png\n")));
        var loaded = Load("mtllib a.mtl\n" + string.Concat(names.Select(name => $"usemtl {name}\nf 1 2 3\n")));
        Assert.Equal("with \"c.png\" all images have more than the limit of 134217728 pixels: drawn grey",
            Assert.Single(loaded.Warnings).Message);
        Assert.Equal(["a", "b"], loaded.Scene.Objects[0].Model.Materials.Where(item => item.Value.Texture is not null)
            .Select(item => item.Key).Order());
    }

    [Theory]
    [InlineData("mtllib ../outside.mtl")]
    [InlineData("mtllib inside.mtl")]
    public void Load_OfAFileOutsideTheFolder_IsNotReadUnlessAllowed(string library)
    {
        WritePngHeader("outside.png", 2, 2);
        _folder.Write("outside.mtl", "newmtl m\nmap_Kd outside.png\n");
        _folder.Write("scene/inside.mtl", "newmtl m\nmap_Kd ../outside.png\n");
        var path = _folder.Write("scene/a.obj", $"{library}\n{Triangle}usemtl m\nf 1 2 3\n");
        var loaded = AssetLoader.Load(path);
        Assert.Contains("lies outside the folder of the file that was opened: allow that with --allow-outside",
            Assert.Single(loaded.Warnings).Message, StringComparison.Ordinal);
        Assert.True(loaded.Scene.Objects[0].Model.Materials.GetValueOrDefault("m") is null or { Texture: null });
        var allowed = AssetLoader.Load(path, new() { AllowOutsideFiles = true });
        Assert.Empty(allowed.Warnings);
        Assert.Equal(_folder["outside.png"], MaterialOf(allowed).Texture!.Path);
    }

    [Theory]
    [InlineData("a.jpg", new byte[] { 0xFF, 0xD8, 0xFF, 0xE0, 0, 4, 1, 2, 0xFF, 0xFF, 0xC2, 0, 17, 8, 0x01, 0x02, 0x03, 0x04, 3, 1, 2, 3 },
        true)]
    [InlineData("a.jpg", new byte[] { 0xFF, 0xD8, 0xFF, 0xE0, 0, 4, 1, 2 }, false)]
    [InlineData("a.jpg", new byte[] { 0xFF, 0xD8, 0xFF, 0xC4, 0, 2, 1, 2, 3, 4, 5, 6, 7 }, false)]
    [InlineData("a.bmp", new byte[] { 0x42, 0x4D, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 40, 0, 0, 0, 9, 0, 0, 0, 0xF0, 0xFF, 0xFF, 0xFF },
        true)]
    [InlineData("a.bmp", new byte[] { 0x42, 0x4D, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 12, 0, 0, 0, 9, 0, 8, 0, 1, 0, 24, 0 }, true)]
    [InlineData("a.bmp", new byte[] { 0x42, 0x4D, 0 }, false)]
    [InlineData("a.tga", new byte[] { 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 5, 0, 6, 0, 24, 0 }, true)]
    [InlineData("a.tga", new byte[] { 0, 0, 7, 0, 0, 0, 0, 0, 0, 0, 0, 0, 5, 0, 6, 0, 24, 0 }, false)]
    [InlineData("a.raw", new byte[] { 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 5, 0, 6, 0, 24, 0 }, false)]
    public void Load_OfAnImageHeader_TellsImagesFromOtherFiles(string name, byte[] header, bool isImage)
    {
        File.WriteAllBytes(_folder[name], isImage ? [.. header, .. new byte[300]] : header);
        _folder.Write("a.mtl", $"newmtl m\nmap_Kd {name}\n");
        var loaded = Load("mtllib a.mtl\nusemtl m\nf 1 2 3\n");
        Assert.Equal(isImage, MaterialOf(loaded).Texture is not null);
        Assert.Equal(isImage, loaded.Warnings.IsEmpty);
    }

    [Theory]
    [InlineData("a.jpg", new byte[] { 0xFF, 0xD8, 0xFF, 0xC0, 0, 17, 8, 0x00, 0x01, 0x20, 0x01, 3, 1 }, "8193×1")]
    [InlineData("a.bmp", new byte[] { 0x42, 0x4D, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 40, 0, 0, 0, 9, 0, 0, 0, 0, 0, 0, 0x80 },
        "9×2147483648")]
    [InlineData("a.tga", new byte[] { 0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 6, 0, 24, 0 }, "65535×6")]
    public void Load_OfAnImageHeader_ReadsItsSize(string name, byte[] header, string size)
    {
        File.WriteAllBytes(_folder[name], header);
        _folder.Write("a.mtl", $"newmtl m\nmap_Kd {name}\n");
        Assert.Contains($" {size} ", SingleWarning(Load("mtllib a.mtl\nusemtl m\nf 1 2 3\n")), StringComparison.Ordinal);
    }

    private static Material MaterialOf(LoadedFile file) => Assert.Single(file.Scene.Objects[0].Model.Materials).Value;

    private LoadedFile Load(string text, string before = "") =>
        AssetLoader.Load(
            _folder.Write("a.obj", before.Length > 0
            ? before + text
            : text.Insert(text.IndexOf("usemtl", StringComparison.Ordinal), Triangle)));

    private string SingleWarning(LoadedFile file)
    {
        var warning = Assert.Single(file.Warnings);
        Assert.Equal(DiagnosticSeverity.Warning, warning.Severity);
        return (warning with { File = Path.GetFileName(warning.File) }).ToString();
    }

    private void AssertMapIsRefused(string statement, string message)
    {
        _folder.Write("a.mtl", $"newmtl m\n{statement} a.png\n");
        var loaded = Load("mtllib a.mtl\nusemtl m\nf 1 2 3\n");
        var warning = Assert.Single(loaded.Warnings);
        Assert.Equal($"{message}: shown without it", warning.Message);
        Assert.Equal((2, statement.Length + 2), (warning.Line, warning.Column));
        Assert.Equal(new Material("m"), MaterialOf(loaded));
    }

    private void AssertImageIsRefused(string message)
    {
        _folder.Write("a.mtl", "newmtl m\nmap_Kd a.png\n");
        var loaded = Load("mtllib a.mtl\nusemtl m\nf 1 2 3\n");
        Assert.Equal($"a.mtl:2:8: warning: {message}: drawn grey\n  map_Kd a.png\n         ^", SingleWarning(loaded));
        Assert.Null(MaterialOf(loaded).Texture);
    }

    /// <summary>Writes the first bytes of a PNG file, which hold its size.</summary>
    private void WritePngHeader(string name, uint width, uint height, int fileBytes = 29)
    {
        byte[] head = [0x89, (byte)'P', (byte)'N', (byte)'G', 0x0D, 0x0A, 0x1A, 0x0A, 0, 0, 0, 13, (byte)'I', (byte)'H', (byte)'D',
            (byte)'R', .. new byte[fileBytes - 16]];
        BinaryPrimitives.WriteUInt32BigEndian(head.AsSpan(16), width);
        BinaryPrimitives.WriteUInt32BigEndian(head.AsSpan(20), height);
        Directory.CreateDirectory(Path.GetDirectoryName(_folder[name])!);
        File.WriteAllBytes(_folder[name], head);
    }
}
