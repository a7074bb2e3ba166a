using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Animation;

/// <summary>Tests the frames of films: those of still images, with the same bits, and the mean of many where the shutter is open.</summary>
[Collection(ConsoleTests.Name)]
public sealed class FilmFramesTests : DrawingCommandTests
{
    private static readonly string[] Traced = ["--trace", "2"];

    public FilmFramesTests()
    {
        Folder.Write(
            "arms.fdo", "lean = 10 from 0 to 90\nsize = 0.5\na. ((0, 1, 0), (0, 0, lean), (size))\nz<box>. [#, a.] box\n<$>. z 3\n");
        Folder.Write(
            "film.sdo",
            """
            c (0, 0, -9) # 60
            film 1
            o "arms.fdo" #
            o "cube.obj" ((2, 0, 0), #, #)
            at 0 c (0, 1, -5) look-at (0, 0.5, 0) 60
            at 1 c (4, 1, -3) look-at (0, 0.5, 0) 50 ease in-out
            at 0.25 lean = 30
            at 0.75 lean = 50 ease hold

            """);
    }

    /// <summary>A frame of the film is the still image at its time, and that of the file with the numbers of the film.</summary>
    [SkippableTheory]
    [InlineData(false)]
    [InlineData(true)]
    public void Animate_AFilm_HasTheBitsOfStillImages(bool isTraced)
    {
        string[] how = isTraced ? Traced : [];
        if (!isTraced)
        {
            Display.Require();
        }

        Animate("film.sdo", [.. how, "--fps", "4"]);
        Assert.Equal(4, Directory.GetFiles(Folder.Path, "f-*.png").Length);
        foreach (int frame in isTraced ? [0, 2, 3] : (int[])[0, 3])
        {
            string time = FormattableString.Invariant($"{frame / 4.0}");
            Assert.Equal(Still("film.sdo", [.. how, "--time", time]), Pixels($"f-000{frame + 1}.png"));
        }

        if (!isTraced)
        {
            return;
        }

        // At rest: the camera of the file, and its numbers.
        Folder.Write("rest.sdo", "c (0, 0, -9) # 60\no \"arms.fdo\" #\no \"cube.obj\" ((2, 0, 0), #, #)\n");
        Assert.Equal(Still("rest.sdo", how), Still("film.sdo", how));
        // The first camera, and the number that is held until 0.75 seconds, then the next one.
        Folder.Write(
            "first.sdo", "c (0, 1, -5) look-at (0, 0.5, 0) 60\no \"arms.fdo\" #\no \"cube.obj\" ((2, 0, 0), #, #)\n");
        Assert.Equal(Still("first.sdo", [.. how, "--set", "lean=30"]), Pixels("f-0001.png"));
        const string camera = "(0, 0, -6) # 60";
        Animate("film.sdo", [.. how, "--fps", "4", "--camera", camera, "--set", "size=0.6"]);
        Assert.Equal(Pixels("f-0001.png"), Pixels("f-0003.png"));
        Assert.Equal(
            Still("rest.sdo", [.. how, "--camera", camera, "--set", "lean=50", "--set", "size=0.6"]), Pixels("f-0004.png"));
    }

    /// <summary>
    /// A plate, 24 pixels wide, passes 16 pixels while the shutter is open: of 16 images each one moves it by a pixel. The light of a pixel
    /// is the part of them in which it is covered, a trapezoid.
    /// </summary>
    [SkippableFact]
    public void Shutter_OverAMovingPlate_IsATrapezoidInLinearLight()
    {
        Display.Require();
        Folder.Write(
            "plate.sdo",
            """
            background (0, 0, 0)
            projection orthographic 2
            light ambient (1, 1, 1)
            o "cube.obj" ((0.0625, 0, 0), #, (3, 8, 1)) colour (1, 1, 1)
            film 1
            at 0 c (0, 0, -5) # 60
            at 1 c (2, 0, -5) # 60

            """);
        Animate(
            "plate.sdo", "--fps", "1", "--shutter", "1", "--gather", "16", "--resolution", "64x16", "--no-ambient-occlusion",
            "--no-shadows");
        var image = ReadImage("f-0001.png");
        for (int x = 0; x < 64; x++)
        {
            double light = Enumerable.Range(0, 16).Count(part => x + part is >= 20 and < 44) / 16.0;
            double expected = 255 * new Colour(light, light, light).FromLinear().Red;
            // Half of a stored value by rounding, and a little more since it is rounded in linear light.
            Assert.Equal(expected, image[x, 8].Red, 0.6);
        }
    }

