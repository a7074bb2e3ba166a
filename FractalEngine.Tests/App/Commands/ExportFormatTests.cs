using FractalEngine.Core.Geometry;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests the options of <c>export</c> on files of formats other than OBJ, and what it says.</summary>
[Collection(ConsoleTests.Name)]
public sealed class ExportFormatTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("stl", "36096 faces, closed, 1.8 MB, ")]
    [InlineData("ply", "36096 faces, closed, ")]
    [InlineData("3mf", "1 object for 36,096 faces, closed, ")]
    [InlineData("obj", "36096 faces, closed, ")]
    public void Weld_OfASpongeOfCubes_ClosesIt(string ending, string told) =>
        Assert.StartsWith($"wrote out.{ending}: {told}", Export(0, ending, "menger-3", "--weld"), StringComparison.Ordinal);

    /// <summary>What is welded is one mesh, whatever number of instances it was made of.</summary>
    [Fact]
    public void Weld_OfTheLargestInstances_IsOneMesh() => Assert.StartsWith(
        "wrote out.3mf: 1 object for 36,096 faces, closed, ", Export(0, "3mf", "menger-3", "--weld", "--instances", "8000"),
        StringComparison.Ordinal);

    /// <summary>What a format can't hold is told, a line each; welding loses more.</summary>
    [Theory]
    [InlineData("ply", "textures are not written", "roughness, metal and glow of gradients are not written")]
    [InlineData("csv", "textures are not written", "roughness, metal and glow of gradients are not written")]
    [InlineData("obj", "roughness, metal and glow of gradients are not written")]
    [InlineData("glb", "roughness, metal and glow of gradients are not written")]
    [InlineData("ply --weld", "textures are not written", "roughness, metal and glow of gradients are not written",
        "colours of vertices are not written")]
    [InlineData("glb --weld", "textures are not written", "roughness, metal and glow of gradients are not written",
        "colours of vertices are not written")]
    public void Losses_OfAFormat_AreTold(string output, params string[] losses)
    {
        File.Copy(Repository.Full("assets/models/crate.png"), _folder["crate.png"]);
        _folder.Write("m.mtl", "newmtl Tiles\nmap_Kd crate.png\n");
        _folder.Write("tiles.fdo", "<$>. box material \"m.mtl\"\n");
        _folder.Write("row.fdo", "<$>. [((3, 0, 0), #, #)^0..3] box\n");
        _folder.Write("painted.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 2 0 0 0 1\nf 1 2 3\n");
        _folder.Write(
            "s.sdo",
            "c (0, 0, -5) # 60\nlight directional (0, -1, 0) (1, 1, 1) 1\no \"tiles.fdo\" #\no \"painted.obj\" ((0, 9, 0), #, #)\n"
            + "o \"row.fdo\" ((0, 5, 0), #, #) gradient height \"ember\" glow 0 1\n");
        string[] words = output.Split(' ');
        var (code, _, error) = AppInProcess.Run(_folder.Path, ["export", "s.sdo", "--output", $"out.{words[0]}", .. words[1..]]);
        Assert.Equal(0, code);
        Assert.Equal(losses.Select(loss => $"out.{words[0]}: warning: {loss}"), error.Trim().Split('\n')[1..]);
        if (words[0] == "glb")
        {
            var read = AssetLoader.Load(_folder["out.glb"]).Scene.Scene;
            Assert.NotNull(read.Camera);
            Assert.Single(read.Lights);
        }
    }

    /// <summary>Coordinates that floats round to one place make no shape.</summary>
    [Theory]
    [InlineData("stl", "1e-40", "0")]
    [InlineData("glb", "1e-40", "0")]
    [InlineData("stl", "1e-3", "1e6")]
    [InlineData("glb", "1e-3", "1e6")]
    public void Lengths_ThatFloatsCannotTell_AreTold(string ending, string scale, string distance)
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("s.sdo", $"o \"cube.obj\" (({distance}, 0, 0), #, ({scale}, {scale}, {scale}))\n");
        var (code, _, error) = AppInProcess.Run(_folder.Path, "export", "s.sdo", "--output", $"out.{ending}");
        Assert.Equal(0, code);
        Assert.Contains($"out.{ending}: warning: floats can't tell the parts of what is ", error, StringComparison.Ordinal);
        (code, _, error) = AppInProcess.Run(_folder.Path, "export", "cube.obj", "--output", $"out.{ending}");
        Assert.Equal((0, false), (code, error.Contains("floats", StringComparison.Ordinal)));
    }

    [Fact]
    public void Height_OfAnExport_IsThatOfTheFile()
    {
        Export(0, "stl", "menger-3", "--depth", "1", "--height", "80mm");
        var mesh = MeshFile.Read(_folder["out.stl"]);
        Assert.Equal(new(new(-40, -40, -40), new(40, 40, 40)), mesh.UsedBounds);
    }

    [Fact]
    public void Frame_OfAnObj_IsTheScenesUnlessOneIsChosen()
    {
        _folder.Write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        _folder.Write("scene.sdo", "o \"mesh.obj\" #\n");
        Assert.Equal(new(Vector(0, 0, 0), Vector(1, 2, 3)), Bounds());
        Assert.Equal(new(Vector(0, 0, -3), Vector(1, 2, 0)), Bounds("--handed", "right"));
        Assert.Equal(new(Vector(0, -3, 0), Vector(1, 0, 2)), Bounds("--up", "z"));
        Assert.Equal(new(Vector(0, 0, 0), Vector(10, 20, 30)), Bounds("--unit", "10mm"));
        Assert.Equal(new(Vector(0, 0, 0), Vector(0.5, 1, 1.5)), Bounds("--height", "1"));

        BoundingBox Bounds(params string[] options)
        {
            Assert.Equal(0, AppInProcess.Run(_folder.Path, ["export", "scene.sdo", "--output", "out.obj", .. options]).ExitCode);
            return MeshFile.Read(_folder["out.obj"]).UsedBounds;
        }
    }

    [Fact]
    public void Instances_OfAnInfiniteFractal_AreSoMany()
    {
        _folder.Write("line.fdo", "v 0.5 0 0\nv -0.5 0 0\nv 0.5 0.5 0.5\nx. box\nt.a. (a, #, 3)\nz<x>. [t.1, t.2] x\n<$>. z\n");
        var result = AppInProcess.Run(_folder.Path, "export", "line.fdo", "--output", "out.csv", "--instances", "100");
        Assert.Equal(0, result.ExitCode);
        Assert.StartsWith("wrote out.csv: 100 instances, ", result.Error, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("--unit and --height both say how long a scene unit is: choose one of them", "--unit", "1", "--height", "2")]
    [InlineData("--height: expected a number above 0", "--height", "0mm")]
    [InlineData("--unit: expected a number above 0", "--unit", "8cm")]
    public void Options_ThatMakeNoSense_AreRefused(string message, params string[] options)
    {
        Assert.StartsWith($"error: {message}", Export(2, "stl", "menger-3", options), StringComparison.Ordinal);
        Assert.Empty(Directory.GetFiles(_folder.Path));
    }

    [Fact]
    public void Limit_OfFaces_IsToldBeforeAnythingIsWritten()
    {
        var error = Export(3, "ply", "menger-3", "--limit", "95999");
        Assert.Contains("more faces than the limit of 95999", error, StringComparison.Ordinal);
        Assert.Empty(Directory.GetFiles(_folder.Path));
    }

    private static Core.Maths.Vector Vector(double x, double y, double z) => new(x, y, z);

    private string Export(int exitCode, string ending, string name, params string[] options)
    {
        var result = AppInProcess.Run(
            _folder.Path, ["export", Repository.Full($"assets/fractals/{name}.fdo"), "--output", $"out.{ending}", .. options]);
        Assert.Equal((exitCode, ""), (result.ExitCode, result.Output));
        return result.Error;
    }
}
