using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Lights;
using FractalEngine.Tests.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests outputs of <c>render</c> with more than 8 bits. A plain reader reads the files.</summary>
[Collection(ConsoleTests.Name)]
public sealed class LightOutputTests : DrawingCommandTests
{
    private const string Shown = "exposure 1.5\ntone filmic\nlight ambient (1, 1, 1) 0.7\nlight directional (0.3, -0.5, 1) (1, 1, 1) 3\n";

    public LightOutputTests() => Folder.Write(
        "shown.sdo", $"background (0.2, 0.4, 0.9)\no \"cube.obj\" # colour (1, 0.5, 0.1)\nc (1, 1.5, -3) look-at (0, 0, 0) 60\n{Shown}");

    [SkippableTheory]
    [InlineData(false)]
    [InlineData(true)]
    public void Render_OfLight_IsShownAsTheImageOf8Bits(bool isTraced)
    {
        string[] options = isTraced ? ["--trace", "4"] : ["--samples", "0"];
        Render("shown.sdo", "a.png", options);
        Render("shown.sdo", "a.exr", [.. options, "--bits", "32"]);
        Render("shown.sdo", "deep.png", [.. options, "--bits", "16"]);
        Render("shown.sdo", "a.hdr", options);
        var (shown, deep) = (ReadImage("a.png"), ReadImage("deep.png"));
        var exr = new PlainExr(File.ReadAllBytes(Folder["a.exr"]));
        var hdr = RadianceFile.Read(File.ReadAllBytes(Folder["a.hdr"]), 1 << 20);
        Assert.Equal(["B", "G", "R"], exr.Channels.Select(channel => channel.Name));
        var display = new DisplayTransform(1.5, Tone.Filmic);
        for (var i = 0; i < 64 * 64; i++)
        {
            var light = hdr[i % 64, i / 64];
            double[] lights = [light.X, light.Y, light.Z];
            for (var channel = 0; channel < 3; channel++)
            {
                var stored = exr["RGB"[channel].ToString()][i];
                var seen = display.Apply(new(stored, 0, 0)).X;
                var srgb = 255 * new Colour(seen, 0, 0).FromLinear().Red;
                // Rounded and, by some drivers, from a table.
                Assert.InRange(shown.Pixels[(4 * i) + channel] - srgb, -1.5, 1.5);
                Assert.InRange(deep.Pixels[(4 * i) + channel] - srgb, -1, 1);
                Assert.InRange(lights[channel] - stored, -0.005 * Math.Max(light.X, Math.Max(light.Y, light.Z)) - 1e-6, 0.005 * 10);
            }
        }
    }

    [SkippableFact]
    public void Render_OfLayers_HasTheirClosedForms()
    {
        const string layers = "samples,level, position,depth,normal,albedo,colour";
        Render("scene.sdo", "a.exr", "--trace", "3", "--layers", layers);
        var exr = new PlainExr(File.ReadAllBytes(Folder["a.exr"]));
        Assert.Equal(
            ["B", "G", "R", "Z", "albedo.B", "albedo.G", "albedo.R", "level.X", "normal.X", "normal.Y", "normal.Z", "position.X",
                "position.Y", "position.Z", "samples.X"], exr.Channels.Select(channel => channel.Name));
        Assert.Equal(["B", "G", "R", "albedo.B", "albedo.G", "albedo.R", "normal.X", "normal.Y", "normal.Z"],
            exr.Channels.Where(channel => channel.IsHalf).Select(channel => channel.Name));
        var front = exr["position.Z"][(32 * 64) + 32];
        for (var y = 0; y < 64; y++)
        {
            for (var x = 0; x < 64; x++)
            {
                var i = (y * 64) + x;
                Assert.Equal(3, exr["samples.X"][i]);
                // The camera looks along z, from 3 before the middle, with half a height of tan 30° at unit depth.
                var depth = front + 3;
                var (right, up) = ((x - 31.5) / 32 * Math.Tan(Math.PI / 6) * depth, (31.5 - y) / 32 * Math.Tan(Math.PI / 6) * depth);
                var isFace = Math.Max(Math.Abs(right), Math.Abs(up)) < -front;
                Assert.Equal(isFace ? 0 : -1, exr["level.X"][i]);
                Assert.Equal(isFace ? depth : float.PositiveInfinity, exr["Z"][i]);
                if (isFace)
                {
                    Assert.InRange(exr["position.X"][i] - right, -1e-5, 1e-5);
                    Assert.InRange(exr["position.Y"][i] - up, -1e-5, 1e-5);
                }
            }
        }

        var middle = (32 * 64) + 32;
        Assert.Equal((1f, 0f, 0f), (exr["albedo.R"][middle], exr["albedo.G"][middle], exr["albedo.B"][middle]));
        Assert.Equal((0f, 0f, -1f), (exr["normal.X"][middle], exr["normal.Y"][middle], exr["normal.Z"][middle]));
        Assert.Equal((0f, 0f, 0f), (exr["albedo.R"][0], exr["normal.Z"][0], exr["position.Z"][0]));
    }