    /// <summary>A white plate of light 1 is as bright as it is opaque, and so is the mean of images in which it moves.</summary>
    [SkippableFact]
    public void Shutter_BeforeATransparentBackground_TakesTheMeanOfOpacityToo()
    {
        Display.Require();
        Folder.Write(
            "plate.sdo",
            """
            projection orthographic 2
            light ambient (1, 1, 1)
            o "cube.obj" ((0.0625, 0, 0), #, (3, 8, 1)) colour (1, 1, 1)
            film 1
            at 0 c (0, 0, -5) # 60
            at 1 c (2, 0, -5) # 60

            """);
        var (exitCode, _, error) = Run(
            "animate", "plate.sdo", "--fps", "1", "--shutter", "1", "--gather", "16", "--resolution", "64x16", "--no-ambient-occlusion",
            "--no-shadows", "--background", "transparent", "--output", "f.exr");
        Assert.True(exitCode == 0, error);
        var image = new PlainExr(File.ReadAllBytes(Folder["f-0001.exr"]));
        Assert.Contains(image["A"], static opacity => opacity is > 0.2f and < 0.8f);
        // Rounded to numbers of 16 bits.
        Assert.All(image["A"].Zip(image["R"]), static pair => Assert.Equal(pair.First, pair.Second, 0.002f));
    }

    /// <summary>Layers show the numbers of a frame's own time, as its light does.</summary>
    [SkippableFact]
    public void Animate_LayersOfAFilm_AreThoseOfStillImages()
    {
        Display.Require();
        string[] how = ["--resolution", "24x16", "--layers", "depth"];
        var (exitCode, _, error) = Run(["animate", "film.sdo", .. how, "--fps", "4", "--output", "f.exr"]);
        Assert.True(exitCode == 0, error);
        (exitCode, _, error) = Run(["render", "film.sdo", .. how, "--time", "0.75", "--output", "a.exr"]);
        Assert.True(exitCode == 0, error);
        Assert.Equal(File.ReadAllBytes(Folder["a.exr"]), File.ReadAllBytes(Folder["f-0004.exr"]));
    }

    [Fact]
    public void Mean_OfImages_IsTakenInLightAndByOpacity()
    {
        var mean = new ImageMean(2, 1);
        mean.Add(new(2, 1, [255, 0, 37, 255, 200, 100, 0, 255]));
        mean.Add(new(2, 1, [0, 0, 37, 255, 9, 9, 9, 0]));
        // Half of the light of 255 is 188 in sRGB (IEC 61966-2-1). What is transparent has no colour.
        Assert.Equal([188, 0, 37, 255, 200, 100, 0, 128], mean.ToImage().Pixels);
        Assert.Throws<ArgumentException>(() => mean.Add(new PixelImage(1, 1, [0, 0, 0, 0])));
        Assert.Throws<InvalidOperationException>(() => new ImageMean(1, 1).ToImage());
    }

    [Fact]
    public void Shutter_OverWhatStands_IsTheStillImage()
    {
        Folder.Write("still.sdo", "film 1\no \"cube.obj\" #\nat 0 c (0, 1, -3) look-at (0, 0, 0) 60\n");
        Animate("still.sdo", "--frames", "1", "--shutter", "0.5", "--trace", "16", "--no-denoise");
        var blurred = Pixels("f-0001.png");
        // Sixteen images of one sample each, with other noise than one of sixteen.
        double difference = Still("still.sdo", "--time", "0", "--trace", "16", "--no-denoise").Zip(blurred)
            .Average(static pair => Math.Abs(pair.First - pair.Second));
        Assert.InRange(difference, 0, 3);
        // No image has fewer than one.
        Animate("still.sdo", "--frames", "1", "--shutter", "0.5", "--trace", "2", "--no-denoise");
        Assert.Equal(blurred, Pixels("f-0001.png"));
    }

    [Theory]
    [InlineData("at 0.5 leam = 3", "film.sdo:9:1: error: no fractal of the scene declares a number 'leam': did you mean 'lean'?\n"
        + "  at 0.5 leam = 3\n  ^\n", 1)]
    [InlineData("p \"cube.obj\" # 1", "error: film.sdo has physics objects, which can't move while the film changes numbers\n", 2)]
    public void Render_AFaultyFilm_SaysWhy(string line, string message, int exitCode)
    {
        File.AppendAllText(Folder["film.sdo"], line + "\n");
        Assert.Equal(new AppResult(exitCode, "", message), Run("render", "film.sdo", "--time", "0.5", "--trace", "1", "--output", "a.png"));
    }

    [Fact]
    public void Animate_ATooLongFilm_AsksForFewerFrames()
    {
        Folder.Write("long.sdo", "film 3600\no \"cube.obj\" #\n");
        Assert.Equal(
            new AppResult(2, "", "error: the film has more than the limit of 100000 frames: expected a smaller --fps, or --frames\n"),
            Run("animate", "long.sdo", "--output", "f.png", "--fps", "60"));
    }

    private void Animate(string file, params string[] options)
    {
        string[] size = options.Contains("--resolution") ? [] : ["--resolution", "24x16"];
        var (exitCode, _, error) = Run(["animate", file, "--output", "f.png", .. size, .. options]);
        Assert.True(exitCode == 0, error);
    }

    private byte[] Still(string file, params string[] options)
    {
        var (exitCode, _, error) = Run(["render", file, "--output", "a.png", "--resolution", "24x16", .. options]);
        Assert.True(exitCode == 0, error);
        return Pixels("a.png");
    }
}
