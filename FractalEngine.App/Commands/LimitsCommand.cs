using System.CommandLine;
using FractalEngine.App.Animation;
using FractalEngine.App.Jobs;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.Core;
using FractalEngine.Core.Approximation;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Physics;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Cameras;
using static System.FormattableString;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>limits</c>, which lists all limits that <c>--limit</c> changes.</summary>
internal static class LimitsCommand
{
    /// <summary>All limits, those of fractals first.</summary>
    public static IEnumerable<Limit> All => [.. FractalLimits.All, .. ApproximationLimits.All, .. ParsingLimits.All, .. PhysicsLimits.All];

    public static Command Create()
    {
        var command = new DocumentedCommand(
            "limits", "List all limits with their values, what they count, and why they are there.",
            "limits", "limits --limit depth=1000");
        command.SetAction(static _ => Run());
        return command;
    }

    /// <summary>The largest values of options, which <c>--limit</c> does not change.</summary>
    private static IEnumerable<(string Option, double Value, string Reason)> OfOptions =>
    [
        ("--zoom", CameraZoom.MaxLevels, "levels that an image flies into a fractal: each takes some frames to find the way"),
        ("--time", SharedOptions.MaxTime, "seconds simulated before an image: minutes of work"),
        ("--frames", AnimationJob.MaxFrameCount, "frames of an animation: their numbers have a fixed width"),
        ("--fps", AnimateCommand.MaxFramesPerSecond, "frames a second: an animated PNG has times of 16 bits"),
        ("--resolution", SharedOptions.MaxImageSide, "pixels along a side of an image: drivers allow less, and say so"),
        ("--samples", DrawOptions.MaxSamples, "samples of each drawn pixel: drivers allow less, and give what they have"),
        ("--gather", DrawOptions.MaxGatheredFrames, "frames whose mean is an image: more change nothing that 8 bits show"),
        ("--instances", DrawOptions.MaxInstances, "instances in a frame: 48 bytes each on the GPU"),
        ("--detail", DrawOptions.MaxDetail, "pixels of a proxy: as large as the frame"),
        ("--trace", TraceOptions.MaxSamples, "samples of each traced pixel: days of work"),
        ("--trace (pixels)", TracedImage.MaxDenoisedPixels, "pixels of a traced image: 2.06 GiB"),
        ("--no-denoise (pixels)", TracedImage.MaxPixels, "pixels of a traced image with its noise: 1.75 GiB"),
        (".exr, .hdr (pixels)", LightFormat.MaxPixels, "pixels of an image of light, or a .png of 16 bits: 2.75 GiB"),
        ("--layers (pixels)", LightFormat.MaxLayeredPixels, "pixels of an image with layers beside its colour: 1.6 GiB"),
        ("--seconds / --step", SimulateCommand.MaxSteps, "steps of a simulation: hours, and gigabytes of text"),
        ("--trail", ViewCommand.MaxTrailLength, "levels of the trail of the paper's zoom: each is drawn"),
        ("--haze", SkyCommand.MaxHaze, "times the haze of a clear day: nothing more is seen"),
        ("--faces", MeshGenerators.MaxFaceCount, "faces of a generated mesh: memory"),
    ];

    private static int Run()
    {
        foreach (var limit in All)
        {
            Console.WriteLine(Invariant($"{limit.Name,-22}{limit.Value,13}  {limit.Subject}: {limit.Reason}"));
        }

        Console.WriteLine("Of options, not changed by --limit:");
        foreach (var (option, value, reason) in OfOptions)
        {
            Console.WriteLine(Invariant($"{option,-22}{value,13}  {reason}"));
        }

        return ExitCode.Done;
    }
}
