using System.CommandLine;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core;
using FractalEngine.Core.Approximation;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Distances;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using static System.FormattableString;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>approximate MODEL --output X.fdo</c>, which looks for a fractal that makes a mesh (paper §6.2).</summary>
internal static class ApproximateCommand
{
    // Vertices and surfaces within this part of the diagonal count as the same.
    private const double ExactTolerance = 1e-6;

    public static Command Create()
    {
        var shared = new SharedOptions();
        var output = SharedOptions.OutputOption(".fdo", "Fractal to write; its meshes get names that end in -base.obj or -part1.obj.");
        var seconds = NumberOption.Positive("--seconds", "N", "End the search after that time (default: when it is done).");
        var report = new ReportOptions();
        var command = new DocumentedCommand(
            "approximate", "Look for a fractal that makes the mesh FILE, and write it if it is exact.",
            "approximate assets/fractals/menger-3.fdo --output out/found.fdo",
            "approximate out/menger.obj --output out/found.fdo --seconds 20")
        {
            output, seconds,
        };
        shared.AddTo(command);
        report.AddTo(command);
        command.SetAction(result => Run(
            result.GetRequiredValue(shared.File), shared.LoadOptions(result), result.GetRequiredValue(output),
            result.GetValue(seconds), report.Begin(result)));
        return command;
    }

    private static int Run(string path, LoadOptions options, string output, double? seconds, WrittenReport report)
    {
        if (output == StandardInput.Name)
        {
            throw new UsageException("a fractal has several files, so --output can't be '-'");
        }

        var file = report.Measure("load", () => ConsoleLoader.Load(path, options));
        InputFiles.Protect(output);
        var mesh = file.Scene.Objects.Flatten(ApproximationLimits.Faces.Value);
        if (mesh.FaceCount == 0)
        {
            throw new UsageException($"{path} has no faces, so there is nothing to approximate");
        }

        var grammar = report.Measure("search", () => Search(mesh, seconds));
        if (grammar is null || Verify(mesh, grammar, report) is not var (vertexDistance, surfaceDistance))
        {
            Console.WriteLine(Invariant($"NO FRACTAL: nothing that makes all {mesh.FaceCount} faces was found"));
            return ExitCode.NoFractal;
        }

        var text = Describe(mesh, grammar, vertexDistance, surfaceDistance);
        GrammarFile.Write(
            output, grammar, mesh.UsedBounds.Diagonal, [$"{DisplayText.Escape(Path.GetFileName(path))} as a fractal: {text[0]}", text[1]]);
        Console.WriteLine(text[0]);
        Console.WriteLine(text[1]);
        report.Written(output, Invariant($"{mesh.FaceCount} faces"));
        return ExitCode.Done;
    }

    private static MeshGrammar? Search(Mesh mesh, double? seconds)
    {
        using var interruption = new InterruptSignal();
        using var limit = CancellationTokenSource.CreateLinkedTokenSource(interruption.Token);
        if (seconds is { } value)
        {
            limit.CancelAfter(TimeSpan.FromSeconds(Math.Min(value, int.MaxValue / 1000)));
        }

        try
        {
            return GrammarSearch.FindExact(mesh, limit.Token);
        }
        catch (OperationCanceledException)
        {
            interruption.ThrowIfRequested();
            Console.Error.WriteLine(Invariant($"note: the search ended after {seconds} s, as --seconds says"));
            return null;
        }
    }

    /// <summary>Expands the files as they are read back, and compares the result with the mesh; null where both differ.</summary>
    private static (double Vertices, double Surfaces)? Verify(Mesh mesh, MeshGrammar grammar, WrittenReport report)
    {
        var length = mesh.UsedBounds.Diagonal;
        var made = report.Measure("expand", () => ReadBack(grammar, length, 2L * mesh.FaceCount));
        if (made is null || VertexDistance.FindLargest(mesh, made, ExactTolerance * length) is not { } vertices)
        {
            return null;
        }

        // Below half of the tolerance there is nothing to distinguish.
        var settings = new SurfaceDistanceSettings { Resolution = 0.5 * ExactTolerance };
        var surfaces = report.Measure("compare", () => SurfaceDistance.Between(mesh, made, settings)).MaxDistance.Upper;
        return surfaces <= ExactTolerance * length ? (vertices / length, surfaces / length) : null;
    }

    /// <summary>Reads files back that stand in a folder for a while; null where the language refuses them, as nearly flat maps.</summary>
    private static Mesh? ReadBack(MeshGrammar grammar, double length, long maxFaces)
    {
        var folder = Directory.CreateTempSubdirectory("fractalengine");
        try
        {
            var path = Path.Combine(folder.FullName, "found.fdo");
            GrammarFile.Write(path, grammar, length, []);
            return FractalFile.Read(path).Flatten(maxFaces);
        }
        catch (FractalEngineException)
        {
            return null;
        }
        finally
        {
            folder.Delete(recursive: true);
        }
    }

    private static string[] Describe(Mesh mesh, MeshGrammar grammar, double vertexDistance, double surfaceDistance)
    {
        return
        [
            (grammar.IsRecursive ? "EXACT: " : "REPEATS: ")
                + Invariant($"{grammar.FaceCount} of {mesh.FaceCount} faces are left, with {grammar.MapCount} maps"),
            Invariant($"vertices are within {vertexDistance:0.0e+0} of the diagonal, surfaces within {surfaceDistance:0.0e+0}"),
        ];
    }
}
