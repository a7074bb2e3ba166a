using System.CommandLine;
using FractalEngine.App.Options;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests that what a command can't do is said, with its reason, instead of being ignored.</summary>
[Collection(ConsoleTests.Name)]
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

    /// <summary>Of several objects the message tells which, whatever of the fractal is needed first.</summary>
    [Theory]
    [InlineData("render scene.sdo -o a.png --trace 1 --resolution 8x8", "")]
    [InlineData("render scene.sdo -o a.png --trace 1 --resolution 8x8", " gradient height \"ember\"")]
    [InlineData("render scene.sdo -o a.png --trace 1 --resolution 8x8", " gradient height \"ember\" glow 0 1")]
    [InlineData("query scene.sdo --points points.txt", "")]
    [InlineData("query scene.sdo --rays rays.txt", "")]
    public void Command_OfAFractalWithoutBounds_NamesTheFractal(string command, string gradient)
    {
        _folder.Write(
            "turns.fdo",
            "t. ((0, 0, 0.01), (0, 0, 37), (1, 0.9999, 1))\nu. ((0.01, 0, 0), (0, 20, 3), (0.9999, 1, 1))\nz<box>. [t., u.] box\n"
            + "<$>. z 9000\n");
        _folder.Write("scene.sdo", $"c (0, 0, -5) # 60\no \"cube.obj\" #\no \"turns.fdo\" #{gradient}\n");
        _folder.Write("points.txt", "1 2 3\n");
        _folder.Write("rays.txt", "0 0 -5 0 0 1\n");
        var (exitCode, _, error) = Run(command.Split(' '));
        Assert.Equal(3, exitCode);
        Assert.StartsWith("error: turns.fdo: exact search needs transformations that shrink", error, StringComparison.Ordinal);
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

    /// <summary>Every option that the other options or the file leave without effect, with the reason.</summary>
    [Theory]
    [InlineData("query cube.obj --rays r.txt --epsilon 1", "--collider, --within, --epsilon and --error-bound need --points")]
    [InlineData("query --epsilon 1 --rays r.txt cube.obj", "--collider, --within, --epsilon and --error-bound need --points")]
    [InlineData("query cube.obj --rays r.txt --collider exact", "--collider, --within, --epsilon and --error-bound need --points")]
    [InlineData("query cube.obj --rays r.txt --within 1", "--collider, --within, --epsilon and --error-bound need --points")]
    [InlineData("query cube.obj --rays r.txt --error-bound", "--collider, --within, --epsilon and --error-bound need --points")]
    [InlineData("query cube.obj --points r.txt --json --header", "--header names the columns of lines, and has no effect with --json")]
    [InlineData("query cube.obj --rays r.txt --json --header", "--header names the columns of lines, and has no effect with --json")]
    [InlineData("info cube.obj --composition affine", "cube.obj has no fractal, so --composition has no effect")]
    [InlineData("info drop.sdo --from-up z", "drop.sdo is a scene: --from-handed, --from-up and --from-unit are for a mesh or fractal")]
    [InlineData("simulate drop.sdo --composition affine", "drop.sdo has no fractal, so --composition has no effect")]
    [InlineData("export cube.obj -o a.obj --depth 3", "cube.obj has no recursive fractal, so --depth has no effect")]
    [InlineData("export cube.obj -o a.html --flat", "--flat has no effect on .html, which keeps levels and coordinates as they are")]
    [InlineData("export cube.obj -o a.HTML --up y", "--up has no effect on .html, which keeps levels and coordinates as they are")]
    [InlineData("export cube.obj -o a.html --unit 1mm --handed left",
        "--handed has no effect on .html, which keeps levels and coordinates as they are")]
    [InlineData("export cube.obj -o a.html --unit 2mm", "--unit has no effect on .html, which keeps levels and coordinates as they are")]
    [InlineData("export cube.obj -o a.html --height 2mm",
        "--height has no effect on .html, which keeps levels and coordinates as they are")]
    [InlineData("export cube.obj -o a.html --instances 2",
        "--instances has no effect on .html, which keeps levels and coordinates as they are")]
    [InlineData("export cube.obj -o a.csv --weld",
        "--weld makes one mesh, and so one row of .csv: choose another ending, or leave it out")]
    [InlineData("simulate drop.sdo --seconds 1 --every 61", "--every 61 is beyond the 60 steps, so nothing would be written")]
    [InlineData("generate icosphere -o a.obj --seed 1", "the mesh 'icosphere' has no random details, so --seed has no effect")]
    [InlineData("generate --seed 1 torus-knot -o a.obj", "the mesh 'torus-knot' has no random details, so --seed has no effect")]
    [InlineData("render cube.obj -o a.png --time 1", "cube.obj has no physics objects, so --time has no effect")]
    [InlineData("render cube.obj -o a.png --up (0,1,0)", "--up needs --look-from or --look-at")]
    [InlineData("render cube.obj -o a.png --view top --up (0,1,0)", "--up needs --look-from or --look-at")]
    [InlineData("render cube.obj -o a.png --keep-partial", "--keep-partial needs --trace")]
    [InlineData("render cube.obj -o a.png --no-denoise", "--no-denoise needs --trace")]
    [InlineData("render cube.obj -o a.png --trace 1 --gather 8", "--gather draws triangles, and has no effect with --trace")]
    [InlineData("render cube.obj -o a.png --trace 1 --samples 8", "--samples draws triangles, and has no effect with --trace")]
    [InlineData("render cube.obj -o a.png --trace 1 --detail 0", "--detail draws triangles, and has no effect with --trace")]
    [InlineData("render cube.obj -o a.png --trace 1 --instances 1", "--instances draws triangles, and has no effect with --trace")]
    [InlineData("render cube.obj -o a.png --trace 1 --grid", "--grid draws triangles, and has no effect with --trace")]
    [InlineData("render cube.obj -o a.png --trace 1 --no-shadows", "--no-shadows draws triangles, and has no effect with --trace")]
    [InlineData("render cube.obj -o a.png --trace 1 --shading vertex", "--shading vertex draws triangles, and has no effect with --trace")]
    [InlineData("render cube.obj -o a.png --trace 1 --no-ambient-occlusion",
        "--no-ambient-occlusion draws triangles, and has no effect with --trace")]
    [InlineData("render --no-ambient-occlusion --trace 1 cube.obj -o a.png",
        "--no-ambient-occlusion draws triangles, and has no effect with --trace")]
    [InlineData("animate cube.obj -o a.apng --turntable --trace 1 --wireframe",
        "--wireframe draws triangles, and has no effect with --trace")]
    [InlineData("view --detail 0 --no-ambient-occlusion cube.obj", "--no-ambient-occlusion has no effect with --detail 0")]
    [InlineData("render cube.obj -o a.png --wireframe --shading vertex", "--shading vertex has no effect with --wireframe")]
    [InlineData("render cube.obj -o a.png --wireframe --no-shadows", "--no-shadows has no effect with --wireframe")]
    [InlineData("render cube.obj -o a.png --wireframe --no-ambient-occlusion",
        "--no-ambient-occlusion has no effect with --wireframe")]
    [InlineData("render cube.obj -o a.png --shading vertex --no-shadows", "--no-shadows has no effect with --shading vertex")]
    [InlineData("render cube.obj -o a.png --shading vertex --no-ambient-occlusion",
        "--no-ambient-occlusion has no effect with --shading vertex")]
    [InlineData("animate cube.obj -o a.apng --turntable --seed 1", "nothing in cube.obj is by chance, so --seed has no effect")]
    [InlineData("animate cube.obj -o a.apng --turntable --time 1", "cube.obj has no physics objects, so --time has no effect")]
    [InlineData("animate cube.obj -o a.png --turntable --fps 5",
        "--fps has no effect on numbered images unless --simulate or a film moves something")]
    [InlineData("animate cube.obj -o a.apng --path c.txt --view top",
        "--camera, --view, --look-from, --look-at, --aperture and --focus have no effect with --path, which names the cameras")]
    public void Option_WithoutEffect_IsRefused(string arguments, string message)
    {
        _folder.Write("drop.sdo", "p \"cube.obj\" # 0.5\n");
        _folder.Write("r.txt", "0 0 -3 0 0 1\n");
        Assert.Equal(new AppResult(2, "", $"error: {message}\n"), Run(arguments.Split(' ')));
    }

    [Fact]
    public void Grid_OfTheCommandLine_HasTheAxes()
    {
        var draw = new DrawOptions();
        var command = new Command("draw");
        draw.AddTo(command);
        Assert.All((bool[])[true, false], isAsked =>
        {
            var settings = draw.Settings(command.Parse(isAsked ? "--grid" : ""));
            Assert.Equal((isAsked, isAsked), (settings.Grid, settings.Axes));
        });
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
                $"textures/a.png:1:1: warning: the texture can't be decoded, drawn grey: byte {png.Length / 2}: the file ends before ")
                + "the chunk IEND\n"),
            (exitCode, error));
    }

    // A window that opens by mistake would stay.
    private AppResult Run(params string[] arguments) =>
        arguments[0] == "view" ? AppProcess.Run(_folder.Path, arguments) : AppInProcess.Run(_folder.Path, arguments);
}
