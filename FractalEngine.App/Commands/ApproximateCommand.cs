using System.CommandLine;
using System.Text;
using FractalEngine.App.Approximation;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core;
using FractalEngine.Core.Approximation;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Approximation;
using static System.FormattableString;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>approximate MODEL --output X.fdo</c>, which looks for a fractal that makes a mesh (paper §6.2).</summary>
internal sealed class ApproximateCommand
{
    private readonly SharedOptions _shared = new();
    private readonly ReportOptions _told = new();

    private readonly Option<string> _output = SharedOptions.OutputOption(
        ".fdo", "Fractal to write; its meshes get names that end in -base.obj or -part1.obj.");

    private readonly Option<int?> _maps = NumberOption.Integer("--maps", "K", 1, int.MaxValue, "The most maps that it may have.");

    private readonly Option<long?> _bytes = NumberOption.Integer(
        "--bytes", "B", 1, long.MaxValue,
        Invariant($"The most bytes of its files (default: any if it is exact, else {ApproximationSettings.DefaultBytes})."));

    private readonly Option<double?> _tolerance = NumberOption.Positive(
        "--tolerance", "T", "How far vertices may be from where maps put them, as a part of the diagonal (default: estimated).");

    private readonly Option<double?> _effort = NumberOption.Positive(
        "--effort", "E", "Budget of hypotheses for a damaged mesh (default: 1).");

    private readonly Option<double?> _seconds = NumberOption.Positive(
        "--seconds", "N", "End the search after that time, with the best so far (default: when it is done).");

    private readonly Option<string> _report = SharedOptions.FileOption("--report", ".json", "Also write what was measured, as JSON.");

    private readonly Option<string> _image = SharedOptions.FileOption(
        "--image", ".png", "Also draw the mesh, the fractal and their distance side by side.");

    private readonly Option<bool> _keepsPartial = SharedOptions.Flag(
        "--keep-partial", "Write the best so far where Ctrl+C ends the search.");

    public static Command Create()
    {
        var options = new ApproximateCommand();
        var command = new DocumentedCommand(
            "approximate", "Look for a fractal that makes the mesh FILE, exactly or better than a simplified mesh.",
            "approximate assets/fractals/menger-3.fdo --output out/found.fdo",
            "approximate out/menger.obj --output out/found.fdo --seconds 20 --report out/found.json --image out/found.png");
        options._shared.AddTo(command);
        SharedOptions.AddAll(
            command, options._output, options._maps, options._bytes, options._tolerance, options._effort, options._seconds,
            options._report, options._image, options._keepsPartial);
        options._told.AddTo(command);
        command.SetAction(options.Run);
        return command;
    }

    private int Run(ParseResult result)
    {
        var (path, output, seconds) = (result.GetRequiredValue(_shared.File), result.GetRequiredValue(_output), result.GetValue(_seconds));
        var (reportPath, imagePath) = (result.GetValue(_report), result.GetValue(_image));
        UsageException.ThrowIf(output == StandardInput.Name, "a fractal has several files, so --output can't be '-'");
        var told = _told.Begin(result);
        var file = told.Measure("load", () => ConsoleLoader.Load(path, _shared.LoadOptions(result)));
        foreach (var written in new[] { output, reportPath, imagePath }.OfType<string>())
        {
            InputFiles.Protect(written);
        }

        var mesh = file.Scene.Objects.Flatten(ApproximationLimits.Faces.Value);
        if (mesh.FaceCount == 0 || mesh.UsedBounds.Diagonal == 0)
        {
            throw new UsageException($"{path} has no faces, so there is nothing to approximate");
        }

        var settings = new ApproximationSettings
        {
            MaxMaps = result.GetValue(_maps),
            MaxBytes = result.GetValue(_bytes),
            Tolerance = result.GetValue(_tolerance),
            Effort = result.GetValue(_effort) ?? 1,
        };
        var run = new ApproximationRun(mesh, settings, told);
        var found = told.Measure("search", () => run.Find(seconds));
        var isInterrupted = run.End == ApproximationEnd.Interruption;
        if (run.End == ApproximationEnd.Time)
        {
            Console.Error.WriteLine(Invariant($"note: the search ended after {seconds} s, as --seconds says"));
        }

        if (found is not null && (!isInterrupted || result.GetValue(_keepsPartial)))
        {
            var text = new ApproximationText(mesh, found);
            Write(path, output, found, text, told);
            WriteReport(reportPath, text.ToJson(run.End), told);
            if (imagePath is not null)
            {
                var image = told.Measure("draw", () => ApproximationImage.Draw(mesh, found));
                OutputFile.Write(imagePath, stream => PngWriter.Write(image, stream));
                told.Written(imagePath, Invariant($"{image.Width}×{image.Height} pixels"));
            }
        }
        else if (!isInterrupted)
        {
            Console.WriteLine("NO FRACTAL: nothing was found in that time, and nothing is written");
        }

        return isInterrupted ? throw new OperationCanceledException("interrupted")
            : found is { Verdict: not ApproximationVerdict.NoFractal } ? ExitCode.Done : ExitCode.NoFractal;
    }

    private static void Write(string path, string output, ApproximationResult found, ApproximationText text, WrittenReport told)
    {
        var lines = text.Lines().ToArray();
        GrammarFile.Write(
            output, found.Grammar, found.Distance.Diagonal,
            [$"{DisplayText.Escape(Path.GetFileName(path))} as a fractal: {lines[0]}", .. lines[1..]]);
        foreach (var line in lines)
        {
            Console.WriteLine(line);
        }

        told.Written(output, Invariant($"{found.Made.FaceCount} faces"));
    }

    private static void WriteReport(string? path, string json, WrittenReport told)
    {
        if (path is not null)
        {
            OutputFile.Write(path, stream => stream.Write(Encoding.UTF8.GetBytes(json + "\n")));
            told.Written(path, "what was measured");
        }
    }
}
