using System.CommandLine;
using FractalEngine.App.Options;
using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Recorded;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Compares the settings and views that options stand for with what is recorded.</summary>
public class RecordedOptionTests
{
    [Fact]
    public void Settings_OfDrawingOptions_AreAsRecorded()
    {
        var draw = new DrawOptions();
        var command = new Command("draw");
        draw.AddTo(command);
        string[] options =
        [
            "", "--wireframe", "--grid", "--instances 7", "--instances 7 --detail 0", "--samples 0", "--samples 32", "--gather 9",
            "--detail 0", "--detail 1000", "--detail 2.5", "--shading vertex", "--shading pixel", "--no-shadows", "--no-ambient-occlusion",
            "--section 0,2,0,3", "--projection orthographic", "--projection perspective", "--resolution 30x20",
        ];
        string whole = Text("");
        RecordedText.Check("options-drawing.txt",
            options.Select(option => $"{option}: {(option.Length == 0 ? whole : Difference(whole, Text(option)))}"));

        string Text(string option)
        {
            var result = command.Parse(option);
            Assert.Empty(result.Errors);
            return $"{Description.Of(draw.Settings(result))} {draw.Resolution(result)} {draw.Projection(result)} "
                + Description.Of(draw.Section(result));
        }
    }

    [Fact]
    public void Views_OfCameraOptions_AreAsRecorded()
    {
        var options = new CameraOptions();
        var command = new Command("draw");
        options.AddTo(command);
        var lines = new List<string>();
        foreach (string file in (string[])["assets/models/crate.obj", "assets/scenes/textured.sdo", "assets/scenes/orthographic.sdo"])
        {
            var scene = AssetLoader.Load(Repository.Full(file)).Scene;
            foreach (string[] arguments in (string[][])[
                [], ["--zoom", "2.5"], ["--camera", "(1, 2, 3) (0.1, 0.2, 0.3) 45"], ["--camera", "(1, 2, 3) look-at (0, 0, 0) 45"],
                ["--look-from", "(1, 2, -3)"], ["--look-at", "(0.5, 0, 0)"], ["--look-from", "(1, 2, -3)", "--look-at", "(0.5, 0, 0)"],
                ["--look-from", "(1, 2, -3)", "--up", "(1, 0, 0)"], ["--view", "front"], ["--view", "right"], ["--view", "top"],
                ["--view", "back"], ["--view", "left"], ["--view", "bottom"], ["--view", "isometric"]])
            {
                var result = command.Parse(arguments);
                lines.Add($"{Path.GetFileName(file)} {string.Join(' ', arguments)}: {options.IsGiven(result)} "
                    + $"{Description.Of(options.Zoom(result))} "
                    + Description.Of(options.View(result, scene, arguments is ["--view", "isometric"] && file.EndsWith(".sdo",
                        StringComparison.Ordinal), 1.5)));
            }
        }

        RecordedText.Check("options-camera.txt", lines);
    }

    // What one text has in other words than another.
    private static string Difference(string whole, string text) =>
        string.Join(' ', text.Split(' ').Except(whole.Split(' '))) + " without " + string.Join(' ',
            whole.Split(' ').Except(text.Split(' ')));
}
