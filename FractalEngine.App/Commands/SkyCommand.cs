using System.CommandLine;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>sky --output X.hdr</c>, which writes the image of a clear day's sky.</summary>
internal static class SkyCommand
{
    /// <summary>Largest amount of haze, by that of a clear day.</summary>
    public const double MaxHaze = 100;

    public static Command Create()
    {
        var output = SharedOptions.OutputOption(".hdr", "Image to write.", isText: false);
        var height = NumberOption.Decimal("--sun-height", "DEGREES", -90, 90, "The sun's height above the horizon (default: 40).");
        var azimuth = NumberOption.Decimal(
            "--sun-azimuth", "DEGREES", -360, 360, "The sun's angle to the right of the middle of the image (default: 0).");
        var haze = NumberOption.Decimal("--haze", "N", 0, MaxHaze, "How hazy it is, by a clear day (default: 1).");
        var noSun = SharedOptions.Flag("--no-sun", "Leave out the sun's disc, and print a light that stands for it.");
        var resolution = SharedOptions.ResolutionOption("1024x512");
        var report = new ReportOptions();
        var command = new DocumentedCommand(
            "sky", "Compute the image of a clear day's sky, and print the lines by which a scene shows it.",
            "sky --sun-height 25 --sun-azimuth 60 --output out/field.hdr", "sky --haze 4 --no-sun --output out/haze.hdr")
        {
            output, height, azimuth, haze, noSun, resolution,
        };
        report.AddTo(command);
        command.SetAction(result => Run(
            new(result.GetValue(height) ?? 40, result.GetValue(azimuth) ?? 0, result.GetValue(haze) ?? 1), !result.GetValue(noSun),
            result.GetValue(resolution) ?? (1024, 512), result.GetRequiredValue(output), report.Begin(result)));
        return command;
    }

    private static int Run(ClearSky sky, bool hasSun, (int Width, int Height) size, string output, WrittenReport report)
    {
        UsageException.ThrowIf(
            (long)size.Width * size.Height > ParsingLimits.SkyPixels.Value,
            $"--resolution: the image of a sky has at most {ParsingLimits.SkyPixels.Value} pixels");
        var image = report.Measure("compute", () => sky.ToImage(size.Width, size.Height, hasSun));
        report.Measure("write", () => OutputFile.Write(output, stream => RadianceFile.Write(image, stream)));
        var scene = new Scene { Sky = new ImageSky(Path.GetFileName(output)), Lights = hasSun ? [] : [sky.ToLight()] };
        Console.Write(SceneWriter.Write(scene));
        report.Written(output, $"{size.Width}×{size.Height} pixels");
        return ExitCode.Done;
    }
}
