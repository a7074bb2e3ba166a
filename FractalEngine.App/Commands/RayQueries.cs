using System.Collections.Immutable;
using System.Diagnostics;
using System.Globalization;
using System.Text;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Rays;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Points;
using FractalEngine.Parsing.Text;

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
        var rays = RaysParser.Parse(StandardInput.IsNamedBy(raysPath)
            ? StandardInput.Read(raysPath, ParsingLimits.MaxPointsBytes)
            : SourceText.Read(raysPath, raysPath, ParsingLimits.MaxPointsBytes));
        QueryCommand.RequireReach(file, RayCaster.MaxCoordinate, "rays");
        var clock = Stopwatch.StartNew();
        var caster = new SceneRayCaster(file.Scene);
        var context = new QueryContext();
        var results = RayBatch.FindNearest(caster, rays.AsMemory(), context);
        if (rays.Length > 0)
        {
            WriteReportLine($"rays {rays.Length / clock.Elapsed.TotalSeconds:F0} a second");
            WriteReportLine($"face tests {(double)context.Statistics.FaceTests / rays.Length:F2} a ray");
            WriteReportLine($"bound tests {(double)context.Statistics.BoundTests / rays.Length:F2} a ray");
        }

        Console.Out.Write(json ? FormatJson(results) : FormatLines(results, header));
        return ExitCode.Done;
    }

    private static StringBuilder FormatLines(ImmutableArray<RayResult> results, bool header)
    {
        var text = new StringBuilder(header ? "distance x y z nx ny nz face\n" : "");
        foreach (var result in results)
        {
            text.Append(result.IsHit
                ? string.Create(
                    CultureInfo.InvariantCulture,
                    $"{result.Hit.Distance:R} {Format(result.Hit.Point, " ")} {Format(result.Hit.Normal, " ")} {result.Hit.FaceIndex}\n")
                : "none\n");
        }

        return text;
    }

    private static StringBuilder FormatJson(ImmutableArray<RayResult> results)
    {
        var text = new StringBuilder("[");
        for (var i = 0; i < results.Length; i++)
        {
            var (objectIndex, hit, path) = results[i];
            text.Append(i > 0 ? ",\n" : "").Append(results[i].IsHit
                ? string.Create(
                    CultureInfo.InvariantCulture,
                    $"{{\"distance\": {hit.Distance:R}, \"point\": [{Format(hit.Point, ", ")}], \"normal\": [{Format(hit.Normal, ", ")}], "
                    + $"\"front\": {(hit.IsFrontFace ? "true" : "false")}, \"face\": {hit.FaceIndex}, "
                    + $"\"barycentrics\": [{Format(hit.Barycentrics, ", ")}], \"object\": {objectIndex}, "
                    + $"\"instance\": [{string.Join(", ", path)}]}}")
                : "null");
        }

        return text.Append("]\n");
    }

    private static string Format(Vector vector, string separator) =>
        string.Create(CultureInfo.InvariantCulture, $"{vector.X:R}{separator}{vector.Y:R}{separator}{vector.Z:R}");

    private static void WriteReportLine(FormattableString line) => Console.Error.WriteLine(FormattableString.Invariant(line));
}
