using System.Diagnostics;
using System.Globalization;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Points;
using FractalEngine.Parsing.Text;
using static FractalEngine.App.Commands.QueryCommand;
using static FractalEngine.App.Shell.StandardStreams;

namespace FractalEngine.App.Commands;

/// <summary>The part of the command <c>query</c> that casts the rays of a list.</summary>
internal static class RayQueries
{
    /// <summary>Casts rays at a file, and prints what they hit.</summary>
    /// <param name="path">Path of the file.</param>
    /// <param name="options">Options for loading it.</param>
    /// <param name="raysPath">The list of rays.</param>
    /// <param name="json">True for a JSON array, false for lines.</param>
    /// <param name="header">True for a first line with the names of the columns.</param>
    public static int Run(string path, LoadOptions options, string raysPath, bool json, bool header)
    {
        StandardInput.RequireOnce(path, raysPath);
        var file = ConsoleLoader.Load(path, options);
        var rays = RaysParser.Parse(StandardInput.ReadOrFile(raysPath, ParsingLimits.PointsBytes.Value));
        RequireReach(file, RayCaster.MaxCoordinate, "rays");
        var clock = Stopwatch.StartNew();
        var caster = new SceneRayCaster(file.Scene);
        var context = new QueryContext();
        var results = BatchQuery.Run(rays, (ray, rayContext) => caster.FindNearest(ray, rayContext), context);
        if (rays.Length > 0)
        {
            WriteReportLine($"rays {rays.Length / clock.Elapsed.TotalSeconds:F0} a second");
            WriteReportLine($"face tests {(double)context.Statistics.FaceTests / rays.Length:F2} a ray");
            WriteReportLine($"bound tests {(double)context.Statistics.BoundTests / rays.Length:F2} a ray");
        }

        Console.Out.Write(FormatResults(
            results, json, header ? "distance x y z nx ny nz face\n" : "", static result => result is { } hit ? FormatLine(hit) : "none",
            result => result is { } hit ? FormatJson(file.Scene, hit) : "null"));
        return ExitCode.Done;
    }

    private static string FormatLine(RayHit hit) => string.Create(
        CultureInfo.InvariantCulture, $"{hit.Distance:R} {FormatVector(hit.Point, " ")} {FormatVector(hit.Normal, " ")} {hit.FaceIndex}");

    private static string FormatJson(LoadedScene scene, RayHit hit) => string.Create(
        CultureInfo.InvariantCulture,
        $"{{\"distance\": {hit.Distance:R}, \"point\": [{FormatVector(hit.Point, ", ")}], "
        + $"\"normal\": [{FormatVector(hit.Normal, ", ")}], \"front\": {(hit.IsFrontFace ? "true" : "false")}, "
        + $"\"face\": {hit.FaceIndex}, {FormatMesh(scene, hit.ObjectIndex, hit.MeshIndex)}"
        + $"\"barycentrics\": [{FormatVector(hit.Barycentrics, ", ")}], \"object\": {hit.ObjectIndex}, "
        + $"\"instance\": [{string.Join(", ", hit.InstancePath)}]}}");
}