    [SkippableFact]
    public void Render_OfADrawnFractal_HasItsLevelsAndTheDepthsOfTheTracedOne()
    {
        Folder.Write(
            "three.fdo",
            "v 0.5 0 0\nv 0.5 0.5 0.5\nv -0.5 0 0\nt.a.b. (a, #, b)\nx. \"cube.obj\"\nz<x>. [t.1.2, t.3.2] x\n<$>. z 3\n");
        Render("three.fdo", "drawn.exr", "--layers", "level,depth", "--bits", "32");
        Render("three.fdo", "traced.exr", "--layers", "depth,level", "--trace", "1");
        var (drawn, traced) = (new PlainExr(File.ReadAllBytes(Folder["drawn.exr"])), new PlainExr(File.ReadAllBytes(Folder["traced.exr"])));
        Assert.Equal(["Z", "level.X"], drawn.Channels.Select(channel => channel.Name));
        Assert.Equal([-1f, 3f], drawn["level.X"].Distinct().Order());
        Assert.Equal(traced["Z"], drawn["Z"]);
    }

    [SkippableFact]
    public void Render_BeforeATransparentBackground_HasItsOpacity()
    {
        Render("shown.sdo", "a.png", "--background", "transparent");
        Render("shown.sdo", "a.exr", "--background", "transparent");
        Render("shown.sdo", "deep.png", "--background", "transparent", "--bits", "16");
        var (shown, deep) = (ReadImage("a.png"), ReadImage("deep.png"));
        var opacity = new PlainExr(File.ReadAllBytes(Folder["a.exr"]))["A"];
        Assert.Contains(opacity, value => value is > 0.2f and < 0.8f);
        for (var i = 0; i < opacity.Length; i++)
        {
            Assert.InRange(opacity[i] - (shown.Pixels[(4 * i) + 3] / 255f), -0.012, 0.012);
            Assert.InRange(opacity[i] - (deep.Pixels[(4 * i) + 3] / 255f), -0.005, 0.005);
        }
    }

    [SkippableFact]
    public void Animate_ToNumberedFilesOfLight_WritesEach()
    {
        var (exitCode, output, error) = Run(
            "animate", "scene.sdo", "--turntable", "--frames", "2", "--trace", "1", "-o", "f.exr", "--layers", "depth",
            "--resolution", "8x8");
        Assert.Equal((0, ""), (exitCode, output));
        Assert.Contains("f-0001.exr to f-0002.exr", error, StringComparison.Ordinal);
        Assert.All(new[] { "f-0001.exr", "f-0002.exr" }, name => Assert.Equal(
            ["Z"], new PlainExr(File.ReadAllBytes(Folder[name])).Channels.Select(channel => channel.Name)));
    }

    [Theory]
    [InlineData("--layers needs an --output that ends in .exr", "a.png", "--layers", "depth")]
    [InlineData("--layers 'hue': expected one of colour, albedo, normal, depth, position, level, samples", "a.exr", "--layers", "hue")]
    [InlineData("--layers samples: drawn images have none, expected --trace", "a.exr", "--layers", "depth,samples")]
    [InlineData("--bits has no effect on .hdr", "a.hdr", "--bits", "16")]
    [InlineData("--bits 32: .png has one of 8, 16", "a.png", "--bits", "32")]
    [InlineData("--bits 8: .exr has one of 16, 32", "a.exr", "--bits", "8")]
    [InlineData("an .hdr has no transparent background: expected .exr or .png", "a.hdr", "--background", "transparent")]
    [InlineData("--output 'a.gif' must end in .png or .exr or .hdr", "a.gif")]
    [InlineData(
        "an image of 5000×5000 pixels has more than the limit of 16777216 for --layers", "a.exr", "--layers", "depth", "--resolution",
        "5000x5000")]
    public void Render_WithOptionsThatDoNotFit_IsRefused(string message, string output, params string[] options)
    {
        var (exitCode, _, error) = Run(["render", "scene.sdo", "-o", output, .. options]);
        Assert.NotEqual(0, exitCode);
        Assert.Contains(message, error, StringComparison.Ordinal);
    }
}
