using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests that what a command can't do is said, with its reason, instead of being ignored.</summary>
public sealed class RefusalTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public RefusalTests() => _folder.Write("cube.obj", SampleFiles.Cube);

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Limits_OfOptions_AreListedToo()
    {
        var output = Run("limits").Output;
        Assert.All(
            (string[])
            [
                "--zoom                         1000  ", "--time                         3600  ",
                "--fps                           655  ", "--samples                        32  ",
            ],
            line => Assert.Contains(line, output, StringComparison.Ordinal));
    }

    [Fact]
    public void Count_OfTheStandardInput_SaysThatItNeedsAFile()
    {
        var (exitCode, _, error) = Run("count", "-");
        Assert.Equal(
            (2, "error: count corrects a file, so it can't read the standard input: expected an OBJ file\n"), (exitCode, error));
    }

    /// <summary>Texts with the mark are saved with it, since the editor that wrote it may need it.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Save_OfASceneWithAByteOrderMark_KeepsIt(bool hasMark)
    {
        _folder.Write("scene.sdo", (hasMark ? "\uFEFF" : "") + "# ä\no \"cube.obj\" #\n");
        Assert.Equal(0, Run("save", "scene.sdo", "--output", "copy.sdo").ExitCode);
        Assert.Equal(File.ReadAllBytes(_folder["scene.sdo"]), File.ReadAllBytes(_folder["copy.sdo"]));
    }

    [Theory]
    [InlineData("0.9999", "0.9999", "shrink too slowly: its bounds still change after thousands of levels; give it a depth")]
    [InlineData("1", "1", "the infinite fractal has no bounds: its transformations don't shrink")]
    [InlineData("1.5", "0.5", "the infinite fractal has no bounds: its transformations don't shrink")]
    public void Info_OfAnInfiniteFractalWithoutBounds_SaysWhy(string scale1, string scale2, string reason)
    {
        _folder.Write(
            "infinite.fdo",
            $"v {scale1} {scale1} {scale1}\nv {scale2} {scale2} {scale2}\nv 1 0 0\nt.a.b. (a, #, b)\nx. \"cube.obj\"\n"
            + "z<x>. [#, t.3.1, t.3.2] x\n<$>. z\n");
        var (exitCode, _, error) = Run("info", "infinite.fdo");
        Assert.Equal(1, exitCode);
        Assert.Contains(reason, error, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("clip 1e-300 10")]
    [InlineData("clip 1 1e300")]
    public void Info_OfClipPlanesBeyondFloats_IsRefused(string line)
    {
        _folder.Write("clip.sdo", $"o \"cube.obj\" #\n{line}\n");
        var (exitCode, _, error) = Run("info", "clip.sdo");
        Assert.Equal(1, exitCode);
        Assert.StartsWith(
            "clip.sdo:2:6: error: clip planes lie between 1E-30 and 1E+30, since depths are drawn as floats", error,
            StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("--samples", "8")]
    [InlineData("--detail", "0")]
    [InlineData("--instances", "10")]
    [InlineData("--without", "frustum-culling")]
    public void Render_TracedWithAnOptionOfDrawing_IsRefused(string option, string value)
    {
        var (exitCode, _, error) = Run("render", "cube.obj", "--output", "a.png", "--trace", "1", option, value);
        Assert.Equal(
            (2, $"error: {option} draws triangles, and has no effect with --trace\n"), (exitCode, error));
    }

    [Fact]
    public void Animate_TracedWithAnOptionOfDrawing_IsRefused()
    {
        var (exitCode, _, error) = Run(
            "animate", "cube.obj", "--output", "a.apng", "--turntable", "--frames", "1", "--trace", "1", "--wireframe");
        Assert.Equal((2, "error: --wireframe draws triangles, and has no effect with --trace\n"), (exitCode, error));
    }

    /// <summary>Shown once, with the name that the user knows.</summary>
    [Fact]
    public void Render_TracedWithADamagedTexture_NamesItOnceAndBriefly()
    {
        _folder.Write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
        _folder.Write("m.mtl", "newmtl a\nmap_Kd textures/a.png\n");
        Directory.CreateDirectory(_folder["textures"]);
        var png = File.ReadAllBytes(Repository.Full("assets/models/crate.png"));
        File.WriteAllBytes(_folder["textures/a.png"], png[..(png.Length / 2)]);
        var (exitCode, _, error) = Run("render", "m.obj", "--output", "a.png", "--trace", "1", "--resolution", "8x8", "--quiet");
        Assert.Equal(
            (0, FormattableString.Invariant(
                $"textures/a.png:1:1: warning: the texture can't be decoded, drawn grey: byte {png.Length / 2}: the file ends within ")
                + "the chunk IDAT\n"),
            (exitCode, error));
    }

    private AppResult Run(params string[] arguments) => AppProcess.Run(_folder.Path, arguments);
}
